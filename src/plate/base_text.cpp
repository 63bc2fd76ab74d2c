#include <algorithm>
#include <array>
#include <vector>

#include "plate/shape_text.h"
#include "relievo/core/text.h"
#include "relievo/plate/base.h"

namespace relievo {
namespace {

constexpr std::array<std::string_view, 6> names = {"plane", "fold", "wave", "cylinder", "dome", "image"};

std::vector<ShapeNumber> numbers_of(BaseOptions& base, std::optional<double>& direction) {
  const ShapeNumber height{"height", &base.height_mm}, along{"direction", &direction};
  switch (base.kind) {
    case BaseKind::plane:
      return {};
    case BaseKind::fold:
      return {height, {"angle", &base.angle_deg}, along};
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
  BaseOptions base;
  const auto found = std::ranges::find(names, shape_kind(text));
  if (found == names.end())
    return wrong_shape(
        "--base", cat("expected plane, fold, wave, cylinder, dome or image, found '", shape_kind(text), "'"));
  base.kind = static_cast<BaseKind>(found - names.begin());
  std::optional<double> direction;
  std::vector<ShapeWord> words;
  if (base.kind != BaseKind::plane) words.push_back({"hollow", &base.is_hollow});
  if (auto good = read_shape(text, "--base", numbers_of(base, direction), words); !good)
    return std::unexpected(good.error());
  base.direction_deg = direction.value_or(base.direction_deg);
  return base;
}

}  // namespace relievo
