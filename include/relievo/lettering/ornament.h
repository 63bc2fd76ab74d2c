// Defines texts, borders and drawings on the ground of a plate.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/choice.h"
#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

// The baseline of a text.
enum class TextArc {
  straight,  // below the relief
  top,       // on a circle around the plate's middle, clockwise
  bottom,    // on the same circle, counter-clockwise
  around     // all around that circle, beginning at the left, with equal gaps between glyph clusters
};

inline constexpr std::array<Choice<TextArc>, 4> text_arc_choices{{{"straight", TextArc::straight},
                                                                  {"top", TextArc::top},
                                                                  {"bottom", TextArc::bottom},
                                                                  {"around", TextArc::around}}};

enum class OrnamentKind {
  text,
  beads,    // a row of balls along the rim
  rope,     // a row of slanted strands along the rim
  line,     // a raised line along the rim
  drawing,  // filled outlines
};

inline constexpr std::array<Choice<OrnamentKind>, 5> ornament_kinds{{{"text", OrnamentKind::text},
                                                                     {"beads", OrnamentKind::beads},
                                                                     {"rope", OrnamentKind::rope},
                                                                     {"line", OrnamentKind::line},
                                                                     {"drawing", OrnamentKind::drawing}}};

// A TrueType or OpenType font. Two ornaments compare equal only if both point to the same FontFile object.
struct FontFile {
  std::string name;  // name for errors
  std::vector<std::byte> bytes;
};

// An ornament. Lengths that are not given are derived from the plate's margin.
struct Ornament {
  OrnamentKind kind = OrnamentKind::text;
  std::string text = {};                      // UTF-8
  std::shared_ptr<const FontFile> font = {};  // null for the built-in font
  TextArc arc = TextArc::straight;
  std::optional<double> size_mm = {};  // height of capitals; diameter of beads; width of borders and drawings
  std::optional<double> height_mm = {};  // height above the ground; negative below it
  std::optional<double> inset_mm = {};   // distance from the rim to the ornament's outer edge
  std::optional<double> angle_deg = {};  // angle of the middle of a text on an arc, counter-clockwise from x
  std::optional<Vec2> at_mm =
      {};                    // middle of a straight text or of a drawing, relative to the plate's middle
  bool is_engraved = false;  // cut into the ground with walls of 45 degrees, which meet in thin strokes
  double tracking_mm = 0;    // additional space between glyph clusters, such as letters
  std::optional<double> count = {};              // number of beads or strands
  std::vector<std::vector<Vec2>> outlines = {};  // drawing: any unit, y up; filled by nonzero winding

  bool operator==(const Ornament&) const = default;
};

// Facts about the ornaments of a plate: their largest height or depth, and their thinnest stroke. The default
// values are those of a plate without ornaments.
struct OrnamentFacts {
  double highest_mm = 0;
  double thinnest_mm = std::numeric_limits<double>::infinity();
};

// Checks that the text can be typeset in its font. Errors: kind option for a font that cannot be read, for a
// text that is too long or has no visible characters, and for characters missing in the font. The message
// names the missing characters.
Result<void> check_text(const Ornament& ornament);

}  // namespace relievo
