#include "scan/turning/turned_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/quantile.h"
#include "core/simd.h"
#include "relievo/core/parallel.h"
#include "scan/scan_limits.h"

namespace relievo {
namespace {

// A point drawn as a disc in view coordinates. The unit is the width of a cell. The origin is the corner of
// the grid.
struct FrontDisc {
  // Radius, in spacings, of the discs that hide points behind them.
  static constexpr float hiding_radius{ScanLimits::disc_radius};

  Vec3f place;
  Vec3f normal;
  Vec2f slope;
  float spacing;
};

// The rows of one band. Each row has extra space at its end, because discs are drawn eight cells at a time.
class DiscBand {
 public:
  DiscBand(int columns, int first_row, int rows);

  // Raises the depths of cells to those of the discs. All depths must be drawn before the first normals.
  void draw_depths(std::span<const FrontDisc> discs);

  // Adds the normal of each disc to the surrounding cells in which the disc is in front.
  void add_normals(std::span<const FrontDisc> discs);

  // Writes depths and unit normals to the band's rows of `cells`.
  void write(FrontCells& cells) const;

  // Returns a pointer to the first cell of a row. Rows are counted from the band's first row.
  float* depths(int row) { return depth_.data() + row * stride_; }
  float* normals(int axis, int row) { return normal_[static_cast<std::size_t>(axis)].data() + row * stride_; }
  int columns() const { return columns_; }
  int first_row() const { return first_row_; }
  int rows() const { return rows_; }

 private:
  int columns_, first_row_, rows_, stride_;
  std::vector<float> depth_;
  std::array<std::vector<float>, 3> normal_;  // x, y and z
};

constexpr int lanes = 8;
// Radius, in spacings, of the discs that average normals. With 1.5, discs of scattered points leave a
// thousandth of the surface uncovered.
constexpr float mean_radius = 1.5F;
constexpr float least_mean_radius = .8F;  // least radius, in cells
constexpr float depth_tolerance{ScanLimits::depth_tolerance};
constexpr auto least_facing = static_cast<float>(ScanLimits::least_facing);

// Two values for each of eight cells of a row: the squared distance in the view plane from a disc's centre to the
// cell's centre, and the height of the disc's plane at the cell's centre above the disc's centre.
struct Steps {
  Float8 distance_sq, rise;
};

RELIEVO_INLINE Steps steps_from(const FrontDisc& disc, int x, float dy) {
  constexpr Float8 lane{0, 1, 2, 3, 4, 5, 6, 7};
  const Float8 dx = static_cast<float>(x) + lane + .5F - disc.place.x();
  return {dx * dx + dy * dy, disc.slope.x() * dx + disc.slope.y() * dy};
}

// Calls f(x, row, dy) for runs of eight cells of a band. The runs contain all cells whose centres are at most
// `radius` away from the disc's centre in the view plane. `dy` is the row's distance from the disc's centre.
template <typename F>
RELIEVO_INLINE void each_run(const DiscBand& band, const FrontDisc& disc, float radius, F&& f) {
  const float y = disc.place.y() - static_cast<float>(band.first_row());
  const int first = std::max(0, static_cast<int>(std::ceil(y - radius - .5F))),
            last = std::min(band.rows(), static_cast<int>(std::floor(y + radius - .5F)) + 1);
  const int left = std::max(0, static_cast<int>(std::ceil(disc.place.x() - radius - .5F))),
            right = std::min(band.columns(), static_cast<int>(std::floor(disc.place.x() + radius - .5F)) + 1);
  for (int row = first; row < last; ++row) {
    const float dy = static_cast<float>(band.first_row() + row) + .5F - disc.place.y();
    for (int x = left; x < right; x += lanes) f(x, row, dy);
  }
}

// Raises the cell that contains the disc's centre, because a small disc may cover no cell's centre.
RELIEVO_INLINE void raise_own_cell(DiscBand& band, const FrontDisc& disc) {
  const int x = static_cast<int>(disc.place.x()), y = static_cast<int>(disc.place.y());
  if (y < band.first_row() || y >= band.first_row() + band.rows()) return;
  const float rise =
      disc.slope.dot(Vec2f(static_cast<float>(x) + .5F, static_cast<float>(y) + .5F) - disc.place.head<2>());
  float& depth = band.depths(y - band.first_row())[x];
  depth = std::max(depth, disc.place.z() + std::clamp(rise, -1.F, 1.F));
}

RELIEVO_INLINE void draw(DiscBand& band, std::span<const FrontDisc> discs) {
  for (const FrontDisc& disc : discs) {
    const float radius = FrontDisc::hiding_radius * disc.spacing, radius_sq = radius * radius;
    each_run(band, disc, radius, [&](int x, int row, float dy) {
      const Steps steps = steps_from(disc, x, dy);
      Float8& depth = *reinterpret_cast<Float8*>(band.depths(row) + x);
      const Float8 raised = disc.place.z() + steps.rise;
      const auto is_higher = (steps.distance_sq + steps.rise * steps.rise <= radius_sq) & (raised > depth);
      depth = is_higher ? raised : depth;
    });
    raise_own_cell(band, disc);
  }
}

RELIEVO_INLINE void add(DiscBand& band, std::span<const FrontDisc> discs) {
  for (const FrontDisc& disc : discs) {
    const float radius = std::max(mean_radius * disc.spacing, least_mean_radius), radius_sq = radius * radius;
    const float tolerance =
        depth_tolerance * std::max(disc.spacing, .5F) / std::max(disc.normal.z(), least_facing);
    each_run(band, disc, radius, [&](int x, int row, float dy) {
      const Steps steps = steps_from(disc, x, dy);
      const Float8 rest = 1 - steps.distance_sq / radius_sq;
      const Float8 depth = *reinterpret_cast<const Float8*>(band.depths(row) + x);
      const auto is_in_front =
          (rest > 0.F) & (depth > FrontCells::no_depth) & (disc.place.z() + steps.rise + tolerance >= depth);
      const Float8 weight = is_in_front ? rest * rest : Float8{};
      for (int axis = 0; axis < 3; ++axis)
        *reinterpret_cast<Float8*>(band.normals(axis, row) + x) += weight * disc.normal[axis];
    });
  }
}

DiscBand::DiscBand(int columns, int first_row, int rows)
    : columns_(columns), first_row_(first_row), rows_(rows), stride_(columns + lanes) {
  const std::size_t cells = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows);
  depth_.assign(cells, FrontCells::no_depth);
  for (std::vector<float>& axis : normal_) axis.assign(cells, 0.F);
}

void DiscBand::draw_depths(std::span<const FrontDisc> discs) {
  RELIEVO_WIDE(draw(*this, discs));
}

void DiscBand::add_normals(std::span<const FrontDisc> discs) {
  RELIEVO_WIDE(add(*this, discs));
}

void DiscBand::write(FrontCells& cells) const {
  for (int row = 0; row < rows_; ++row)
    for (int x = 0; x < columns_; ++x) {
      const auto i = static_cast<std::size_t>(row * stride_ + x);
      const Vec3f n(normal_[0][i], normal_[1][i], normal_[2][i]);
      const float length = n.norm();
      cells.depth.at(x, first_row_ + row) = depth_[i];
      cells.normal.at(x, first_row_ + row) = length > 0 ? Vec3f(n / length) : Vec3f::Zero();
    }
}

constexpr std::size_t block = 1 << 15;  // points that one task turns
constexpr int band_rows = 32;           // rows of cells that one task draws
constexpr float least_cell = .6F;       // least cell width, in spacings; smaller cells show no more detail
constexpr float steepest = 20;          // largest slope of a disc
constexpr float infinity = std::numeric_limits<float>::infinity();

struct FlatBox {
  Vec3f least = Vec3f::Constant(infinity), most = Vec3f::Constant(-infinity);
  void extend(const Vec3f& p) { least = least.cwiseMin(p), most = most.cwiseMax(p); }
  FlatBox merged(const FlatBox& other) const {
    return {least.cwiseMin(other.least), most.cwiseMax(other.most)};
  }
  Vec3f size() const { return most - least; }
};

// Returns the box to which `extend` adds the places of points.
template <typename F>
FlatBox box_of(std::span<const FrontPoint> points, F&& extend) {
  return parallel_reduce(
      points.size(), FlatBox{},
      [&](std::size_t begin, std::size_t end) {
        FlatBox box;
        for (std::size_t i = begin; i < end; ++i) extend(box, points[i].place);
        return box;
      },
      [](const FlatBox& a, const FlatBox& b) { return a.merged(b); }, block);
}

// Returns the part of a box inside the crop.
FlatBox cropped_box(const FlatBox& box, const Crop& crop) {
  const Vec3f size = box.size();
  const Vec3 least(crop.least.x(), crop.least.y(), 1 - crop.farthest),
      most(crop.most.x(), crop.most.y(), 1 - crop.nearest);
  return {box.least + size.cwiseProduct(least.cast<float>()),
          box.least + size.cwiseProduct(most.cast<float>())};
}

// The discs of one block of points, per band of rows: entry b has the discs that touch band b.
using Bands = std::vector<std::vector<FrontDisc>>;

class FrontDrawing {
 public:
  FrontDrawing(std::span<const FrontPoint> points, const View& view, NormalSigns signs)
      : points_(points), signs_(signs), R_(view.R_view_model.cast<float>()), crop_(view.crop) {
    box_ = box_of(points, [this](FlatBox& box, const Vec3f& p) { box.extend(R_ * p); });
    if (crop_ != Crop{}) box_ = cropped_box(box_, crop_);
  }

  FrontCells draw(std::size_t wanted) {
    set_cells(wanted);
    sort_into_bands();
    parallel_for(
        bands(), [this](std::size_t b) { draw_band(static_cast<int>(b)); }, 1);
    if (crop_ != Crop{}) cells_.diagonal = shown_diagonal();
    cells_.covered = static_cast<std::size_t>(
        std::ranges::count_if(cells_.normal.pixels, [](const Vec3f& n) { return n.z() > 0; }));
    return std::move(cells_);
  }

 private:
  std::size_t bands() const {
    return static_cast<std::size_t>((cells_.depth.height + band_rows - 1) / band_rows);
  }
  bool is_shown(const Vec3f& p) const {
    return (p.array() >= box_.least.array()).all() && (p.array() <= box_.most.array()).all();
  }

  float shown_diagonal() const {
    const FlatBox shown = box_of(points_, [this](FlatBox& box, const Vec3f& p) {
      if (is_shown(R_ * p)) box.extend(p);
    });
    return shown.size().norm();
  }

  Vec3f normal_of(const FrontPoint& point) const {
    const bool is_reversed = signs_ == NormalSigns::unknown && point.normal.dot(R_.row(2).transpose()) < 0;
    return is_reversed ? Vec3f(-point.normal) : point.normal;
  }

  // Returns approximately the area covered by the points, from a coarse mask of the points that face the
  // viewer.
  float covered_area() const {
    constexpr int side = 64;
    using Mask = std::array<std::uint8_t, static_cast<std::size_t>(side * side)>;
    const Vec3f size = box_.size();
    const float cell = std::max({size.x(), size.y(), 1e-30F}) / side;
    const Mask mask = parallel_reduce(
        points_.size(), Mask{},
        [&](std::size_t begin, std::size_t end) {
          Mask part{};
          for (std::size_t i = begin; i < end; ++i) {
            if (R_.row(2).dot(normal_of(points_[i])) <= 0) continue;
            const Vec3f p = R_ * points_[i].place;
            if (!is_shown(p)) continue;
            const int x = std::min(static_cast<int>((p.x() - box_.least.x()) / cell), side - 1),
                      y = std::min(static_cast<int>((p.y() - box_.least.y()) / cell), side - 1);
            part[static_cast<std::size_t>(y * side + x)] = 1;
          }
          return part;
        },
        [](Mask a, const Mask& b) {
          for (std::size_t i = 0; i < a.size(); ++i) a[i] |= b[i];
          return a;
        },
        block);
    return cell * cell * static_cast<float>(std::ranges::count(mask, 1));
  }

  float usual_spacing() const {
    std::vector<float> some;
    for (std::size_t i = 0; i < points_.size(); i += 97) some.push_back(points_[i].spacing);
    return some.empty() ? 0 : median(some);
  }

  void set_cells(std::size_t wanted) {
    constexpr float most_side = 4096;
    const Vec3f size = box_.size();
    const float longer = std::max({size.x(), size.y(), 1e-30F});
    cells_.cell = std::max({std::sqrt(covered_area() / static_cast<float>(wanted)),
                            least_cell * usual_spacing(), longer / most_side});
    // The grid has a margin of one empty cell.
    cells_.corner = box_.least.head<2>() - Vec2f::Constant(1.5F * cells_.cell);
    const int columns = 3 + static_cast<int>(size.x() / cells_.cell),
              rows = 3 + static_cast<int>(size.y() / cells_.cell);
    cells_.depth = filled_image(columns, rows, FrontCells::no_depth);
    cells_.normal = filled_image<Vec3f>(columns, rows, Vec3f::Zero());
    cells_.is_behind = filled_image<std::uint8_t>(columns, rows, 0);
  }

  void sort_into_bands() {
    blocks_.resize((points_.size() + block - 1) / block);
    behind_.resize(blocks_.size());
    parallel_ranges(points_.size(), block, [&](std::size_t begin, std::size_t end) {
      Bands& mine = blocks_[begin / block];
      mine.resize(bands());
      for (std::size_t i = begin; i < end; ++i) add(points_[i], mine, behind_[begin / block]);
    });
    for (const std::vector<Vec2f>& places : behind_)
      for (const Vec2f& p : places) cells_.is_behind.at(static_cast<int>(p.x()), static_cast<int>(p.y())) = 1;
  }

  void add(const FrontPoint& point, Bands& to, std::vector<Vec2f>& behind) const {
    const Vec3f turned = R_ * point.place, n = R_ * normal_of(point);
    if (!is_shown(turned)) return;
    Vec3f place = turned / cells_.cell;
    place.head<2>() -= cells_.corner / cells_.cell;
    if (n.z() <= 0) return behind.emplace_back(place.head<2>()), void();
    const float nz = std::max(n.z(), 1 / steepest), spacing = point.spacing / cells_.cell;
    const FrontDisc disc{place, n, Vec2f(-n.head<2>() / nz), spacing};
    const float reach = std::max(FrontDisc::hiding_radius * spacing, 1.F);
    const int rows = cells_.depth.height;
    const int first = std::clamp(static_cast<int>(place.y() - reach), 0, rows - 1) / band_rows,
              last = std::clamp(static_cast<int>(place.y() + reach), 0, rows - 1) / band_rows;
    for (int b = first; b <= last; ++b) to[static_cast<std::size_t>(b)].push_back(disc);
  }

  void draw_band(int number) {
    const int first_row = number * band_rows;
    DiscBand band(cells_.depth.width, first_row, std::min(band_rows, cells_.depth.height - first_row));
    const auto b = static_cast<std::size_t>(number);
    for (const Bands& bands : blocks_) band.draw_depths(bands[b]);
    for (const Bands& bands : blocks_) band.add_normals(bands[b]);
    band.write(cells_);
  }

  std::span<const FrontPoint> points_;
  NormalSigns signs_;
  Eigen::Matrix3f R_;
  Crop crop_;
  FlatBox box_;
  FrontCells cells_;
  std::vector<Bands> blocks_;
  std::vector<std::vector<Vec2f>> behind_;
};

}  // namespace

FrontCells draw_front(std::span<const FrontPoint> points, const View& view, std::size_t wanted,
                      NormalSigns signs) {
  FrontCells cells = FrontDrawing(points, view, signs).draw(wanted);
  for (float& depth : cells.depth.pixels) depth *= cells.cell;
  return cells;
}

}  // namespace relievo
