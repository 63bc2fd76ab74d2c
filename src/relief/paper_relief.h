// Makes reliefs of models that use Method::paper. src/paper/ has the equations. Tested by
// tests/paper/paper_model_test.cpp.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "core/height_span.h"
#include "paper/height_to_order.h"
#include "paper/paper_model.h"
#include "relief/height_search.h"
#include "relievo/relief/relief.h"

namespace relievo {

// Makes the heights of one model of Method::paper, in single precision. Not for concurrent use.
class PaperRelief {
 public:
  explicit PaperRelief(const PaperModel& model)
      : model_(model),
        solve_workspace_(model.make_solve_workspace()),
        map_workspace_(model.make_map_workspace()),
        solved_(model.control_points()),
        mapped_(model.control_points()) {}

  // Solves equation (9) for the shape. Parameters of the shape that the paper does not have are ignored.
  void solve(const Shape& shape) {
    const Compression& c = shape.compression;
    model_.solve({c.u, c.beta, shape.max_slope, shape.boundary_width}, solve_workspace_, solved_);
  }

  // Gives the result of the last solve() to map(), so that the next solve() may run at the same time as map().
  void hand_over() { std::swap(solved_, mapped_); }

  // Writes the heights of all visible points, with detail, for the result that hand_over() passed.
  void map(const Shape& shape, std::span<float> heights) {
    model_.map(mapped_, shape.gamma, map_workspace_, heights);
  }

  // Calls solve(), hand_over() and map(). Returns the height of the relief.
  double raise(const Shape& shape, std::span<float> heights) {
    solve(shape);
    hand_over();
    map(shape, heights);
    return static_cast<double>(span_of(std::span<const float>(heights)).size());
  }

  std::size_t size() const { return model_.size(); }
  std::size_t memory() const { return solve_workspace_.system.memory() + model_.size() * sizeof(float); }

 private:
  const PaperModel& model_;
  PaperModel::SolveWorkspace solve_workspace_;
  PaperModel::MapWorkspace map_workspace_;
  std::vector<float> solved_, mapped_;  // heights of the control points
};

// Finds the shape with the requested height. If beta is free, Algorithm 1 of the paper searches alpha and
// beta; it accepts relative errors of the height up to 1 %. If beta is fixed or Algorithm 1 fails, beta stays
// as requested, and u is searched with the given tolerance. `raise` makes the relief of `shape` and returns
// its height. Returns whether the height is reached; if not, the last relief is the highest one.
template <typename Raise>
bool search_paper_height(double height, double tolerance, Shape& shape, Raise&& raise) {
  if (shape.is_beta_free) {
    const Compression asked = shape.compression;
    const paper::HeightToOrder found = paper::adjust_to_height(height, [&](double alpha, double beta) {
      shape.compression = Compression::from_alpha(alpha, beta);
      return raise();
    });
    if (found.is_met) return true;
    shape.compression = asked;
  }
  return HeightSearch(height, tolerance).bracket([&](double log_u) {
    shape.compression.u = std::exp(log_u);
    return raise();
  });
}

inline Relief make_paper_relief(const PaperModel& model, const Shape& shape) {
  std::vector<float> heights(model.size());
  const double height = PaperRelief(model).raise(shape, heights);
  return {{heights.begin(), heights.end()}, height, shape};
}

// Returns the relief that search_paper_height() finds, scaled to exactly the requested height. Errors
// are those of ReliefModel::make_at_height().
template <typename IsCancelled>
Result<Relief> make_paper_relief_at(const PaperModel& model, double height, Shape shape, double unit_mm,
                                    const IsCancelled& is_cancelled) {
  PaperRelief maker(model);
  std::vector<float> heights(model.size());
  double reached = 0;
  const bool is_met = search_paper_height(
      height, 1e-5, shape, [&] { return is_cancelled() ? height : reached = maker.raise(shape, heights); });
  if (is_cancelled()) return cancelled_error();
  if (!is_met) return out_of_reach(reached * unit_mm, height * unit_mm);
  Relief relief{{heights.begin(), heights.end()}, height, shape};
  for (double& z : relief.heights) z *= height / reached;
  return relief;
}

}  // namespace relievo
