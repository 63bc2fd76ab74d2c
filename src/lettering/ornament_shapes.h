// Places ornaments on a plate.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/outline_union.h"
#include "geometry/raised_shape.h"
#include "relievo/lettering/ornament.h"

namespace relievo {

// The area for ornaments: the ground of a plate, and the limits of the ornaments' walls.
struct OrnamentFrame {
  std::vector<Vec2> inner;            // convex polygon inside the rim, counter-clockwise, in mm
  double margin_mm = 5;               // width of the ground around the relief
  double border_mm = 0;               // width of the part of the margin where borders leave no room for texts
  std::optional<double> rim_mm = {};  // height of the rim; empty without a rim
  double slope = 4;                   // steepest slope of walls, > 0
  bool is_mirrored = false;           // whether left and right are exchanged
  bool is_die = false;                // whether raised ornaments become sunk
};

// Returns the width of the margin that borders occupy, in mm. Ignores borders that are farther inside than
// the margin's middle.
double margin_of_borders(std::span<const Ornament> ornaments, double margin_mm);

// Returns the shapes of the ornaments in the order of the list. Errors: those of check_text(); kind option
// for lengths out of their range, for texts longer than their circle, and for drawings without an area or a
// size.
Result<std::vector<RaisedShape>> ornament_shapes(std::span<const Ornament> ornaments,
                                                 const OrnamentFrame& frame);

// A row of equal beads or strands along a convex polygon.
struct BorderRow {
  std::vector<Vec2> path;
  double width_mm = 0;
  double count = 0;  // number of beads or strands; 0: as many as fit well
};

// Returns both edges of a line with the given width. The outer edge is `before_mm` inside the polygon.
Outlines line_outlines(std::span<const Vec2> polygon, double before_mm, double width_mm);

// Returns discs whose diameter is the width of the row.
Outlines bead_outlines(const BorderRow& row);

// Returns ellipses that are tilted against the path, as the strands of a rope.
Outlines rope_outlines(const BorderRow& row);

// Returns the radius of the largest circle inside a bead, which is a polygon.
double bead_radius(const BorderRow& row);

// Returns the smaller half axis of a rope's ellipse.
double strand_radius(const BorderRow& row);

// Glyphs that belong together, such as a letter with its marks. Coordinates are relative to the start of the
// line and its baseline. The unit is the height of the font's capitals.
struct GlyphCluster {
  Outlines outlines;
  double begin = 0, advance = 0;
  bool is_joined = false;  // connected to its neighbours, as Arabic letters are
};

struct ShapedLine {
  std::vector<GlyphCluster> clusters;  // from left to right
  double advance = 0, x_height = 0;
};

// Returns the line of text in the ornament's font, or in the embedded font if the ornament has no font.
// Curves become polygons that deviate by at most `tolerance`, in heights of capitals. Errors: those of
// check_text().
Result<ShapedLine> shape_line(const Ornament& ornament, double tolerance);

}  // namespace relievo
