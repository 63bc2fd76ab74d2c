#include <utility>

#include "plate/coincident_points.h"
#include "plate/front/folds.h"
#include "relievo/core/length.h"
#include "relievo/plate/solid.h"

namespace relievo {

Solid in_unit(Solid solid, LengthUnit unit) {
  if (unit == std::exchange(solid.unit, unit)) return solid;
  const bool is_height_field = find_folds(solid).empty();  // a wrapped solid may not be one
  const double scale = unit == LengthUnit::mm ? mm_per_inch : 1 / mm_per_inch;
  Box box;
  for (Vec3& p : solid.points) {
    p *= scale;
    box.extend(p);
  }
  if (is_height_field) unfold(solid);
  if (!box.is_empty()) separate_coincident(solid, box.centre().z());
  return solid;
}

}  // namespace relievo
