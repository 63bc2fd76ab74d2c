#include "settle_normals.h"

#include <algorithm>

#include "relievo/normals.h"
#include "relievo/visible.h"

namespace relievo {
namespace {

// A scan from the viewer's side, say a depth image of a room: turned, its normals would all face away.
bool all_face_viewer(const Cloud& viewed) {
  return std::ranges::all_of(viewed.normals, [](const Vec3f& n) { return n.z() > 0; });
}

}  // namespace

NormalsWere settle_normals(Cloud& viewed, const Spacing& spacing, const Cloud& cloud) {
  if (!viewed.has_normals()) {
    estimate_normals(viewed);
    turn_to_viewer(viewed);
    turn_to_viewer(viewed, spacing, visible_points(viewed, spacing));
    return NormalsWere::missing;
  }
  if (all_face_viewer(viewed) || !normals_point_inward(cloud)) return NormalsWere::outward;
  flip_normals(viewed);
  return NormalsWere::inward;
}

}  // namespace relievo
