// Pictures of a finished solid from any side, for programs that show the content of a file.
#pragma once

#include <memory>

#include "relievo/picture/render.h"
#include "relievo/plate/solid.h"
#include "relievo/plate/tool.h"

namespace relievo {

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
