#include "scan/measured_cloud.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/scan/normals.h"
#include "scan/coarse_visibility.h"
#include "scan/noise/noise.h"

namespace relievo {
namespace {

// Removes noise at points that may be visible. Before that, estimates their normals again from more neighbours,
// because noise disturbs the first estimate; the signs are kept.
void remove_noise_in_front(Cloud& cloud, const Spacing& spacing, double noise) {
  constexpr double neighbours = 16, more_neighbours = 48;
  const std::vector<Index> front = points_near_front(cloud.normals, Vec3f::UnitZ(), spacing);
  const KdTree<Vec3> tree(cloud.points);
  const std::vector<Vec3f> normals = estimated_normals(
      {cloud, spacing, tree}, front, static_cast<std::size_t>(neighbours + more_neighbours * noise));
  for (std::size_t k = 0; k < front.size(); ++k) {
    Vec3f& n = cloud.normals[front[k]];
    n = n.dot(normals[k]) < 0 ? Vec3f(-normals[k]) : normals[k];
  }
  const CleanPoints clean = without_noise({cloud, spacing, tree}, {noise, front}, nullptr);
  for (std::size_t k = 0; k < front.size(); ++k)
    cloud.points[front[k]] = clean.points[k], cloud.normals[front[k]] = clean.normals[k];
}

// Gives estimated normals the signs that the view implies. Then measures the noise, for which the signs must be
// known, and removes it.
void sign_normals(ViewedCloud& viewed, Surface& surface) {
  give_signs(viewed.cloud, viewed.spacing());
  surface.measured_noise = measure_noise(viewed.cloud, viewed.spacing());
  surface.removed_noise = surface.view.noise_to_remove(surface.measured_noise);
  if (surface.removed_noise == 0) return;
  remove_noise_in_front(viewed.cloud, viewed.spacing(), surface.removed_noise);
}

// Each point stands for an area in the view plane, whether it is visible or hidden. Returns the area of the
// points whose normals face the viewer, as a share of the area of all points.
double facing_share(const ViewedCloud& viewed) {
  double facing = 0, total = 0;
  for (std::size_t i = 0; i < viewed.cloud.size(); ++i) {
    const auto side = static_cast<double>(viewed.spacing().local[i]);
    const double area = side * side * static_cast<double>(viewed.cloud.normals[i].z());
    facing += std::max(0., area);
    total += std::abs(area);
  }
  return total > 0 ? facing / total : 1;
}

// Returns the text of the options that select the best view of the cloud other than `view`.
std::string other_view(const MeasuredCloud& measured, const View& view) {
  Cloud cloud = measured.cloud();
  for (Vec3& p : cloud.points) p += measured.centre();
  const auto ranked = rank_views(cloud);
  const auto is_other = [&](const ViewGuess& guess) {
    const View best = parse_view(guess.name, guess.up).value_or(View{});
    return !best.R_view_model.row(2).isApprox(view.R_view_model.row(2));
  };
  const ViewGuess& best = *std::ranges::find_if(ranked, is_other);
  return cat("--view ", best.name, best.up.empty() ? "" : cat(" --up ", best.up));
}

}  // namespace

Cloud turned(const Cloud& cloud, const Mat3& R, const Vec3& centre) {
  const Eigen::Matrix3f rotation = R.cast<float>();
  const auto moved = [&](const Vec3& p) -> Vec3 { return R * (p - centre); };
  Cloud out{std::vector<Vec3>(cloud.size()), std::vector<Vec3f>(cloud.normals.size())};
  parallel_for(cloud.size(), [&](std::size_t i) { out.points[i] = moved(cloud.points[i]); });
  parallel_for(cloud.normals.size(), [&](std::size_t i) { out.normals[i] = rotation * cloud.normals[i]; });
  out.axes.resize(cloud.axes.size());
  parallel_for(cloud.axes.size(), [&](std::size_t i) { out.axes[i] = rotation * cloud.axes[i]; });
  for (const OutlineSegment& s : cloud.outlines)
    out.outlines.push_back({moved(s.from), moved(s.to), s.is_jump});
  out.is_height_field = cloud.is_height_field && R == Mat3::Identity();
  return out;
}

Surface surface_of_view(const MeasuredCloud& measured, const View& view) {
  Surface surface;
  surface.view = view;
  surface.centre = measured.centre();
  surface.diagonal = measured.diagonal();
  surface.input_points = measured.input_points();
  surface.repeated_points = measured.repeated_points();
  surface.units_per_value = measured.cloud().units_per_value;
  return surface;
}

ViewedCloud look_at(const MeasuredCloud& measured, Surface& surface, const Progress* progress) {
  const Mat3& R = surface.view.R_view_model;
  const auto clean = measured.without_noise(R.row(2).transpose().cast<float>(), progress);
  ViewedCloud viewed{turned(clean->cloud, R), measured, clean};
  surface.rho = measured.spacing().rho;
  surface.has_estimated_normals = measured.has_estimated_normals();
  if (surface.has_estimated_normals) {
    sign_normals(viewed, surface);
    return viewed;
  }
  surface.measured_noise = measured.measured_noise();
  surface.removed_noise = measured.removed_noise();
  surface.has_flipped_normals = measured.do_normals_point_inward() && !all_face_viewer(viewed.cloud);
  if (!surface.has_flipped_normals) return viewed;
  flip_normals(viewed.cloud);
  viewed.sign = -1;
  return viewed;
}

Result<void> check_side(const ViewedCloud& viewed, const View& view) {
  constexpr double least = .1;
  if (viewed.measured.has_estimated_normals()) return {};
  const double facing = facing_share(viewed);
  if (facing >= least) return {};
  return geometry_error(
      cat("expected a view of the side that was scanned, found ", std::lround(100 * (1 - facing)),
          " % of the surface facing away from the viewer; ", other_view(viewed.measured, view),
          " or --view auto shows it; if the file's normals are wrong, take them out of it: they are then "
          "estimated"));
}

std::unexpected<Error> too_few_visible(std::size_t visible) {
  return geometry_error(
      cat("expected at least 4 points that face the viewer, found ", visible, "; try another view"));
}

std::unexpected<Error> no_area_error() {
  return geometry_error("expected visible points that enclose an area, found all of them on one line");
}

}  // namespace relievo
