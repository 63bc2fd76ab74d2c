// The methods a relief can be made with, by name: ours, the paper's and its rivals.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "relievo/relief.h"

namespace relievo {

enum class Method {
  ours,      // normal space compression in layers, held within the height
  paper,     // normal space compression as in the paper
  linear,    // depths scaled
  equalise,  // adaptive histogram equalisation of the depths (Sun et al. 2009)
  gradient,  // gradient-domain compression (Weyrich et al. 2007)
  detail     // linear base with amplified detail (Ji et al. 2014)
};

struct MethodInfo {
  Method method;
  std::string_view name;  // as typed
};

inline constexpr std::array<MethodInfo, 6> methods{{{Method::ours, "ours"},
                                                    {Method::paper, "paper"},
                                                    {Method::linear, "linear"},
                                                    {Method::equalise, "equalise"},
                                                    {Method::gradient, "gradient"},
                                                    {Method::detail, "detail"}}};

std::optional<Method> parse_method(std::string_view name);
std::string_view name_of(Method method);

// All names, for people: "ours, paper, ...".
std::string method_names();

// Whether the method shapes a relief by Shape; the rivals have options of their own.
inline bool has_shape(Method method) {
  return method == Method::ours || method == Method::paper;
}

// The shape that a method with one starts from, when a height is asked for.
Shape default_shape(Method method);

// Returns the relief of that height by that method: ReliefModel::make_at_height() or a rival with its default
// options, which take no notice of `shape`. Errors: those of make_at_height(); kind
// option for the gradient domain and base and detail, which need the system of all points, if the model has
// none.
Result<Relief> make_by_method(Method method, const ReliefModel& model, double height, const Shape& shape,
                              double unit_mm, Progress* progress = nullptr);

}  // namespace relievo
