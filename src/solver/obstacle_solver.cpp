#include "solver/obstacle_solver.h"

#include <algorithm>
#include <utility>

#include "core/memory.h"

namespace relievo {
namespace {

// Per level, from fine to coarse: what is long takes more sweeps, which cost less.
constexpr std::array<int, ElasticSheet::levels> sweeps{8, 14, 30, 40};
constexpr float over_relaxation = 1.6F;

}  // namespace

std::size_t ElasticSheet::Fields::memory() const {
  return bytes(lowest) + bytes(highest) + bytes(wanted) + bytes(b) + bytes(moment);
}

ElasticSheet::Level::Level(std::size_t width, Stiffness stiffness)
    : width_(width),
      stiffness_(std::move(stiffness)),
      fixed_(stiffness_.bending.size()),
      diagonal_(stiffness_.bending.size()) {
  for (Index n = 0; n < diagonal_.size(); ++n)
    if (is_free(n)) couple(n);
}

void ElasticSheet::Level::couple(std::size_t n) {
  nodes_[(n % width_ + 2 * (n / width_)) % nodes_.size()].push_back(static_cast<Index>(n));
  const auto& [bending, tension] = stiffness_;
  diagonal_[n] = 16 * bending[n];
  for (const std::size_t side : {n - 1, n + 1, n - width_, n + width_}) {
    diagonal_[n] += bending[side];
    (is_free(side) ? diagonal_ : fixed_)[n] += (tension[n] + tension[side]) / 2;
  }
}

std::size_t ElasticSheet::Level::memory() const {
  std::size_t sum = bytes(stiffness_.bending) + bytes(stiffness_.tension) + bytes(fixed_) + bytes(diagonal_);
  for (const std::vector<Index>& colour : nodes_) sum += bytes(colour);
  return sum;
}

// Every other node of every other row. What yields easily at a node or next to it does so here, too.
ElasticSheet::Level ElasticSheet::Level::coarser() const {
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

void ElasticSheet::Level::restrict_from(const Level& finer, const Fields& from, Fields& to) const {
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

void ElasticSheet::Level::prolong_from(const Level& coarser, const Fields& from, Fields& to) const {
  each_node([&](Index n) {
    const std::size_t x = n % width_, y = n / width_;
    const std::size_t m = x / 2 + y / 2 * coarser.width_, right = x % 2, up = y % 2 * coarser.width_;
    to.b[n] = (from.b[m] + from.b[m + right] + from.b[m + up] + from.b[m + right + up]) / 4;
  });
}

// Puts b within its limits.
void ElasticSheet::Level::start(Fields& f) const {
  std::vector<float>& b = f.b;
  each_node([&](Index n) { b[n] = std::clamp(b[n], f.lowest[n], f.highest[n]); });
  each_node([&](Index n) {
    f.moment[n] = stiffness_.bending[n] * (b[n - 1] + b[n + 1] + b[n - width_] + b[n + width_] - 4 * b[n]);
  });
}

// Moves one node to where the energy is least, and further, within its limits.
inline void ElasticSheet::Level::move(Index n, const Ties& ties, Fields& f) const {
  float *b = f.b.data() + n, *m = f.moment.data() + n;
  const float *c = stiffness_.bending.data() + n, *t = stiffness_.tension.data() + n;
  const auto row = static_cast<std::ptrdiff_t>(width_);
  const auto pull = [&](std::ptrdiff_t side) { return (t[0] + t[side]) * (b[side] - b[0]); };
  const float tense = (pull(-1) + pull(1) + pull(-row) + pull(row)) / 2;
  const float lap_m = m[-1] + m[1] + m[-row] + m[row] - 4 * m[0];
  const float tied = ties.pull + ties.anchor * fixed_[n];
  const float rise = lap_m - tense + (tied - fixed_[n]) * b[0] - f.wanted[n];
  const float step = over_relaxation * rise / (diagonal_[n] + tied);
  const float next = std::clamp(b[0] - step, f.lowest[n], f.highest[n]);
  const float change = next - b[0];
  b[0] = next;
  m[0] -= 4 * c[0] * change;
  for (const std::ptrdiff_t side : {std::ptrdiff_t{-1}, std::ptrdiff_t{1}, -row, row})
    m[side] += c[side] * change;
}

void ElasticSheet::Level::relax(int times, const Ties& ties, Fields& f) const {
  start(f);
  for (int sweep = 0; sweep < times; ++sweep) each_node([&](Index n) { move(n, ties, f); });
}

ElasticSheet::ElasticSheet(std::size_t width, Stiffness stiffness) {
  levels_[0] = Level(width, std::move(stiffness));
  for (std::size_t l = 1; l < levels; ++l) levels_[l] = levels_[l - 1].coarser();
}

ElasticSheet::Workspace ElasticSheet::make_workspace() const {
  Workspace w;
  for (std::size_t l = 0; l < levels; ++l)
    for (std::vector<float>* values : {&w[l].lowest, &w[l].highest, &w[l].wanted, &w[l].b, &w[l].moment})
      values->resize(levels_[l].size());
  return w;
}

std::size_t ElasticSheet::memory() const {
  std::size_t sum = 0;
  for (const Level& level : levels_) sum += level.memory();
  return sum;
}

void ElasticSheet::solve(const Ties& ties, Workspace& w) const {
  for (std::size_t l = 1; l < levels; ++l) levels_[l].restrict_from(levels_[l - 1], w[l - 1], w[l]);
  std::ranges::fill(w.back().b, 0.F);
  for (std::size_t l = levels; l-- > 0;) {
    if (l + 1 < levels) levels_[l].prolong_from(levels_[l + 1], w[l + 1], w[l]);
    // A node stands for 4^l of the finest, and along a rim for 2^l; more than fixed it cannot be.
    const Ties here{ties.pull * static_cast<float>(1 << 2 * l),
                    std::min(ties.anchor * static_cast<float>(1 << l), 1.F)};
    levels_[l].relax(sweeps[l], here, w[l]);
  }
}

}  // namespace relievo
