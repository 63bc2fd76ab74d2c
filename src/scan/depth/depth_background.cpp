// Finds the background of a depth image. Tested by tests/scan/depth_image_test.cpp.
#include <algorithm>
#include <limits>

#include "scan/depth/depth_grid.h"

namespace relievo {
namespace {

// A contact is a pair of neighbouring pixels of different parts. A background covers at least the share
// `least_border` of the image's border. Of the contacts between background and figure, at least the share
// `least_jumps` are depth jumps. If more than the share `most_missing` of the figure's contacts are with
// missing pixels, the missing pixels are the figure's background.
constexpr double least_border = .5, least_jumps = .9, most_missing = .5;
constexpr double least_figure_share = .01;  // share of the image; smaller figures are specks
// Outlines may be blurred over `widest_outline` points. The slope across a jump is at least `steeper` times
// the figure's slope beside it. (Where a sphere touches a plane, the slope is about twice the slope beside
// it, but there is no jump.)
constexpr int widest_outline = 12;
constexpr float steeper = 3;
// The depths of a figure and its background may overlap. This share of the background's points, the nearest
// ones, may be in front of the median depth of the figure.
constexpr double nearest_share = .05;

constexpr int none = -1;

// A part of the image, separated from other parts by depth jumps.
struct Part {
  std::size_t points = 0, border = 0;
  // `before`: contacts with other parts in which this part is in front; `behind`: those in which it is behind.
  std::size_t before = 0, behind = 0;
  float nearest = -std::numeric_limits<float>::infinity();
};

class Parts {
 public:
  explicit Parts(const DepthGrid& grid) : grid_(grid), part_(grid.height.size(), none) {
    for (std::size_t i = 0; i < part_.size(); ++i)
      if (grid.bounds.is_known[i] && part_[i] == none) flood(i);
    each_line(grid, [&](const GridLine& line) {
      for (int i = 0; i + 1 < line.size; ++i) count_contact(line.at(i), line.at(i + 1));
      for (const int end : {0, line.size - 1})
        if (const int p = part_[line.at(end)]; p != none) ++all_[static_cast<std::size_t>(p)].border;
    });
  }

  // Returns the grid points of all rear parts. A part that lies behind its neighbours is rear in two cases:
  // it touches the image's border, or it is no nearer to the viewer than the largest rear part at the border.
  GridMask rear() const {
    std::vector<std::uint8_t> is_rear(all_.size(), 0);
    float nearest = -std::numeric_limits<float>::infinity();
    std::size_t largest = 0;
    for (std::size_t p = 0; p < all_.size(); ++p)
      if (all_[p].border > 0 && lies_behind(all_[p])) {
        is_rear[p] = 1;
        if (all_[p].points > largest) largest = all_[p].points, nearest = all_[p].nearest;
      }
    GridMask mask(part_.size(), 0);
    for (std::size_t p = 0; p < all_.size(); ++p)
      is_rear[p] = is_rear[p] || (lies_behind(all_[p]) && all_[p].nearest <= nearest);
    for (std::size_t i = 0; i < mask.size(); ++i)
      mask[i] = part_[i] != none && is_rear[static_cast<std::size_t>(part_[i])];
    return mask;
  }

 private:
  // Adds a part that consists of all points connected with `from`. Only neighbours with similar heights are
  // connected. A steep step separates neighbours even if it continues a steep slope. Otherwise a blurred
  // outline, which is such a slope, would connect the figure with its background.
  void flood(std::size_t from) {
    const BoundedGrid& b = grid_.bounds;
    const int number = static_cast<int>(all_.size());
    all_.emplace_back();
    std::vector<std::size_t> open = {from};
    part_[from] = number;
    while (!open.empty()) {
      const std::size_t i = open.back(), width = static_cast<std::size_t>(b.width), column = i % width;
      open.pop_back();
      ++all_.back().points;
      all_.back().nearest = std::max(all_.back().nearest, grid_.height[i]);
      const auto visit = [&](bool is_inside, std::size_t j) {
        if (!is_inside || !b.is_known[j] || part_[j] != none || !grid_.is_near(i, j)) return;
        part_[j] = number;
        open.push_back(j);
      };
      visit(column > 0, i - 1), visit(column + 1 < width, i + 1);
      visit(i >= width, i - width), visit(i + width < part_.size(), i + width);
    }
  }

  void count_contact(std::size_t i, std::size_t j) {
    if (part_[i] == none || part_[j] == none || part_[i] == part_[j]) return;
    const bool is_before = grid_.height[i] > grid_.height[j];
    ++all_[static_cast<std::size_t>(part_[is_before ? i : j])].before;
    ++all_[static_cast<std::size_t>(part_[is_before ? j : i])].behind;
  }

  static bool lies_behind(const Part& part) {
    return part.behind > 0 &&
           static_cast<double>(part.behind) >= least_jumps * static_cast<double>(part.behind + part.before);
  }

  const DepthGrid& grid_;
  std::vector<int> part_;  // part of each grid point
  std::vector<Part> all_;
};

// Returns the heights of the known points inside or outside the mask, in ascending order.
std::vector<float> sorted_heights(const DepthGrid& grid, const GridMask& mask, bool is_inside) {
  std::vector<float> heights;
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (grid.bounds.is_known[i] && (mask[i] != 0) == is_inside) heights.push_back(grid.height[i]);
  std::ranges::sort(heights);
  return heights;
}

// Counts the contacts that speak for and against a background.
class Evidence {
 public:
  Evidence(const DepthGrid& grid, const GridMask& is_rear) : grid_(grid), is_rear_(is_rear) {
    each_line(grid, [&](const GridLine& line) {
      for (int i = 0; i + 1 < line.size; ++i) look(line, i, -1), look(line, i + 1, 1);
      for (const int end : {0, line.size - 1}) border_ += 1, rear_border_ += is_rear_[line.at(end)];
    });
  }

  bool is_strong() const {
    return rear_border_ >= least_border * border_ && contacts_ > 0 && jumps_ >= least_jumps * contacts_ &&
           missing_ <= most_missing * (missing_ + contacts_) && is_behind_figure();
  }

 private:
  bool is_figure(std::size_t i) const { return grid_.bounds.is_known[i] && !is_rear_[i]; }

  // If grid point i belongs to the figure, counts its contact with the neighbour on the side opposite to `inwards`.
  void look(const GridLine& line, int i, int inwards) {
    const std::size_t beside = line.at(i - inwards);
    if (!is_figure(line.at(i))) return;
    if (!grid_.bounds.is_known[beside]) missing_ += 1;
    if (!is_rear_[beside]) return;
    contacts_ += 1;
    jumps_ += is_jump(line, i, inwards);
  }

  // Returns whether, at some point of the figure, the mean slope from the background up to this point is
  // several times as steep as the slope beyond the point.
  bool is_jump(const GridLine& line, int i, int inwards) const {
    const float ground = grid_.height[line.at(i - inwards)];
    for (int k = 1; k <= widest_outline; ++k, i += inwards) {
      const float here = grid_.height[line.at(i)], rise = (here - ground) / static_cast<float>(k);
      const int next = i + inwards;
      const bool has_next = next >= 0 && next < line.size && is_figure(line.at(next));
      const float beyond = has_next ? std::max(grid_.height[line.at(next)] - here, 0.F) : 0;
      if (rise > steeper * beyond && !grid_.is_near(line.at(i), line.at(i - inwards))) return true;
      if (!has_next) return false;
    }
    return false;
  }

  bool is_behind_figure() const {
    const std::vector<float> figure = sorted_heights(grid_, is_rear_, false),
                             rear = sorted_heights(grid_, is_rear_, true);
    if (static_cast<double>(figure.size()) < least_figure_share * static_cast<double>(is_rear_.size()))
      return false;
    const double nearest = (1 - nearest_share) * static_cast<double>(rear.size() - 1);
    return rear[static_cast<std::size_t>(nearest)] < figure[figure.size() / 2];
  }

  const DepthGrid& grid_;
  const GridMask& is_rear_;
  double border_ = 0, rear_border_ = 0, contacts_ = 0, jumps_ = 0, missing_ = 0;
};

// Returns the grid points behind the threshold that best separates two groups of depths. Returns none if the
// groups are not distinct, or if the far group covers little of the border.
GridMask far_group(const DepthGrid& grid) {
  const BoundedGrid& b = grid.bounds;
  GridMask is_far(grid.height.size(), 0);
  const std::vector<float> heights = sorted_heights(grid, is_far, false);
  if (heights.size() < 16) return is_far;
  // Otsu's method: at the best threshold the variance between the groups is largest, so the variance within
  // them is least.
  double sum = 0, total = 0, total_sq = 0;
  for (const float h : heights) total += double{h}, total_sq += double{h} * double{h};
  const auto n = static_cast<double>(heights.size());
  double best = 0;
  std::size_t split = 0;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    sum += double{heights[i - 1]};
    const auto k = static_cast<double>(i);
    const double gap = sum / k - (total - sum) / (n - k), between = k * (n - k) * gap * gap / (n * n);
    if (between > best && heights[i] > heights[i - 1]) best = between, split = i;
  }
  const double variance = total_sq / n - total / n * (total / n);
  // If the variance between the groups is less than 70 % of the variance of all depths, no clear gap
  // separates them.
  if (split == 0 || best < .7 * variance) return is_far;
  const float threshold = (heights[split] + heights[split - 1]) / 2;
  std::size_t border = 0, far_border = 0;
  const auto look = [&](int c, int r) {
    const std::size_t i = b.at(c, r);
    border += 1;
    far_border += !b.is_known[i] || grid.height[i] < threshold;
  };
  for (int c = 0; c < b.width; ++c) look(c, 0), look(c, b.height - 1);
  for (int r = 0; r < b.height; ++r) look(0, r), look(b.width - 1, r);
  // A background covers at least 60 % of the border; otherwise the figure extends beyond the image.
  if (10 * far_border < 6 * border) return is_far;
  for (std::size_t i = 0; i < grid.height.size(); ++i)
    is_far[i] = b.is_known[i] && grid.height[i] < threshold;
  return is_far;
}

}  // namespace

GridMask find_background(const DepthGrid& grid, bool is_wanted) {
  GridMask is_rear = Parts(grid).rear();
  if (Evidence(grid, is_rear).is_strong()) return is_rear;
  return is_wanted ? far_group(grid) : GridMask(is_rear.size(), 0);
}

}  // namespace relievo
