#include "geometry/raster.h"

#include <algorithm>
#include <array>
#include <utility>

namespace relievo {
namespace {

constexpr int steps_per_pixel = 256;

// Rounds a coordinate to steps of 1 / steps_per_pixel. Truncation is faster than rounding, but rounds only positive
// numbers correctly. So the coordinate is shifted by 1 pixel; if it is below -1 pixel, the error is up to 1.5 steps.
int snap(double pixels) {
  return static_cast<int>((pixels + 1) * steps_per_pixel + 0.5) - steps_per_pixel;
}

// Returns the first pixel whose centre is at the coordinate `steps` or after it.
int first_centre(int steps) {
  const int shifted = steps + steps_per_pixel / 2 - 1;  // may be negative, so a pixel is added and removed
  return (shifted + steps_per_pixel) / steps_per_pixel - 1;
}

// Does the same as first_centre(), but limits the result to [0, most].
std::uint16_t cell_of(int steps, int most) {
  return static_cast<std::uint16_t>(std::clamp(first_centre(steps), 0, most));
}

// A linear function of a pixel's column and row. The function is not negative inside the triangle. Its values
// are integers below 2^53, so doubles are exact.
struct EdgeFunction {
  double value;  // value at the centre of column 0 of the current row
  double per_column, per_row;
};

template <typename Corner>
EdgeFunction edge_between(const Corner& a, const Corner& b, int row) {
  const int half = steps_per_pixel / 2;
  const double dx = b.x - a.x, dy = b.y - a.y, y = row * steps_per_pixel + half - a.y;
  EdgeFunction edge{dx * y - dy * (half - a.x), -dy * steps_per_pixel, dx * steps_per_pixel};
  // A pixel centre on an edge belongs to the triangle to the right of the edge or below it.
  const bool owns_its_points = edge.per_column > 0 || (edge.per_column == 0 && edge.per_row > 0);
  if (!owns_its_points) edge.value -= 1;
  return edge;
}

struct Columns {
  int begin, end;
};

// Returns the columns of the current row where no edge function is negative. Quotients give the columns where
// the functions are 0. A quotient is below 2^15. It is an integer, or at least 2^-31 away from any integer.
// So rounding cannot move it across an integer.
Columns columns_inside(const std::array<EdgeFunction, 3>& edges, int width) {
  double first = 0, last = width - 1;
  for (const EdgeFunction& edge : edges) {
    if (edge.per_column > 0) {
      first = std::max(first, -edge.value / edge.per_column);
    } else if (edge.per_column < 0) {
      last = std::min(last, -edge.value / edge.per_column);
    } else if (edge.value < 0) {
      return {0, 0};
    }
  }
  if (last < first) return {0, 0};
  const int floor = static_cast<int>(first);
  return {floor < first ? floor + 1 : floor, static_cast<int>(last) + 1};
}

// The plane of a triangle as a function of the pixel. Heights are limited to the range of the corners, so
// that slivers cause no spikes.
struct DepthPlane {
  double value = 0, per_column = 0, per_row = 0;  // `value` is the height at the image's corner
  double lowest = 0, highest = 0;
};

DepthPlane plane_through(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto [lowest, highest] = std::minmax({a.z(), b.z(), c.z()});
  const Vec3 p = b - a, q = c - a;
  const double area = p.x() * q.y() - p.y() * q.x();
  // In square pixels. If twice a triangle's area is less than this, its height is that of its highest corner
  // everywhere.
  const double least_area = 1e-9;
  if (std::abs(area) < least_area) return {highest, 0, 0, lowest, highest};
  const double per_column = (p.z() * q.y() - p.y() * q.z()) / area;
  const double per_row = (p.x() * q.z() - p.z() * q.x()) / area;
  return {a.z() - per_column * a.x() - per_row * a.y(), per_column, per_row, lowest, highest};
}

}  // namespace

Rasterizer::Rasterizer(const RasterInput& scene, int band_rows) : scene_(scene), band_rows_(band_rows) {
  corners_.resize(scene.points.size());
  cells_.resize(scene.points.size());
  parallel_for(scene.points.size(), [&](std::size_t i) {
    const Vec3& p = scene.points[i];
    const Corner corner{snap(p.x()), snap(p.y())};
    corners_[i] = corner;
    cells_[i] = {cell_of(corner.x, scene.width), cell_of(corner.y, scene.height)};
  });
  sort_into_bands();
}

// Returns whether the triangle lies between two neighbouring rows or columns of pixel centres, so that it covers no
// centre. Most triangles of a fine scan do, and this test reads few bytes of memory for each.
bool Rasterizer::slips_through(const Triangle& triangle) const {
  const Cell a = cells_[triangle[0]], b = cells_[triangle[1]], c = cells_[triangle[2]];
  const bool is_in_column = a.column == b.column && b.column == c.column;
  return is_in_column || (a.row == b.row && b.row == c.row);
}

bool Rasterizer::is_facing(const Triangle& triangle) const {
  const Corner &a = corners_[triangle[0]], &b = corners_[triangle[1]], &c = corners_[triangle[2]];
  const auto cross = std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
  return cross < 0;  // y points down: triangles that the viewer sees counter-clockwise are negative here
}

// Returns the rows whose pixel centres are between the triangle's corners. Centres at the height of its lowest corner
// are not included; they belong to other triangles.
Rasterizer::Rows Rasterizer::rows_of(const Triangle& triangle) const {
  const auto [top, bottom] =
      std::minmax({cells_[triangle[0]].row, cells_[triangle[1]].row, cells_[triangle[2]].row});
  return {top, bottom};
}

// Returns those triangles of [begin, end) that face the viewer and may cover a pixel centre, each with its bands.
std::vector<Rasterizer::InBands> Rasterizer::covering(std::size_t begin, std::size_t end) const {
  std::vector<InBands> found;
  for (std::size_t t = begin; t < end; ++t) {
    const Triangle& triangle = scene_.triangles[t];
    if (slips_through(triangle) || !is_facing(triangle)) continue;
    const Rows rows = rows_of(triangle);
    found.push_back({static_cast<Index>(t), {rows.begin / band_rows_, (rows.end - 1) / band_rows_ + 1}});
  }
  return found;
}

void Rasterizer::sort_into_bands() {
  constexpr std::size_t block = 1 << 14;  // triangles that one task sorts
  const std::size_t count = scene_.triangles.size(), blocks = (count + block - 1) / block;
  const auto bands = static_cast<std::size_t>((scene_.height + band_rows_ - 1) / band_rows_);
  std::vector<std::vector<InBands>> covering_in(blocks);
  // Per block and band: first the number of triangles, later the position in triangles_ for the next
  // triangle.
  std::vector<std::size_t> next(blocks * bands);
  parallel_ranges(count, block, [&](std::size_t begin, std::size_t end) {
    covering_in[begin / block] = covering(begin, end);
    for (const InBands& p : covering_in[begin / block])
      for (int b = p.bands.begin; b < p.bands.end; ++b)
        ++next[begin / block * bands + static_cast<std::size_t>(b)];
  });
  std::size_t sum = 0;
  for (std::size_t b = 0; b < bands; ++b) {
    first_.push_back(sum);
    for (std::size_t i = b; i < next.size(); i += bands) next[i] = std::exchange(sum, sum + next[i]);
  }
  first_.push_back(sum);
  triangles_.resize(sum);
  parallel_for(
      blocks,
      [&](std::size_t i) {
        for (const InBands& p : covering_in[i])
          for (int b = p.bands.begin; b < p.bands.end; ++b)
            triangles_[next[i * bands + static_cast<std::size_t>(b)]++] = p.triangle;
      },
      1);
}

void Rasterizer::draw_triangle(Index t, Rows rows, RowBand& band) const {
  const auto& [i, j, k] = scene_.triangles[t];
  const Corner &a = corners_[i], &b = corners_[k], &c = corners_[j];  // reversed, because y points down
  std::array edges{edge_between(a, b, rows.begin), edge_between(b, c, rows.begin),
                   edge_between(c, a, rows.begin)};
  const DepthPlane plane = plane_through(scene_.points[i], scene_.points[j], scene_.points[k]);
  for (int row = rows.begin; row < rows.end; ++row) {
    const Columns columns = columns_inside(edges, scene_.width);
    Fragment* const fragments = &band.fragments.at(0, row - band.first_row);
    const double z0 = plane.value + (row + 0.5) * plane.per_row + 0.5 * plane.per_column;
    for (int column = columns.begin; column < columns.end; ++column) {
      const double z = std::clamp(z0 + column * plane.per_column, plane.lowest, plane.highest);
      Fragment& fragment = fragments[column];
      if (static_cast<float>(z) > fragment.z) fragment = {static_cast<float>(z), t};
    }
    for (EdgeFunction& edge : edges) edge.value += edge.per_row;
  }
}

RowBand Rasterizer::draw(std::size_t b) const {
  const int first = static_cast<int>(b) * band_rows_, end = std::min(first + band_rows_, scene_.height);
  RowBand band{first, filled_image(scene_.width, end - first, Fragment{})};
  for (std::size_t at = first_[b]; at < first_[b + 1]; ++at) {
    const Index t = triangles_[at];
    const Rows rows = rows_of(scene_.triangles[t]);
    draw_triangle(t, {std::max(rows.begin, first), std::min(rows.end, end)}, band);
  }
  return band;
}

Vec3f corner_weights(const RasterInput& scene, Index triangle, double x, double y) {
  const auto& [i, j, k] = scene.triangles[triangle];
  const Vec2 place(x, y);
  const Vec2 a = scene.points[i].head<2>() - place, b = scene.points[j].head<2>() - place,
             c = scene.points[k].head<2>() - place;
  const auto cross = [](const Vec2& p, const Vec2& q) {
    return std::max(0.0, p.y() * q.x() - p.x() * q.y());
  };
  const Vec3 weights(cross(b, c), cross(c, a), cross(a, b));
  const double sum = weights.sum();
  if (!(sum > 0)) return Vec3f::Constant(1.0F / 3);
  return (weights / sum).cast<float>();
}

}  // namespace relievo
