// Describes milling tools, and computes the part of a front that they reach and the surface that they leave.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/image.h"
#include "relievo/core/types.h"

namespace relievo {

struct Solid;

// The tip of a tool that rotates about the z axis and cuts downwards. Diameters are those of the cutting
// part, in mm.
struct Tool {
  enum class Kind { ball, flat, v };
  Kind kind = Kind::ball;
  double diameter_mm = 1;  // diameter of a ball or flat end, [0.01, 1000]
  double angle_deg = 60;   // angle between a V tool's flanks, [1, 170]; the flanks have unlimited length
  double tip_mm = 0;       // diameter of the ball at a V tool's tip, [0, 1000]; 0 for a sharp tip

  bool operator==(const Tool&) const = default;
};

// Returns the tool described by a text: "ball:DIAMETER", "flat:DIAMETER", "v:ANGLE" or "v:ANGLE:TIP". ANGLE
// is in degrees; DIAMETER and TIP are lengths for parse_length(). Errors: kind option, naming tool.
Result<Tool> parse_tool(std::string_view text, LengthUnit bare = LengthUnit::mm);

// Returns the tool as a text that parse_tool() reads, in millimetres.
std::string text_of(const Tool& tool);

// Returns the height in mm of the tool's surface above the tool's lowest point, at the distance `distance_mm`
// from the tool's axis; infinity beyond the tool's radius.
double tool_profile(const Tool& tool, double distance_mm);

// Returns the lowest surface that the tool can leave without cutting below the height of any sample: the
// morphological closing of the heights by the tool's shape. It is never below the heights. NaN marks samples
// without material, where nothing obstructs the tool, and remains NaN. The tool's axis visits all samples,
// and positions outside the image at most the tool's radius away from it. The radius is limited to half the
// longer side of the image; a V tool's flank is limited to the range of the heights. The result is exact at
// the samples. Positions between samples are not visited. So the height at which a ball of radius R touches
// has an error of up to step_mm^2 / (8 R) on gentle slopes. On walls the error is up to half a step times the
// slope. Takes about 0.5 s for 4M samples and a radius of 15 samples on two cores.
Image<float> close_by_tool(const Image<float>& heights_mm, double step_mm, const Tool& tool);

struct ToolReach {
  double reached_share = 1;        // share of the front's area that the tool reaches within the tolerance
  double largest_residual_mm = 0;  // largest height of material that is left on the front
  double tolerance_mm = 0;         // 0.01, or an eighth of mm_per_sample if that is larger
  double mm_per_sample = 0;  // a twelfth of the tool's radius, but in [1/4096, 1/2048] of the longer side
  Image<float> heights_mm;   // heights of the front above its lowest point; NaN where there is no front
  Image<float> residual_mm;  // height of material that is left on the front; NaN where there is no front
};

// Returns the part of a solid's front that the tool reaches. An empty front has no samples and counts as
// reached.
ToolReach measure_reach(const Solid& solid, const Tool& tool);

}  // namespace relievo
