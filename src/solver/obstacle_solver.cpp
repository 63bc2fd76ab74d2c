#include "solver/obstacle_solver.h"

#include <algorithm>
#include <utility>

#include "core/memory.h"

namespace relievo::solver {
namespace {

// Sweeps per level, from fine to coarse. Coarse levels resolve the long waves, which converge slowly, but a
// sweep there costs a quarter of one on the next finer level: the four take about as long as 14 fine sweeps.
// That is enough: see docs/decisions/height-correction.md.
constexpr std::array<int, ObstacleSolver::levels> sweeps{8, 14, 30, 40};
// Successive over-relaxation converges for factors in (0, 2). The best one grows towards 2 with the number of
// nodes per side; 1.6 suits the short waves that are left to the finer levels.
constexpr float over_relaxation = 1.6F;

}  // namespace

std::size_t ObstacleSolver::Fields::memory() const {
  return bytes(lowest) + bytes(highest) + bytes(wanted) + bytes(b) + bytes(moment);
}

ObstacleSolver::Level::Level(std::size_t width, Stiffness stiffness)
    : width_(width),
      stiffness_(std::move(stiffness)),
      fixed_(stiffness_.bending.size()),
      diagonal_(stiffness_.bending.size()) {
  for (Index n = 0; n < diagonal_.size(); ++n)
    if (is_free(n)) couple(n);
}

void ObstacleSolver::Level::couple(std::size_t n) {
  nodes_[(n % width_ + 2 * (n / width_)) % nodes_.size()].push_back(static_cast<Index>(n));
  const auto& [bending, tension] = stiffness_;
  diagonal_[n] = 16 * bending[n];
  for (const std::size_t side : {n - 1, n + 1, n - width_, n + width_}) {
    diagonal_[n] += bending[side];
    (is_free(side) ? diagonal_ : fixed_)[n] += (tension[n] + tension[side]) / 2;
  }
}

std::size_t ObstacleSolver::Level::memory() const {
  std::size_t sum = bytes(stiffness_.bending) + bytes(stiffness_.tension) + bytes(fixed_) + bytes(diagonal_);
  for (const std::vector<Index>& colour : nodes_) sum += bytes(colour);
  return sum;
}

// Keeps every other node of every other row. A coarse node takes the least bending stiffness of its five fine
// nodes and the harmonic mean of their tensions, so that thin hinges between stiff regions are not lost.
ObstacleSolver::Level ObstacleSolver::Level::coarser() const {
  const std::size_t rows = size() / width_, width = width_ / 2 + 2, nodes = width * (rows / 2 + 2);
  const auto& [bending, tension] = stiffness_;
  Stiffness coarse{std::vector<float>(nodes), std::vector<float>(nodes, 1)};
  for (std::size_t y = 1; 2 * y + 1 < rows; ++y)
    for (std::size_t x = 1; 2 * x + 1 < width_; ++x) {
      const std::size_t n = 2 * (x + y * width_);
      float least = bending[n], yielding = 1 / tension[n];
      for (const std::size_t side : {n - 1, n + 1, n - width_, n + width_}) {
        if (is_free(side)) least = std::min(least, bending[side]);
        yielding += 1 / tension[side];
      }
      coarse.bending[x + y * width] = least / 4, coarse.tension[x + y * width] = 5 / yielding;
    }
  return {width, std::move(coarse)};
}

void ObstacleSolver::Level::restrict_from(const Level& finer, const Fields& from, Fields& to) const {
  const std::size_t row = finer.width_;
  each_node([&](Index n) {
    const std::size_t m = 2 * (n % width_ + n / width_ * row);
    float low = from.lowest[m], high = from.highest[m], wanted = from.wanted[m];
    for (const std::size_t side : {m - 1, m + 1, m - row, m + row})
      if (finer.is_free(side)) {
        low = std::max(low, from.lowest[side]), high = std::min(high, from.highest[side]);
        wanted += from.wanted[side] / 2;
      }
    for (const std::size_t corner : {m - row - 1, m - row + 1, m + row - 1, m + row + 1})
      if (finer.is_free(corner)) wanted += from.wanted[corner] / 4;
    if (low > high) low = high = (low + high) / 2;
    to.lowest[n] = low, to.highest[n] = high, to.wanted[n] = wanted;
  });
}

void ObstacleSolver::Level::prolong_from(const Level& coarser, const Fields& from, Fields& to) const {
  each_node([&](Index n) {
    const std::size_t x = n % width_, y = n / width_;
    const std::size_t m = x / 2 + y / 2 * coarser.width_, right = x % 2, up = y % 2 * coarser.width_;
    to.b[n] = (from.b[m] + from.b[m + right] + from.b[m + up] + from.b[m + right + up]) / 4;
  });
}

// Clamps b to its bounds and computes the moments from it.
void ObstacleSolver::Level::start(Fields& f) const {
  std::vector<float>& b = f.b;
  each_node([&](Index n) { b[n] = std::clamp(b[n], f.lowest[n], f.highest[n]); });
  each_node([&](Index n) {
    f.moment[n] = stiffness_.bending[n] * (b[n - 1] + b[n + 1] + b[n - width_] + b[n + width_] - 4 * b[n]);
  });
}

// One step of projected over-relaxation: moves a node to the minimum of the energy along it, overshooting by
// the factor above, clamps it to its bounds and updates the moments of the node and its neighbours.
inline void ObstacleSolver::Level::move(Index n, const Springs& springs, Fields& f) const {
  float *b = f.b.data() + n, *m = f.moment.data() + n;
  const float *c = stiffness_.bending.data() + n, *t = stiffness_.tension.data() + n;
  const auto row = static_cast<std::ptrdiff_t>(width_);
  const auto pull = [&](std::ptrdiff_t side) { return (t[0] + t[side]) * (b[side] - b[0]); };
  const float tense = (pull(-1) + pull(1) + pull(-row) + pull(row)) / 2;
  const float lap_m = m[-1] + m[1] + m[-row] + m[row] - 4 * m[0];
  const float held = springs.stiffness + springs.boundary_stiffness * fixed_[n];
  const float rise = lap_m - tense + (held - fixed_[n]) * b[0] - f.wanted[n];
  const float step = over_relaxation * rise / (diagonal_[n] + held);
  const float next = std::clamp(b[0] - step, f.lowest[n], f.highest[n]);
  const float change = next - b[0];
  b[0] = next;
  m[0] -= 4 * c[0] * change;
  for (const std::ptrdiff_t side : {std::ptrdiff_t{-1}, std::ptrdiff_t{1}, -row, row})
    m[side] += c[side] * change;
}

void ObstacleSolver::Level::relax(int times, const Springs& springs, Fields& f) const {
  start(f);
  for (int sweep = 0; sweep < times; ++sweep) each_node([&](Index n) { move(n, springs, f); });
}

ObstacleSolver::ObstacleSolver(std::size_t width, Stiffness stiffness) {
  levels_[0] = Level(width, std::move(stiffness));
  for (std::size_t l = 1; l < levels; ++l) levels_[l] = levels_[l - 1].coarser();
}

ObstacleSolver::Workspace ObstacleSolver::make_workspace() const {
  Workspace w;
  for (std::size_t l = 0; l < levels; ++l)
    for (std::vector<float>* values : {&w[l].lowest, &w[l].highest, &w[l].wanted, &w[l].b, &w[l].moment})
      values->resize(levels_[l].size());
  return w;
}

std::size_t ObstacleSolver::memory() const {
  std::size_t sum = 0;
  for (const Level& level : levels_) sum += level.memory();
  return sum;
}

void ObstacleSolver::solve(const Springs& springs, Workspace& w) const {
  for (std::size_t l = 1; l < levels; ++l) levels_[l].restrict_from(levels_[l - 1], w[l - 1], w[l]);
  std::ranges::fill(w.back().b, 0.F);
  for (std::size_t l = levels; l-- > 0;) {
    if (l + 1 < levels) levels_[l].prolong_from(levels_[l + 1], w[l + 1], w[l]);
    // A node of level l represents 4^l of the finest nodes and, along a rim, 2^l; the factor of the tension
    // at the rim cannot exceed 1, which means fixed.
    const Springs here{springs.stiffness * static_cast<float>(1 << 2 * l),
                       std::min(springs.boundary_stiffness * static_cast<float>(1 << l), 1.F)};
    levels_[l].relax(sweeps[l], here, w[l]);
  }
}

}  // namespace relievo::solver
