#include "relievo/scan/view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/lists.h"
#include "relievo/core/text.h"
#include "relievo/scan/cloud.h"
#include "scan/measured_cloud.h"

namespace relievo {
namespace {

struct NamedView {
  std::string_view name;
  Vec3 towards_viewer, up;
};

const std::array<NamedView, 6>& named_views() {
  static const std::array<NamedView, 6> views{{{"front", {0, 0, 1}, {0, 1, 0}},
                                               {"back", {0, 0, -1}, {0, 1, 0}},
                                               {"left", {-1, 0, 0}, {0, 1, 0}},
                                               {"right", {1, 0, 0}, {0, 1, 0}},
                                               {"top", {0, 1, 0}, {0, 0, -1}},
                                               {"bottom", {0, -1, 0}, {0, 0, 1}}}};
  return views;
}

Result<Vec3> parse_direction(std::string_view option, std::string_view text) {
  const std::optional<Vec3> v = parse_triple(text);
  if (!v) return option_error(std::string(option), cat("expected three numbers X,Y,Z, found '", text, "'"));
  return *v;
}

}  // namespace

Result<View> view_towards(const Vec3& towards_viewer, const Vec3& up) {
  const double length = towards_viewer.norm();
  if (!(length > 0) || !std::isfinite(length))
    return option_error("view", "expected a direction that is not zero and finite");
  if (!(up.norm() > 0) || !std::isfinite(up.norm()))
    return option_error("up", "expected a direction that is not zero and finite");
  const Vec3 z = towards_viewer / length;
  Vec3 x = up.normalized().cross(z);
  // If `up` is parallel to z, the cross product is 0. Then the model's Z axis takes the place of `up` or, if
  // z is parallel to this axis, the Y axis.
  for (const Vec3& other : {Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitY())})
    if (x.norm() < 1e-6) x = other.cross(z);
  x.normalize();
  View view;
  view.R_view_model << x.transpose(), z.cross(x).transpose(), z.transpose();
  return view;
}

Result<View> parse_view(std::string_view text, std::string_view up) {
  if (text == "auto") {
    if (!up.empty()) return option_error("up", "expected no direction with view auto, which finds it");
    return View{.is_best = true};
  }
  NamedView wanted{text, {}, {0, 1, 0}};
  const auto named = std::find_if(named_views().begin(), named_views().end(),
                                  [&](const NamedView& view) { return view.name == text; });
  if (named != named_views().end()) {
    wanted = *named;
  } else {
    const std::optional<Vec3> direction = parse_triple(text);
    if (!direction)
      return option_error(
          "view", cat("expected front, back, left, right, top, bottom, X,Y,Z or auto, found '", text, "'"));
    wanted.towards_viewer = *direction;
  }
  if (!up.empty()) {
    RELIEVO_TRY(const Vec3 parsed, parse_direction("up", up));
    wanted.up = parsed;
    const Vec3 across = wanted.up.stableNormalized().cross(wanted.towards_viewer.stableNormalized());
    if (across.norm() < 1e-6 && wanted.up != Vec3::Zero())
      return option_error("up", cat("expected another direction than that of the view, found '", up, "'"));
  }
  return view_towards(wanted.towards_viewer, wanted.up);
}

Result<Crop> parse_crop(std::string_view text) {
  if (text.empty()) return Crop{};
  const auto wrong = [&] {
    return option_error(
        "crop", cat("expected shares X0,Y0,X1,Y1 or X0,Y0,X1,Y1,NEAR,FAR from 0 to 1, the lesser ones "
                    "first, found '",
                    text, "'"));
  };
  std::vector<double> shares = parse_numbers(text).value_or(std::vector<double>());
  if (shares.size() == 4) shares.insert(shares.end(), {0, 1});
  const auto is_share = [](double s) { return s >= 0 && s <= 1; };
  if (shares.size() != 6 || !std::ranges::all_of(shares, is_share)) return wrong();
  const Crop crop{{shares[0], shares[1]}, {shares[2], shares[3]}, shares[4], shares[5]};
  if (!(crop.least.x() < crop.most.x() && crop.least.y() < crop.most.y() && crop.nearest < crop.farthest))
    return wrong();
  return crop;
}

Result<std::optional<double>> parse_denoise(std::string_view text) {
  if (text == "auto") return std::optional<double>();
  const auto noise = parse_numbers(text);
  if (!noise || noise->size() != 1 || !((*noise)[0] >= 0 && (*noise)[0] <= 1))
    return option_error({}, cat("expected auto or a number from 0 to 1, found '", text, "'"));
  return (*noise)[0];
}

Cloud cropped(const Cloud& cloud, const View& view) {
  if (view.crop == Crop{}) return cloud;
  const Mat3& R = view.R_view_model;
  Box box;
  for (const Vec3& p : cloud.points) box.extend(R * p);
  const Vec3 size = box.size();
  const Crop& crop = view.crop;
  const Vec3 least = box.min + size.cwiseProduct(Vec3(crop.least.x(), crop.least.y(), 1 - crop.farthest));
  const Vec3 most = box.min + size.cwiseProduct(Vec3(crop.most.x(), crop.most.y(), 1 - crop.nearest));
  const auto is_part = [&](const Vec3& of_cloud) {
    const Vec3 p = R * of_cloud;
    return (p.array() >= least.array()).all() && (p.array() <= most.array()).all();
  };
  Cloud part =
      erase_points(cloud, indices_where(cloud.size(), [&](Index i) { return !is_part(cloud.points[i]); }));
  std::erase_if(part.outlines, [&](const OutlineSegment& s) { return !is_part(s.from) || !is_part(s.to); });
  return part;
}

Cloud in_view(const Cloud& cloud, const View& view) {
  Cloud out = turned(cloud, view.R_view_model, bounds(cloud).centre());
  out.colours = cloud.colours;
  out.own_heights = cloud.own_heights;
  return out;
}

}  // namespace relievo
