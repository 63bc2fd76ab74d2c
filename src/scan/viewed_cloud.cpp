#include "scan/viewed_cloud.h"

#include <algorithm>

#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/scan/normals.h"
#include "scan/noise/noise.h"

namespace relievo {
namespace {

// Returns the points, normals and outlines of a cloud in a view. The colours are left out.
Cloud turned(const Cloud& cloud, const Mat3& R) {
  const Eigen::Matrix3f rotation = R.cast<float>();
  Cloud out{std::vector<Vec3>(cloud.size()), std::vector<Vec3f>(cloud.normals.size())};
  parallel_for(cloud.size(), [&](std::size_t i) { out.points[i] = R * cloud.points[i]; });
  parallel_for(cloud.normals.size(), [&](std::size_t i) { out.normals[i] = rotation * cloud.normals[i]; });
  for (const OutlineSegment& s : cloud.outlines)
    out.outlines.push_back({Vec3(R * s.from), Vec3(R * s.to), s.is_jump});
  out.is_height_field = cloud.is_height_field && R == Mat3::Identity();
  return out;
}

// Estimates the normals again and keeps their signs. Uses more neighbours because of the noise.
void estimate_again(Cloud& cloud, double noise) {
  constexpr double neighbours = 16, more_neighbours = 48;
  const std::vector<Vec3f> before = cloud.normals;
  estimate_normals(cloud, static_cast<std::size_t>(neighbours + more_neighbours * noise));
  for (std::size_t i = 0; i < before.size(); ++i)
    if (cloud.normals[i].dot(before[i]) < 0) cloud.normals[i] = -cloud.normals[i];
}

// Gives estimated normals the signs that the view suggests. Only then can the noise be measured; removes it,
// too.
void sign_normals(ViewedCloud& viewed, Surface& surface) {
  give_signs(viewed.cloud, viewed.spacing());
  surface.measured_noise = measure_noise(viewed.cloud, viewed.spacing());
  surface.removed_noise = surface.view.noise_to_remove(surface.measured_noise);
  if (surface.removed_noise == 0) return;
  estimate_again(viewed.cloud, surface.removed_noise);
  remove_noise(viewed.cloud, viewed.spacing(), surface.removed_noise);
}

bool all_look_away(const Cloud& viewed) {
  return std::ranges::all_of(viewed.normals, [](const Vec3f& n) { return n.z() < 0; });
}

}  // namespace

Surface surface_of_view(const MeasuredCloud& measured, const View& view) {
  Surface surface;
  surface.view = view;
  surface.centre = measured.centre();
  surface.diagonal = measured.diagonal();
  surface.input_points = measured.input_points();
  surface.repeated_points = measured.repeated_points();
  return surface;
}

ViewedCloud look_at(const MeasuredCloud& measured, Surface& surface) {
  ViewedCloud viewed{turned(measured.cloud(), surface.view.R_view_model), measured};
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

std::unexpected<Error> too_few_visible(const Cloud& viewed, std::size_t visible) {
  return geometry_error(
      cat("expected at least 4 points that face the viewer, found ", visible,
          all_look_away(viewed)
              ? ": all normals point away from the viewer; look from the other side, or take the "
                "normals out of the file if they are wrong: they are then estimated"
              : "; try another view"));
}

std::unexpected<Error> no_area_error() {
  return geometry_error("expected visible points that enclose an area, found all of them on one line");
}

}  // namespace relievo
