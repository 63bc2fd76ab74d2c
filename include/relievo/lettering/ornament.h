// Texts, borders and drawings on the ground of a plate.
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

// The line on which a text stands.
enum class TextArc {
  straight,  // below the relief
  top,       // on a circle around the plate's middle, read clockwise
  bottom,    // on that circle, read counter-clockwise
  around     // on the whole circle, from the left, clusters spread evenly
};

inline constexpr std::array<Choice<TextArc>, 4> text_arc_choices{{{"straight", TextArc::straight},
                                                                  {"top", TextArc::top},
                                                                  {"bottom", TextArc::bottom},
                                                                  {"around", TextArc::around}}};

enum class OrnamentKind {
  text,
  beads,    // a row of balls along the rim
  rope,     // a row of slanting strands along the rim
  line,     // a raised line along the rim
  drawing,  // filled outlines
};

inline constexpr std::array<Choice<OrnamentKind>, 5> ornament_kinds{{{"text", OrnamentKind::text},
                                                                     {"beads", OrnamentKind::beads},
                                                                     {"rope", OrnamentKind::rope},
                                                                     {"line", OrnamentKind::line},
                                                                     {"drawing", OrnamentKind::drawing}}};

// The bytes of a TrueType or OpenType font. Two are equal if they are the same object.
struct FontFile {
  std::string name;  // for errors
  std::vector<std::byte> bytes;
};

// An ornament. Lengths without a value follow from the plate's margin.
struct Ornament {
  OrnamentKind kind = OrnamentKind::text;
  std::string text = {};                      // UTF-8
  std::shared_ptr<const FontFile> font = {};  // null: the font inside the program
  TextArc arc = TextArc::straight;
  std::optional<double> size_mm = {};  // height of capitals; diameter of beads; width of borders and drawings
  std::optional<double> height_mm = {};  // above the ground, below it if negative
  std::optional<double> inset_mm = {};   // distance from the rim to the outer edge
  std::optional<double> angle_deg = {};  // middle of a text on an arc, counter-clockwise from x
  std::optional<Vec2> at_mm =
      {};                    // middle of a straight text's line or of a drawing, from the plate's middle
  bool is_engraved = false;  // sunk by walls of 45 degrees that meet in the middle of thin strokes
  double tracking_mm = 0;    // added between clusters
  std::optional<double> count = {};              // of beads or strands
  std::vector<std::vector<Vec2>> outlines = {};  // of a drawing, in any unit, y up; filled by winding number

  bool operator==(const Ornament&) const = default;
};

// The thinnest stroke and the largest height or depth of a plate's ornaments; 0 and infinite without ornaments.
struct OrnamentFacts {
  double highest_mm = 0;
  double thinnest_mm = std::numeric_limits<double>::infinity();
};

// Returns whether this build can set texts; the one for WebAssembly cannot.
bool has_lettering();

// Checks that the text can be set in its font. Errors: kind option for a font that cannot be read, for a text
// without visible characters or too long, and for characters that the font lacks, which are named.
Result<void> check_text(const Ornament& ornament);

}  // namespace relievo
