// Finds the side that was scanned. For the choice of the constants see docs/decisions/best-view.md.
#include "scan/coarse_visibility.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/angle.h"

namespace relievo {
namespace {

// The least CoarseVisibility::one_layer of one-sided scans. Closed models have less than .45.
constexpr double one_layer_share = .8;
constexpr double same_share = .05;  // smaller differences of one_layer between directions are ignored

// A direction along which a scan may have been taken; its sign is arbitrary.
struct Direction {
  Vec3 along;
  double one_layer = 0;
};

View view_of(const Side& side) {
  return view_towards(side.towards_viewer, side.up).value_or(View{});
}

// Returns the upward direction that parse_view() uses for the named views.
Vec3 usual_up(const Vec3& towards_viewer) {
  const bool is_along_y = std::abs(towards_viewer.y()) > std::sqrt(.5);
  const Vec3 up = is_along_y ? Vec3(0, 0, towards_viewer.y() > 0 ? -1 : 1) : Vec3(Vec3::UnitY());
  return (up - up.dot(towards_viewer) * towards_viewer).normalized();
}

Direction measured(const Cloud& cloud, const Vec3& along, NormalSigns signs) {
  const View view = view_of({along, usual_up(along)});
  return {along, coarse_visibility(cloud, {{view}}, signs)[0].one_layer};
}

// Returns the mean of v v^T over the vectors v = vector(i) of all points.
template <typename F>
Mat3 second_moment(std::size_t count, F vector) {
  Mat3 sum = Mat3::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 v = vector(i);
    sum += v * v.transpose();
  }
  return sum / static_cast<double>(count);
}

// Finds the direction of the scan, whatever the axes of its file are. The candidates are the mean direction of the
// normals, their principal direction, and the directions of the least and second least extent of the points.
class OwnDirection {
 public:
  OwnDirection(const Cloud& cloud, NormalSigns signs) : cloud_(cloud), signs_(signs) {}

  Direction find() {
    if (signs_ != NormalSigns::unknown) {
      Vec3 sum = Vec3::Zero();
      for (const Vec3f& n : cloud_.normals) sum += n.cast<double>();
      if (sum.norm() > 0) take(sum.normalized());
    }
    const auto normal = [&](std::size_t i) -> Vec3 { return cloud_.normals[i].cast<double>(); };
    const Eigen::SelfAdjointEigenSolver<Mat3> normals(second_moment(cloud_.size(), normal));
    is_flat_ = normals.eigenvalues()[2] > flat;
    take(normals.eigenvectors().col(2));
    const Vec3 centre = bounds(cloud_).centre();
    const auto place = [&](std::size_t i) -> Vec3 { return cloud_.points[i] - centre; };
    const Eigen::SelfAdjointEigenSolver<Mat3> places(second_moment(cloud_.size(), place));
    for (const int axis : {0, 1}) take(places.eigenvectors().col(axis));
    return best_;
  }

  // Returns an angle in degrees. If the direction found is closer to an axis of the file than this, the view is along
  // the axis. The angle is small for flat scans such as coins, whose direction is exact. It is large for others such
  // as busts, whose direction depends on which parts were scanned.
  double snap_deg() const { return is_flat_ ? 3 : 25; }

 private:
  static constexpr double flat = .85;  // least second moment of normals along the direction of a flat scan

  void take(const Vec3& along) {
    const Direction next = measured(cloud_, along, signs_);
    if (best_.one_layer == 0 || next.one_layer > best_.one_layer + same_share) best_ = next;
  }

  const Cloud& cloud_;
  NormalSigns signs_;
  bool is_flat_ = false;
  Direction best_{Vec3::UnitZ()};
};

// Returns +1 if a camera at the file's origin that looks along +Z could have seen the cloud, -1 for a camera
// that looks along -Z, and 0 otherwise.
double camera_along_z(const Cloud& cloud) {
  constexpr double widest = 1.2;  // tangent of half the field of view of a wide camera
  constexpr double most = .99;    // least share of the points inside that field of view
  std::size_t ahead = 0, behind = 0;
  for (const Vec3& p : cloud.points) {
    const bool is_within = std::max(std::abs(p.x()), std::abs(p.y())) < widest * std::abs(p.z());
    ahead += is_within && p.z() > 0;
    behind += is_within && p.z() < 0;
  }
  const double least = most * static_cast<double>(cloud.size());
  return static_cast<double>(ahead) > least ? 1 : static_cast<double>(behind) > least ? -1 : 0;
}

// Returns the direction of the scan, with arbitrary sign.
std::optional<Vec3> scan_direction(const Cloud& cloud, NormalSigns signs, bool is_from_camera) {
  std::vector<Direction> axes;
  for (const int axis : {2, 1, 0}) axes.push_back(measured(cloud, Vec3::Unit(axis), signs));
  if (is_from_camera && axes[0].one_layer >= one_layer_share) return axes[0].along;
  OwnDirection own(cloud, signs);
  const Direction direct = own.find();
  double most = direct.one_layer;
  for (const Direction& axis : axes) most = std::max(most, axis.one_layer);
  if (most < one_layer_share) return {};
  const double least_cosine = std::cos(to_radians(own.snap_deg()));
  for (const Direction& axis : axes)
    if (axis.one_layer >= most - same_share && (std::abs(axis.along.dot(direct.along)) >= least_cosine ||
                                                direct.one_layer < axis.one_layer - same_share))
      return axis.along;
  return direct.along;
}

// Returns the width of the part of the object that touches the ground, as a share of the object's width, in a view
// with these x and y axes.
double foot_width(const Cloud& cloud, const Vec3& x, const Vec3& y) {
  constexpr double foot = .03;  // share of the height; points below it belong to the foot
  constexpr std::size_t most_points = 20'000;
  std::array<bool, 16> is_stood_on{};
  const std::size_t step = 1 + cloud.size() / most_points;
  Box box;
  for (std::size_t i = 0; i < cloud.size(); i += step)
    box.extend({x.dot(cloud.points[i]), y.dot(cloud.points[i]), 0});
  if (!(box.size().x() > 0)) return 0;
  for (std::size_t i = 0; i < cloud.size(); i += step) {
    if (y.dot(cloud.points[i]) > box.min.y() + foot * box.size().y()) continue;
    const double share = (x.dot(cloud.points[i]) - box.min.x()) / box.size().x();
    is_stood_on[std::min(static_cast<std::size_t>(share * is_stood_on.size()), is_stood_on.size() - 1)] =
        true;
  }
  return static_cast<double>(std::ranges::count(is_stood_on, true)) / is_stood_on.size();
}

// Rotates the view about the line of sight, so that the object stands on its broadest foot. Returns the given
// view unless this foot is much broader than the foot in the given view. Angles are multiples of `step_deg`.
Side standing(const Cloud& cloud, const Side& side, int step_deg) {
  constexpr double broad = .6, broader = 2, same = .05;
  const Vec3 x = side.up.cross(side.towards_viewer);
  Side best = side;
  const double usual = foot_width(cloud, x, side.up);
  double widest = usual;
  for (int turn = step_deg; turn <= 180; turn += step_deg)
    for (const int deg : {turn, -turn}) {
      const Eigen::AngleAxisd by(to_radians(deg), side.towards_viewer);
      const double width = foot_width(cloud, by * x, by * side.up);
      if (width < std::max({broad, broader * usual, widest + same})) continue;
      widest = width;
      best.up = by * side.up;
    }
  return best;
}

}  // namespace

std::optional<Side> scanned_side(const Cloud& cloud, NormalSigns signs) {
  constexpr double camera_weight = .5;  // weight of camera_along_z() relative to CoarseVisibility::outside
  const double camera = camera_along_z(cloud);
  const std::optional<Vec3> along = scan_direction(cloud, signs, camera != 0);
  if (!along) return {};
  const std::vector<View> views{view_of({*along, usual_up(*along)}), view_of({-*along, usual_up(-*along)})};
  const std::vector<CoarseVisibility> seen = coarse_visibility(cloud, views, signs);
  const auto mark = [&](std::size_t i) {
    return signs == NormalSigns::unknown ? seen[i].outside : seen[i].facing_share;
  };
  const double from_camera = signs == NormalSigns::unknown ? camera_weight * camera * along->z() : 0;
  const Vec3 towards = mark(0) - mark(1) >= 2 * from_camera ? *along : Vec3(-*along);
  const Side side{towards, usual_up(towards)};
  if (camera != 0 && towards.z() == -camera) return Side{towards, {0, -camera, 0}};
  // A scan that was aligned with one axis was probably aligned with the others, too.
  const bool is_along_axis = towards.cwiseAbs().maxCoeff() == 1;
  return standing(cloud, side, is_along_axis ? 90 : 1);
}

}  // namespace relievo
