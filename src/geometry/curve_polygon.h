// Turns straight lines, quadratic curves and cubic curves into polygons, for glyphs and drawings. Tested by
// tests/io/svg_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/outline_union.h"

namespace relievo {

// Builds closed outlines from the commands of a pen. Approximates curves by polygons, with an error of at
// most `tolerance`.
class CurvePolygons {
  static constexpr double most_steps = 100;  // most line segments for one curve

 public:
  explicit CurvePolygons(double tolerance) : tolerance_(tolerance) {}

  void move_to(const Vec2& p) {
    close();
    outline_ = {p};
  }

  // Begins an outline at p unless one is open.
  void continue_at(const Vec2& p) {
    if (outline_.empty()) outline_ = {p};
  }

  void line_to(const Vec2& p) {
    if (outline_.empty() || p != outline_.back()) outline_.push_back(p);
  }

  void quadratic_to(const Vec2& c, const Vec2& p) {
    const Vec2 from = pen();
    cubic_to(from + 2. / 3 * (c - from), p + 2. / 3 * (c - p), p);
  }

  void cubic_to(const Vec2& c, const Vec2& d, const Vec2& p) {
    const Vec2 from = pen();
    // If the curve's parameter increases by `step` per line segment, the error is at most step^2 / 8 times
    // the second derivative.
    const double bend = 6 * std::max((from - 2 * c + d).norm(), (c - 2 * d + p).norm());
    const int steps =
        static_cast<int>(std::clamp(std::ceil(std::sqrt(bend / (8 * tolerance_))), 1.0, most_steps));
    for (int k = 1; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps, s = 1 - t;
      line_to(s * s * s * from + 3 * s * s * t * c + 3 * s * t * t * d + t * t * t * p);
    }
    line_to(p);
  }

  // Returns the position of the pen.
  Vec2 pen() const { return outline_.empty() ? Vec2(Vec2::Zero()) : outline_.back(); }

  // Ends the outline.
  void close() {
    if (outline_.size() > 1 && outline_.front() == outline_.back()) outline_.pop_back();
    if (outline_.size() > 2) outlines_.push_back(outline_);
    outline_.clear();
  }

  Outlines take() {
    close();
    return std::move(outlines_);
  }

 private:
  double tolerance_;
  std::vector<Vec2> outline_;
  Outlines outlines_;
};

}  // namespace relievo
