// Makes a relief into a closed body for milling or printing, in millimetres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/types.h"
#include "relievo/lettering/ornament.h"
#include "relievo/plate/base.h"
#include "relievo/plate/outline.h"
#include "relievo/plate/tool.h"
#include "relievo/plate/wrap.h"

namespace relievo {

// The front of a relief: a triangulated height field over the view plane, in millimetres.
// - `points`: x and y in the plane, z is the height; no two points have the same x and y.
// - `triangles`: cover the convex hull of the points without overlaps, counter-clockwise seen from +Z.
// - `hull`: the convex hull, counter-clockwise, including points on its edges; all at height `ground_mm`.
struct HeightFieldMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<Index> hull;
  double ground_mm = 0;              // height of the flat ground
  std::vector<Colour> colours = {};  // colours of the points, or empty
  // Per triangle: true if it is part of the relief, false if it is part of the ground around or inside the
  // relief. Empty if all triangles are part of the relief. Used only for a plate without ground.
  std::vector<std::uint8_t> is_relief = {};
};

// A raised rim along the outline, as on coins and plaques. Each length is 0 or has a magnitude of at least
// 0.001 mm.
struct RimOptions {
  double width_mm = 0;  // width from the outline to the inner ground; 0 for no rim
  // Height of the rim's flat top above the ground. If negative, the rim is a groove, as in a die, and the
  // plate extends beyond the groove by the rim's width.
  double height_mm = 1;
  double bevel_mm = .3;  // width of the sloping inner side, which is a part of width_mm

  bool operator==(const RimOptions&) const = default;
};

struct PlateOptions {
  double margin_mm = 5;     // least width of the flat ground between front and rim, >= 0.001
  double thickness_mm = 3;  // least thickness of the plate, >= 0.001
  Outline outline = Outline::rectangle;
  double corner_mm = 5;  // radius of the corners of outline `round`, >= 0.001
  RimOptions rim = {};
  BaseOptions base = {};
  WrapOptions wrap = {};      // the body that wrap_plate() will bend the plate around; requires a plane base
  double tolerance_mm = .01;  // largest distance of triangles from a curved base or wrap, >= 0.0001
  // The tolerance of simplify() for the whole front, including the ground. If it is 0, or the plate has no
  // ground, the front is not simplified.
  double simplify_mm = 0;
  double max_slope = std::numeric_limits<double>::infinity();            // slope limit for simplify()
  std::size_t most_triangles = std::numeric_limits<std::size_t>::max();  // limit of triangles for simplify()
  std::optional<Tool> tool = {};  // if given, the front is cut by this tool; only for a plane base
  // Width and height of the outline, see OutlineOptions; 0 if not given. For a die whose rim is a groove,
  // this is the size of the workpiece that the die makes.
  Vec2 size_mm = Vec2::Zero();
  Vec2 shift_mm = Vec2::Zero();          // shift of the front from the middle of an outline with a given size
  std::vector<Ornament> ornaments = {};  // ornaments on the ground; not for the outline `none`
  // Slope of the ornaments' walls, > 0; the default is 15 degrees off the vertical.
  double ornament_slope = 3.7;
  // If one of these is true, make_plate() mirrors or inverts the ornaments. The front must be mirrored or
  // inverted already.
  bool is_mirrored = false;  // whether left and right are swapped
  bool is_die = false;       // whether what is raised in the relief is sunk, and vice versa

  bool operator==(const PlateOptions&) const = default;
};

// The parts of a front; ornaments belong to `bevel`. Renderers draw a crease between two parts, even at a
// very small angle.
enum class Region : std::uint8_t { relief, ground, bevel };

// A closed triangle mesh, oriented outwards. The first `front_triangles` triangles are the front: relief,
// ground and rim.
struct Solid {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::size_t front_triangles = 0;
  std::vector<Colour> colours = {};  // colours of the points, or empty
  std::vector<Region> regions = {};  // regions of front triangles, for pictures; empty if all are relief
  Vec3 shift = Vec3::Zero();         // with flat ground: the solid's coordinates minus the front's
  double ground_mm = 0;              // height of the flat ground, or of a curved base in the middle
  double error_mm = 0;  // largest distance from the exact surface, due to bending and simplifying
  OrnamentFacts ornaments = {};
  // Unit of the coordinates; only in_unit() and files use other units than mm.
  LengthUnit unit = LengthUnit::mm;
};

// Returns the solid with coordinates in `unit`, for files. Points that would coincide in single precision are
// separated as in make_plate().
Solid in_unit(Solid solid, LengthUnit unit);

// Returns the plate: front, flat ground and rim up to the outline, walls, and bottom. Its bounding box begins
// at the origin: x, y, z >= 0, with the bottom at z = 0 and the lowest point of the front at z =
// thickness_mm. Its extent in z is the thickness plus the difference between the highest and the lowest point
// of the front, including ground and rim. The front's points and triangles come first, in their order. The
// only points that the ground adds are the corners of the outline and of the rim's edges. Ornaments add their
// own points. If two points would coincide in single precision, z of the second one is changed by the
// smallest step that separates them.
//
// The outline `none` makes a body of only the relief, with its holes, or several bodies if the relief has
// several connected parts. The front then has only the relief's points and triangles, in their order, and the
// bottom has as many of both as the front. Triangles that are connected only by a corner, and parts smaller
// than a thousandth of the whole, are left out.
//
// Errors: kind option for a margin, thickness, corner or rim that is not finite or below a micrometre, a
// bevel wider than its rim, a rim or ornaments with the outline `none`, or ornaments without sufficient
// space; kind geometry for an empty front, a front with triangles whose corners are missing or not finite,
// or, with the outline `none`, a front without relief. Time: O(n log n), 0.1 s for 340k points.
Result<Solid> make_plate(const HeightFieldMesh& front, const PlateOptions& options);

// Returns the base that make_plate() uses under the front, in the front's coordinates. Errors: those of
// make_plate() and Base::over().
Result<Base> plate_base(const HeightFieldMesh& front, const PlateOptions& options);

// Returns the plate bent around its wrap: its ground is on the wrap, its bottom is the other side of the
// shell, and its walls point towards the axis. Its bounding box begins at the origin. If a rectangle goes all
// the way around a cylinder or a cone, its two sides are joined. `plate` must be the result of make_plate()
// with the same options. Errors: those of plate_wrap(); kind option if there is no wrap, or if the shell or
// the relief would reach the axis. A plate that goes all the way around is also an error of kind option if
// its outline is not a rectangle, its wrap has a slanted axis, or it has a rim.
Result<Solid> wrap_plate(const Solid& plate, const PlateOptions& options);

// Returns the wrap of a plate that make_plate() made with the same options. Errors: those of Wrap::around().
Result<Wrap> plate_wrap(const Solid& plate, const PlateOptions& options);

// Checks that a solid is closed and has no faults: every edge is shared by exactly two triangles with
// opposite directions; no triangle has two equal corners; no two used points have the same single-precision
// coordinates; the volume is positive. Returns a description of the first fault, or an empty string. This
// function is public for tests and bug reports. It takes 0.1 s for 1M triangles.
std::string check_solid(const Solid& solid);

// Returns the enclosed volume in cubic millimetres; negative if the solid is inside out.
double volume_mm3(const Solid& solid);

}  // namespace relievo
