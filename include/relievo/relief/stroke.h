// Defines strokes, which are local changes of a relief that users paint onto the model.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/choice.h"
#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

// The change that a stroke makes to the heights z under it. Every brush adds to z a field that is 0 outside
// of the stroke, so other heights do not change. The blurs are Gaussian, along the surface, and do not cross
// depth jumps. `protect` is an error in a scene in which a model has its own height.
enum class Brush {
  strengthen,  // adds amount * (z - wide blur of z), which emphasises shapes as wide as a finger or a brow
  sharpen,     // adds amount * (z - narrow blur of z)
  soften,      // subtracts amount * (z - narrow blur of z)
  raise,       // adds amount * height of the relief
  sink,        // subtracts amount * height of the relief
  level,       // adds amount * (mean height under the stroke - z)
  // Removes the share `amount` of the height correction, but keeps the plane that fits this correction best.
  // With amount 1 the correction only moves and tilts the shapes under the stroke, and does not flatten them.
  protect,
  in_front  // raises the stroke as a whole until it stands amount * height above the surface behind it
};

inline constexpr std::array<Choice<Brush>, 8> brushes{{{"strengthen", Brush::strengthen},
                                                       {"sharpen", Brush::sharpen},
                                                       {"soften", Brush::soften},
                                                       {"raise", Brush::raise},
                                                       {"sink", Brush::sink},
                                                       {"level", Brush::level},
                                                       {"protect", Brush::protect},
                                                       {"in-front", Brush::in_front}}};

// The points that belong to a stroke.
enum class StrokeArea {
  line,  // the points within the radius of a line
  // The points inside a closed line, seen in the direction in which the line was drawn. Points that are
  // behind the line by more than half of the longer side of the line's bounding box are left out.
  lasso,
  region  // the points around a single point, as far as the surface turns less than the tolerance
};

inline constexpr std::array<Choice<StrokeArea>, 3> stroke_areas{
    {{"line", StrokeArea::line}, {"lasso", StrokeArea::lasso}, {"region", StrokeArea::region}}};

// Standard deviations of the two blurs, as shares of the surface's longer side.
inline constexpr double narrow_blur = .008, wide_blur = .03;

// A line or an area on the model, and the change there. A stroke is fixed to the model: in other views it is
// at the same place of the model, and changes the points that are visible there.
struct Stroke {
  std::string name;
  Brush brush = Brush::soften;
  double amount = 1;  // factor of the change, see Brush: [0, 1]; strengthen and sharpen: [0, 4]
  // Largest distance from the line, in the units of the scan, > 0. In a lasso or a region, the change fades
  // out towards the edge, and has its full amount at this distance from the edge and farther inside.
  double radius = 0;
  double softness = 1;         // share of the radius over which the change fades out, [0.05, 1]
  bool is_muted = false;       // a muted stroke changes nothing
  std::vector<Vec3> points{};  // corners of the line, in the scan's coordinates; one point is allowed
  StrokeArea area = StrokeArea::line;
  Vec3 direction =
      Vec3::Zero();      // for a lasso: direction to the viewer who drew it, in the scan's axes; not zero
  double tolerance = 6;  // for a region: largest turn in degrees per 1 % of the longer side, [0.1, 180]

  bool operator==(const Stroke&) const = default;
};
using Strokes = std::vector<Stroke>;

inline constexpr std::size_t most_strokes = 10'000, most_stroke_points = 100'000;

// Returns the strokes in a JSON array such as
//   [{"brush": "soften", "amount": 0.5, "radius": 3, "points": [[0, 1, 2], [1, 1, 2]], "name": "cheek"}].
// Amount, softness, name and muted are optional. Without the key "area", the area is "line". A lasso has at
// least three points and a "direction" [x, y, z]; a region has one point, and perhaps a "tolerance". An empty
// text means no strokes. Errors: kind option, naming the stroke and what was expected.
Result<Strokes> parse_strokes(std::string_view json);

}  // namespace relievo
