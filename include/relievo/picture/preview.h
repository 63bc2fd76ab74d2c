// Draws shaded pictures of a finished body on the CPU: from the front and obliquely, or from any direction.
#pragma once

#include <limits>
#include <memory>

#include "relievo/core/image.h"
#include "relievo/picture/material.h"
#include "relievo/picture/render.h"
#include "relievo/plate/solid.h"
#include "relievo/plate/tool.h"

namespace relievo {

struct PreviewOptions {
  int longer_side_px = 1200;      // longer side of each of the two pictures
  Vec3f light = upper_left_lamp;  // direction to the lamp, in the axes of the plate
  Material material = Material::plaster;
  // The body before bending. If given, the front picture shows this body instead of the bent body. Bending to
  // the inside would hide the relief, and any bending would hide a porcelain relief, which is lit from
  // behind. The solid must outlive the call.
  const Solid* flat = nullptr;
  // The oblique picture cuts the body at this height in z, and shows only the part below.
  double nearest_mm = std::numeric_limits<double>::infinity();
};

// Returns a picture (3 channels) of the body on a neutral background: on the left from the front, on the
// right obliquely. Both views equal FrameRenderer's fine picture of the same body at the same size and zoom,
// up to one grey level of rounding: lamp and sky, soft cast shadows and darkened hollows are the same. The
// light is fixed to the plate, so both views show the same shading. Horizontal triangles are shaded flat. The
// result has no pixels for an empty solid or a side not in [1, 5461]. Takes about 0.4 s for 700k triangles on
// two cores.
Image8 render_preview(const Solid& solid, const PreviewOptions& options);

// Draws one solid like render_preview(). The background is transparent (opacity 0) except for the solid's
// soft shadow. Not for concurrent use.
class SolidRenderer {
 public:
  // Shares ownership of the solid, which must have at least one triangle.
  explicit SolidRenderer(std::shared_ptr<const Solid> solid);

  // Also colours the material that the tool leaves on the solid, from orange to red. Shares ownership of
  // `reach`, too.
  SolidRenderer(std::shared_ptr<const Solid> solid, std::shared_ptr<const ToolReach> reach);
  SolidRenderer(SolidRenderer&&) noexcept;
  ~SolidRenderer();

  // Overwrites the picture; it gets no pixels if options.has_size() is false. At zoom 1 the solid fits
  // into the picture. The camera rotates about the centre of the solid's box, at the height of its ground.
  // The lengths in the options (mm_per_unit, margin_mm, thickness_mm) are ignored, because the solid has its
  // own. After cancellation the picture is unfinished.
  void render(const RenderOptions& options, Picture& picture, const Progress* progress = nullptr);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
