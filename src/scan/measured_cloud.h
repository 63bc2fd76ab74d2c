// Measures a cloud once for all views: order, spacing and normals. At points that views have shown, it also keeps the
// points without noise and the curvature.
#pragma once

#include <memory>

#include "geometry/neighbours.h"
#include "relievo/core/parallel.h"
#include "relievo/core/progress.h"
#include "relievo/scan/surface.h"

namespace relievo {

class MeasuredCloud {
 public:
  // Measures the part of the cloud that the view's crop keeps. Errors: those of find_surface() that do not
  // depend on the visible points.
  static Result<std::shared_ptr<const MeasuredCloud>> measure(const Cloud& whole, const View& view,
                                                              Progress* progress = nullptr);

  // Returns whether measuring for `view` would give the same results, so that they can be used for it. A crop
  // and the exact outlines of a mesh depend on the direction of the view.
  bool serves(const View& view) const;

  const View& view() const { return view_; }

  struct Scan {
    Cloud cloud;
    std::unique_ptr<const KdTree<Vec3>> tree;
    std::vector<std::uint8_t> is_clean = {};  // per point: whether its noise was removed; empty if nowhere
  };

  // Returns the points relative to the centre of their box, in the axes of the cloud and in the order of a
  // space-filling curve, which makes all results independent of the file's order. Noise is not removed from them.
  // Signs of estimated normals are arbitrary.
  const Cloud& cloud() const { return scan_->cloud; }

  // Returns the cloud, without colours, after the noise was removed at all points that a view from the
  // direction `towards_viewer` may show. If `towards_viewer` is 0, the noise was removed at all points.
  // Changed points are kept for later views. If the normals are estimated, nothing is removed. May be called
  // concurrently. The result is not usable once the progress is cancelled.
  std::shared_ptr<const Scan> without_noise(const Vec3f& towards_viewer,
                                            const Progress* progress = nullptr) const;

  const Spacing& spacing() const { return spacing_; }

  // Values that are the same for the surfaces of all views.
  const Vec3& centre() const { return centre_; }
  double diagonal() const { return diagonal_; }
  std::size_t input_points() const { return input_points_; }
  // Number of points that without_repeated_points() left out.
  std::size_t repeated_points() const { return repeated_points_; }
  bool has_estimated_normals() const { return has_estimated_normals_; }
  bool do_normals_point_inward() const { return do_normals_point_inward_; }
  double measured_noise() const { return measured_noise_; }
  double removed_noise() const { return removed_noise_; }

  // Returns the mean curvature at points that a view may show, for normals that point outwards. `clean` is the
  // cloud without noise for this view. If no noise is removed, values are kept, so that each point is measured once.
  // May be called concurrently.
  std::vector<double> curvature(const Scan& clean, std::span<const Index> points,
                                const Progress* progress) const;

 private:
  MeasuredCloud() = default;
  Result<void> measure_points(const View& view, Progress* progress);

  View view_;
  std::shared_ptr<Scan> scan_ = std::make_shared<Scan>();
  mutable Guarded<std::shared_ptr<const Scan>> clean_;  // without noise at the points that views have needed
  Spacing spacing_;
  Vec3 centre_ = Vec3::Zero();
  double diagonal_ = 0;
  std::size_t input_points_ = 0, repeated_points_ = 0;
  bool has_estimated_normals_ = false, do_normals_point_inward_ = false;
  double measured_noise_ = 0, removed_noise_ = 0;
  mutable Guarded<std::vector<double>> curvature_;  // per point; NaN if not measured yet
};

// Returns the surface that a view shows, like find_surface() of a cloud. `measured.serves(view)` must be true.
Result<Surface> find_surface(const MeasuredCloud& measured, const View& view, Progress* progress = nullptr);

// Returns the surface that a view shows. Frees the cloud as soon as it is not needed any more, unless it has other
// owners.
Result<Surface> find_surface(std::shared_ptr<const MeasuredCloud> measured, const View& view,
                             Progress* progress = nullptr);

// The whole cloud in view coordinates, with signed normals. Noise is removed at points that may be visible.
struct ViewedCloud {
  Cloud cloud;  // without colours
  const MeasuredCloud& measured;
  std::shared_ptr<const MeasuredCloud::Scan> clean;  // the cloud that was turned into the view
  double sign = 1;                                   // -1 if the measured normals were reversed, else 1

  const Spacing& spacing() const { return measured.spacing(); }
};

// Returns a surface without points. It has all properties that follow from the measurements and the view.
Surface surface_of_view(const MeasuredCloud& measured, const View& view);

// Returns the points, normals and outlines of a cloud in a view, relative to a centre and without colours. This is the
// paper's equation (1), up to a turn about the line of sight.
Cloud turned(const Cloud& cloud, const Mat3& R, const Vec3& centre = Vec3::Zero());

// Rotates the cloud into the view of the surface, and gives the normals their signs. At all points that the
// view may show, removes the noise that the view asks to remove. Sets the surface's rho, and its members about
// normals and noise. The result is not usable once the progress is cancelled.
ViewedCloud look_at(const MeasuredCloud& measured, Surface& surface, const Progress* progress = nullptr);

// Returns an error that names a better view, if nine tenths of the surface face away from the viewer. A
// relief would show only the remaining tenth, as when a bust that was scanned from the front is viewed from
// behind.
Result<void> check_side(const ViewedCloud& viewed, const View& view);

// too_few_visible() returns the error for a view in which only `visible` points face the viewer. no_area_error()
// returns the error for visible points that are collinear.
std::unexpected<Error> too_few_visible(std::size_t visible);
std::unexpected<Error> no_area_error();

}  // namespace relievo
