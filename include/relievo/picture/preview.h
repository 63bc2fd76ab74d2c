// Shaded pictures of a finished body, from the front and obliquely or from any side, drawn on the CPU.
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
  int longer_side_px = 1200;      // longer side of each of the two pictures, front and oblique
  Vec3f light = upper_left_lamp;  // towards the lamp, seen from the plate
  Material material = Material::plaster;
  // The body before it was bent. If given, the front picture shows this solid instead, because bending to the
  // inside hides the relief, and any bending hides the relief of porcelain, which is lit from behind. The
  // solid must outlive the call.
  const Solid* flat = nullptr;
  // The oblique picture cuts the body open at this height in z, and leaves out the part that is nearer to the
  // viewer.
  double nearest_mm = std::numeric_limits<double>::infinity();
};

// Returns the body as seen from the front and, beside it, obliquely, on a neutral ground (3 channels). Each
// of the two pictures equals, up to one grey level of rounding, FrameRenderer's fine picture of the same body
// at this size and zoom, with the same lamp and sky, soft cast shadows and darkened hollows. The light
// belongs to the plate, so both pictures show the same shading. Level triangles are shaded flat. The result
// has no pixels for an empty solid or a side not in [1, 5461]. It takes about 0.4 s for 700k triangles on two
// cores.
Image8 render_preview(const Solid& solid, const PreviewOptions& options);

// Draws one solid as render_preview() does. The background is transparent (opacity 0) except for the solid's
// soft shadow. Not for concurrent use.
class SolidRenderer {
 public:
  // Shares ownership of the solid, which has at least one triangle.
  explicit SolidRenderer(std::shared_ptr<const Solid> solid);

  // Also colours the material that the tool leaves on the solid, from orange to red. Shares ownership of
  // `reach`, too.
  SolidRenderer(std::shared_ptr<const Solid> solid, std::shared_ptr<const ToolReach> reach);
  SolidRenderer(SolidRenderer&&) noexcept;
  ~SolidRenderer();

  // Overwrites the picture, which gets no pixels if the size is out of range. Zoom 1 fits the solid into the
  // picture; the camera turns around the middle of its box, at the height of its ground. Lengths in the
  // options (mm_per_unit, margin_mm, thickness_mm) have no effect: the solid has its own. A picture that is
  // cancelled is left unfinished.
  void render(const RenderOptions& options, Picture& picture, const Progress* progress = nullptr);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
