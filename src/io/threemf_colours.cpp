#include "io/threemf_colours.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "io/text.h"

namespace relievo::io {
namespace {

// Reads "#RRGGBB" or "#RRGGBBAA"; the opacity AA is ignored.
std::optional<Colour> parse_colour(std::string_view text) {
  if (!text.starts_with('#') || (text.size() != 7 && text.size() != 9)) return std::nullopt;
  Colour colour = {};
  for (std::size_t c = 0; c < 3; ++c) {
    const char* const first = text.data() + 1 + 2 * c;
    const auto [end, failed] = std::from_chars(first, first + 2, colour[c], 16);
    if (failed != std::errc{} || end != first + 2) return std::nullopt;
  }
  return colour;
}

}  // namespace

void ThreeMfColours::take(const XmlElements& elements, std::size_t resource) {
  const std::string_view kind = local_name(elements[resource].name);
  const bool are_materials = kind == "basematerials";
  if (!are_materials && kind != "colorgroup") return;
  std::vector<Colour>& group = groups_[elements[resource].attribute("id")];
  for (std::size_t i = resource + 1; i < elements[resource].end; i = elements[i].end)
    if (local_name(elements[i].name) == (are_materials ? "base" : "color"))
      group.push_back(parse_colour(elements[i].attribute(are_materials ? "displaycolor" : "color"))
                          .value_or(Colour{255, 255, 255}));
}

std::optional<Colour> ThreeMfColours::of_corner(const XmlElement& object, const XmlElement& triangle,
                                                std::size_t corner) const {
  // A triangle without colour has the colour of its object. A corner without colour has the colour of the
  // first corner.
  constexpr std::array names = {"p1", "p2", "p3"};
  std::string_view index = triangle.attribute(names[corner]), id = triangle.attribute("pid");
  if (index.empty()) index = triangle.attribute("p1");
  if (index.empty()) index = object.attribute("pindex"), id = object.attribute("pid");
  if (id.empty()) id = object.attribute("pid");
  const auto group = groups_.find(id);
  const auto number = parse_integer(index);
  if (group == groups_.end() || !number || *number < 0 ||
      static_cast<std::uint64_t>(*number) >= group->second.size())
    return std::nullopt;
  return group->second[static_cast<std::size_t>(*number)];
}

}  // namespace relievo::io
