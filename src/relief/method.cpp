#include "relievo/method.h"

#include "relievo/core/text.h"

#include <algorithm>

#include "relievo/relief/baselines.h"

namespace relievo {

std::optional<Method> parse_method(std::string_view name) {
  const auto found = std::ranges::find(methods, name, &MethodInfo::name);
  return found == methods.end() ? std::nullopt : std::optional(found->method);
}

std::string method_names() {
  std::string names;
  for (const MethodInfo& info : methods) names += cat(names.empty() ? "" : ", ", info.name);
  return names;
}

std::string_view name_of(Method method) {
  return std::ranges::find(methods, method, &MethodInfo::method)->name;
}

Shape default_shape(Method method) {
  return method == Method::ours ? layered_shape() : Shape{{1, .01}, .02};
}

Result<Relief> make_by_method(Method method, const ReliefModel& model, double height, const Shape& shape,
                              double unit_mm, Progress* progress) {
  const bool needs_all_points = method == Method::gradient || method == Method::detail;
  if (needs_all_points && !model.system())
    return std::unexpected(
        Error{ErrorKind::option, "--mode", {}, cat("expected exact for the method ", name_of(method))});
  switch (method) {
    case Method::linear:
      return linear_relief(model.surface(), height);
    case Method::equalise:
      return equalised_relief(model.surface(), height);
    case Method::gradient:
      return gradient_relief(model, height);
    case Method::detail:
      return base_and_detail_relief(model, height);
    case Method::ours:
    case Method::paper:
      break;
  }
  return model.make_at_height(height, shape, unit_mm, progress);
}

}  // namespace relievo
