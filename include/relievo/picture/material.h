// Defines the material of a body in a picture, and the direction of the light.
#pragma once

#include <array>

#include "relievo/core/choice.h"
#include "relievo/core/types.h"

namespace relievo {

enum class Material { plaster, silver, bronze, walnut, porcelain };  // porcelain is lit from behind

inline constexpr std::array<Choice<Material>, 5> material_choices{{{"plaster", Material::plaster},
                                                                   {"silver", Material::silver},
                                                                   {"bronze", Material::bronze},
                                                                   {"walnut", Material::walnut},
                                                                   {"porcelain", Material::porcelain}}};

// The direction to the lamp, in the axes of the plate. Light comes from the upper left, because people assume
// that light comes from there (Kleffner and Ramachandran, On the perception of shape from shading, 1992). The
// lamp is 30 degrees above the plate, which is low enough to distinguish the slopes of a shallow relief.
inline const Vec3f upper_left_lamp(-1, 1, .8F);

}  // namespace relievo
