#include "scan/orient_normals.h"

#include <algorithm>

#include "relievo/scan/normals.h"
#include "relievo/scan/visible.h"

namespace relievo {
namespace {

// Returns whether the cloud was scanned from the viewer's side, as a depth image of a room is. Such a scan
// looks as if its normals pointed inwards, but if they were reversed, all of them would face away from the
// viewer.
bool all_face_viewer(const Cloud& viewed) {
  return std::ranges::all_of(viewed.normals, [](const Vec3f& n) { return n.z() > 0; });
}

}  // namespace

OriginalNormals orient_normals(Cloud& viewed, const Spacing& spacing, const Cloud& cloud) {
  if (!viewed.has_normals()) {
    estimate_normals(viewed);
    turn_to_viewer(viewed);
    spread_normal_signs(viewed, spacing, visible_points(viewed, spacing));
    return OriginalNormals::missing;
  }
  if (all_face_viewer(viewed) || !normals_point_inward(cloud)) return OriginalNormals::usable;
  flip_normals(viewed);
  return OriginalNormals::inward;
}

}  // namespace relievo
