// Renders all pictures of bodies: previews, live pictures and comparisons.
#pragma once

#include <memory>

#include "picture/body.h"
#include "picture/screen_transform.h"
#include "picture/visibility.h"
#include "plate/height_field.h"
#include "relievo/core/progress.h"
#include "relievo/picture/material.h"
#include "relievo/plate/tool.h"

namespace relievo {

struct DrawParams {
  Material material = Material::plaster;
  Vec3f light = upper_left_lamp;  // towards the lamp, seen from the plate
  bool has_shadows = true;
  bool is_fine = false;                         // more samples per pixel and finer shadows
  std::shared_ptr<const ToolReach> reach = {};  // material left on the front is coloured
  const Progress* progress = nullptr;           // a cancelled picture is left unfinished
};

// Results that stay valid between pictures of the same body, if it is a height field.
struct DrawCache {
  CachedVisibility front, quick_light, fine_light;
};

// Overwrites the picture (4 channels) with the body and its drop shadow on a transparent background. The same
// body, transform and parameters give the same pixels, for any number of threads and after any earlier
// pictures.
void draw_body(const DrawnBody& body, const ScreenTransform& transform, const DrawParams& params,
               DrawCache& cache, Image8& picture);

// Returns the heights of the body's front above its lowest point, with a longer side of that many pixels.
HeightField front_heights(const DrawnBody& body, int longer_side_px, CachedVisibility& cache);

}  // namespace relievo
