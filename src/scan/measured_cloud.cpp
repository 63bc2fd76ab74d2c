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

// Returns the step between single-precision numbers at the largest coordinate; 0 if a coordinate has more digits than
// single precision represents.
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

// Returns an error if single precision has moved points by about as much as their spacing.
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
// search for neighbours near a position with many points would read all of them. Then all searches together
// would take quadratic time. The order of the file decides which eight are kept.
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
  Cloud& own = measured->scan_->cloud;
  own = in_view(cloud, {});
  // A fixed order makes the result independent of the file's order, and neighbours close in memory make all
  // searches faster.
  std::vector<Index> order = space_curve_order(own.points);
  thin_out_coincident(own.points, order);
  RELIEVO_CHECK(check_cancelled(progress));
  own = {pick(own.points, order), pick(own.normals, order), pick(own.colours, order),
         std::move(own.outlines), cloud.is_height_field,    pick(own.own_heights, order),
         cloud.units_per_value,   pick(own.axes, order)};
  RELIEVO_CHECK(measured->measure_points(view, progress));
  RELIEVO_CHECK(check_digits(cloud, measured->spacing().rho));
  measured->repeated_points_ = cloud.size() - own.size();
  return measured;
}

Result<void> MeasuredCloud::measure_points(const View& view, Progress* progress) {
  RELIEVO_CHECK(begin_stage(progress, "spacing", .05));
  auto& [cloud, tree, is_clean] = *scan_;
  tree = std::make_unique<const KdTree<Vec3>>(cloud.points);
  RELIEVO_CHECK(check_cancelled(progress));
  if (std::optional<Cloud> merged = without_repeated_points(cloud, *tree)) {
    cloud = std::move(*merged);
    tree = std::make_unique<const KdTree<Vec3>>(cloud.points);
    RELIEVO_CHECK(check_cancelled(progress));
  }
  spacing_ = measure_spacing(*tree, cloud.points, progress);
  RELIEVO_CHECK(check_cancelled(progress));
  if (!(spacing_.rho > 0))
    return geometry_error("expected points at a distance from each other, found most of them equal");
  RELIEVO_CHECK(begin_stage(progress, "normals", .2));
  has_estimated_normals_ = !cloud.has_normals();
  if (has_estimated_normals_) {
    // The view decides the signs of these normals. Noise is measured when the signs are known.
    estimate_normals(cloud, 16, progress);
    return check_cancelled(progress);
  }
  measured_noise_ = measure_noise(cloud, spacing_);
  removed_noise_ = view.noise_to_remove(measured_noise_);
  do_normals_point_inward_ = normals_point_inward(cloud);
  return {};
}

namespace {

using Scan = MeasuredCloud::Scan;

// Returns the scan without colours and tree.
std::shared_ptr<Scan> copy_of(const Scan& scan) {
  auto copy = std::make_shared<Scan>();
  copy->cloud.points = scan.cloud.points, copy->cloud.normals = scan.cloud.normals;
  copy->cloud.outlines = scan.cloud.outlines, copy->cloud.is_height_field = scan.cloud.is_height_field;
  copy->is_clean = scan.is_clean;
  copy->is_clean.resize(scan.cloud.size(), 0);
  return copy;
}

void set_clean(Scan& scan, Index i, const Vec3& point, const Vec3f& normal) {
  scan.cloud.points[i] = point, scan.cloud.normals[i] = normal;
  scan.is_clean[i] = 1;
}

}  // namespace

// Removes as much noise as View::denoise states or, if that is empty, as much as was measured. Does not
// measure the spacing again, because removing the noise brings points of overlapping scans closer together
// than the surface is sampled. Points that this view does not need keep their noise, even if another view has
// removed it, because a relief must not depend on earlier views.
std::shared_ptr<const MeasuredCloud::Scan> MeasuredCloud::without_noise(const Vec3f& towards_viewer,
                                                                        const Progress* progress) const {
  if (removed_noise_ == 0) return scan_;
  const Cloud& cloud = scan_->cloud;
  // Normals that point inwards may have to be reversed. That decision depends on all normals, so none is left out.
  const Vec3f direction = do_normals_point_inward_ ? Vec3f::Zero() : towards_viewer;
  const std::vector<Index> needed = points_near_front(cloud.normals, direction, spacing_);
  const std::shared_ptr<const Scan> known = clean_.with([](const auto& clean) { return clean; });
  std::vector<Index> missing = needed;
  if (known) std::erase_if(missing, [&](Index i) { return known->is_clean[i] != 0; });
  const CleanPoints found =
      relievo::without_noise({cloud, spacing_, *scan_->tree}, {removed_noise_, missing}, progress);
  const std::shared_ptr<Scan> all = copy_of(known ? *known : *scan_);
  for (std::size_t k = 0; k < missing.size(); ++k)
    set_clean(*all, missing[k], found.points[k], found.normals[k]);
  if (progress && progress->is_cancelled()) return all;
  const std::shared_ptr<Scan> clean = known ? copy_of(*scan_) : all;
  if (known)
    for (const Index i : needed) set_clean(*clean, i, all->cloud.points[i], all->cloud.normals[i]);
  clean->tree = std::make_unique<const KdTree<Vec3>>(clean->cloud.points);
  clean_.with([&](auto& kept) { kept = all; });
  return clean;
}

bool MeasuredCloud::serves(const View& view) const {
  View same = view_;
  // Views that differ only in these fields share their measurements. A new field of View requires new measurements
  // unless it is added here.
  same.has_crumbs = view.has_crumbs;
  same.most_pieces = view.most_pieces;
  same.has_plane = view.has_plane;
  same.gap = view.gap;
  same.is_paper = view.is_paper;
  same.is_best = view.is_best;
  const bool is_of_any_view = view.crop == Crop{} && cloud().outlines.empty();
  if (is_of_any_view) same.R_view_model = view.R_view_model;
  return same == view;
}

std::vector<double> MeasuredCloud::curvature(const Scan& clean, std::span<const Index> points,
                                             const Progress* progress) const {
  const SearchableCloud searchable{clean.cloud, spacing_, *clean.tree};
  // If noise is removed, each view has its own k-d tree, which decides the order in which neighbours are found and so
  // the rounding of sums. Therefore values are not kept for other views.
  if (removed_noise_ != 0) return mean_curvature(searchable, points, {}, progress);
  std::vector<double> k = curvature_.with([&](std::vector<double>& known) {
    if (known.empty()) known.assign(cloud().size(), std::numeric_limits<double>::quiet_NaN());
    return pick(known, points);
  });
  std::vector<Index> missing, places;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::isnan(k[i])) missing.push_back(points[i]), places.push_back(static_cast<Index>(i));
  const std::vector<double> found = mean_curvature(searchable, missing, {}, progress);
  for (std::size_t i = 0; i < missing.size(); ++i) k[places[i]] = found[i];
  if (progress && progress->is_cancelled()) return k;
  curvature_.with([&](std::vector<double>& known) {
    for (std::size_t i = 0; i < missing.size(); ++i) known[missing[i]] = found[i];
  });
  return k;
}

}  // namespace relievo
