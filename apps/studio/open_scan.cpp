#include "open_scan.h"

namespace relievo::studio {

OpenScan::OpenScan(Input input, Scene scene) : input_(std::move(input)), scene_(std::move(scene)) {
  const std::shared_ptr<const CloudFile> first = scene_.models[0].file;
  if (is_one_file() && (!first->mesh.empty() || far_points(first->cloud).empty())) {
    cloud_ = {first, &first->cloud};
    return;
  }
  Cloud all;
  const auto places = place_models(scene_, {});
  for (std::size_t i = 0; places && i < places->size(); ++i) add(*scene_.models[i].file, (*places)[i], all);
  cloud_ = std::make_shared<const Cloud>(std::move(all));
}

bool OpenScan::is_one_file() const {
  return scene_.models.size() == 1 && scene_.models[0].pose == Pose{};
}

// Normals are kept as long as every model has some, colours likewise.
void OpenScan::add(const CloudFile& file, const PlacedModel& place, Cloud& all) {
  const bool is_mesh = !file.mesh.empty();
  const std::vector<Index> strays = is_mesh ? std::vector<Index>() : far_points(file.cloud);
  left_out_ += strays.size();
  const Cloud near = without(file.cloud, strays);
  const bool is_first = all.size() == 0;
  const bool has_normals = near.has_normals() && (is_first || all.has_normals());
  const bool has_colours = near.has_colours() && (is_first || all.has_colours());
  for (const Vec3& p : near.points) all.points.push_back(place(p));
  if (!has_normals) all.normals.clear();
  if (!has_colours) all.colours.clear();
  if (has_normals)
    for (const Vec3f& n : near.normals) all.normals.push_back(place.turn.cast<float>() * n);
  if (has_colours) all.colours.insert(all.colours.end(), near.colours.begin(), near.colours.end());
}

Result<std::shared_ptr<const Cloud>> OpenScan::seen_from(const View& view) const {
  if (is_one_file() && scene_.models[0].file->mesh.empty()) return cloud_;
  Result<SeenPoints> seen = seen_points(scene_, view, ReliefOptions{}.points);
  if (!seen) return std::unexpected(seen.error());
  return seen->cloud;
}

}  // namespace relievo::studio
