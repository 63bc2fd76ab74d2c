#include "scan/turning/front_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/disjoint_sets.h"
#include "relievo/core/parallel.h"
#include "scan/turning/disc_band.h"

namespace relievo {
namespace {

constexpr std::size_t block = 1 << 15;  // points that one task turns
constexpr int band_rows = 32;           // rows of cells that one task draws
constexpr float least_cell = .6F;       // in spacings: smaller cells show nothing more
constexpr float steepest = 20;          // slope of a disc
constexpr float infinity = std::numeric_limits<float>::infinity();

struct FlatBox {
  Vec3f least = Vec3f::Constant(infinity), most = Vec3f::Constant(-infinity);
  void extend(const Vec3f& p) { least = least.cwiseMin(p), most = most.cwiseMax(p); }
  FlatBox merged(const FlatBox& other) const {
    return {least.cwiseMin(other.least), most.cwiseMax(other.most)};
  }
  Vec3f size() const { return most - least; }
};

template <typename F>
FlatBox box_of(std::span<const FrontPoint> points, F&& turned) {
  return parallel_reduce(
      points.size(), FlatBox{},
      [&](std::size_t begin, std::size_t end) {
        FlatBox box;
        for (std::size_t i = begin; i < end; ++i) box.extend(turned(points[i].place));
        return box;
      },
      [](const FlatBox& a, const FlatBox& b) { return a.merged(b); }, block);
}

// Returns the part of a box that the crop shows.
FlatBox cropped_box(const FlatBox& box, const Crop& crop) {
  const Vec3f size = box.size();
  const Vec3 least(crop.least.x(), crop.least.y(), 1 - crop.farthest),
      most(crop.most.x(), crop.most.y(), 1 - crop.nearest);
  return {box.least + size.cwiseProduct(least.cast<float>()),
          box.least + size.cwiseProduct(most.cast<float>())};
}

// The points of one block that touch each band of rows.
using Bands = std::vector<std::vector<FrontDisc>>;

class FrontDrawing {
 public:
  FrontDrawing(std::span<const FrontPoint> points, const View& view)
      : points_(points), R_(view.R_view_model.cast<float>()), crop_(view.crop) {
    box_ = box_of(points, [this](const Vec3f& p) -> Vec3f { return R_ * p; });
    if (crop_ != Crop{}) box_ = cropped_box(box_, crop_);
  }

  FrontCells draw(std::size_t wanted) {
    set_cells(wanted);
    sort_into_bands();
    parallel_for(
        bands(), [this](std::size_t b) { draw_band(static_cast<int>(b)); }, 1);
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

  // Returns about how much of the box the points cover, by a coarse mask of those that face the viewer.
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
            if (R_.row(2).dot(points_[i].normal) <= 0) continue;
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
    if (some.empty()) return 0;
    std::ranges::nth_element(some, some.begin() + static_cast<long>(some.size() / 2));
    return some[some.size() / 2];
  }

  void set_cells(std::size_t wanted) {
    constexpr float most_side = 4096;
    const Vec3f size = box_.size();
    const float longer = std::max({size.x(), size.y(), 1e-30F});
    cells_.cell = std::max({std::sqrt(covered_area() / static_cast<float>(wanted)),
                            least_cell * usual_spacing(), longer / most_side});
    // One empty cell stands around what is drawn.
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
    const Vec3f turned = R_ * point.place, n = R_ * point.normal;
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
  Eigen::Matrix3f R_;
  Crop crop_;
  FlatBox box_;
  FrontCells cells_;
  std::vector<Bands> blocks_;
  std::vector<std::vector<Vec2f>> behind_;
};

}  // namespace

FrontCells draw_front(std::span<const FrontPoint> points, const View& view, std::size_t wanted) {
  FrontCells cells = FrontDrawing(points, view).draw(wanted);
  for (float& depth : cells.depth.pixels) depth *= cells.cell;
  return cells;
}

namespace {

// Returns the sets of neighbouring cells that are all covered, or all not.
DisjointSets pieces_of(const FrontCells& front) {
  const int width = front.normal.width, height = front.normal.height;
  DisjointSets sets(front.normal.size());
  const auto is_covered = [&](Index cell) { return front.normal[cell].z() > 0; };
  const auto are_alike = [&](Index a, Index b) { return is_covered(a) == is_covered(b); };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto cell = static_cast<Index>(front.normal.index(x, y)),
                 above = cell + static_cast<Index>(width);
      const bool is_like_left = x > 0 && are_alike(cell, cell - 1);
      if (is_like_left) sets.join(cell, cell - 1);
      if (y + 1 == height || !are_alike(cell, above)) continue;
      // Where the cells to the left of both are like them, these two are in one set already.
      if (!is_like_left || !are_alike(above, above - 1)) sets.join(cell, above);
    }
  return sets;
}

struct Filling {
  Index cell;
  float depth;
  Vec3f normal;
};

// Returns what the cell would be filled with; nothing without a covered neighbour.
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

void clear_small_pieces(FrontCells& front, std::size_t least) {
  DisjointSets pieces = pieces_of(front);
  for (Index i = 0; i < front.normal.size(); ++i) {
    if (front.normal[i].z() <= 0 || pieces.size_of(i) >= least) continue;
    front.normal[i] = Vec3f::Zero();
    --front.covered;
  }
}

void fill_small_holes(FrontCells& front, std::size_t most) {
  DisjointSets pieces = pieces_of(front);
  std::vector<Index> empty;
  for (Index i = 0; i < front.normal.size(); ++i)
    if (front.normal[i].z() <= 0 && pieces.size_of(i) <= most) empty.push_back(i);
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

// Returns whether no surface spans two neighbouring cells, see is_jump().
bool is_edge_between(const FrontCells& front, int x, int y, int dx, int dy) {
  if (!front.is_covered(x + dx, y + dy)) return true;
  const Vec2f step = front.cell * Vec2f(static_cast<float>(dx), static_cast<float>(dy));
  const auto rise = [&](const Vec3f& n) { return std::abs(n.head<2>().dot(step)) / std::max(n.z(), .1F); };
  const float rises = std::max(rise(front.normal.at(x, y)), rise(front.normal.at(x + dx, y + dy)));
  return std::abs(front.depth.at(x, y) - front.depth.at(x + dx, y + dy)) > 2 * rises + 3 * front.cell;
}

}  // namespace

void mark_edges(FrontCells& front) {
  front.is_edge.resize(front.normal.width, front.normal.height);
  parallel_for(
      static_cast<std::size_t>(front.normal.height),
      [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < front.normal.width; ++x)
          front.is_edge.at(x, y) =
              front.is_covered(x, y) &&
              (is_edge_between(front, x, y, 1, 0) || is_edge_between(front, x, y, -1, 0) ||
               is_edge_between(front, x, y, 0, 1) || is_edge_between(front, x, y, 0, -1));
      },
      16);
}

}  // namespace relievo
