// Turns the cloud into a view, before its visible points are known (stage 2). Tested by tests/scan/surface_test.cpp.
#pragma once

#include "scan/measured_cloud.h"

namespace relievo {

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

// Turns the cloud into the view of the surface, with signed normals. At all points that the view may show, removes
// the noise that the view asks to remove. Sets the surface's rho, and its members about normals and noise. The result
// is not usable once the progress is cancelled.
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
