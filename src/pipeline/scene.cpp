#include "relievo/scene.h"
#include "core/angle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

// The gap between models, and the largest width of a model, as multiples of their common height.
constexpr double gap = .08, widest = 1.5;

Result<void> check(const Scene& scene) {
  if (scene.models.empty()) return option_error({}, "expected a scene of at least one model");
  for (const SceneModel& model : scene.models) {
    const Pose& pose = model.pose;
    if (!(pose.scale >= 1e-6 && pose.scale <= 1e6))
      return option_error(model.name, cat("expected a scale from 1e-06 to 1e+06, found ", pose.scale));
    if (!pose.rotate_deg.allFinite()) return option_error(model.name, "expected angles that are finite");
    if (pose.translate && !pose.translate->allFinite())
      return option_error(model.name, "expected a place that is finite");
    if (pose.height && !(*pose.height >= least_own_height && *pose.height <= most_own_height))
      return option_error(model.name, cat("expected a height from ", least_own_height, " to ",
                                          most_own_height, " of the relief's, found ", *pose.height));
  }
  return {};
}

// Returns `count` of the cloud's n points. Point i of the result is the cloud's point with the index f * n,
// rounded down, where f is the fractional part of i times the golden ratio. Indices with equal steps could
// coincide with the rows of a scanner.
Cloud some_of(const Cloud& cloud, std::size_t count) {
  constexpr double golden_ratio = .6180339887498949;
  Cloud some;
  some.points.reserve(count);
  if (cloud.has_normals()) some.normals.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double turns = static_cast<double>(i) * golden_ratio;
    const auto at = static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(cloud.size()));
    some.points.push_back(cloud.points[at]);
    if (cloud.has_normals()) some.normals.push_back(cloud.normals[at]);
  }
  return some;
}

// Calls f for each corner of a mesh's triangles, or for each point of a cloud that is not an outlier.
template <typename F>
void each_point(const CloudFile& file, F&& f) {
  for (const Triangle& triangle : file.mesh.triangles)
    for (const Index corner : triangle) f(file.mesh.points[corner]);
  if (!file.mesh.empty()) return;
  const std::vector<Index> outlying = outliers(file.cloud);
  auto next = outlying.begin();
  for (Index i = 0; i < file.cloud.size(); ++i) {
    if (next != outlying.end() && *next == i)
      ++next;
    else
      f(file.cloud.points[i]);
  }
}

Box box_of(const CloudFile& file, const Mat3& turn) {
  Box box;
  each_point(file, [&](const Vec3& p) { box.extend(turn * p); });
  return box;
}

PlacedModel placed_as_told(const SceneModel& model) {
  const Pose& pose = model.pose;
  PlacedModel placed{turn_of(pose), pose.scale, pose.translate.value_or(Vec3::Zero())};
  const bool is_moved_only = placed.turn.isIdentity(0) && placed.scale == 1;
  if (is_moved_only) return placed;
  const Vec3 centre = box_of(*model.file, Mat3::Identity()).centre();
  placed.offset += centre - placed.scale * (placed.turn * centre);
  return placed;
}

// Arranges models side by side.
class Row {
 public:
  explicit Row(const Mat3& to_view) : to_view_(to_view) {}

  PlacedModel next(const SceneModel& model) {
    PlacedModel placed{turn_of(model.pose)};
    const Box box = box_of(*model.file, to_view_ * placed.turn);
    if (!(height_ > 0)) begin(box);
    placed.scale = model.pose.scale * fitting_scale(box.size());
    const Vec3 foot(placed.scale * box.min.x(), placed.scale * box.min.y(), placed.scale * box.centre().z());
    placed.offset = to_view_.transpose() * (Vec3(at_.x(), at_.y(), at_.z()) - foot);
    at_.x() += placed.scale * box.size().x() + gap * height_;
    return placed;
  }

 private:
  void begin(const Box& box) {
    height_ = std::max(box.size().y(), box.size().x() / widest);
    at_ = {box.min.x(), box.min.y(), box.centre().z()};
  }

  double fitting_scale(const Vec3& size) const {
    const double scale = std::min(height_ / size.y(), widest * height_ / size.x());
    return std::isfinite(scale) ? scale : 1;
  }

  Mat3 to_view_;
  double height_ = 0;
  Vec3 at_ = Vec3::Zero();  // left end and bottom of the next model, and the middle of its depth
};

}  // namespace

// Returns exactly the identity if the pose neither rotates nor mirrors.
Mat3 turn_of(const Pose& pose) {
  const auto about = [&](int axis) {
    return Eigen::AngleAxisd(to_radians(pose.rotate_deg[axis]), Vec3(Vec3::Unit(axis))).toRotationMatrix();
  };
  Mat3 turn = pose.rotate_deg.isZero(0) ? Mat3(Mat3::Identity()) : Mat3(about(2) * about(1) * about(0));
  if (pose.is_mirrored) turn.col(0) = -turn.col(0);
  return turn;
}

bool Pose::operator==(const Pose& other) const {
  return rotate_deg == other.rotate_deg && translate == other.translate && scale == other.scale &&
         is_mirrored == other.is_mirrored && height == other.height;
}

Result<std::vector<PlacedModel>> place_models(const Scene& scene, const View& view) {
  RELIEVO_CHECK(check(scene));
  const bool is_placed =
      scene.models.size() == 1 ||
      std::ranges::any_of(scene.models, [](const SceneModel& m) { return m.pose.translate.has_value(); });
  Row row(view.R_view_model);
  std::vector<PlacedModel> placed;
  for (const SceneModel& model : scene.models)
    placed.push_back(is_placed ? placed_as_told(model) : row.next(model));
  return placed;
}

ViewGuess best_side(const Scene& scene) {
  constexpr std::size_t mesh_points = 200'000, most_points = 1'000'000;
  if (scene.models.size() != 1 || scene.models[0].pose != Pose{}) return {"front", ""};
  const CloudFile& file = *scene.models[0].file;
  if (!file.mesh.empty()) return rank_views(scatter(file.mesh, mesh_points))[0];
  return rank_views(file.cloud.size() > most_points ? some_of(file.cloud, most_points) : file.cloud)[0];
}

View on_side(View view, const ViewGuess& side) {
  view.R_view_model = parse_view(side.name, side.up).value_or(View{}).R_view_model;
  view.is_best = false;
  return view;
}

View chosen_view(const Scene& scene, const View& view) {
  return view.is_best ? on_side(view, best_side(scene)) : view;
}

}  // namespace relievo
