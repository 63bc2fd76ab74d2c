#include "plate/front/sample_front.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/lists.h"
#include "core/quantile.h"
#include "core/srgb.h"
#include "geometry/edges.h"
#include "geometry/point_set.h"
#include "geometry/raster.h"
#include "geometry/segment_grid.h"
#include "geometry/smooth_surface.h"
#include "plate/front/silhouette.h"
#include "relievo/core/image.h"
#include "relievo/core/parallel.h"
#include "relievo/geometry/triangulation.h"

namespace relievo {
namespace {

// A grid over the front. It knows the triangle that contains the centre of each cell.
struct SampleGrid {
  double step = 0;
  Vec2 corner;  // upper left corner of the grid
  RasterInput input;
  Image<Index> triangle;  // no_index where there is no front

  Vec2 place(int x, int y) const { return {corner.x() + (x + .5) * step, corner.y() - (y + .5) * step}; }
  Vec2 pixel(const Vec2& p) const { return Vec2(p.x() - corner.x(), corner.y() - p.y()) / step; }
};

// Returns a grid whose cells have sides of `step`, or more for a large front. Its width and height, in
// cells, are multiples of `block`.
SampleGrid sample_grid(const HeightFieldMesh& front, double step, int block) {
  const Box box = Box::of(front.points);
  SampleGrid grid;
  grid.step = std::max(step, box.longer_side() / (RasterInput::most_pixels - 16));
  // The box is often a whole number of cells long. The added fraction keeps rounding errors from changing the
  // number of cells.
  const auto cells = [&](double mm) { return (static_cast<int>(mm / grid.step + .37) / block + 1) * block; };
  grid.corner = {box.min.x(), box.max.y()};
  grid.input.width = cells(box.size().x());
  grid.input.height = cells(box.size().y());
  grid.input.triangles = front.triangles;
  for (const Vec3& p : front.points) {
    const Vec2 place = grid.pixel(p.head<2>());
    grid.input.points.emplace_back(place.x(), place.y(), 0);
  }
  // In images y points down, which reverses the orientation of triangles.
  grid.triangle = filled_image(grid.input.width, grid.input.height, no_index);
  draw_bands(grid.input, 32, [&](const RowBand& band) {
    const auto first = static_cast<std::ptrdiff_t>(grid.triangle.index(0, band.first_row));
    std::ranges::transform(band.fragments.pixels, grid.triangle.pixels.begin() + first,
                           [](const Fragment& f) { return f.triangle; });
  });
  return grid;
}

constexpr int band_rings = 3;  // rings of triangles around creases; they form the band, whose points are kept
constexpr int most_divisions = 16;
// Smallest distances, in grid steps. `apart` is the distance from samples to points of the band. Samples of
// quartered squares need only half of this distance. `apart_in_band` is the distance between points of the
// band that are not on creases.
constexpr double apart = .6, apart_in_band = .3;
constexpr float no_slope = std::numeric_limits<float>::quiet_NaN();

// Marks the triangles of the band. These are all triangles that are not smooth, and band_rings rings of
// smooth triangles around them and along the hull.
std::vector<std::uint8_t> band_triangles(const HeightFieldMesh& front,
                                         std::span<const std::uint8_t> is_smooth) {
  std::vector<std::uint8_t> is_near(front.points.size(), 0), is_band(front.triangles.size());
  for (std::size_t t = 0; t < is_band.size(); ++t) is_band[t] = !is_smooth[t];
  for (const Index i : front.hull) is_near[i] = 1;
  for (int ring = 0; ring <= band_rings; ++ring) {
    for (std::size_t t = 0; t < is_band.size(); ++t)
      if (is_band[t])
        for (const Index i : front.triangles[t]) is_near[i] = 1;
    if (ring == band_rings) break;
    for (std::size_t t = 0; t < is_band.size(); ++t)
      is_band[t] |=
          is_near[front.triangles[t][0]] || is_near[front.triangles[t][1]] || is_near[front.triangles[t][2]];
  }
  return is_band;
}

class Sampler {
 public:
  Sampler(const HeightFieldMesh& front, std::span<const std::uint8_t> is_smooth, const FrontSampling& options)
      : front_(front),
        is_smooth_(is_smooth),
        options_(options),
        surface_(front.points, front.triangles, is_smooth),
        is_band_(band_triangles(front, is_smooth)),
        grid_(sample_grid(front, options.resolution_mm, largest_square)),
        band_points_(apart_in_band * grid_.step) {}

  Result<HeightFieldMesh> make(const Progress* progress) {
    RELIEVO_CHECK(check_cancelled(progress));
    add_old_points();
    divide_band();
    thin_out_band();
    RELIEVO_CHECK(check_cancelled(progress));
    add_squares();
    for (Vec3& p : out_.points) p.z() = std::clamp(p.z(), low_, high_);

    RELIEVO_CHECK(check_cancelled(progress));
    return triangulated();
  }

 private:
  void add(Index triangle, const Vec2& place, const SmoothSurface::Sample& sample, bool is_fixed = false) {
    out_.points.emplace_back(place.x(), place.y(), sample.height);
    slopes_.push_back(sample.slope.cast<float>());
    is_fixed_.push_back(is_fixed);
    if (!front_.colours.empty()) out_.colours.push_back(colour_at(triangle, place));
  }

  Colour colour_at(Index t, const Vec2& place) const {
    const Vec2 pixel = grid_.pixel(place);
    return weighted_mean(front_.colours, front_.triangles[t],
                         corner_weights(grid_.input, t, pixel.x(), pixel.y()));
  }

  // Adds the points of the given front that are kept: points of the band near creases, points of
  // the hull, and the highest and the lowest point.
  void add_old_points() {
    std::vector<std::uint8_t> is_kept(front_.points.size(), 0), is_fixed = is_kept;
    for (std::size_t t = 0; t < is_band_.size(); ++t)
      for (const Index i : front_.triangles[t]) is_kept[i] |= is_band_[t], is_fixed[i] |= !is_smooth_[t];
    for (const Index i : front_.hull) is_kept[i] = is_fixed[i] = 1;
    const auto height = [&](Index i) { return front_.points[i].z(); };
    Index lowest = front_.triangles[0][0], highest = lowest;
    for (const Triangle& t : front_.triangles)
      for (const Index i : t) {
        if (height(i) < height(lowest)) lowest = i;
        if (height(i) > height(highest)) highest = i;
      }
    low_ = height(lowest), high_ = height(highest);
    is_kept[lowest] = is_kept[highest] = is_fixed[lowest] = is_fixed[highest] = 1;
    for (Index i = 0; i < is_kept.size(); ++i) {
      if (!is_kept[i]) continue;
      out_.points.push_back(front_.points[i]);
      slopes_.push_back(Vec2f::Constant(no_slope));
      is_fixed_.push_back(is_fixed[i]);
      if (!front_.colours.empty()) out_.colours.push_back(front_.colours[i]);
    }
  }

  // Divides each edge of the smooth triangles in the band near creases. All edges get the same number of
  // parts; with this number the median part is about as long as the resolution. New points on creases stay on
  // the creases.
  void divide_band() {
    std::vector<double> lengths;
    for (Index t = 0; t < is_band_.size(); ++t)
      if (is_band_[t] && is_smooth_[t])
        for (std::size_t i = 0; i < 3; ++i) {
          const Triangle& c = front_.triangles[t];
          lengths.push_back((front_.points[c[i]] - front_.points[c[(i + 1) % 3]]).head<2>().norm());
        }
    if (lengths.empty()) return;
    const double side = median(lengths);
    divisions_ = std::clamp(static_cast<int>(std::lround(side / options_.resolution_mm)), 1, most_divisions);
    if (divisions_ == 1) return;
    for (Index t = 0; t < is_band_.size(); ++t)
      if (is_band_[t] && is_smooth_[t]) divide_inside(t);
    each_edge(
        front_.triangles, [&](const TriangleSide& s) { return is_band_[s.triangle] != 0; },
        [&](std::span<const TriangleSide> sides) { divide_edge(sides); });
  }

  void divide_inside(Index t) {
    const Triangle& c = front_.triangles[t];
    const auto at = [&](int i) -> Vec2 { return front_.points[c[i]].head<2>(); };
    for (int i = 1; i < divisions_; ++i)
      for (int j = 1; i + j < divisions_; ++j) {
        const Vec2 place = (i * at(0) + j * at(1) + (divisions_ - i - j) * at(2)) / divisions_;
        add(t, place, surface_.at(t, place));
      }
  }

  // Divides an edge if at least one of its triangles is smooth. `sides` are the sides of these triangles at
  // the edge.
  void divide_edge(std::span<const TriangleSide> sides) {
    const auto is_smooth = [&](const TriangleSide& side) { return is_smooth_[side.triangle] != 0; };
    if (std::ranges::none_of(sides, is_smooth)) return;
    const bool is_on_hull = sides.size() == 1;
    const bool is_crease = is_on_hull || !std::ranges::all_of(sides, is_smooth);
    const Vec3 &a = front_.points[sides[0].low()], &b = front_.points[sides[0].high()];
    for (int k = 1; k < divisions_; ++k) {
      const double share = static_cast<double>(k) / divisions_;
      const Vec3 plane = a + share * (b - a);
      const Index t = sides[0].triangle;
      SmoothSurface::Sample sample = surface_.at(t, plane.head<2>());
      if (is_crease) sample.height = plane.z();
      add(t, plane.head<2>(), sample, is_crease);
    }
  }

  // Subsamples the band near creases, because points of a scan may nearly coincide in the view. Fixed points
  // are kept: points on creases and on the hull, the lowest and the highest point. Another point is kept
  // only if it is not too close to a fixed point or to a point already kept.
  void thin_out_band() {
    const double least = apart_in_band * options_.resolution_mm;
    const auto plane = [&](std::size_t i) -> Vec2 { return out_.points[i].head<2>(); };
    for (std::size_t i = 0; i < out_.points.size(); ++i)
      if (is_fixed_[i]) band_points_.add(plane(i), 0);
    std::vector<std::uint8_t> is_left(out_.points.size());
    for (std::size_t i = 0; i < is_left.size(); ++i)
      is_left[i] = is_fixed_[i] || band_points_.add(plane(i), least);
    const auto is_kept = [&](std::size_t i) { return is_left[i] != 0; };
    keep_where(out_.points, is_kept), keep_where(slopes_, is_kept), keep_where(out_.colours, is_kept);
    keep_where(is_fixed_, is_kept);
  }

  bool is_open(int x, int y) const {
    const Index t = grid_.triangle.at(x, y);
    return t != no_index && is_smooth_[t] && !is_band_[t];
  }

  // The band lies near creases and the hull. Outside the band, adds a sample near the middle of each square.
  void add_squares() {
    const int width = grid_.input.width, height = grid_.input.height;
    Image<Vec2f> slopes = filled_image(width, height, Vec2f(Vec2f::Constant(no_slope)));
    parallel_for(
        static_cast<std::size_t>(height),
        [&](std::size_t row) {
          const int y = static_cast<int>(row);
          for (int x = 0; x < width; ++x)
            if (is_open(x, y))
              slopes.at(x, y) = surface_.at(grid_.triangle.at(x, y), grid_.place(x, y)).slope.cast<float>();
        },
        16);
    const std::vector<std::uint8_t> is_taken = taken_cells();
    const auto squares = sample_squares(slopes, static_cast<float>(options_.facet_angle));
    std::optional<SampleGrid> quarters;
    if (std::ranges::any_of(squares, &SampleSquare::is_quartered))
      quarters = sample_grid(front_, grid_.step / 2, 2 * largest_square);
    // `has_quarters` is false for very large fronts, because sample_grid() makes coarser grids for them.
    const bool has_quarters = quarters && quarters->step == grid_.step / 2;
    for (const SampleSquare& square : squares) {
      if (square.is_quartered && has_quarters)
        add_quarters(square, *quarters);
      else if (square.side > 1 || !is_taken[grid_.triangle.index(square.x, square.y)])
        add_middle(square);
    }
  }

  void add_middle(const SampleSquare& square) {
    const int x = square.x + square.side / 2, y = square.y + square.side / 2;
    const Index t = grid_.triangle.at(x, y);
    const Vec2 place = grid_.place(x, y);
    add(t, place, surface_.at(t, place));
  }

  // Adds the centres of a square's quarters as samples, except those close to a point of the band near
  // creases. The grid `quarters` has half the step of grid_.
  void add_quarters(const SampleSquare& square, const SampleGrid& quarters) {
    for (int k = 0; k < 4; ++k) {
      const int x = 2 * square.x + k % 2, y = 2 * square.y + k / 2;
      const Vec2 place = quarters.place(x, y);
      const Index t = quarters.triangle.at(x, y);
      if (t == no_index || band_points_.is_near(place, apart * grid_.step / 2)) continue;
      add(t, place, surface_.at(t, place));
    }
  }

  // Marks the grid cells that are close to points of the band near creases.
  std::vector<std::uint8_t> taken_cells() const {
    const int width = grid_.input.width, height = grid_.input.height;
    std::vector<std::uint8_t> is_taken(grid_.triangle.pixels.size(), 0);
    for (const Vec3& p : out_.points) {
      const Vec2 pixel = grid_.pixel(p.head<2>());
      for (int y = static_cast<int>(pixel.y()) - 1; y <= static_cast<int>(pixel.y()) + 1; ++y)
        for (int x = static_cast<int>(pixel.x()) - 1; x <= static_cast<int>(pixel.x()) + 1; ++x)
          if (x >= 0 && y >= 0 && x < width && y < height && (Vec2(x + .5, y + .5) - pixel).norm() < apart)
            is_taken[grid_.triangle.index(x, y)] = 1;
    }
    return is_taken;
  }

  HeightFieldMesh triangulated() {
    std::vector<Vec2> plane;
    for (const Vec3& p : out_.points) plane.emplace_back(p.head<2>());
    Triangulation mesh = delaunay(plane);
    turn_diagonals(plane, slopes_, mesh);
    out_.triangles = std::move(mesh.triangles);
    out_.hull = std::move(mesh.hull);
    out_.ground_mm = front_.ground_mm;
    if (!front_.is_relief.empty()) tell_relief(plane);
    return std::move(out_);
  }

  // Marks each triangle whose centroid is in the relief.
  void tell_relief(const std::vector<Vec2>& plane) {
    const double near = 2 * grid_.step;
    std::vector<Segment> edges;
    for (const auto& [a, b] : boundary_edges(relief_triangles(front_)))
      edges.push_back({front_.points[a].head<2>(), front_.points[b].head<2>()});
    const SegmentGrid silhouette(std::move(edges), near);
    out_.is_relief.resize(out_.triangles.size());
    parallel_for(out_.triangles.size(), [&](std::size_t t) {
      const auto& [a, b, c] = out_.triangles[t];
      const Vec2 centre = (plane[a] + plane[b] + plane[c]) / 3;
      const NearestSegment edge = silhouette.nearest(centre, near);
      out_.is_relief[t] = edge.segment == no_index ? is_relief_around(centre) : edge.is_left;
    });
  }

  // Returns whether `place` is in the relief. `place` must be farther than a grid cell from the silhouette.
  bool is_relief_around(const Vec2& place) const {
    const Vec2 pixel = grid_.pixel(place);
    const int x = std::clamp(static_cast<int>(pixel.x()), 0, grid_.input.width - 1),
              y = std::clamp(static_cast<int>(pixel.y()), 0, grid_.input.height - 1);
    const Index old = grid_.triangle.at(x, y);
    return old != no_index && front_.is_relief[old];
  }

  const HeightFieldMesh& front_;
  std::span<const std::uint8_t> is_smooth_;
  const FrontSampling& options_;
  SmoothSurface surface_;
  std::vector<std::uint8_t> is_band_;
  SampleGrid grid_;
  PointSet band_points_;
  HeightFieldMesh out_;
  std::vector<Vec2f> slopes_;           // slopes at the points of out_; NaN for points of the given front
  std::vector<std::uint8_t> is_fixed_;  // per point of the band: whether it is kept in any case
  double low_ = 0, high_ = 0;
  int divisions_ = 1;
};

}  // namespace

Result<HeightFieldMesh> sample_front(const HeightFieldMesh& front, std::span<const std::uint8_t> is_smooth,
                                     const FrontSampling& options, const Progress* progress) {
  if (front.triangles.empty()) return front;
  return Sampler(front, is_smooth, options).make(progress);
}

}  // namespace relievo
