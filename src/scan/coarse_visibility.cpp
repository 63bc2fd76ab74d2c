#include "scan/coarse_visibility.h"

#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"
#include "relievo/scan/normals.h"
#include "relievo/scan/visible.h"

namespace relievo {
namespace {

constexpr double cells_along_diagonal = 160;
// The weights of three indications that a visible side is the outside of an object, not the hollow back of a scan.
// With these weights, the front of every generated one-sided scan of the tests is distinguished from its back; each
// indication alone fails for some scans. See docs/decisions/best-view.md.
constexpr double outline_weight = 2, crease_weight = .5, ground_weight = .6;

// The nearest and the farthest point of a cell.
struct Cell {
  Index front = no_index;
  double front_z = 0, back_z = 0;
  Vec3f normal = Vec3f::Zero();  // normal of the front point, turned to the viewer if signs are unknown

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
    // Cells are at least two spacings wide. Otherwise some cells would contain no points of the front, and
    // points at the back of the model would seem visible there. The factor 2 below accounts for the points at
    // the back, about half of all.
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
    constexpr float edge_on = .1F;  // n_z at 6 degrees from edge-on; if it is smaller, its sign is unreliable
    std::size_t facing = 0, away = 0;
    for (const Cell& cell : cells_) {
      facing += cell.normal.z() > edge_on;
      away += cell.normal.z() < -edge_on;
    }
    return facing + away ? static_cast<double>(facing) / static_cast<double>(facing + away) : .5;
  }

  double one_layer() const {
    constexpr double thin = 6;  // in cells; a layer that is tilted by 80 degrees rises by less within a cell
    std::size_t cells = 0, thin_cells = 0;
    for (const Cell& cell : cells_) {
      if (cell.is_empty()) continue;
      ++cells;
      thin_cells += cell.front_z - cell.back_z < thin * width_;
    }
    return cells ? static_cast<double>(thin_cells) / static_cast<double>(cells) : 0;
  }

  // Returns the weighted sum of the three indications of an outside. For the same surface, seen from behind, the sum
  // has the opposite sign.
  double outside() const {
    return outline_weight * signed_share(1) - crease_weight * signed_share(3) + ground_weight * ground_mark();
  }

  double normal_variation() const {
    double sum = 0;
    each_pair([&](const Cell& a, const Cell& b, int) {
      const bool faces_viewer = a.normal.z() > 0 && b.normal.z() > 0;
      // A pair counts at most 0.5, so that a sharp edge counts no more than a rounded one.
      if (faces_viewer) sum += std::min(.5, static_cast<double>((a.normal - b.normal).norm()));
    });
    return sum;
  }

 private:
  std::size_t cell_of(const Vec3& p) const {
    const auto column = static_cast<std::size_t>((p.x() - box_.min.x()) / width_);
    const auto row = static_cast<std::size_t>((p.y() - box_.min.y()) / width_);
    return std::min(row, rows_ - 1) * columns_ + std::min(column, columns_ - 1);
  }

  // Calls f(a, b, axis) for all pairs of neighbouring cells with points; b follows a along the axis. Pairs
  // across depth jumps are left out.
  template <typename F>
  void each_pair(F f) const {
    const auto take = [&](const Cell& a, const Cell& b, int axis) {
      if (!a.is_empty() && !b.is_empty() && std::abs(a.front_z - b.front_z) <= 4 * width_) f(a, b, axis);
    };
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t column = 0; column < columns_; ++column) {
        const std::size_t cell = row * columns_ + column;
        if (column + 1 < columns_) take(cells_[cell], cells_[cell + 1], 0);
        if (row + 1 < rows_) take(cells_[cell], cells_[cell + columns_], 1);
      }
  }

  // The bend between two neighbouring cells is the difference of their normals along the axis on which they
  // are neighbours; it is positive where the surface is convex. Raises each bend to an odd power. Returns the
  // sum of the results, divided by the sum of their absolute values; in [-1, 1].
  // - Power 1: along a row of cells without jumps, the sum of the bends is the change from the first normal
  // to the last one. It is positive if the surface turns away from the viewer at both ends, as the outside of
  // an object does.
  // - Power 3: sharp bends dominate. Parts of an object that touch or overlap meet in sharp concave creases,
  // so on an outside the sharp bends are concave.
  double signed_share(int power) const {
    double sum = 0, total = 0;
    each_pair([&](const Cell& a, const Cell& b, int axis) {
      const double bend = std::pow(static_cast<double>(b.normal[axis] - a.normal[axis]), power);
      sum += bend;
      total += std::abs(bend);
    });
    return total > 0 ? sum / total : 0;
  }

  // Returns a measure of the skewness of the depths, in (-1, 1). Objects on a ground cover less area than the
  // ground, so on an outside the mean depth is nearer to the viewer than the median.
  double ground_mark() const {
    double count = 0, mean = 0, square = 0, cube = 0;
    for (const Cell& cell : cells_)
      if (!cell.is_empty()) mean += (cell.front_z - mean) / ++count;
    for (const Cell& cell : cells_) {
      if (cell.is_empty()) continue;
      const double z = cell.front_z - mean;
      square += z * z / count;
      cube += z * z * z / count;
    }
    const double skewness = square > 0 ? cube / std::pow(square, 1.5) : 0;
    return skewness / (1 + std::abs(skewness));
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
        seen[i] = {grid.facing_share(), grid.normal_variation(), grid.one_layer(), grid.outside()};
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
