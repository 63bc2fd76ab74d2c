#include "studio/loaded_scan.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "relievo/core/text.h"
#include "relievo/core/within_memory.h"
#include "relievo/scan/mesh.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/spacing.h"

namespace relievo::app::studio {
namespace {

constexpr std::size_t scattered = 400'000;  // number of points on meshes, of which about half face the viewer

// Returns points on all sides of a model, in the axes of its file.
Cloud sides_of(const CloudFile& file, std::size_t points) {
  return file.mesh.empty() ? erase_points(file.cloud, outliers(file.cloud)) : scatter(file.mesh, points);
}

// Returns for each model the share of its points to keep, so that all models are about equally dense. This is needed
// because all points are drawn as discs of the same size, which suits only one density. The common spacing is that of
// the coarsest model, but at most three times that of the densest one.
std::vector<double> even_shares(std::span<const Cloud> clouds, std::span<const PlacedModel> places) {
  if (places.size() < 2) return std::vector<double>(places.size(), 1);
  std::vector<double> apart;
  for (std::size_t i = 0; i < places.size(); ++i)
    apart.push_back(clouds[i].size() < 2 ? 0 : places[i].scale * measure_spacing(clouds[i]).rho);
  const auto [finest, coarsest] = std::ranges::minmax(apart);
  const double wanted = std::min(3 * finest, coarsest);
  for (double& share : apart) share = wanted > 0 ? std::min(1.0, std::pow(share / wanted, 2)) : 1;
  return apart;
}

Cloud share_of(const Cloud& cloud, double share) {
  std::vector<Index> left_out;
  for (Index i = 0; i < cloud.size(); ++i)
    if (std::floor((i + 1) * share) == std::floor(i * share)) left_out.push_back(i);
  return erase_points(cloud, left_out);
}

// Adds the points of a model to `all`. Drops the normals unless all models have normals. If any model has colours,
// models without colours become white, as in sample_for_view().
void add(const Cloud& model, const PlacedModel& place, const Pose& pose, Cloud& all) {
  constexpr Colour white{255, 255, 255};
  const std::size_t before = all.size();
  const bool has_normals = model.has_normals() && (before == 0 || all.has_normals());
  for (const Vec3& p : model.points) all.points.push_back(place(p));
  if (!has_normals) all.normals.clear();
  if (has_normals)
    for (const Vec3f& n : model.normals) all.normals.push_back(place.turn.cast<float>() * n);
  if (model.has_colours() || all.has_colours()) {
    all.colours.resize(before, white);
    all.colours.insert(all.colours.end(), model.colours.begin(), model.colours.end());
    all.colours.resize(all.size(), white);
  }
  if (pose.height || !all.own_heights.empty()) {
    all.own_heights.resize(before, 0);
    all.own_heights.resize(all.size(), static_cast<float>(pose.height.value_or(0)));
  }
}

// Returns points on all sides of all models, placed as the view shows them.
Cloud sides_of(const Scene& scene, const View& view) {
  const std::vector<PlacedModel> places = place_models(scene, view).value_or(std::vector<PlacedModel>());
  const auto is_mesh = [](const SceneModel& model) { return !model.file->mesh.empty(); };
  const auto meshes = static_cast<std::size_t>(std::ranges::count_if(scene.models, is_mesh));
  std::vector<Cloud> clouds;
  for (std::size_t i = 0; i < places.size(); ++i)
    clouds.push_back(sides_of(*scene.models[i].file, scattered / std::max<std::size_t>(meshes, 1)));
  const std::vector<double> shares = even_shares(clouds, places);
  Cloud all;
  for (std::size_t i = 0; i < places.size(); ++i)
    add(share_of(clouds[i], shares[i]), places[i], scene.models[i].pose, all);
  return all;
}

}  // namespace

LoadedScan::LoadedScan(ScanOrder order, Scene scene) : order_(std::move(order)), scene_(std::move(scene)) {
  for (const SceneModel& model : scene_.models)
    if (model.file->mesh.empty()) left_out_ += outliers(model.file->cloud).size();
  const std::shared_ptr<const CloudFile> first = scene_.models[0].file;
  if (!is_one_file())
    cloud_ = std::make_shared<const Cloud>(sides_of(scene_, {}));
  else if (left_out_ > 0)
    cloud_ = std::make_shared<const Cloud>(sides_of(*first, 0));
  else
    cloud_ = {first, &first->cloud};
}

bool LoadedScan::depends_on(const InputArguments& how) const {
  const auto is_depth_image = [](const SceneModel& model) { return model.pixels != nullptr; };
  return order_.how.keeps_doubtful != how.keeps_doubtful ||
         (order_.how != how && std::ranges::any_of(scene_.models, is_depth_image));
}

const SceneModel* LoadedScan::depth_image() const {
  return scene_.models.size() == 1 && scene_.models[0].pixels ? &scene_.models[0] : nullptr;
}

bool LoadedScan::is_one_file() const {
  return scene_.models.size() == 1 && scene_.models[0].pose == Pose{};
}

Result<std::shared_ptr<const Cloud>> LoadedScan::all_sides(const View& view) const {
  if (scene_.models.empty())
    return std::unexpected(Error{ErrorKind::geometry, {}, {}, "expected a scan to be open"});
  const Mesh& mesh = scene_.models[0].file->mesh;
  if (is_one_file() && !mesh.empty()) return std::make_shared<const Cloud>(scatter(mesh, scattered));
  const bool is_as_in_front = is_one_file() || view.R_view_model == Mat3::Identity();
  return is_as_in_front ? cloud_ : std::make_shared<const Cloud>(sides_of(scene_, view));
}

Result<std::vector<ViewGuess>> LoadedScan::ranked_sides() const {
  constexpr std::size_t ranked = 200'000;  // as many as best_side() ranks, so that both find the same side
  if (scene_.models.empty())
    return std::unexpected(Error{ErrorKind::geometry, {}, {}, "expected a scan to be open"});
  const Mesh& mesh = scene_.models[0].file->mesh;
  const auto sides = rank_views(is_one_file() && !mesh.empty() ? scatter(mesh, ranked) : *cloud_);
  return std::vector<ViewGuess>(sides.begin(), sides.end());
}

std::vector<std::string> LoadedScan::remarks() const {
  std::vector<std::string> lines;
  std::size_t triangles = 0;
  for (const SceneModel& model : scene_.models) {
    triangles += model.file->mesh.triangles.size();
    for (const std::string& line : model.remarks) {
      const std::string& path = is_one_file() ? input().path : model.name;
      const std::string name = is_one_file() ? "" : std::filesystem::path(path).filename().string() + ": ";
      const bool has_path = line.starts_with(path + ": ");
      lines.push_back(has_path ? name + line.substr(path.size() + 2) : line);
    }
  }
  if (triangles > 0)
    lines.push_back(cat("the points are taken from a mesh of ", triangles,
                        " triangles: with fewer points from meshes, below, all is quicker"));
  return lines;
}

Result<std::shared_ptr<const Cloud>> LoadedScan::seen_from(const View& view, std::optional<double> points,
                                                           Progress* progress) const {
  if (is_one_file() && scene_.models[0].file->mesh.empty()) return cloud_;
  RELIEVO_TRY(const ViewSample sample, sample_for_view(scene_, view, points, progress));
  return sample.cloud;
}

InputArguments reading_of(const OptionValues& values) {
  const ReliefOptions options = parse_options(values).value_or(ReliefOptions{});
  InputArguments how;
  how.depth = parse_depth(values).value_or(how.depth);
  how.keeps_doubtful = parse_doubtful(values).value_or(how.keeps_doubtful);
  how.depth.points = options.points.value_or(how.depth.points);
  how.is_lithophane = options.form == Form::lithophane;
  return how;
}

OptionValues with_side(OptionValues values, const std::optional<ViewGuess>& best) {
  const auto side = values.find("view");
  if (side == values.end() || side->second != OptionValue("auto") || !best) return values;
  side->second = std::string(best->name);
  if (best->up.empty())
    values.erase("up");
  else
    values["up"] = std::string(best->up);
  return values;
}

Result<LoadedScan> read_scan(const ScanOrder& from, const std::function<bool()>& is_unwanted) {
  Result<LoadedScan> scan = within_memory([&]() -> Result<LoadedScan> {
    ScanOrder order = from;
    RELIEVO_TRY(Scene models, load_input(order.input, {}, {order.how, is_unwanted}));
    if (is_unwanted()) return cancelled_error();
    return LoadedScan(std::move(order), std::move(models));
  });
  if (!scan && scan.error().kind == ErrorKind::memory) scan.error().input = from.input.name;
  return scan;
}

}  // namespace relievo::app::studio
