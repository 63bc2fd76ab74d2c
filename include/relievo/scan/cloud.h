// Scattered point clouds, and operations that need no view.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

// A part of an outline. As seen by the viewer, the visible surface is on its left. On its right is nothing,
// or at a jump a surface farther behind.
struct OutlineSegment {
  Vec3 from, to;
  bool is_jump = false;
};

// Points in the units of their source, in double precision, so that geo-referenced coordinates (1e6 and more)
// keep all their digits. `normals` is empty or has one unit vector per point, `colours` is empty or has one
// colour per point.
struct Cloud {
  std::vector<Vec3> points;
  std::vector<Vec3f> normals;
  std::vector<Colour> colours = {};
  // If the points were sampled from a mesh, its exact outlines in the view of the sampling; else empty.
  std::vector<OutlineSegment> outlines = {};
  // Seen from +Z, no point hides another, as in a depth image.
  bool is_height_field = false;
  // For each point the height of its model in the scene, Pose::height, or 0 if that is not given; empty if no
  // model's is.
  std::vector<float> own_heights = {};
  // If the points come from a depth image, the ratio of z to the image's values, seen from +Z. It is negative
  // if values grow away from the viewer, and 0 if z is not proportional to them.
  std::optional<double> units_per_value = {};
  // For each point the direction in which the surface is thinnest there, as Gaussian splats state it, with any
  // sign; zero where it is not known. Empty if the file states none. estimate_normals() uses it.
  std::vector<Vec3f> axes = {};

  std::size_t size() const { return points.size(); }
  bool has_normals() const { return !normals.empty(); }
  bool has_colours() const { return !colours.empty(); }
};

// Returns the box of all points; an empty box for an empty cloud.
Box bounds(const Cloud& cloud);

// Returns the indices, ascending, of points that cannot belong to the model. Their distance from its middle
// (the median of each coordinate) is more than 20 times the distance within which 90 % of the points lie. A
// single outlier, for instance at the origin of a geo-referenced scan, would make the model a speck in its
// own box.
std::vector<Index> outliers(const Cloud& cloud);

// Returns the cloud with only the first point of each group of points that repeat one another, exactly or
// nearly; the cloud is unchanged if hardly any points do. Points repeat one another if they are much closer
// together than to all other points and their normals do not point apart: both sides of a thin sheet stay.
// Normals and colours are the means of the group.
Cloud without_repeated_points(Cloud cloud);

// Returns the cloud without the points with the indices `erased`, which are ascending.
Cloud erase_points(const Cloud& cloud, std::span<const Index> erased);

}  // namespace relievo
