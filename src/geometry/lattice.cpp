#include "geometry/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lists.h"
#include "core/memory.h"
#include "geometry/plane.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr Index most_counted =
    12;  // counted points per cell; more would hardly change a cell's mean, but cost time in every frame

}  // namespace

Lattice::Lattice(std::span<const Vec3> points, std::span<const Index> counted, double cell)
    : places_(points.size()) {
  set_places(points, cell);
  set_first_nodes();
  count(counted);
  std::vector<Corners> sums(nodes());
  // If all shares and all values are 1, gather() writes the sum of the squared weights at each node. A share is the
  // inverse of this sum.
  share_.assign(nodes(), 1);
  gather(std::span<const float>(std::vector<float>(points.size(), 1)), sums, share_);
  for (float& s : share_) s = s > 0 ? 1 / s : 0;
}

void Lattice::set_places(std::span<const Vec3> points, double cell) {
  const Box box = Box::of(points);
  const auto nodes_along = [&](int axis) { return static_cast<std::size_t>(box.size()[axis] / cell) + 6; };
  width_ = nodes_along(0);
  share_.resize(width_ * nodes_along(1));
  parallel_for(points.size(), [&](std::size_t i) {
    const Vec2 at = (points[i] - box.min).head<2>() / cell + Vec2(1, 1), whole = at.array().floor();
    const Vec2f share = (at - whole).cast<float>();
    places_[i] = {static_cast<Index>(static_cast<std::size_t>(whole.x()) +
                                     width_ * static_cast<std::size_t>(whole.y())),
                  packed_share(share.x()), packed_share(share.y())};
  });
}

// Lists the cells with points, because refine(), which runs in every frame, skips all others.
void Lattice::set_first_nodes() {
  std::vector<std::uint8_t> is_first(nodes());
  for (const SplinePlace& p : places_) is_first[p.node] = 1;
  first_nodes_ = indices_where(is_first.size(), [&](Index n) { return is_first[n] != 0; });
}

void Lattice::count(std::span<const Index> counted) {
  std::vector<Index> all(nodes()), seen(nodes());
  for (const Index i : counted) ++all[cell_of(places_[i])];
  begin_.assign(1, 0);
  for (const Index n : all) begin_.push_back(begin_.back() + std::min(n, most_counted));
  counted_.resize(begin_.back());
  std::vector<Index> next(begin_.begin(), begin_.end() - 1);
  for (const Index i : counted) {
    const std::size_t c = cell_of(places_[i]);
    // Keeps `kept` of the cell's points, at even intervals in their order.
    const Index n = seen[c]++, kept = std::min(all[c], most_counted);
    if (n * kept / all[c] != (n + 1) * kept / all[c]) counted_[next[c]++] = {i, places_[i]};
  }
}

Vec2 Lattice::place(std::size_t point) const {
  const SplinePlace& p = places_[point];
  const std::size_t cell = cell_of(p);
  return Vec2(cell % width_, cell / width_) + Vec2f(unpacked_share(p.x), unpacked_share(p.y)).cast<double>();
}

void Lattice::spread(const Vec2& place, float amount, std::span<float> nodes) const {
  const Vec2 whole = place.array().floor();
  const CubicRow x = cubic_basis(static_cast<float>(place.x() - whole.x())),
                 y = amount * cubic_basis(static_cast<float>(place.y() - whole.y()));
  const std::size_t first =
      static_cast<std::size_t>(whole.x()) - 1 + width_ * (static_cast<std::size_t>(whole.y()) - 1);
  for (std::size_t l = 0; l < 4; ++l) {
    Eigen::Map<CubicRow> row(&nodes[first + l * width_]);
    row += y[static_cast<Eigen::Index>(l)] * x;
  }
}

void Lattice::mark_nodes_in(const Triangle& triangle, std::span<std::uint8_t> marks) const {
  const std::array corners{place(triangle[0]), place(triangle[1]), place(triangle[2])};
  const Vec2 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
  const Vec2 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
  for (double y = std::ceil(low.y()); y <= high.y(); ++y)
    for (double x = std::ceil(low.x()); x <= high.x(); ++x)
      if (is_within({x, y}, corners))
        marks[static_cast<std::size_t>(x) + width_ * static_cast<std::size_t>(y)] = 1;
}

std::size_t Lattice::memory() const {
  return bytes(places_) + bytes(first_nodes_) + bytes(counted_) + bytes(begin_) + bytes(share_);
}

// Calls f(cell, counted points of the cell) for each cell, concurrently.
template <typename F>
void Lattice::for_cells(F&& f) const {
  constexpr std::size_t grain = 256;
  parallel_for(
      nodes(),
      [&](std::size_t c) { f(c, std::span(counted_).subspan(begin_[c], begin_[c + 1] - begin_[c])); }, grain);
}

void Lattice::refine(std::span<const float> nodes, std::span<Tile> tiles) const {
  const std::array basis{cubic_basis(0), cubic_basis(.25F), cubic_basis(.5F), cubic_basis(.75F),
                         cubic_basis(1)};
  parallel_for(
      first_nodes_.size(),
      [&](std::size_t i) {
        const Index first = first_nodes_[i];
        std::array<CubicRow, 4> row;
        for (std::size_t l = 0; l < 4; ++l) row[l] = Eigen::Map<const CubicRow>(&nodes[first + l * width_]);
        for (std::size_t y = 0; y < 5; ++y) {
          CubicRow mean = basis[y][0] * row[0];
          for (Eigen::Index l = 1; l < 4; ++l) mean += basis[y][l] * row[static_cast<std::size_t>(l)];
          for (std::size_t x = 0; x < 5; ++x) tiles[first][5 * y + x] = (mean * basis[x]).sum();
        }
      },
      256);
}

template <typename Real>
void Lattice::gather(std::span<const Real> values, std::span<Corners> sums, std::span<float> means) const {
  for_cells([&](std::size_t c, std::span<const Counted> points) {
    Corners sum{};
    for (const Counted& p : points) {
      const Corners w = weights(p.place);
      const auto value = static_cast<float>(values[p.point]);
      for (std::size_t k = 0; k < 4; ++k) sum[k] += w[k] * w[k] * value;
    }
    sums[c] = sum;
  });
  for (std::size_t n = 0; n < means.size(); ++n) {
    float sum = 0;
    each_cell(n, [&](std::size_t c, std::size_t corner) { sum += sums[c][corner]; });
    means[n] = share_[n] * sum;
  }
}

template <typename Real>
void Lattice::compare(std::span<const Real> values, std::span<const float> nodes,
                      std::span<Extent> cells) const {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for_cells([&](std::size_t c, std::span<const Counted> points) {
    Extent extent{infinity, -infinity};
    for (const Counted& p : points) {
      const float rest = static_cast<float>(values[p.point]) - between(weights(p.place), &nodes[c]);
      extent.lowest = std::min(extent.lowest, rest);
      extent.highest = std::max(extent.highest, rest);
    }
    cells[c] = extent;
  });
}

template void Lattice::gather(std::span<const float>, std::span<Corners>, std::span<float>) const;
template void Lattice::gather(std::span<const double>, std::span<Corners>, std::span<float>) const;
template void Lattice::compare(std::span<const float>, std::span<const float>, std::span<Extent>) const;
template void Lattice::compare(std::span<const double>, std::span<const float>, std::span<Extent>) const;

}  // namespace relievo
