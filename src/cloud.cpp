#include "relievo/cloud.h"

namespace relievo {

Box bounds(const Cloud& cloud) {
  Box box;
  for (const Vec3& p : cloud.points) box.extend(p);
  return box;
}

}  // namespace relievo
