// Clears the crumbs of drawn fronts, closes small holes, and marks the ends of the surface. Declared in
// turned_surface.h, tested by tests/scan/turning_test.cpp.
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/disjoint_sets.h"
#include "relievo/core/parallel.h"
#include "scan/turning/turned_surface.h"

namespace relievo {
namespace {

// Consecutive cells of a row that are all covered or all uncovered.
struct Run {
  Index begin, end;  // index of the first cell, and of the cell after the last
  bool is_covered;
  std::size_t piece_size = 0;  // number of cells in the run's component
  bool is_first = false;       // whether this run stands for its component in counts
};

std::vector<Run> runs_of_row(const FrontCells& front, int y) {
  std::vector<Run> runs;
  const auto first = static_cast<Index>(front.normal.index(0, y)),
             last = first + static_cast<Index>(front.normal.width);
  for (Index cell = first; cell < last; ++cell) {
    const bool is_covered = front.normal[cell].z() > 0;
    if (runs.empty() || runs.back().is_covered != is_covered) runs.push_back({cell, cell, is_covered});
    runs.back().end = cell + 1;
  }
  return runs;
}

// Returns the runs of all rows, from the lowest upwards.
std::vector<Run> runs_of(const FrontCells& front) {
  const int height = front.normal.height;
  std::vector<std::vector<Run>> rows(static_cast<std::size_t>(height));
  parallel_for(
      rows.size(), [&](std::size_t y) { rows[y] = runs_of_row(front, static_cast<int>(y)); }, 16);
  std::vector<Run> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

// Joins touching runs of neighbouring rows if both are covered or both are uncovered.
DisjointSets joined(std::span<const Run> runs, Index width) {
  DisjointSets sets(runs.size());
  std::size_t above = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Index begin = runs[i].begin + width, end = runs[i].end + width;
    while (above < runs.size() && runs[above].end <= begin) ++above;
    for (std::size_t j = above; j < runs.size() && runs[j].begin < end; ++j)
      if (runs[j].is_covered == runs[i].is_covered) sets.join(static_cast<Index>(i), static_cast<Index>(j));
  }
  return sets;
}

// Returns the runs with the sizes of their components. A component consists of connected cells that are all
// covered or all uncovered.
std::vector<Run> pieces_of(const FrontCells& front) {
  std::vector<Run> runs = runs_of(front);
  DisjointSets sets = joined(runs, static_cast<Index>(front.normal.width));
  std::vector<std::size_t> cells(runs.size());
  for (Index i = 0; i < runs.size(); ++i) cells[sets.find(i)] += runs[i].end - runs[i].begin;
  for (Index i = 0; i < runs.size(); ++i)
    runs[i].piece_size = cells[sets.find(i)], runs[i].is_first = sets.find(i) == i;
  return runs;
}

// Returns the least size of the components to keep; the rule is that of drop_crumbs().
std::size_t least_size(std::span<const Run> runs, std::size_t least, std::size_t most_pieces) {
  std::vector<std::size_t> sizes;
  for (const Run& run : runs)
    if (run.is_covered && run.is_first) sizes.push_back(run.piece_size);
  std::ranges::sort(sizes, std::greater<>());
  if (most_pieces == 0 || most_pieces >= sizes.size()) return least;
  return std::max(least, sizes[most_pieces - 1]);
}

struct Filling {
  Index cell;
  float depth;
  Vec3f normal;
};

// Returns the mean depth and normal of a cell's covered neighbours; nothing if there are none.
std::optional<Filling> filling_of(const FrontCells& front, Index cell) {
  const int x = static_cast<int>(cell) % front.normal.width, y = static_cast<int>(cell) / front.normal.width;
  Filling filling{cell, 0, Vec3f::Zero()};
  float count = 0;
  for (int j = y - 1; j <= y + 1; ++j)
    for (int i = x - 1; i <= x + 1; ++i) {
      if (!front.is_covered(i, j)) continue;
      filling.depth += front.depth.at(i, j);
      filling.normal += front.normal.at(i, j);
      ++count;
    }
  if (count == 0) return std::nullopt;
  filling.depth /= count;
  filling.normal.normalize();
  return filling;
}

}  // namespace

void clear_small_pieces(FrontCells& front, std::size_t least, std::size_t most_pieces) {
  const std::vector<Run> runs = pieces_of(front);
  least = least_size(runs, least, most_pieces);
  for (const Run& run : runs) {
    if (!run.is_covered || run.piece_size >= least) continue;
    std::fill(front.normal.pixels.begin() + run.begin, front.normal.pixels.begin() + run.end, Vec3f::Zero());
    front.covered -= run.end - run.begin;
  }
}

void fill_small_holes(FrontCells& front, std::size_t most) {
  std::vector<Index> empty;
  for (const Run& run : pieces_of(front)) {
    if (run.is_covered || run.piece_size > most) continue;
    for (Index cell = run.begin; cell < run.end; ++cell) empty.push_back(cell);
  }
  while (!empty.empty()) {
    std::vector<Filling> found;
    for (const Index cell : empty)
      if (const auto filling = filling_of(front, cell)) found.push_back(*filling);
    for (const Filling& f : found) front.depth[f.cell] = f.depth, front.normal[f.cell] = f.normal;
    front.covered += found.size();
    std::erase_if(empty, [&](Index cell) { return front.normal[cell].z() > 0; });
    if (found.empty()) return;
  }
}

namespace {

// Returns, for each cell, how much the surface rises to the next column and to the next row.
Image<Vec2f> rises_of(const FrontCells& front) {
  Image<Vec2f> rises;
  rises.resize(front.normal.width, front.normal.height);
  parallel_for(rises.size(), [&](std::size_t i) {
    const Vec3f& n = front.normal[i];
    rises[i] = front.cell / std::max(n.z(), .1F) * n.head<2>().cwiseAbs();
  });
  return rises;
}

// Finds the cells at which the surface ends or jumps; the rule is that of is_jump().
class EdgeSearch {
 public:
  explicit EdgeSearch(const FrontCells& front) : front_(front), rises_(rises_of(front)) {}

  bool is_edge(int x, int y) const {
    return front_.is_covered(x, y) &&
           (is_edge_between(x, y, x + 1, y, 0) || is_edge_between(x, y, x - 1, y, 0) ||
            is_edge_between(x, y, x, y + 1, 1) || is_edge_between(x, y, x, y - 1, 1));
  }

 private:
  // Returns whether the surface is not continuous from the cell to its neighbour (u, v) in the same row (axis
  // 0) or column (axis 1).
  bool is_edge_between(int x, int y, int u, int v, int axis) const {
    if (!front_.is_covered(u, v)) return true;
    const float rise = std::max(rises_.at(x, y)[axis], rises_.at(u, v)[axis]);
    return std::abs(front_.depth.at(x, y) - front_.depth.at(u, v)) > 2 * rise + 3 * front_.cell;
  }

  const FrontCells& front_;
  Image<Vec2f> rises_;
};

}  // namespace

void mark_edges(FrontCells& front) {
  const EdgeSearch search(front);
  front.is_edge.resize(front.normal.width, front.normal.height);
  parallel_for(
      static_cast<std::size_t>(front.normal.height),
      [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < front.normal.width; ++x) front.is_edge.at(x, y) = search.is_edge(x, y);
      },
      16);
}

}  // namespace relievo
