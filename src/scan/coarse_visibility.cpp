#include "scan/coarse_visibility.h"

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

class Grid {
 public:
  Grid(const Cloud& cloud, int cells) : cloud_(cloud), box_(bounds(cloud)) {
    // Cells at least two spacings wide, or the back shows through gaps in the front. The factor 2 in the
    // spacing accounts for the points at the back.
    const Vec3 size = box_.size();
    const double spacing = std::sqrt(2 * size.x() * size.y() / static_cast<double>(cloud.size()));
    cell_ = std::max({box_.diagonal() / cells, 2 * spacing, 1e-300});
    columns_ = 1 + static_cast<std::size_t>(box_.size().x() / cell_);
    rows_ = 1 + static_cast<std::size_t>(box_.size().y() / cell_);
    front_.assign(columns_ * rows_, no_index);
    back_ = front_;
    for (Index i = 0; i < cloud.size(); ++i) {
      const std::size_t cell = cell_of(cloud.points[i]);
      Index &front = front_[cell], &back = back_[cell];
      if (front == no_index || cloud.points[i].z() > cloud.points[front].z()) front = i;
      if (back == no_index || cloud.points[i].z() < cloud.points[back].z()) back = i;
    }
  }

  double facing_share() const {
    constexpr float edge_on = .1F;  // the sign of normals within 6 degrees of edge on is not reliable
    std::size_t facing = 0, away = 0;
    for (const Index i : front_) {
      if (i == no_index) continue;
      facing += cloud_.normals[i].z() > edge_on;
      away += cloud_.normals[i].z() < -edge_on;
    }
    return facing + away ? static_cast<double>(facing) / static_cast<double>(facing + away) : .5;
  }

  double one_layer() const {
    constexpr double thin = 6;  // cells: a surface of 80 degrees rises by as much in one
    std::size_t cells = 0, thin_cells = 0;
    for (std::size_t cell = 0; cell < front_.size(); ++cell) {
      if (front_[cell] == no_index) continue;
      ++cells;
      thin_cells += cloud_.points[front_[cell]].z() - cloud_.points[back_[cell]].z() < thin * cell_;
    }
    return cells ? static_cast<double>(thin_cells) / static_cast<double>(cells) : 0;
  }

  double bulge() const {
    struct Mean {
      double sum = 0, count = 0;
    } inside, outline;
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t column = 0; column < columns_; ++column) {
        const Index i = front_[row * columns_ + column];
        if (i == no_index) continue;
        Mean& mean = is_on_outline(row, column) ? outline : inside;
        mean.sum += cloud_.points[i].z();
        ++mean.count;
      }
    if (inside.count == 0 || outline.count == 0 || !(box_.diagonal() > 0)) return 0;
    return (inside.sum / inside.count - outline.sum / outline.count) / box_.diagonal();
  }

  double normal_variation() const {
    double sum = 0;
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t column = 0; column < columns_; ++column) {
        const std::size_t cell = row * columns_ + column;
        if (column + 1 < columns_) sum += difference(front_[cell], front_[cell + 1]);
        if (row + 1 < rows_) sum += difference(front_[cell], front_[cell + columns_]);
      }
    return sum;
  }

 private:
  std::size_t cell_of(const Vec3& p) const {
    const auto column = static_cast<std::size_t>((p.x() - box_.min.x()) / cell_);
    const auto row = static_cast<std::size_t>((p.y() - box_.min.y()) / cell_);
    return std::min(row, rows_ - 1) * columns_ + std::min(column, columns_ - 1);
  }

  bool is_on_outline(std::size_t row, std::size_t column) const {
    if (row == 0 || column == 0 || row + 1 == rows_ || column + 1 == columns_) return true;
    const std::size_t cell = row * columns_ + column;
    return front_[cell - 1] == no_index || front_[cell + 1] == no_index ||
           front_[cell - columns_] == no_index || front_[cell + columns_] == no_index;
  }

  // Returns the difference between the normals of two cells, 0 across depth jumps. At most 0.5: a sharp edge
  // shall not count for more than a rounded one.
  double difference(Index a, Index b) const {
    if (a == no_index || b == no_index) return 0;
    const bool is_jump = std::abs(cloud_.points[a].z() - cloud_.points[b].z()) > 4 * cell_;
    const bool faces_viewer = cloud_.normals[a].z() > 0 && cloud_.normals[b].z() > 0;
    if (is_jump || !faces_viewer) return 0;
    return std::min(.5, static_cast<double>((cloud_.normals[a] - cloud_.normals[b]).norm()));
  }

  const Cloud& cloud_;
  Box box_;
  double cell_ = 1;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<Index> front_, back_;
};

}  // namespace

CoarseVisibility coarse_visibility(const Cloud& viewed, int cells) {
  if (viewed.size() == 0 || !viewed.has_normals()) return {};
  const Grid grid(viewed, cells);
  return {grid.facing_share(), grid.normal_variation(), grid.one_layer(), grid.bulge()};
}

}  // namespace relievo
