#include "relievo/scan/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/srgb.h"
#include "geometry/raster.h"
#include "geometry/weld.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "scan/outlines/mesh_outlines.h"

namespace relievo {
namespace {

constexpr int first_side_px = 512;  // side of the image that serves to estimate the number of visible pixels
constexpr int rows_per_band = 32;
// The least n_z of interpolated normals. They may face away from the viewer although the triangle does not;
// then they are turned until they just face the viewer.
constexpr float least_corner_normal_z = .02F;

// The mesh in view coordinates, with all triangles facing the viewer.
struct SeenMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::array<Vec3f, 3>> normals;  // normals of the corners, not normalised yet
  Box box;
};

// Returns whether more than 1 % of the mesh's corner normals differ from the normals of its flat triangles. Files of
// some programs contain only the normals of the flat triangles, which would show facets.
bool tells_normals(const Mesh& mesh) {
  const float same = .9999F;  // cosine of 0.8 degrees
  const auto count_told = [&](std::size_t begin, std::size_t end) {
    std::size_t told = 0;
    for (std::size_t t = begin; t < end; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const Vec3 p = mesh.points[b] - mesh.points[a], q = mesh.points[c] - mesh.points[a];
      const Vec3f flat = p.cross(q).stableNormalized().cast<float>();
      for (const Vec3f& n : mesh.corner_normals[t]) told += std::abs(n.dot(flat)) < same && !n.isZero(0);
    }
    return told;
  };
  const std::size_t told =
      parallel_reduce(mesh.corner_normals.size(), std::size_t{0}, count_told, std::plus<>());
  return 100 * told > 3 * mesh.corner_normals.size();
}

SeenMesh look_at(const Mesh& mesh, const View& view, const Vec3& centre) {
  SeenMesh seen;
  seen.points.resize(mesh.points.size());
  parallel_for(seen.points.size(),
               [&](std::size_t i) { seen.points[i] = view.R_view_model * (mesh.points[i] - centre); });
  seen.triangles = mesh.triangles;
  seen.normals = normals_to_show(mesh);
  const Eigen::Matrix3f turn = view.R_view_model.cast<float>();
  parallel_for(seen.triangles.size(), [&](std::size_t t) {
    Triangle& corners = seen.triangles[t];
    auto& normals = seen.normals[t];
    const Vec3 p = seen.points[corners[1]] - seen.points[corners[0]],
               q = seen.points[corners[2]] - seen.points[corners[0]];
    const Vec3f flat = p.cross(q).stableNormalized().cast<float>();
    const bool looks_away = flat.z() < 0;
    for (Vec3f& n : normals) n = n.isZero(0) ? (looks_away ? Vec3f(-flat) : flat) : Vec3f(turn * n);
    if (!looks_away) return;
    std::swap(corners[1], corners[2]);
    std::swap(normals[1], normals[2]);
    // If the normals agree with the old order of the corners, the triangle shows its back, so the normals are
    // reversed, too. Otherwise only the order was wrong.
    if ((normals[0] + normals[1] + normals[2]).dot(flat) > 0)
      for (Vec3f& n : normals) n = -n;
  });
  seen.box = used_box(seen.points, seen.triangles);
  return seen;
}

RasterInput scene_of(const SeenMesh& seen, double pixel) {
  RasterInput scene;
  scene.triangles = seen.triangles;
  const Vec3 size = seen.box.size() / pixel;
  scene.width = std::max(1, static_cast<int>(std::ceil(size.x())));
  scene.height = std::max(1, static_cast<int>(std::ceil(size.y())));
  scene.points.resize(seen.points.size());
  parallel_for(seen.points.size(), [&](std::size_t i) {
    const Vec3 p = seen.points[i].cwiseMax(seen.box.min).cwiseMin(seen.box.max);
    scene.points[i] = {(p.x() - seen.box.min.x()) / pixel, (seen.box.max.y() - p.y()) / pixel, p.z()};
  });
  return scene;
}

std::size_t covered_pixels(const RasterInput& scene) {
  std::atomic<std::size_t> covered = 0;
  draw_bands(scene, rows_per_band, [&](const RowBand& band) {
    covered += static_cast<std::size_t>(std::ranges::count_if(
        band.fragments.pixels, [](const Fragment& s) { return s.triangle != no_index; }));
  });
  return covered;
}

// Returns the width of the pixels: the requested spacing, or the width at which about the wanted number of
// pixels show the mesh. Returns nothing if no pixel shows the mesh.
std::optional<double> pixel_for(const SeenMesh& seen, const MeshSampling& options) {
  const double longer = seen.box.longer_side();
  const double finest = longer / (RasterInput::most_pixels / 8.0);
  if (options.spacing > 0 && longer > 0) return std::max(finest, options.spacing);
  double pixel = longer / first_side_px;
  if (!(pixel > 0)) return std::nullopt;
  const int tries = 4;  // each try has finer pixels, which may show a thin wire that coarser ones miss
  for (int i = 0; i < tries; ++i) {
    const auto covered = static_cast<double>(covered_pixels(scene_of(seen, pixel)));
    const bool is_sure = covered > 1000;  // with so many pixels the area is accurate to a few per cent
    if (is_sure) return std::max(finest, pixel * std::sqrt(covered / options.points));
    pixel = std::max(finest, pixel / 4);
  }
  return std::nullopt;
}

// Samples the mesh at the centres of pixels. To find outlines between these centres, draws the mesh with fine pixels;
// a pixel is `fine` of them wide.
class Sampler {
 public:
  static constexpr int fine = 5;  // odd, so that the centre of a pixel is also the centre of a fine pixel

  Sampler(const Mesh& mesh, const SeenMesh& seen, double pixel)
      : mesh_(mesh),
        seen_(seen),
        fine_pixel_(pixel / fine),
        scene_(scene_of(seen, fine_pixel_)),
        columns_((scene_.width + fine - 1) / fine),
        rows_((scene_.height + fine - 1) / fine) {}

  // Returns the points in view coordinates.
  Cloud sample() {
    draw();
    std::vector<Cloud> parts(static_cast<std::size_t>(rows_));
    parallel_for(
        parts.size(), [&](std::size_t r) { sample_row(static_cast<int>(r), parts[r]); }, 16);
    Cloud cloud;
    for (const Cloud& part : parts) {
      cloud.points.insert(cloud.points.end(), part.points.begin(), part.points.end());
      cloud.normals.insert(cloud.normals.end(), part.normals.begin(), part.normals.end());
      cloud.colours.insert(cloud.colours.end(), part.colours.begin(), part.colours.end());
      cloud.own_heights.insert(cloud.own_heights.end(), part.own_heights.begin(), part.own_heights.end());
    }
    return cloud;
  }

 private:
  static constexpr int middle = fine / 2;

  // Draws the mesh. Keeps the visible triangles along the middle lines of the pixels' rows and columns,
  // because the outline is searched only there.
  void draw() {
    along_rows_ = filled_image(columns_ * fine, rows_, no_index);
    along_columns_ = filled_image(columns_, rows_ * fine, no_index);
    draw_bands(scene_, rows_per_band, [&](const RowBand& band) {
      for (int r = 0; r < band.fragments.height; ++r) {
        const int row = band.first_row + r;
        for (int c = middle; c < scene_.width; c += fine)
          along_columns_.at(c / fine, row) = band.fragments.at(c, r).triangle;
        if (row % fine != middle) continue;
        for (int c = 0; c < scene_.width; ++c)
          along_rows_.at(c, row / fine) = band.fragments.at(c, r).triangle;
      }
    });
  }

  Index in_row(int row, int fine_column) const {
    return along_rows_.contains(fine_column, row) ? along_rows_.at(fine_column, row) : no_index;
  }
  Index in_column(int fine_row, int column) const {
    return along_columns_.contains(column, fine_row) ? along_columns_.at(column, fine_row) : no_index;
  }

  void sample_row(int row, Cloud& to) const {
    for (int column = -1; column < columns_; ++column) {
      const int x = column * fine + middle, y = row * fine + middle;
      if (column >= 0) add(in_row(row, x), x, y, to);
      const auto across = [&](int step) { return in_row(row, x + step); };
      add_outline(across, [&](Index t, int step) { add(t, x + step, y, to); });
      if (column < 0) continue;
      const auto down = [&](int step) { return in_column(y + step, column); };
      add_outline(down, [&](Index t, int step) { add(t, x, y + step, to); });
      if (row > 0) continue;
      const auto up = [&](int step) { return in_column(y - step, column); };
      add_outline(up, [&](Index t, int step) { add(t, x, y - step, to); });
    }
  }

  // Adds a point on the outline between two neighbouring pixels if exactly one of them shows the mesh. Goes
  // from the centre of that pixel towards the other one, and adds the point at the last fine pixel that shows
  // the mesh, unless this fine pixel is at the centre or next to it. seen_at(i) returns the triangle that is
  // visible i fine pixels after the centre of the first pixel.
  template <typename SeenAt, typename Add>
  static void add_outline(const SeenAt& seen_at, const Add& add_at) {
    const bool is_first = seen_at(0) != no_index, is_second = seen_at(fine) != no_index;
    if (is_first == is_second) return;
    const int begin = is_first ? 0 : fine, towards = is_first ? 1 : -1;
    int steps = 0;
    while (steps + 1 < fine && seen_at(begin + (steps + 1) * towards) != no_index) ++steps;
    if (steps >= 2) add_at(seen_at(begin + steps * towards), begin + steps * towards);
  }

  // Adds the point of triangle t at the centre of a fine pixel, unless t is no_index.
  void add(Index t, int fine_column, int fine_row, Cloud& to) const {
    if (t == no_index) return;
    const Vec2 place(fine_column + .5, fine_row + .5);
    const Vec3f weights = corner_weights(scene_, t, place.x(), place.y());
    const Triangle& corners = seen_.triangles[t];
    double z = 0;
    Vec3f normal = Vec3f::Zero();
    for (int i = 0; i < 3; ++i) {
      z += static_cast<double>(weights[i]) * seen_.points[corners[i]].z();
      normal += weights[i] * seen_.normals[t][i];
    }
    normal.z() = std::max(normal.z(), least_corner_normal_z);
    const Vec2 from_corner = fine_pixel_ * place;
    to.points.emplace_back(seen_.box.min.x() + from_corner.x(), seen_.box.max.y() - from_corner.y(), z);
    to.normals.push_back(normal.normalized());
    if (!mesh_.own_heights.empty()) to.own_heights.push_back(mesh_.own_heights[corners[0]]);
    if (!mesh_.colours.empty()) to.colours.push_back(weighted_mean(mesh_.colours, corners, weights));
  }

  const Mesh& mesh_;
  const SeenMesh& seen_;
  double fine_pixel_;
  RasterInput scene_;
  int columns_, rows_;  // numbers of pixels, not of fine pixels
  Image<Index> along_rows_, along_columns_;
};

// Transforms a cloud from view coordinates to the model's axes.
void turn_back(Cloud& cloud, const View& view, const Vec3& centre) {
  const Mat3 back = view.R_view_model.transpose();
  const Eigen::Matrix3f turn = back.cast<float>();
  parallel_for(cloud.size(), [&](std::size_t i) {
    cloud.points[i] = back * cloud.points[i] + centre;
    cloud.normals[i] = (turn * cloud.normals[i]).normalized();
  });
  for (OutlineSegment& s : cloud.outlines) s.from = back * s.from + centre, s.to = back * s.to + centre;
}

}  // namespace

std::vector<std::array<Vec3f, 3>> normals_to_show(const Mesh& mesh) {
  return tells_normals(mesh) ? mesh.corner_normals : smooth_normals(mesh);
}

Result<void> check_points(double points) {
  if (points >= 100 && points <= 1e7) return {};
  return option_error("points", cat("expected a number from 100 to 1e+07, found ", points));
}

Result<Cloud> sample_mesh(const Mesh& mesh, const View& view, const MeshSampling& options,
                          Progress* progress) {
  RELIEVO_CHECK(check_points(options.points));
  RELIEVO_CHECK(begin_stage(progress, "mesh", 0));
  const Box box = Box::of(mesh.points);
  const Vec3 centre = box.centre();
  if (!mesh.empty() && !(box.diagonal() > 1e-100 && box.diagonal() < 1e100))
    return geometry_error("expected a mesh between 1e-100 and 1e100 units large, found another");
  const SeenMesh seen = look_at(mesh, view, centre);
  const std::optional<double> pixel = pixel_for(seen, options);
  if (!pixel) return geometry_error("expected triangles that show an area in this view; try another view");
  RELIEVO_CHECK(begin_stage(progress, "mesh samples", 0));
  Cloud cloud = Sampler(mesh, seen, *pixel).sample();
  cloud.outlines = seen_outlines(seen.points, seen.triangles, *pixel);
  turn_back(cloud, view, centre);
  return cloud;
}

}  // namespace relievo
