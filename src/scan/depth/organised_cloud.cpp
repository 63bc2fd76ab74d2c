#include "scan/depth/organised_cloud.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/quantile.h"
#include "relievo/scan/depth_image.h"

namespace relievo {
namespace {

// The rays of a camera at the origin. The ray of the pixel in column c and row r is start + c right + r down. The
// component of a ray along `forward` is 1.
struct OrganisedCamera {
  Vec3 start, right, down, forward;

  Vec3 ray(double c, double r) const { return start + c * right + r * down; }
  // The focal length in pixels.
  double focal() const { return 1 / std::sqrt(right.norm() * down.norm()); }
};

struct Pixel {
  double c = 0, r = 0;
  Vec3 at;
};

Pixel pixel_of(const OrganisedCloud& scan, std::size_t i) {
  return {static_cast<double>(i % scan.columns), static_cast<double>(i / scan.columns), scan.cloud.points[i]};
}

bool is_measured(const Vec3& point) {
  return point.allFinite() && !point.isZero(0);
}

// Returns about 4,000 measured pixels, taken evenly.
std::vector<Pixel> some_pixels(const OrganisedCloud& scan) {
  constexpr std::size_t enough = 4000;
  std::vector<std::size_t> measured;
  for (std::size_t i = 0; i < scan.cloud.size(); ++i)
    if (is_measured(scan.cloud.points[i])) measured.push_back(i);
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < measured.size(); i += 1 + measured.size() / enough)
    pixels.push_back(pixel_of(scan, measured[i]));
  return pixels;
}

// Returns the camera whose rays fit the pixels' points best. Each ray has a component perpendicular to the direction
// of its point, and the sum of the squares of these components is least. Returns nothing if the rays span no picture.
std::optional<OrganisedCamera> nearest_camera(const std::vector<Pixel>& pixels, double scale) {
  using Unknowns = Eigen::Matrix<double, 9, 9>;
  Unknowns squares = Unknowns::Zero();
  for (const Pixel& pixel : pixels) {
    const Vec3 to = pixel.at.normalized(), place(1, pixel.c / scale, pixel.r / scale);
    const Mat3 across = Mat3::Identity() - to * to.transpose();
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index k = 0; k < 3; ++k) squares.block<3, 3>(3 * i, 3 * k) += place[i] * place[k] * across;
  }
  const Eigen::Vector<double, 9> rays =
      Eigen::SelfAdjointEigenSolver<Unknowns>(squares).eigenvectors().col(0);
  OrganisedCamera camera{rays.head<3>(), rays.segment<3>(3) / scale, rays.tail<3>() / scale, {}};
  camera.forward = camera.right.cross(camera.down).normalized();
  const double ahead = camera.forward.dot(camera.start);
  if (!camera.forward.allFinite() || std::abs(ahead) < 1e-6) return std::nullopt;
  for (Vec3* part : {&camera.start, &camera.right, &camera.down}) *part /= ahead;
  std::size_t behind = 0;
  for (const Pixel& pixel : pixels) behind += camera.forward.dot(pixel.at) < 0;
  if (2 * behind < pixels.size()) return camera;
  for (Vec3* part : {&camera.start, &camera.right, &camera.down, &camera.forward}) *part *= -1;
  return camera;
}

// If the camera looks almost exactly along an axis of the file, makes `forward` this axis, because the file has exact
// depths only along its axes.
void snap_to_axis(OrganisedCamera& camera) {
  constexpr double slant = 2e-3;
  Eigen::Index axis = 0;
  const double along = camera.forward.cwiseAbs().maxCoeff(&axis);
  if (along < 1 - slant * slant) return;
  camera.forward = std::copysign(1., camera.forward[axis]) * Vec3::Unit(axis);
}

// Returns the camera if nine in ten points are less than half a pixel away from the rays of their pixels,
// else nothing.
std::optional<OrganisedCamera> find_camera(const OrganisedCloud& scan) {
  constexpr double farthest_px = .5, share = .9;
  const std::vector<Pixel> pixels = some_pixels(scan);
  if (pixels.size() < 64) return std::nullopt;
  auto camera = nearest_camera(pixels, static_cast<double>(scan.columns));
  if (!camera) return std::nullopt;
  std::vector<double> misses_px;
  for (const Pixel& pixel : pixels) {
    const double depth = camera->forward.dot(pixel.at);
    if (!(depth > 0)) return std::nullopt;
    misses_px.push_back(camera->focal() * (pixel.at / depth - camera->ray(pixel.c, pixel.r)).norm());
  }
  if (!(quantile(misses_px, share) < farthest_px)) return std::nullopt;
  snap_to_axis(*camera);
  return camera;
}

// Returns the step of a camera's depths: the least difference between two values. Returns 0 if values occur so rarely
// that the differences are due to chance.
double step_of(const std::vector<float>& values) {
  constexpr std::size_t least_pixels_per_value = 32;
  constexpr float rounding = 1e-6F;
  std::vector<float> sorted;
  std::ranges::copy_if(values, std::back_inserter(sorted), [](float v) { return std::isfinite(v); });
  const std::size_t pixels = sorted.size();
  std::ranges::sort(sorted);
  sorted.erase(std::ranges::unique(sorted).begin(), sorted.end());
  if (sorted.size() < 2 || pixels < least_pixels_per_value * sorted.size()) return 0;
  float step = std::numeric_limits<float>::infinity();
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > rounding * sorted[i]) step = std::min(step, sorted[i] - sorted[i - 1]);
  return std::isfinite(step) ? double{step} : 0;
}

DepthImage depths_of(const OrganisedCloud& scan, const OrganisedCamera& camera) {
  DepthImage image;
  image.values.resize(static_cast<int>(scan.columns), static_cast<int>(scan.cloud.size() / scan.columns));
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    const Vec3& p = scan.cloud.points[i];
    const double depth = is_measured(p) ? camera.forward.dot(p) : 0;
    image.values[i] = depth > 0 ? static_cast<float>(depth) : std::numeric_limits<float>::quiet_NaN();
  }
  image.step = step_of(image.values.pixels);
  return image;
}

// Returns the normal in space at the point on a ray. `in_picture` is the normal of the height field -f log(depth)
// over the pixels; f is the focal length.
Vec3f normal_in_space(const OrganisedCamera& camera, const Vec3& ray, const Vec3f& in_picture) {
  const Vec3 n = in_picture.cast<double>() / double{in_picture.z()};
  const Vec3 along = camera.right + n.x() / camera.focal() * ray;
  const Vec3 down = camera.down - n.y() / camera.focal() * ray;
  const Vec3 normal = along.cross(down).normalized();
  return (normal.dot(ray) > 0 ? Vec3(-normal) : normal).cast<float>();
}

// Moves the points back onto their rays, at the depths of the smoothed picture.
void put_back(const DepthCloud& smoothed, const OrganisedCamera& camera, OrganisedCloud& scan) {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  const auto columns = static_cast<double>(scan.columns);
  const double rows = static_cast<double>(scan.cloud.size() / scan.columns);
  std::vector<Vec3> points(scan.cloud.size(), Vec3::Constant(nowhere));
  scan.cloud.normals.assign(points.size(), Vec3f::Zero());
  for (std::size_t i = 0; i < smoothed.cloud.size(); ++i) {
    const Vec3& p = smoothed.cloud.points[i];
    const double c = p.x() + (columns - 1) / 2, r = (rows - 1) / 2 - p.y();
    const auto pixel = static_cast<std::size_t>(std::lround(r * columns + c));
    const Vec3 ray = scan.cloud.points[pixel] / camera.forward.dot(scan.cloud.points[pixel]);
    points[pixel] = std::exp(-p.z() / camera.focal()) * ray;
    scan.cloud.normals[pixel] = normal_in_space(camera, ray, smoothed.cloud.normals[i]);
  }
  scan.cloud.points = std::move(points);
}

bool is_picture(const OrganisedCloud& scan) {
  const std::size_t columns = scan.columns, pixels = scan.cloud.size();
  constexpr std::size_t narrowest = 4, most_pixels = 10'000'000;
  return columns >= narrowest && pixels / columns >= narrowest && pixels % columns == 0 &&
         pixels <= most_pixels && !scan.cloud.has_normals();
}

}  // namespace

std::optional<OrganisedSmoothing> smooth_organised(OrganisedCloud& scan) {
  if (!is_picture(scan)) return std::nullopt;
  const auto camera = find_camera(scan);
  if (!camera) return std::nullopt;
  DepthOptions options;
  options.camera = DepthCamera{camera->focal(), camera->focal()};
  options.background = Removal::keep;
  if (scan.keeps_blur) options.blur = Removal::keep;
  options.points = 1e7;  // so many that pixels are not merged
  const auto smoothed = depth_cloud(depths_of(scan, *camera), options);
  if (!smoothed || smoothed->reduction != 1) return std::nullopt;
  put_back(*smoothed, *camera, scan);
  return OrganisedSmoothing{smoothed->noise, smoothed->blur};
}

}  // namespace relievo
