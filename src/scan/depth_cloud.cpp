// Converts a depth image into points. Tested by tests/scan/depth_image_test.cpp.
#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/scan/depth_image.h"
#include "scan/depth_grid.h"

namespace relievo {
namespace {

// Returns a mask of the grid points without a depth that are enclosed by known ones. Finds them by flooding
// all other unknown grid points from the image's border.
std::vector<std::uint8_t> enclosed_holes(const BoundedGrid& b) {
  std::vector<std::uint8_t> is_hole(b.is_known.size());
  for (std::size_t i = 0; i < is_hole.size(); ++i) is_hole[i] = !b.is_known[i];
  std::vector<std::pair<int, int>> open;
  const auto flood = [&](int c, int r) {
    if (c < 0 || r < 0 || c >= b.width || r >= b.height || !is_hole[b.at(c, r)]) return;
    is_hole[b.at(c, r)] = 0;
    open.emplace_back(c, r);
  };
  for (int c = 0; c < b.width; ++c) flood(c, 0), flood(c, b.height - 1);
  for (int r = 0; r < b.height; ++r) flood(0, r), flood(b.width - 1, r);
  while (!open.empty()) {
    const auto [c, r] = open.back();
    open.pop_back();
    flood(c - 1, r), flood(c + 1, r), flood(c, r - 1), flood(c, r + 1);
  }
  return is_hole;
}

// Gives each grid point of a hole a height: the lowest of the nearest known heights in the four directions
// along its row and column. The lowest is right because a hole beside an outline belongs to the surface
// behind it.
void fill(const BoundedGrid& b, const std::vector<std::uint8_t>& is_hole, std::vector<float>& z) {
  const std::vector<float> known = z;
  parallel_for(
      static_cast<std::size_t>(b.height),
      [&](std::size_t row) {
        const int r = static_cast<int>(row);
        for (int c = 0; c < b.width; ++c) {
          if (!is_hole[b.at(c, r)]) continue;
          float lowest = std::numeric_limits<float>::infinity();
          const auto look = [&](int dc, int dr) {
            int x = c, y = r;
            while (x >= 0 && y >= 0 && x < b.width && y < b.height && !b.is_known[b.at(x, y)])
              x += dc, y += dr;
            if (x >= 0 && y >= 0 && x < b.width && y < b.height) lowest = std::min(lowest, known[b.at(x, y)]);
          };
          look(1, 0), look(-1, 0), look(0, 1), look(0, -1);
          z[b.at(c, r)] = std::isfinite(lowest) ? lowest : 0;
        }
      },
      16);
}

// Returns the mean of the differences to the joined neighbours on both sides; 0 if there are none.
float slope_between(float before, float here, float after, bool joins_before, bool joins_after) {
  const float sum = (joins_before ? here - before : 0) + (joins_after ? after - here : 0);
  return joins_before && joins_after ? sum / 2 : sum;
}

Vec3f normal_at(const BoundedGrid& b, const std::vector<float>& z, int c, int r) {
  const std::size_t i = b.at(c, r), w = static_cast<std::size_t>(b.width);
  const bool left = c > 0 && b.joins_right[i - 1], up = r > 0 && b.joins_down[i - w];
  const bool right = b.joins_right[i], down = b.joins_down[i];
  const float dx = slope_between(left ? z[i - 1] : 0, z[i], right ? z[i + 1] : 0, left, right);
  const float dy = slope_between(up ? z[i - w] : 0, z[i], down ? z[i + w] : 0, up, down);
  return Vec3f(-dx, dy, 1).normalized();  // rows go down, y goes up
}

// Gives pixels, which are 1 wide and high, another width and height.
void scale_pixels(Cloud& cloud, const Vec2& shape) {
  if (shape == Vec2::Ones()) return;
  for (Vec3& p : cloud.points) p.head<2>() = p.head<2>().cwiseProduct(shape);
  for (Vec3f& n : cloud.normals) {
    n.head<2>() = n.head<2>().cwiseQuotient(shape.cast<float>());
    n.normalize();
  }
}

Cloud points_of(const DepthGrid& grid, const std::vector<float>& z,
                const std::vector<std::uint8_t>& is_hole) {
  const BoundedGrid& b = grid.bounds;
  Cloud cloud;
  for (int r = 0; r < b.height; ++r)
    for (int c = 0; c < b.width; ++c) {
      const std::size_t i = b.at(c, r);
      if (!b.is_known[i] && !is_hole[i]) continue;
      const double x = c - (b.width - 1) / 2.0, y = (b.height - 1) / 2.0 - r;
      cloud.points.emplace_back(x, y, double{z[i]});
      cloud.normals.push_back(is_hole[i] ? Vec3f(Vec3f::UnitZ()) : normal_at(b, z, c, r));
    }
  return cloud;
}

}  // namespace

Result<DepthCloud> depth_cloud(const DepthImage& image, const DepthOptions& options, Progress* progress) {
  RELIEVO_CHECK(check(options));
  RELIEVO_CHECK(begin_stage(progress, "depths", 0));
  DepthGrid grid = make_grid(image, options);
  DepthCloud out;
  out.reduction = grid.reduction;
  out.missing = grid.missing;
  out.noise = grid.noise;
  const bool is_removed = options.background == Background::remove ||
                          (options.background == Background::automatic && !options.camera);
  if (is_removed) out.background = remove_background(grid);
  join(grid);
  out.cut = cut_ramps(grid);
  const auto known = std::ranges::count(grid.bounds.is_known, 1);
  if (known < 16) return geometry_error(cat("expected at least 16 pixels with a depth, found ", known));
  RELIEVO_CHECK(begin_stage(progress, "smooth depths", 0));
  std::vector<float> z = smoothest(grid.bounds);
  const std::vector<std::uint8_t> is_hole = enclosed_holes(grid.bounds);
  fill(grid.bounds, is_hole, z);
  out.cloud = points_of(grid, z, is_hole);
  scale_pixels(out.cloud, image.pixel_shape());
  out.cloud.is_height_field = true;
  out.cloud.units_per_value = grid.units_per_value;
  return out;
}

Result<void> check(const DepthOptions& options) {
  if (!(options.range >= .01 && options.range <= 10))
    return option_error("depth-range", cat("expected a number from 0.01 to 10, found ", options.range));
  if (options.channel < 0 || options.channel > 64)
    return option_error("channel", cat("expected a number from 0 to 64, found ", options.channel));
  if (!(options.points >= 1000 && options.points <= 1e7))
    return option_error("points", cat("expected a number from 1000 to 1e+07, found ", options.points));
  return {};
}

}  // namespace relievo
