#include "relievo/relief/method.h"

#include <algorithm>

#include "relief/colour_lines.h"
#include "relief/height_search.h"
#include "relief/stroke_fields.h"
#include "relievo/core/text.h"
#include "relievo/relief/relief.h"

namespace relievo {
namespace {

const MethodInfo& info_of(Method method) {
  return *std::ranges::find(methods, method, &MethodInfo::method);
}

}  // namespace

Result<Method> parse_method(std::string_view name, std::string_view option) {
  const auto found = std::ranges::find(methods, name, &MethodInfo::name);
  if (found != methods.end()) return found->method;
  return not_one_of(option, names_of(methods), name);
}

std::string method_names() {
  std::string names;
  for (const MethodInfo& info : methods) names += cat(names.empty() ? "" : ", ", info.name);
  return names;
}

std::string_view name_of(Method method) {
  return info_of(method).name;
}

bool has_shape(Method method) {
  return !info_of(method).make;
}

Shape default_shape(Method method) {
  return method == Method::layered ? layered_shape() : Shape{{1, .01}, .02};
}

Result<Relief> make_by_method(Method method, const ReliefModel& model, double height, const Shape& shape,
                              double unit_mm, Progress* progress) {
  const MethodInfo& info = info_of(method);
  if (info.needs_all_points && !model.system())
    return option_error("mode", cat("expected exact for the method ", name_of(method)));
  if (!info.make) return model.make_at_height(height, shape, unit_mm, progress);
  Relief relief = info.make(model, height);
  if (!(relief.height > 0)) return out_of_reach(0, height * unit_mm);
  give_own_heights(model, relief);
  relief.shape.strokes = shape.strokes;
  relief.shape.line_depth = shape.line_depth;
  apply_strokes(model.surface(), {}, relief);
  sink_lines(model.surface(), relief);
  return relief;
}

}  // namespace relievo
