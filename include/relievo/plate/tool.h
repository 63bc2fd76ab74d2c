// Milling tools, the part of a front that they can reach, and the surface that they leave.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/image.h"
#include "relievo/core/types.h"

namespace relievo {

struct Solid;

// The tip of a tool that turns about the z axis and cuts downwards. Diameters are those of the cutting part,
// in mm.
struct Tool {
  enum class Kind { ball, flat, v };
  Kind kind = Kind::ball;
  double diameter_mm = 1;  // diameter of a ball or flat end, [0.01, 1000]
  double angle_deg = 60;   // angle between a V tool's flanks, [1, 170]; the flanks are unlimited
  double tip_mm = 0;       // diameter of the ball that rounds a V tool's tip, [0, 1000]; 0 is sharp

  bool operator==(const Tool&) const = default;
};

// Returns the tool that a text describes: "ball:DIAMETER", "flat:DIAMETER", "v:ANGLE" or "v:ANGLE:TIP", in
// degrees and lengths, see parse_length(). Errors: kind option, naming tool.
Result<Tool> parse_tool(std::string_view text, LengthUnit bare = LengthUnit::mm);

// Returns the text of the tool as parse_tool() reads it, in millimetres.
std::string text_of(const Tool& tool);

// Returns the height of the tool's surface above its lowest point at that distance from its axis, in mm;
// infinite beyond the tool's radius.
double tool_profile(const Tool& tool, double distance_mm);

// Returns the lowest surface that the tool can leave without cutting into the heights at any sample: the
// morphological closing of the heights by the tool's shape. It is never below the heights. NaN marks samples
// without material, where nothing obstructs the tool, and stays NaN. The tool's axis passes through the
// samples, and through positions beside the picture up to the tool's radius. A radius is limited to half the
// longer side of the picture, a V tool's flank to the span of the heights. The result is exact at the
// samples. Between samples, the height at which a ball of radius R touches is found to within step_mm^2 / (8
// R) on gentle slopes, and to within half a step times the slope on walls. Takes about 0.5 s for 4M samples
// and a radius of 15 samples on two cores.
Image<float> close_by_tool(const Image<float>& heights_mm, double step_mm, const Tool& tool);

struct ToolReach {
  double reached_share = 1;        // share of the front's area that is reached within the tolerance
  double largest_residual_mm = 0;  // greatest height of material left above the front
  double tolerance_mm = 0;         // 0.01, or an eighth of a sample if that is more
  double mm_per_sample = 0;        // a twelfth of the tool's radius, in [1/4096, 1/2048] of the longer side
  Image<float> heights_mm;         // heights of the front above its lowest point; NaN beside the front
  Image<float> residual_mm;        // height of material left above the front; NaN beside it
};

// Returns the part of a solid's front that the tool reaches. An empty front has no samples and counts as
// reached.
ToolReach measure_reach(const Solid& solid, const Tool& tool);

}  // namespace relievo
