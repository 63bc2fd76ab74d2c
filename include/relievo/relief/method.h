// Declares the methods for making a relief, their names, and the modes that choose the points for which
// heights are solved. To add a baseline, add an enumerator, a declaration and a table entry here, and
// implement it in src/relief/baselines/.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "relievo/core/choice.h"
#include "relievo/core/error.h"

namespace relievo {

class Progress;
class ReliefModel;
struct Relief;
struct Shape;

enum class Method { layered, paper, linear, equalise, gradient, base_detail };

// Makes a relief by a published method, for comparison. The relief has exactly the requested height, > 0, and
// its boundary points are on the base. It is flat if the surface has no height that could be scaled. Its
// Relief::shape has no meaning.
using Baseline = Relief(const ReliefModel& model, double height);

// Each function is a baseline with default options. baselines.h declares variants with options.
Baseline linear_relief, equalised_relief, gradient_relief, base_and_detail_relief;

struct MethodInfo {
  Method method;
  std::string_view name;  // the word that users type
  // Makes the relief of a baseline; null for methods whose reliefs have a Shape.
  Baseline* make = nullptr;
  bool needs_all_points = false;  // whether the method has no subspace mode
};

inline constexpr std::array methods{
    // Compresses normals layer by layer, and heights by a smooth correction.
    MethodInfo{Method::layered, "layered"},
    // Normal space compression as in the paper.
    MethodInfo{Method::paper, "paper"},
    // Scales the depths.
    MethodInfo{Method::linear, "linear", linear_relief},
    // Adaptive histogram equalisation of the depths (Sun et al. 2009).
    MethodInfo{Method::equalise, "equalise", equalised_relief},
    // Gradient-domain compression (Weyrich et al. 2007).
    MethodInfo{Method::gradient, "gradient", gradient_relief, true},
    // A linear base with amplified detail (Ji et al. 2014).
    MethodInfo{Method::base_detail, "detail", base_and_detail_relief, true},
};

// Returns the method with that name. Errors: kind option for any other name, naming `option`.
Result<Method> parse_method(std::string_view name, std::string_view option = "method");
std::string_view name_of(Method method);

// Returns all names, for messages, such as "layered, paper, ...".
std::string method_names();

// Returns whether the method's reliefs have a Shape; baselines have options of their own.
bool has_shape(Method method);

// Returns the default shape of a method with has_shape(), for a requested height.
Shape default_shape(Method method);

// Returns the relief of that height by that method. Methods with has_shape() use
// ReliefModel::make_at_height(). A baseline has its default options, and uses only the strokes and the line
// depth of `shape`. Errors: those of make_at_height(); kind option if the method needs the system of all
// points and the model does not have it.
Result<Relief> make_by_method(Method method, const ReliefModel& model, double height, const Shape& shape,
                              double unit_mm, Progress* progress = nullptr);

// The points for which the heights of a relief are solved.
enum class Mode {
  exact,     // all visible points
  subspace,  // a few thousand control points, see SubspaceModel
  automatic  // `exact`, or `subspace` for more than `most_exact_points` visible points
};

inline constexpr std::array<Choice<Mode>, 3> mode_choices{
    {{"exact", Mode::exact}, {"subspace", Mode::subspace}, {"auto", Mode::automatic}}};

inline constexpr std::size_t usual_control_points = 8000;  // the number in most rows of the paper's Table 1

// The options for preparing a model. They determine which reliefs the model can make, and how fast.
struct ModelOptions {
  Mode mode = Mode::exact;
  std::size_t control_points = usual_control_points;  // approximate number in subspace mode
};

}  // namespace relievo
