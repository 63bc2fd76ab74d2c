#include "solver/obstacle_solver.h"

#include <algorithm>
#include <utility>

#include "core/memory.h"

namespace relievo::solver {
namespace {

// Sweeps per level, from fine to coarse. Errors of long wavelength converge slowly on fine levels, so coarse levels
// remove them. A sweep costs a quarter of a sweep on the next finer level, so all these sweeps take about as long as
// 14 sweeps of the finest level. For the choice of these numbers see docs/decisions/height-correction.md.
constexpr std::array<int, ObstacleSolver::levels> sweeps{8, 14, 30, 40};
// Successive over-relaxation converges for factors in (0, 2). The best factor approaches 2 as the number of
// nodes per side of the lattice grows. 1.6 suits the errors of short wavelength that remain on the finer
// levels.
constexpr float over_relaxation = 1.6F;
// The number of sweeps between updates of the forces between pairs of nodes, per level from fine to coarse. More
// updates improve none of the measures (docs/decisions/near-order.md).
constexpr std::array<int, ObstacleSolver::levels> sweeps_per_update{8, 2, 2, 2};

// Returns the weights of bilinear interpolation at a position within a cell, one per node of the cell, row by
// row.
std::array<float, 4> weights(const Vec2f& at) {
  const float x = at.x(), y = at.y();
  return {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
}

}  // namespace

std::size_t ObstacleSolver::Fields::memory() const {
  return bytes(lowest) + bytes(highest) + bytes(load) + bytes(hold) + bytes(b) + bytes(heights) +
         bytes(lack) + bytes(moment) + bytes(at_ties);
}

ObstacleSolver::Level::Level(std::size_t width, Stiffness stiffness, std::vector<Tie> ties)
    : width_(width),
      stiffness_(std::move(stiffness)),
      ties_(std::move(ties)),
      diagonal_(stiffness_.bending.size()) {
  std::vector<Index> tie_of(size(), no_index);
  for (std::size_t t = 0; t < ties_.size(); ++t) tie_of[ties_[t].cell] = static_cast<Index>(t);
  for (Index n = 0; n < size(); ++n)
    if (is_free(n)) couple(n, tie_of);
}

// Returns the ties of the coarser level. All ties in a coarse cell become one tie, at the mean of the
// positions of these ties, weighted by stiffness.
std::vector<Tie> ObstacleSolver::Level::coarser_ties(std::size_t width) const {
  std::vector<Tie> coarse;
  std::vector<Index> tie_of(diagonal_.size(), no_index);
  for (const Tie& fine : ties_) {
    const std::size_t x = fine.cell % width_, y = fine.cell / width_, cell = x / 2 + y / 2 * width;
    const Vec2f at = (Vec2f(x % 2, y % 2) + fine.at) / 2;
    if (tie_of[cell] == no_index) {
      tie_of[cell] = static_cast<Index>(coarse.size());
      coarse.push_back({cell, Vec2f::Zero(), 0});
    }
    Tie& joined = coarse[tie_of[cell]];
    joined.stiffness += fine.stiffness;
    joined.at += fine.stiffness / joined.stiffness * (at - joined.at);
  }
  return coarse;
}

// Adds a free node to the nodes of its colour, together with its weights in the ties (see Springs) of the
// four cells around it. `tie_of` has the index of each cell's tie.
void ObstacleSolver::Level::couple(std::size_t n, std::span<const Index> tie_of) {
  const auto& [bending, tension] = stiffness_;
  diagonal_[n] = 16 * bending[n];
  for (const std::size_t side : {n - 1, n + 1, n - width_, n + width_})
    diagonal_[n] += bending[side] + (tension[n] + tension[side]) / 2;

  const std::array<std::size_t, 4> cells{n, n - 1, n - width_, n - width_ - 1};
  TiedNode tied{static_cast<Index>(n), {}};
  bool is_tied = false;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const Index t = tie_of[cells[corner]];
    tied.shares[corner].tie = static_cast<Index>(ties_.size() + tied_nodes_);
    if (t == no_index) continue;
    const float weight = weights(ties_[t].at)[corner];
    tied.shares[corner] = {t, weight, ties_[t].stiffness * weight};
    is_tied = true;
  }
  Colour& colour = colours_[(n % width_ + 2 * (n / width_)) % colours_.size()];
  if (is_tied) {
    colour.tied.push_back(tied);
    ++tied_nodes_;
  } else {
    colour.untied.push_back(tied.node);
  }
}

std::size_t ObstacleSolver::Level::memory() const {
  std::size_t sum = bytes(stiffness_.bending) + bytes(stiffness_.tension) + bytes(diagonal_) + bytes(ties_) +
                    order_.memory();
  for (const Colour& colour : colours_) sum += bytes(colour.untied) + bytes(colour.tied);
  return sum;
}

// Returns the next coarser level, with every other node of every other row. A coarse node gets the least
// bending stiffness among the fine node at its position and the free neighbours of that fine node. It gets
// the harmonic mean of the tensions of the fine node and its four neighbours. So thin hinges between stiff
// regions remain.
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
  return {width, std::move(coarse), coarser_ties(width)};
}

void ObstacleSolver::Level::restrict_from(const Level& finer, const Fields& from, Fields& to) const {
  const std::size_t row = finer.width_;
  each_node([&](Index n) {
    const std::size_t m = 2 * (n % width_ + n / width_ * row);
    float low = from.lowest[m], high = from.highest[m], load = from.load[m], hold = from.hold[m];
    for (const std::size_t side : {m - 1, m + 1, m - row, m + row})
      if (finer.is_free(side)) {
        low = std::max(low, from.lowest[side]), high = std::min(high, from.highest[side]);
        load += from.load[side] / 2, hold += from.hold[side] / 2;
      }
    for (const std::size_t corner : {m - row - 1, m - row + 1, m + row - 1, m + row + 1})
      if (finer.is_free(corner)) load += from.load[corner] / 4, hold += from.hold[corner] / 4;
    if (low > high) low = high = (low + high) / 2;
    to.lowest[n] = low, to.highest[n] = high, to.load[n] = load, to.hold[n] = hold;
    to.heights[n] = from.heights[m];
  });
}

void ObstacleSolver::Level::prolong_from(const Level& coarser, const Fields& from, Fields& to) const {
  each_node([&](Index n) {
    const std::size_t x = n % width_, y = n / width_;
    const std::size_t m = x / 2 + y / 2 * coarser.width_, right = x % 2, up = y % 2 * coarser.width_;
    to.b[n] = (from.b[m] + from.b[m + right] + from.b[m + up] + from.b[m + right + up]) / 4;
  });
}

// Clamps b to its bounds, then computes the moments and the values at the ties.
void ObstacleSolver::Level::start(Fields& f) const {
  std::vector<float>& b = f.b;
  each_node([&](Index n) { b[n] = std::clamp(b[n], f.lowest[n], f.highest[n]); });
  each_node([&](Index n) {
    f.moment[n] = stiffness_.bending[n] * (b[n - 1] + b[n + 1] + b[n - width_] + b[n + width_] - 4 * b[n]);
  });
  for (std::size_t t = 0; t < ties_.size(); ++t) {
    const std::size_t n = ties_[t].cell;
    const std::array<float, 4> w = weights(ties_[t].at);
    f.at_ties[t] = w[0] * b[n] + w[1] * b[n + 1] + w[2] * b[n + width_] + w[3] * b[n + width_ + 1];
  }
}

// Makes one step of projected over-relaxation at a node. Moves b towards the minimum of the energy by
// over_relaxation times the distance. Then clamps b to its bounds, and updates the moments of the node and
// its neighbours. Returns the change.
inline float ObstacleSolver::Level::move(Index n, const Slope& ties, Fields& f) const {
  float *b = f.b.data() + n, *m = f.moment.data() + n;
  const float *c = stiffness_.bending.data() + n, *t = stiffness_.tension.data() + n;
  const auto row = static_cast<std::ptrdiff_t>(width_);
  const auto pull = [&](std::ptrdiff_t side) { return (t[0] + t[side]) * (b[side] - b[0]); };
  const float tense = (pull(-1) + pull(1) + pull(-row) + pull(row)) / 2;
  const float lap_m = m[-1] + m[1] + m[-row] + m[row] - 4 * m[0];
  const float rise = lap_m - tense + f.hold[n] * b[0] - f.load[n] + ties.first;
  const float diagonal = diagonal_[n] + f.hold[n] + ties.second;
  const float next = std::clamp(b[0] - over_relaxation * rise / diagonal, f.lowest[n], f.highest[n]);
  const float change = next - b[0];
  b[0] = next;
  m[0] -= 4 * c[0] * change;
  for (const std::ptrdiff_t side : {std::ptrdiff_t{-1}, std::ptrdiff_t{1}, -row, row})
    m[side] += c[side] * change;
  return change;
}

// Does the same as move() at a node whose cells have ties, and updates the values at these ties.
inline void ObstacleSolver::Level::move_tied(const TiedNode& tied, const Springs& springs, Fields& f) const {
  float* at_ties = f.at_ties.data();
  Slope slope;
  for (const auto& [tie, weight, stiffness] : tied.shares) {
    const float value = at_ties[tie], below = std::min(value - springs.least_at_ties, 0.F);
    slope.first += stiffness * (springs.tie_stiffness * value + springs.stop_stiffness * below);
    slope.second += stiffness * weight * (springs.tie_stiffness + (below < 0 ? springs.stop_stiffness : 0.F));
  }
  const float change = move(tied.node, slope, f);
  for (const Share& share : tied.shares) at_ties[share.tie] += share.weight * change;
}

void ObstacleSolver::Level::relax(int times, int every, const Springs& springs, Fields& f) const {
  start(f);
  for (int sweep = 0; sweep < times; ++sweep) {
    if (!order_.empty() && sweep % every == 0)
      order_.write_bound(f.b, f.heights, springs.order, {f.load, f.hold, f.lack});
    for (const Colour& colour : colours_) {
      for (const Index n : colour.untied) move(n, {}, f);
      for (const TiedNode& tied : colour.tied) move_tied(tied, springs, f);
    }
  }
}

std::vector<float> ObstacleSolver::Level::kept_by(const Level& coarser, std::span<const float> values) const {
  std::vector<float> kept(coarser.size());
  for (std::size_t n = 0; n < kept.size(); ++n) {
    const std::size_t x = 2 * (n % coarser.width_), y = 2 * (n / coarser.width_);
    if (x < width_ && x + y * width_ < values.size()) kept[n] = values[x + y * width_];
  }
  return kept;
}

ObstacleSolver::ObstacleSolver(std::size_t width, Stiffness stiffness, std::span<const Tie> ties,
                               const OrderedPairs& pairs) {
  levels_[0] = Level(width, std::move(stiffness), {ties.begin(), ties.end()});
  for (std::size_t l = 1; l < levels; ++l) levels_[l] = levels_[l - 1].coarser();
  if (pairs.depth.empty()) return;
  std::vector<float> depth(pairs.depth.begin(), pairs.depth.end()),
      share(pairs.share.begin(), pairs.share.end());
  OrderedPairs here = pairs;
  for (std::size_t l = 0; l < levels; ++l) {
    if (l > 0)
      depth = levels_[l - 1].kept_by(levels_[l], depth), share = levels_[l - 1].kept_by(levels_[l], share);
    for (std::size_t n = 0; n < share.size(); ++n)
      if (!levels_[l].is_free(n)) share[n] = 0;
    here.depth = depth, here.share = share;
    levels_[l].set_order(here);
    for (float& distance : here.distances) distance /= 2;
  }
}

ObstacleSolver::Workspace ObstacleSolver::make_workspace() const {
  Workspace w;
  for (std::size_t l = 0; l < levels; ++l) {
    for (std::vector<float>* values : {&w[l].lowest, &w[l].highest, &w[l].load, &w[l].hold, &w[l].b,
                                       &w[l].heights, &w[l].lack, &w[l].moment})
      values->resize(levels_[l].size());
    w[l].at_ties.resize(levels_[l].tie_values());
  }
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
    // A node of level l represents 4^l nodes of the finest level.
    Springs here = springs;
    here.order.stiffness *= static_cast<float>(1 << 2 * l);
    // A coarse tie has the sum of the stiffnesses of several fine ties. The sweeps would not converge with
    // this sum, so the factors of the ties are reduced.
    here.tie_stiffness = std::min(here.tie_stiffness, 1 / static_cast<float>(1 << l));
    here.stop_stiffness /= static_cast<float>(1 << l);
    levels_[l].relax(sweeps[l], sweeps_per_update[l], here, w[l]);
  }
}

}  // namespace relievo::solver
