// Finds the plane that supports a scanned figure or is behind it: a table, the ground or a wall.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "relievo/core/choice.h"
#include "relievo/scan/cloud.h"

namespace relievo {

enum class PlaneKind : std::uint8_t { table, background };

inline constexpr std::array<Choice<PlaneKind>, 2> plane_kinds{
    {{"table", PlaneKind::table}, {"background", PlaneKind::background}}};

// A plane in view coordinates: the points p with normal . p = offset.
struct SupportPlane {
  PlaneKind kind = PlaneKind::background;
  Vec3 normal = Vec3::UnitZ();  // unit vector towards the viewer and the figure
  double offset = 0;
  double tolerance = 0;  // points within this distance belong to the plane, in the cloud's units
  double share = 0;      // share of the visible points that belong to the plane

  // Returns whether a point is not part of the figure: it is behind the plane, or on it with a normal similar
  // to the plane's.
  bool takes(const Vec3& point, const Vec3f& point_normal) const;
  bool operator==(const SupportPlane&) const = default;
};

// Returns the plane that the visible points of a cloud stand on or in front of; nothing if there is none.
// `viewed` is in view coordinates and has normals, `visible` are the indices of its visible points, and rho
// is its sampling distance. A plane is a table if it is level from left to right and rises away from the
// viewer; other planes that face the viewer are backgrounds. To exclude the faces of solids, nearly all
// points off the plane must be in front of it. Most of these points must stand over the hull of the points on
// the plane. They must also rise far above the plane, compared with the width of the area that they cover on
// it. The result has the same bits for any number of threads.
std::optional<SupportPlane> find_support_plane(const Cloud& viewed, std::span<const Index> visible,
                                               double rho);

}  // namespace relievo
