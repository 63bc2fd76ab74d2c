#include "scan/coarse_visibility.h"

#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"
#include "relievo/scan/normals.h"
#include "relievo/scan/visible.h"

namespace relievo {
namespace {

constexpr double cells_along_diagonal = 160;

// The nearest and the farthest point of a cell.
struct Cell {
  Index front = no_index;
  double front_z = 0, back_z = 0;
  Vec3f normal = Vec3f::Zero();  // normal of the front point, turned into the view

  bool is_empty() const { return front == no_index; }

  void take(Index i, double z) {
    if (is_empty()) back_z = z;
    back_z = std::min(back_z, z);
    if (!is_empty() && z <= front_z) return;
    front = i;
    front_z = z;
  }
};

class Grid {
 public:
  Grid(const Cloud& cloud, const Mat3& R, NormalSigns signs) {
    for (const Vec3& p : cloud.points) box_.extend(R * p);
    // Cells are at least two spacings wide; otherwise the back would show through gaps in the front. The
    // factor 2 below is there because about half of the points are at the back.
    const Vec3 size = box_.size();
    const double spacing = std::sqrt(2 * size.x() * size.y() / static_cast<double>(cloud.size()));
    width_ = std::max({box_.diagonal() / cells_along_diagonal, 2 * spacing, 1e-300});
    columns_ = 1 + static_cast<std::size_t>(size.x() / width_);
    rows_ = 1 + static_cast<std::size_t>(size.y() / width_);
    cells_.resize(columns_ * rows_);
    for (Index i = 0; i < cloud.size(); ++i) {
      const Vec3 p = R * cloud.points[i];
      cells_[cell_of(p)].take(i, p.z());
    }
    for (Cell& cell : cells_) {
      if (cell.is_empty()) continue;
      cell.normal = R.cast<float>() * cloud.normals[cell.front];
      if (signs == NormalSigns::inward || (signs == NormalSigns::unknown && cell.normal.z() < 0))
        cell.normal = -cell.normal;
    }
  }

  double facing_share() const {
    constexpr float edge_on = .1F;  // the sign of normals within 6 degrees of edge on is not reliable
    std::size_t facing = 0, away = 0;
    for (const Cell& cell : cells_) {
      facing += cell.normal.z() > edge_on;
      away += cell.normal.z() < -edge_on;
    }
    return facing + away ? static_cast<double>(facing) / static_cast<double>(facing + away) : .5;
  }

  double one_layer() const {
    constexpr double thin = 6;  // in cells: a surface tilted by 80 degrees rises by as much in one cell
    std::size_t cells = 0, thin_cells = 0;
    for (const Cell& cell : cells_) {
      if (cell.is_empty()) continue;
      ++cells;
      thin_cells += cell.front_z - cell.back_z < thin * width_;
    }
    return cells ? static_cast<double>(thin_cells) / static_cast<double>(cells) : 0;
  }

  double bulge() const {
    struct Mean {
      double sum = 0, count = 0;
    } inside, outline;
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t column = 0; column < columns_; ++column) {
        const Cell& cell = cells_[row * columns_ + column];
        if (cell.is_empty()) continue;
        Mean& mean = is_on_outline(row, column) ? outline : inside;
        mean.sum += cell.front_z;
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
        if (column + 1 < columns_) sum += difference(cells_[cell], cells_[cell + 1]);
        if (row + 1 < rows_) sum += difference(cells_[cell], cells_[cell + columns_]);
      }
    return sum;
  }

 private:
  std::size_t cell_of(const Vec3& p) const {
    const auto column = static_cast<std::size_t>((p.x() - box_.min.x()) / width_);
    const auto row = static_cast<std::size_t>((p.y() - box_.min.y()) / width_);
    return std::min(row, rows_ - 1) * columns_ + std::min(column, columns_ - 1);
  }

  bool is_on_outline(std::size_t row, std::size_t column) const {
    if (row == 0 || column == 0 || row + 1 == rows_ || column + 1 == columns_) return true;
    const std::size_t cell = row * columns_ + column;
    return cells_[cell - 1].is_empty() || cells_[cell + 1].is_empty() || cells_[cell - columns_].is_empty() ||
           cells_[cell + columns_].is_empty();
  }

  // Returns the difference between the normals of two cells, 0 across depth jumps. It is at most 0.5, so that
  // a sharp edge does not count for more than a rounded one.
  double difference(const Cell& a, const Cell& b) const {
    if (a.is_empty() || b.is_empty()) return 0;
    const bool is_jump = std::abs(a.front_z - b.front_z) > 4 * width_;
    const bool faces_viewer = a.normal.z() > 0 && b.normal.z() > 0;
    if (is_jump || !faces_viewer) return 0;
    return std::min(.5, static_cast<double>((a.normal - b.normal).norm()));
  }

  Box box_;
  double width_ = 1;  // width of a cell
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<Cell> cells_;
};

}  // namespace

std::vector<CoarseVisibility> coarse_visibility(const Cloud& cloud, std::span<const View> views,
                                                NormalSigns signs) {
  std::vector<CoarseVisibility> seen(views.size());
  if (cloud.size() == 0 || !cloud.has_normals()) return seen;
  parallel_for(
      views.size(),
      [&](std::size_t i) {
        const Grid grid(cloud, views[i].R_view_model, signs);
        seen[i] = {grid.facing_share(), grid.normal_variation(), grid.one_layer(), grid.bulge()};
      },
      1);
  return seen;
}

bool normals_point_inward(std::span<const CoarseVisibility> sides) {
  double facing = 0;
  for (const CoarseVisibility& side : sides) facing += side.facing_share;
  return facing < static_cast<double>(sides.size()) / 3;
}

void give_signs(Cloud& viewed, const Spacing& spacing) {
  turn_to_viewer(viewed);
  spread_normal_signs(viewed, spacing, visible_points(viewed, spacing));
}

bool all_face_viewer(const Cloud& viewed) {
  return std::ranges::all_of(viewed.normals, [](const Vec3f& n) { return n.z() > 0; });
}

OriginalNormals orient_normals(Cloud& viewed, const Spacing& spacing, const Cloud& cloud) {
  if (!viewed.has_normals()) {
    estimate_normals(viewed);
    give_signs(viewed, spacing);
    return OriginalNormals::missing;
  }
  if (all_face_viewer(viewed) || !normals_point_inward(cloud)) return OriginalNormals::usable;
  flip_normals(viewed);
  return OriginalNormals::inward;
}

}  // namespace relievo
