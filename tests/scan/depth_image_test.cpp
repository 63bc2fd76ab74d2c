#include "relievo/scan/depth_image.h"
#include "relievo/io/read.h"

#include "relievo/make_relief.h"
#include "relievo/relief/relief.h"
#include "support/results.h"
#include "support/self_intersections.h"
#include "support/shapes.h"

namespace relievo {
namespace {

constexpr int width = 240, height = 180;

// Returns a depth image whose values are value(column, row).
template <typename F>
DepthImage image_of(F&& value, double step) {
  DepthImage image{{width, height, 1, {}}, step, "test"};
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c) image.values.pixels.push_back(static_cast<float>(value(c, r)));
  return image;
}

// Returns the height, in [0, 1], of a smooth surface. Its hills differ in steepness.
double hills(double c, double r) {
  const auto hill = [&](double x, double y, double radius) {
    return std::exp(-((c - x) * (c - x) + (r - y) * (r - y)) / (2 * radius * radius));
  };
  return .75 * hill(90, 80, 50) + .25 * hill(170, 120, 18) + .12 * hill(60, 130, 9);
}

double highest_hill() {
  double high = 0;
  for (int i = 0; i < width * height; ++i) high = std::max(high, hills(i % width, i / width));
  return high;
}

// Returns the normal of the surface hills(). A height of 1 is `scale` pixels high.
Vec3f hills_normal(double c, double r, double scale) {
  const double e = 1e-3, dx = (hills(c + e, r) - hills(c - e, r)) / (2 * e),
               dy = (hills(c, r + e) - hills(c, r - e)) / (2 * e);
  return Vec3(-scale * dx, scale * dy, 1).normalized().cast<float>();
}

double angle_deg(const Vec3f& a, const Vec3f& b) {
  return std::acos(std::min(1.0, double{a.dot(b)})) * 180 / std::numbers::pi;
}

std::size_t pixel_of(const Vec3& p) {
  const double c = p.x() + (width - 1) / 2.0, r = (height - 1) / 2.0 - p.y();
  return static_cast<std::size_t>(std::lround(r) * width + std::lround(c));
}

struct Errors {
  double height = 0, angle_deg = 0;  // root mean square error of heights; mean error of angles
};

// Returns the errors of the cloud's heights and normals, compared with those of hills(). An offset
// that all heights have in common does not count.
Errors errors_of(const Cloud& cloud, double scale) {
  Errors sum;
  double shift = 0;
  for (const Vec3& p : cloud.points) {
    const auto i = pixel_of(p);
    shift += p.z() - scale * hills(static_cast<double>(i % width), static_cast<double>(i / width));
  }
  shift /= static_cast<double>(cloud.size());
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    const auto i = pixel_of(cloud.points[k]);
    const double c = static_cast<double>(i % width), r = static_cast<double>(i / width);
    const double off = cloud.points[k].z() - scale * hills(c, r) - shift;
    sum.height += off * off;
    sum.angle_deg += angle_deg(cloud.normals[k], hills_normal(c, r, scale));
  }
  return {std::sqrt(sum.height / static_cast<double>(cloud.size())),
          sum.angle_deg / static_cast<double>(cloud.size())};
}

DepthOptions as_heights() {
  return {.values = DepthValues::height, .background = Removal::keep};
}

TEST(DepthCloud, EightBitsComeBackCloserThanTheirSteps) {
  const double high = highest_hill();
  const DepthImage image = image_of([&](int c, int r) { return std::round(255 * hills(c, r) / high); }, 1);
  const auto made = value_of(depth_cloud(image, as_heights()));
  ASSERT_EQ(made.cloud.size(), image.values.size());
  const double scale = .5 * width / high, step = .5 * width / 255;  // in pixels
  const Errors smooth = errors_of(made.cloud, scale);

  // `raw` is the same cloud without smoothing, so its rounded heights form steps. Its normals are computed by
  // the same formula.
  Cloud raw = made.cloud;
  const auto value = [&](int c, int r) {
    c = std::clamp(c, 0, width - 1), r = std::clamp(r, 0, height - 1);
    return step * double{image.values[static_cast<std::size_t>(r * width + c)]};
  };
  for (std::size_t k = 0; k < raw.size(); ++k) {
    const auto i = static_cast<int>(pixel_of(raw.points[k]));
    const int c = i % width, r = i / width;
    raw.points[k].z() = value(c, r);
    raw.normals[k] = Vec3((value(c - 1, r) - value(c + 1, r)) / 2, (value(c, r + 1) - value(c, r - 1)) / 2, 1)
                         .normalized()
                         .cast<float>();
  }
  const Errors stepped = errors_of(raw, scale);
  RecordProperty("mean_normal_error_deg", std::to_string(smooth.angle_deg));
  RecordProperty("mean_normal_error_of_steps_deg", std::to_string(stepped.angle_deg));
  RecordProperty("height_error_in_steps", std::to_string(smooth.height / step));
  EXPECT_NEAR(stepped.height / step, 1 / std::sqrt(12), .02);  // the standard deviation of rounding errors
  EXPECT_LT(smooth.height, .5 * stepped.height);
  EXPECT_LT(smooth.angle_deg, .2 * stepped.angle_deg);
  EXPECT_LT(smooth.angle_deg, 2);
}

TEST(DepthCloud, StaysWithinTheStepEverywhere) {
  const DepthImage image = image_of([&](int c, int r) { return std::round(100 * hills(c, r)); }, 1);
  const auto made = value_of(depth_cloud(image, as_heights()));
  const auto [low, high] = std::ranges::minmax(image.values.pixels);
  const double step = .5 * width / double{high - low};
  for (const Vec3& p : made.cloud.points) EXPECT_NEAR(p.z() / step, double{image.values[pixel_of(p)]}, .5001);
}

TEST(DepthCloud, FloatsWithoutNoiseStayAsTheyAre) {
  const auto made = value_of(depth_cloud(image_of(hills, 0), as_heights()));
  const double high = highest_hill();
  const Errors errors = errors_of(made.cloud, .5 * width / high);
  EXPECT_LT(errors.height, .06);
  EXPECT_LT(errors.angle_deg, .2);
}

TEST(DepthCloud, NoiseIsMeasuredAndTakenAway) {
  test::Random random(3);
  const double sigma = .004;  // about half a pixel
  const auto made = depth_cloud(
      image_of([&](int c, int r) { return hills(c, r) + sigma * random.gaussian(); }, 0), as_heights());
  ASSERT_TRUE(made);
  const double high = highest_hill();
  const double scale = .5 * width / (high + 2 * 3.5 * sigma);  // the range includes the noise
  EXPECT_NEAR(made->noise, 2 * sigma * scale, .3 * sigma * scale);
  EXPECT_LT(errors_of(made->cloud, scale).angle_deg, 4.5);  // 26 degrees without smoothing
}

TEST(DepthCloud, AWallThatACameraSeesAskewIsAPlane) {
  // A ray (u, v, 1) meets the plane n . p = 1 at the depth 1 / (n . (u, v, 1)).
  const DepthCamera camera{300, 300, 119.5, 89.5};
  const Vec3 n = Vec3(.3, -.2, 1);
  const auto ray = [&](double c, double r) {
    return Vec3((c - camera.cx) / camera.fx, (r - camera.cy) / camera.fy, 1);
  };
  DepthOptions options{.camera = camera};
  const auto made = depth_cloud(image_of([&](int c, int r) { return 1500 / n.dot(ray(c, r)); }, 0), options);
  ASSERT_TRUE(made) << made.error().message();
  for (std::size_t k = 0; k < made->cloud.size(); k += 31) {
    const auto i = static_cast<int>(pixel_of(made->cloud.points[k]));
    const Vec3 r = ray(i % width, i / width);
    // The z of the cloud is -f log(depth), where f is the focal length. So the slope of z per pixel is
    // (n.x, n.y) / (n . ray).
    const Vec3f expected = Vec3(-n.x() / n.dot(r), n.y() / n.dot(r), 1).normalized().cast<float>();
    EXPECT_LT(angle_deg(made->cloud.normals[k], expected), .3) << k;
  }
}

TEST(DepthCloud, DepthInverseDepthAndHeightAgree) {
  // A ball in front of a wall is stored as depth and as inverse depth.
  const auto depth = [](int c, int r) {
    const double x = (c - 120) / 60.0, y = (r - 90) / 60.0, d = 1 - x * x - y * y;
    return 4 - (d > 0 ? .5 * std::sqrt(d) : 0);
  };
  DepthOptions options{.camera = DepthCamera{264, 264, 119.5, 89.5}, .background = Removal::keep};
  const auto by_depth = depth_cloud(image_of(depth, 0), options);
  options.camera.reset();
  options.values = DepthValues::inverse;  // the default camera has the same focal length, 1.1 times 240
  const auto by_inverse = depth_cloud(image_of([&](int c, int r) { return 7 / depth(c, r); }, 0), options);
  ASSERT_TRUE(by_depth && by_inverse);
  ASSERT_EQ(by_depth->cloud.size(), by_inverse->cloud.size());
  for (std::size_t k = 0; k < by_depth->cloud.size(); k += 7)
    EXPECT_LT(angle_deg(by_depth->cloud.normals[k], by_inverse->cloud.normals[k]), 1) << k;
}

TEST(DepthCloud, HolesHaveNoPoints) {
  const auto is_missing = [](int c, int r) { return std::hypot(c - 100, r - 90) < 10 || c > 200; };
  const auto made = value_of(depth_cloud(
      image_of([&](int c, int r) { return is_missing(c, r) ? 0.0 : 1000 + .1 * c; }, 1), DepthOptions()));
  EXPECT_EQ(made.cloud.size() + made.missing, static_cast<std::size_t>(width * height));
  for (const Vec3& p : made.cloud.points) {
    const auto i = static_cast<int>(pixel_of(p));
    EXPECT_FALSE(is_missing(i % width, i / width));
  }
}

TEST(DepthCloud, LargeImagesAreReduced) {
  DepthOptions options = as_heights();
  options.points = 5000;
  const auto made = value_of(depth_cloud(image_of(hills, 0), options));
  EXPECT_EQ(made.reduction, 3);
  EXPECT_EQ(made.cloud.size(), 80U * 60);
}

TEST(DepthCloud, RefusesWhatItCannotUse) {
  DepthOptions options{.range = 0};
  EXPECT_EQ(depth_cloud(image_of(hills, 0), options).error().input, "depth-range");
  EXPECT_EQ(depth_cloud(image_of([](int, int) { return 0; }, 1), {}).error().kind, ErrorKind::geometry);
  Cancelled progress;
  EXPECT_EQ(depth_cloud(image_of(hills, 0), {}, &progress).error().kind, ErrorKind::cancelled);
}

// The normals of a hollow point inwards, like those of a model that is inside out. Here they face the
// viewer, so they must not be flipped.
TEST(DepthCloud, OfAHollowBecomesARelief) {
  const auto hollow = depth_cloud(image_of([](int c, int r) { return 1 - hills(c, r); }, 0), as_heights());
  ASSERT_TRUE(hollow);
  ReliefOptions options{{.height_mm = 2}};
  const auto made = value_of(make_relief(hollow->cloud, options));
  EXPECT_EQ(check_solid(made.solid), "");
  EXPECT_GT(made.report.visible_points, .95 * width * height);
}

// At each edge of a picture, the points are on one line, exactly or up to rounding. That must not
// make the solid intersect itself.
TEST(DepthCloud, MakesSolidsThatDoNotCutThemselves) {
  DepthImage image{{48, 36, 1, {}}, 0, "test"};
  for (int i = 0; i < 48 * 36; ++i)
    image.values.pixels.push_back(static_cast<float>(1 - hills(5 * (i % 48), 5 * (i / 48))));
  const ReliefModel model = value_of(prepare(value_of(depth_cloud(image, as_heights())).cloud, View{}));
  ReliefOptions options{{.height_mm = 2, .resolution_mm = 2}};
  using Limit = std::optional<double>;
  for (const Outline outline : {Outline::rectangle, Outline::none})
    for (const auto& [tolerance, triangles] :
         {std::pair<Limit, Limit>{}, {.02, std::nullopt}, {std::nullopt, 2500}}) {
      options.outline = outline;
      options.tolerance_mm = tolerance;
      options.triangles = triangles;
      SCOPED_TRACE(testing::Message() << name_in(outline_choices, outline) << ", tolerance "
                                      << tolerance.value_or(0) << ", triangles " << triangles.value_or(0));
      const auto made = value_of(make_relief(model, options));
      EXPECT_EQ(check_solid(made.solid), "");
      EXPECT_EQ(test::self_intersections(made.solid), "");
      EXPECT_EQ(test::self_intersections(in_unit(made.solid, LengthUnit::inch)), "");
    }
}

TEST(ParseCamera, TakesFourOrNineNumbers) {
  EXPECT_EQ(parse_camera("585,584,320,240")->fy, 584);
  const auto matrix = value_of(parse_camera(" 5.85e+02\t 0.0 \t3.2e+02\n 0 5.84e+02 2.4e+02\r\n 0 0 1\n"));
  EXPECT_EQ(matrix.fx, 585);
  EXPECT_EQ(matrix.fy, 584);
  EXPECT_EQ(matrix.cx, 320);
  EXPECT_EQ(matrix.cy, 240);
  for (const char* text :
       {"", "1,2,3", "1,2,3,x", "0,1,2,3", "1,-1,2,3", "1 2 3 4 5", "1 2 3 4 5 6 7 8 9 10", "nan,1,2,3"})
    EXPECT_EQ(parse_camera(text).error().input, "camera") << text;
}

}  // namespace
}  // namespace relievo
