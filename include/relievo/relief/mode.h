// How the heights of a relief are found: from all points, or from a few thousand.
#pragma once

#include <array>
#include <string_view>

#include "relievo/core/choice.h"

namespace relievo {

enum class Mode {
  exact,     // from all visible points
  subspace,  // from a few thousand control points: see SubspaceModel
  automatic  // exact, unless there are more visible points than `most_exact_points`
};

inline constexpr std::array<Choice<Mode>, 3> mode_choices{
    {{"exact", Mode::exact}, {"subspace", Mode::subspace}, {"auto", Mode::automatic}}};

// Returns the mode of that name. Errors: kind option for any other, naming mode.
inline Result<Mode> parse_mode(std::string_view name) {
  return parse_choice("mode", name, mode_choices);
}

}  // namespace relievo
