#include "scan/depth/depth_grid.h"

#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr int smallest_side = 8;  // least width and height of a grid
constexpr int steps = 150;        // steps on each grid; coarser grids remove long waves of the error
constexpr float step_size =
    1 / 64.F;  // below 2 / 64, the limit of convergence; 64 is the largest eigenvalue of the bending energy
constexpr std::size_t rows_per_task = 16;

// Returns a grid with half the width and height. A point represents up to four points of the fine grid.
BoundedGrid halved(const BoundedGrid& fine) {
  BoundedGrid half{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}, {}, {}, {}};
  const std::size_t n = half.at(0, half.height);
  half.low.assign(n, 0), half.high.assign(n, 0);
  half.is_known.assign(n, 0), half.joins_right.assign(n, 0), half.joins_down.assign(n, 0);
  const auto joins = [&](const std::vector<std::uint8_t>& flags, int column, int row) {
    return column < fine.width && row < fine.height && flags[fine.at(column, row)];
  };
  for (int r = 0; r < half.height; ++r)
    for (int c = 0; c < half.width; ++c) {
      const std::size_t i = half.at(c, r);
      float known = 0;
      for (int y = 2 * r; y < std::min(2 * r + 2, fine.height); ++y)
        for (int x = 2 * c; x < std::min(2 * c + 2, fine.width); ++x) {
          const std::size_t j = fine.at(x, y);
          if (!fine.is_known[j]) continue;
          half.low[i] += fine.low[j], half.high[i] += fine.high[j], ++known;
        }
      if (known == 0) continue;
      half.low[i] /= known, half.high[i] /= known;
      half.is_known[i] = 1;
      // Two coarse points are connected only if both pairs of fine neighbours between them are connected. So no
      // grid smooths across a jump.
      half.joins_right[i] = joins(fine.joins_right, 2 * c + 1, 2 * r) &&
                            (2 * r + 1 >= fine.height || joins(fine.joins_right, 2 * c + 1, 2 * r + 1));
      half.joins_down[i] = joins(fine.joins_down, 2 * c, 2 * r + 1) &&
                           (2 * c + 1 >= fine.width || joins(fine.joins_down, 2 * c + 1, 2 * r + 1));
    }
  return half;
}

// Returns heights at the points of the fine grid. They are interpolated linearly between connected points of
// the coarse grid, whose heights are `z`. Then they are clamped to the bounds of the fine grid.
std::vector<float> refined(const BoundedGrid& fine, const BoundedGrid& half, const std::vector<float>& z) {
  std::vector<float> out(fine.low.size(), 0);
  parallel_for(
      static_cast<std::size_t>(fine.height),
      [&](std::size_t row) {
        const int r = static_cast<int>(row);
        for (int c = 0; c < fine.width; ++c) {
          const std::size_t i = fine.at(c, r);
          if (!fine.is_known[i]) continue;
          const std::size_t own = half.at(c / 2, r / 2);
          // A fine point lies a quarter of the way from its own coarse point to a neighbouring coarse point.
          float value = z[own];
          const int dx = c % 2 ? 1 : -1, dy = r % 2 ? 1 : -1;
          const std::size_t left = dx > 0 ? own : own - 1,
                            up = dy > 0 ? own : own - static_cast<std::size_t>(half.width);
          if ((dx > 0 || c > 1) && half.joins_right[left])
            value += .25F * (z[dx > 0 ? own + 1 : own - 1] - z[own]);
          if ((dy > 0 || r > 1) && half.joins_down[up])
            value += .25F * (z[dy > 0 ? own + static_cast<std::size_t>(half.width) : up] - z[own]);
          out[i] = std::clamp(value, fine.low[i], fine.high[i]);
        }
      },
      rows_per_task);
  return out;
}

// Minimises the bending energy within the bounds by projected gradient descent with Nesterov's momentum.
class Descent {
 public:
  explicit Descent(const BoundedGrid& grid)
      : grid_(grid),
        width_(static_cast<std::size_t>(grid.width)),
        along_(size()),
        down_(size()),
        twist_(size()) {}

  void run(std::vector<float>& z) {
    std::vector<float> ahead = z, next(size());
    float t = 1;
    for (int i = 0; i < steps; ++i) {
      find_bends(ahead);
      const float t_next = (1 + std::sqrt(1 + 4 * t * t)) / 2, momentum = (t - 1) / t_next;
      each_row([&](int c, int r, std::size_t k) {
        next[k] = grid_.is_known[k]
                      ? std::clamp(ahead[k] - step_size * slope_at(c, r, k), grid_.low[k], grid_.high[k])
                      : 0.F;
      });
      each_row([&](int, int, std::size_t k) { ahead[k] = next[k] + momentum * (next[k] - z[k]); });
      z.swap(next);
      t = t_next;
    }
  }

 private:
  std::size_t size() const { return grid_.low.size(); }

  template <typename F>
  void each_row(F&& f) const {
    parallel_for(
        static_cast<std::size_t>(grid_.height),
        [&](std::size_t row) {
          const int r = static_cast<int>(row);
          std::size_t k = row * width_;
          for (int c = 0; c < grid_.width; ++c, ++k) f(c, r, k);
        },
        rows_per_task);
  }

  // Computes the second differences. They are 0 where a neighbour is missing or beyond a jump, which leaves
  // the edge of a surface free.
  void find_bends(const std::vector<float>& z) {
    const auto& right = grid_.joins_right;
    const auto& down = grid_.joins_down;
    each_row([&](int c, int r, std::size_t k) {
      along_[k] = c > 0 && right[k - 1] && right[k] ? z[k - 1] - 2 * z[k] + z[k + 1] : 0.F;
      down_[k] = r > 0 && down[k - width_] && down[k] ? z[k - width_] - 2 * z[k] + z[k + width_] : 0.F;
      const bool is_whole = right[k] && down[k] && right[k + width_] && down[k + 1];
      twist_[k] = is_whole ? z[k] - z[k + 1] - z[k + width_] + z[k + width_ + 1] : 0.F;
    });
  }

  // Returns half the derivative of the energy along^2 + down^2 + 2 twist^2 with respect to the height of one
  // point.
  float slope_at(int c, int r, std::size_t k) const {
    float sum = -2 * (along_[k] + down_[k]) + 2 * twist_[k];
    if (c > 0) sum += along_[k - 1] - 2 * twist_[k - 1];
    if (c + 1 < grid_.width) sum += along_[k + 1];
    if (r > 0) sum += down_[k - width_] - 2 * twist_[k - width_];
    if (r + 1 < grid_.height) sum += down_[k + width_];
    if (c > 0 && r > 0) sum += 2 * twist_[k - width_ - 1];
    return sum;
  }

  const BoundedGrid& grid_;
  std::size_t width_;
  std::vector<float> along_, down_, twist_;
};

}  // namespace

std::vector<float> smoothest(const BoundedGrid& grid) {
  std::vector<BoundedGrid> coarser;
  const auto coarsest = [&]() -> const BoundedGrid& { return coarser.empty() ? grid : coarser.back(); };
  while (std::min(coarsest().width, coarsest().height) >= 2 * smallest_side)
    coarser.push_back(halved(coarsest()));
  std::vector<float> z(coarsest().low.size());
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = (coarsest().low[i] + coarsest().high[i]) / 2;
  for (std::size_t level = coarser.size() + 1; level-- > 0;) {
    const BoundedGrid& it = level == 0 ? grid : coarser[level - 1];
    if (level < coarser.size()) z = refined(it, coarser[level], z);
    Descent(it).run(z);
  }
  return z;
}

}  // namespace relievo
