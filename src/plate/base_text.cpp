#include <vector>

#include "plate/shape_text.h"
#include "relievo/plate/base.h"

namespace relievo {
namespace {

std::vector<ShapeNumber> numbers_of(BaseOptions& base, std::optional<double>& direction) {
  const ShapeNumber height{"height", &base.height_mm}, along{"direction", &direction, ShapeUnit::degrees};
  switch (base.kind) {
    case BaseKind::plane:
      return {};
    case BaseKind::fold:
      return {height, {"angle", &base.angle_deg, ShapeUnit::degrees}, along};
    case BaseKind::wave:
      return {height, {"length", &base.length_mm}, along};
    case BaseKind::cylinder:
      return {height, {"diameter", &base.diameter_mm}, along};
    case BaseKind::dome:
      return {height, {"diameter", &base.diameter_mm}};
    case BaseKind::image:
      return {height};
  }
  return {};
}

}  // namespace

Result<BaseOptions> parse_base(std::string_view text) {
  RELIEVO_TRY(const BaseKind kind, parse_choice("base", shape_kind(text), base_choices));
  BaseOptions base;
  base.kind = kind;
  std::optional<double> direction;
  std::vector<ShapeWord> words;
  if (base.kind != BaseKind::plane) words.push_back({"hollow", &base.is_hollow});
  RELIEVO_CHECK(read_shape(text, "base", numbers_of(base, direction), words));
  base.direction_deg = direction.value_or(base.direction_deg);
  return base;
}

}  // namespace relievo
