#include "scan/measured_cloud.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/lists.h"
#include "geometry/hilbert.h"
#include "relievo/core/text.h"
#include "relievo/scan/normals.h"
#include "scan/measure_with_tree.h"
#include "scan/merging/repeated_points.h"
#include "scan/noise/noise.h"

namespace relievo {
namespace {

Result<void> check_numbers(const Cloud& cloud) {
  if (cloud.has_normals() && cloud.normals.size() != cloud.size())
    return geometry_error(
        cat("expected a normal for each of ", cloud.size(), " points, found ", cloud.normals.size()));
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (!cloud.points[i].allFinite() || (cloud.has_normals() && !cloud.normals[i].allFinite()))
      return geometry_error(cat("expected finite coordinates and normals, found others at point ", i));
  return {};
}

// Returns an error if the points coincide or are collinear, up to rounding.
Result<void> check_extent(const Cloud& cloud, const Box& box) {
  if (cloud.size() < 4) return geometry_error(cat("expected at least 4 points, found ", cloud.size()));
  const Vec3 centre = box.centre();
  const double scale = box.diagonal();
  if (!(scale > 0)) return geometry_error("expected points that span a surface, found all of them equal");
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& p : cloud.points) covariance += (p - centre) * (p - centre).transpose() / (scale * scale);
  const Vec3 spread = Eigen::SelfAdjointEigenSolver<Mat3>(covariance, Eigen::EigenvaluesOnly).eigenvalues();
  if (spread[1] <= 1e-14 * spread[2])
    return geometry_error("expected points that span a surface, found all of them on one line");
  return {};
}

// Returns the step between single-precision numbers at the largest coordinate; 0 if single precision cannot
// represent all coordinates exactly.
double step_of_digits(const Cloud& cloud) {
  float largest = 0;
  for (const Vec3& p : cloud.points)
    for (const double c : p) {
      const auto rounded = static_cast<float>(c);
      if (static_cast<double>(rounded) != c) return 0;
      largest = std::max(largest, std::abs(rounded));
    }
  return static_cast<double>(std::nextafter(largest, std::numeric_limits<float>::infinity()) - largest);
}

// Returns an error if rounding has moved points about as far as their spacing.
Result<void> check_digits(const Cloud& cloud, double rho) {
  constexpr double least_steps = 1.5;
  const double step = step_of_digits(cloud);
  if (rho >= least_steps * step) return {};
  return geometry_error(
      cat("expected coordinates with more digits, found points ", rho, " apart in steps of ", step,
          ": single precision has no more at this distance from the origin; save them in double "
          "precision, or nearer to the origin"));
}

// Keeps at most eight of the points at each position; `order` has coincident points next to each other. A
// search near more of them would read them all, so all searches together would take quadratic time. The order
// of the file decides which eight are kept.
void thin_out_coincident(std::span<const Vec3> points, std::vector<Index>& order) {
  constexpr std::size_t most = 8;
  std::size_t same = 0;
  keep_where(order, [&](std::size_t i) {
    same = i > 0 && points[order[i]] == points[order[i - 1]] ? same + 1 : 0;
    return same < most;
  });
}

}  // namespace

Result<std::shared_ptr<const MeasuredCloud>> MeasuredCloud::measure(const Cloud& whole, const View& view,
                                                                    Progress* progress) {
  RELIEVO_CHECK(check_numbers(whole));
  std::optional<Cloud> part;
  if (view.crop != Crop{}) {
    part = cropped(whole, view);
    if (part->size() < 4)
      return option_error("crop", cat("expected a part with at least 4 points, found ", part->size()));
  }
  const Cloud& cloud = part ? *part : whole;
  const Box box = bounds(cloud);
  RELIEVO_CHECK(check_extent(cloud, box));
  RELIEVO_CHECK(begin_stage(progress, "view", 0));
  std::shared_ptr<MeasuredCloud> measured(new MeasuredCloud);
  measured->view_ = view;
  measured->centre_ = box.centre();
  measured->diagonal_ = box.diagonal();
  measured->input_points_ = whole.size();
  measured->cloud_ = in_view(cloud, {});
  // A fixed order makes the result independent of the file's order. Searches are faster if neighbours are
  // close in memory.
  std::vector<Index> order = space_curve_order(measured->cloud_.points);
  thin_out_coincident(measured->cloud_.points, order);
  RELIEVO_CHECK(check_cancelled(progress));
  measured->cloud_ = {pick(measured->cloud_.points, order),
                      pick(measured->cloud_.normals, order),
                      pick(measured->cloud_.colours, order),
                      std::move(measured->cloud_.outlines),
                      cloud.is_height_field,
                      pick(measured->cloud_.own_heights, order),
                      cloud.units_per_value,
                      pick(measured->cloud_.axes, order)};
  RELIEVO_CHECK(measured->measure_points(view, progress));
  RELIEVO_CHECK(check_digits(cloud, measured->spacing().rho));
  measured->repeated_points_ = cloud.size() - measured->cloud_.size();
  return measured;
}

Result<void> MeasuredCloud::measure_points(const View& view, Progress* progress) {
  RELIEVO_CHECK(begin_stage(progress, "spacing", .05));
  tree_ = std::make_unique<const KdTree<Vec3>>(cloud_.points);
  RELIEVO_CHECK(check_cancelled(progress));
  if (std::optional<Cloud> merged = without_repeated_points(cloud_, *tree_)) {
    cloud_ = std::move(*merged);
    tree_ = std::make_unique<const KdTree<Vec3>>(cloud_.points);
    RELIEVO_CHECK(check_cancelled(progress));
  }
  spacing_ = measure_spacing(*tree_, cloud_.points, progress);
  RELIEVO_CHECK(check_cancelled(progress));
  if (!(spacing_.rho > 0))
    return geometry_error("expected points at a distance from each other, found most of them equal");
  RELIEVO_CHECK(begin_stage(progress, "normals", .2));
  has_estimated_normals_ = !cloud_.has_normals();
  if (has_estimated_normals_)
    // Noise is measured later, when the view has determined the signs of the normals.
    estimate_normals(cloud_, 16, progress);
  else
    remove_noise(view, progress);
  RELIEVO_CHECK(check_cancelled(progress));
  do_normals_point_inward_ = !has_estimated_normals_ && normals_point_inward(cloud_);
  return {};
}

// Removes the noise that View::denoise specifies or, if that is empty, the measured noise. The spacing is not
// measured again: if several scans overlap, denoising moves their points closer together than the spacing at
// which the surface was sampled.
void MeasuredCloud::remove_noise(const View& view, const Progress* progress) {
  measured_noise_ = measure_noise(cloud_, spacing_);
  removed_noise_ = view.noise_to_remove(measured_noise_);
  if (removed_noise_ == 0) return;
  CleanPoints clean = without_noise({cloud_, spacing_, *tree_}, removed_noise_, progress);
  if (progress && progress->is_cancelled()) return;
  cloud_.points = std::move(clean.points);
  cloud_.normals = std::move(clean.normals);
  tree_ = std::make_unique<const KdTree<Vec3>>(cloud_.points);
}

bool MeasuredCloud::serves(const View& view) const {
  // A new field of View breaks this line on purpose: decide here whether the field needs other measurements.
  const auto& [R_view_model, crop, has_crumbs, most_pieces, has_plane, gap, denoise, is_paper, is_best] =
      view;
  if (denoise != view_.denoise || crop != view_.crop) return false;
  const bool is_of_any_view = crop == Crop{} && cloud_.outlines.empty();
  return is_of_any_view || R_view_model == view_.R_view_model;
}

std::vector<double> MeasuredCloud::curvature(std::span<const Index> points, const Progress* progress) const {
  std::vector<double> k = curvature_.with([&](std::vector<double>& known) {
    if (known.empty()) known.assign(cloud_.size(), std::numeric_limits<double>::quiet_NaN());
    return pick(known, points);
  });
  std::vector<Index> missing, places;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::isnan(k[i])) missing.push_back(points[i]), places.push_back(static_cast<Index>(i));
  const std::vector<double> found = mean_curvature({cloud_, spacing_, *tree_}, missing, {}, progress);
  for (std::size_t i = 0; i < missing.size(); ++i) k[places[i]] = found[i];
  if (progress && progress->is_cancelled()) return k;
  curvature_.with([&](std::vector<double>& known) {
    for (std::size_t i = 0; i < missing.size(); ++i) known[missing[i]] = found[i];
  });
  return k;
}

}  // namespace relievo
