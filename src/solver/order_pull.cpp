#include "solver/order_pull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/memory.h"

namespace relievo::solver {
namespace {

constexpr float diagonal = std::numbers::sqrt2_v<float> / 2;
const std::array<Vec2f, 4> ways{Vec2f(1, 0), Vec2f(0, 1), Vec2f(diagonal, diagonal),
                                Vec2f(-diagonal, diagonal)};

}  // namespace

OrderPull::OrderPull(std::size_t width, const OrderedPairs& pairs) {
  const auto columns = static_cast<long>(width), nodes = static_cast<long>(pairs.depth.size());
  for (const float distance : pairs.distances)
    for (const Vec2f& way : ways) {
      const long dx = std::lround(distance * way.x()), dy = std::lround(distance * way.y());
      const long offset = dx + dy * columns;
      if (offset <= 0 || offset >= nodes || std::abs(dx) >= columns) continue;
      Direction direction{static_cast<std::size_t>(offset), std::vector<float>(pairs.depth.size())};
      for (long n = 0; n + offset < nodes; ++n) {
        const long x = n % columns + dx;
        const float share = pairs.share[n] * pairs.share[n + offset];
        if (x < 0 || x >= columns || share == 0) continue;
        // tanh is computed in double precision and then rounded, because the last bit of a single-precision tanh
        // differs between standard libraries.
        direction.wanted[n] = share * static_cast<float>(std::tanh(static_cast<double>(
                                          (pairs.depth[n] - pairs.depth[n + offset]) / pairs.saturation)));
      }
      directions_.push_back(std::move(direction));
    }
}

std::size_t OrderPull::memory() const {
  std::size_t sum = 0;
  for (const Direction& direction : directions_) sum += bytes(direction.wanted);
  return sum;
}

// The energy of a pair contains (x - y)^2, where x and y are the moves of its nodes. As (x - y)^2 <= 2 (x^2 + y^2), a
// spring of twice the stiffness at each node gives an upper bound.
void OrderPull::write_bound(std::span<const float> b, std::span<const float> heights,
                            const OrderLimits& limits, const Bound& bound) const {
  const std::size_t nodes = b.size();
  float *load = bound.load.data(), *hold = bound.hold.data(), *lack = bound.lack.data();
  const float *z = heights.data(), *field = b.data();
  std::ranges::fill(bound.load, 0.F);
  std::ranges::fill(bound.hold, 0.F);
  for (const auto& [offset, wanted] : directions_) {
    const float* w = wanted.data();
    const std::size_t firsts = nodes - offset;
    for (std::size_t n = 0; n < firsts; ++n) {
      const float rise = field[n] + z[n] - field[n + offset] - z[n + offset];
      const float lacking = limits.height * w[n] - rise;
      lack[n] = w[n] * lacking > 0 ? lacking : 0.F;
    }
    for (std::size_t n = 0; n < firsts; ++n) load[n] += lack[n], hold[n] += lack[n] != 0 ? 2.F : 0.F;
    for (std::size_t n = 0; n < firsts; ++n)
      load[n + offset] -= lack[n], hold[n + offset] += lack[n] != 0 ? 2.F : 0.F;
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    hold[n] *= limits.stiffness;
    load[n] = limits.stiffness * load[n] + hold[n] * field[n];
  }
}

}  // namespace relievo::solver
