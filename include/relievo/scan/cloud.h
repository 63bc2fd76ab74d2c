// Defines clouds of scattered points, and operations that need no view.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

// A part of an outline. As the viewer sees it, the visible surface is on the left side of the segment. On its
// right side there is nothing or, at a depth jump, a surface farther behind.
struct OutlineSegment {
  Vec3 from, to;
  bool is_jump = false;
};

// Points in the units of their source, in double precision, so that georeferenced coordinates (1e6 and more)
// keep all digits. `normals` is empty or has a unit vector per point; `colours` is empty or has a colour per
// point.
struct Cloud {
  std::vector<Vec3> points;
  std::vector<Vec3f> normals;
  std::vector<Colour> colours = {};
  // If the points were sampled from a mesh: its exact outlines in the view of the sampling; else empty.
  std::vector<OutlineSegment> outlines = {};
  // Whether no point hides another point from a viewer on the +Z side, as in a depth image.
  bool is_height_field = false;
  // For each point: Pose::height of its model, or 0 if that is not given. Empty if no model has a height.
  std::vector<float> own_heights = {};
  // If the points are from a depth image: the ratio of z, seen from +Z, to the image's values. It is negative
  // if values increase away from the viewer, and 0 if z is not proportional to them.
  std::optional<double> units_per_value = {};
  // For each point the shortest axis of its Gaussian splat, which is perpendicular to the surface and may
  // have either sign; zero where it is not known. Empty for other clouds. estimate_normals() uses the axes.
  std::vector<Vec3f> axes = {};

  std::size_t size() const { return points.size(); }
  bool has_normals() const { return !normals.empty(); }
  bool has_colours() const { return !colours.empty(); }
};

// Returns the bounding box of all points; an empty box for an empty cloud.
Box bounds(const Cloud& cloud);

// Returns the indices, ascending, of points that cannot belong to the model: their distance from the middle
// (the median of each coordinate) is more than 20 times the distance within which 90 % of the points are. A
// single outlier, for example at the origin of a georeferenced scan, would make the model tiny in its box.
std::vector<Index> outliers(const Cloud& cloud);

// Returns the cloud with only the first point of each group of exact or near repeats; unchanged if hardly any
// points are repeated. Points repeat each other if they are much closer to each other than to all other
// points and their normals differ by at most 90 degrees. This limit keeps both sides of a thin sheet. Normals
// and colours are the means of the group.
Cloud without_repeated_points(Cloud cloud);

// Returns the cloud without the points whose indices are in `erased`, which must be in ascending order.
Cloud erase_points(const Cloud& cloud, std::span<const Index> erased);

}  // namespace relievo
