// The plane on which or in front of which a scanned figure stands: a table, the ground, a wall.
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
  Vec3 normal = Vec3::UnitZ();  // unit length, towards the viewer and the figure
  double offset = 0;
  double tolerance = 0;  // points at most this far from the plane belong to it, in the cloud's units
  double share = 0;      // share of the visible points that belong to the plane

  // Returns whether a point is not part of the figure, because it lies behind the plane, or on it with a
  // normal that fits the plane.
  bool takes(const Vec3& point, const Vec3f& point_normal) const;
  bool operator==(const SupportPlane&) const = default;
};

// Returns the plane on which or in front of which the visible points of a cloud stand; nothing if there is
// none. `viewed` is in view coordinates and has normals, `visible` are the indices of its visible points, and
// rho is its sampling distance. A table is level from the left to the right and rises away from the viewer;
// other planes that face the viewer are backgrounds. A face of a solid is no support plane: all but a few of
// the other points have to lie in front of the plane and over it, and to rise far above it relative to their
// extent. The result has the same bits for any number of threads.
std::optional<SupportPlane> find_support_plane(const Cloud& viewed, std::span<const Index> visible,
                                               double rho);

}  // namespace relievo
