// Makes coarse reliefs for display while a model is turned. They have about 18,000 points, take a few
// hundredths of a second, and are shaded by the normals of all points of the scan.
#pragma once

#include <memory>

#include "relievo/picture/render.h"
#include "relievo/relief/relief.h"

namespace relievo {

class MeasuredCloud;

// A model for display. The model of a turned relief has fewer points than the scan. Drawn with `detail`, its
// relief looks like a relief of all points in the same view.
struct ShownModel {
  std::shared_ptr<const ReliefModel> model;
  std::shared_ptr<const SurfaceDetail> detail = nullptr;  // normals finer than the points, for Shown::detail
  // The scan's sampling distance divided by the model's. Shape::boundary_width is in sampling distances, so
  // it must be multiplied by this ratio.
  double spacing_ratio = 1;
};

// Makes coarse reliefs of one scan. Const calls may run concurrently.
class Turntable {
 public:
  // The approximate number of points inside a turned relief; about 3,000 points along outlines are added.
  static constexpr std::size_t points = 15'000;

  // Copies the data that it needs from the cloud, which must be measured without a crop: turn() crops.
  explicit Turntable(const MeasuredCloud& measured);
  ~Turntable();

  // Returns the relief of a view. `like` is a model of the same scan in another view, or null. If `like` has
  // a support plane and View::has_plane is false, the points of that plane are left out. Errors: kind
  // geometry if the view shows no area; kind cancelled.
  Result<ShownModel> turn(const View& view, const ReliefModel* like, Progress* progress = nullptr) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace relievo
