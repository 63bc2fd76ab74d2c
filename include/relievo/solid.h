// A relief as a closed body that a machine can cut or print, in millimetres, and its files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "relievo/error.h"
#include "relievo/outline.h"
#include "relievo/types.h"

namespace relievo {

// The front of a relief: a height field over the view plane, in millimetres.
// - `points`: x, y in the plane, z the height; no two share x and y.
// - `triangles`: cover the convex hull of the points, counter-clockwise seen from +Z, no overlaps.
// - `hull`: the convex hull, counter-clockwise, with the points on its edges; all at height `ground_mm`.
struct Front {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<Index> hull;
  double ground_mm = 0;              // height of the flat background
  std::vector<Colour> colours = {};  // of the points, or empty
  // Per triangle: part of the relief, not of the ground around and within it; empty if all are. Only a plate
  // without ground asks for it.
  std::vector<std::uint8_t> is_relief = {};
};

struct PlateOptions {
  double margin_mm = 5;     // least flat ground around the front, >= 0.001
  double thickness_mm = 3;  // smallest thickness of the plate anywhere, >= 0.001
  Outline outline = Outline::rectangle;
  double corner_mm = 5;  // radius of the corners of outline `round`, >= 0.001
};

// A closed triangle mesh, oriented outwards. `front_triangles` first triangles are the front (relief and
// ground).
struct Solid {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::size_t front_triangles = 0;
  std::vector<Colour> colours = {};  // of the points, or empty
};

// Returns the plate: front, flat ground out to the outline, walls, bottom. Moved so that its box starts at
// the origin: x, y, z >= 0, the bottom at z = 0, the lowest point of the front at z = thickness_mm. Its z
// extent is thickness + (highest - lowest point of the front, ground included). The front's points and
// triangles come first, in their order; the ground adds no points but the outline's corners. Of two points
// that single precision cannot tell apart the second is lifted or lowered by the smallest step that separates
// them.
//
// Outline `none` makes a body of the relief alone, or several where it has several pieces, with their holes:
// the front is the relief's points and triangles alone, in their order, and the bottom has as many. Left out
// are triangles that hang on by a corner only, and pieces below a thousandth of the whole.
//
// Errors: kind option for a margin, thickness or corner that is not finite or below a micrometre; kind
// geometry for an empty front, one whose corners are not finite points of it, or without relief for outline
// `none`. Time: O(n log n), 0.1 s for 340k points.
Result<Solid> make_plate(const Front& front, const PlateOptions& options);

// Returns what is wrong with a solid, or an empty string: every edge shared by exactly two triangles with
// opposite directions, no triangle with two equal corners, no two used points with the same single-precision
// coordinates, volume positive. A public checker, for tests and bug reports; 0.1 s for 1M triangles.
std::string check_solid(const Solid& solid);

// Enclosed volume in cubic millimetres; negative if the solid is inside out.
double volume_mm3(const Solid& solid);

// The solid as a file: binary STL; binary little-endian PLY; OBJ. Coordinates are in millimetres, single
// precision. Of colours only PLY tells. The solid's corners must exist, as check_solid() tells.
std::vector<std::byte> write_stl(const Solid& solid);
std::vector<std::byte> write_ply(const Solid& solid);
std::vector<std::byte> write_obj(const Solid& solid);

}  // namespace relievo
