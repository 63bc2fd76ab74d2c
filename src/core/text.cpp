#include "relievo/core/text.h"

#include <cmath>

namespace relievo {

std::optional<Vec3> parse_triple(std::string_view text) {
  Vec3 v;
  for (int axis = 0; axis < 3; ++axis) {
    const char* const end = text.data() + text.size();
    const auto [rest, status] = std::from_chars(text.data(), end, v[axis]);
    if (status != std::errc{} || !std::isfinite(v[axis])) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
    if (axis == 2) break;
    if (text.empty() || text.front() != ',') return std::nullopt;
    text.remove_prefix(1);
  }
  return text.empty() ? std::optional(v) : std::nullopt;
}

}  // namespace relievo
