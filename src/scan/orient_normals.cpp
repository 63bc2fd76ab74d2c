#include "scan/orient_normals.h"

#include <algorithm>

#include "relievo/scan/normals.h"
#include "relievo/scan/visible.h"

namespace relievo {

void give_signs(Cloud& viewed, const Spacing& spacing) {
  turn_to_viewer(viewed);
  spread_normal_signs(viewed, spacing, visible_points(viewed, spacing));
}

bool all_face_viewer(const Cloud& viewed) {
  return std::ranges::all_of(viewed.normals, [](const Vec3f& n) { return n.z() > 0; });
}

OriginalNormals orient_normals(Cloud& viewed, const Spacing& spacing, const Cloud& cloud) {
  if (!viewed.has_normals()) {
    estimate_normals(viewed);
    give_signs(viewed, spacing);
    return OriginalNormals::missing;
  }
  if (all_face_viewer(viewed) || !normals_point_inward(cloud)) return OriginalNormals::usable;
  flip_normals(viewed);
  return OriginalNormals::inward;
}

}  // namespace relievo
