// Tests depth images in the conventions of different programs. The conventions differ in how depths are
// stored, in the value that marks missing depths, and in the background behind the figure.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "relievo/scan/depth_image.h"
#include "support/results.h"

namespace relievo {
namespace {

constexpr int side = 200;
constexpr double nothing = std::numeric_limits<double>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// Returns the depth in metres at a pixel of a bust, which is made of ellipsoids and seen along parallel
// rays. Returns `nothing` outside the bust.
double bust(int column, int row) {
  struct Ellipsoid {
    double x, y, z, rx, ry, rz;
  };
  constexpr std::array parts = {Ellipsoid{0, -.3, 2.7, .45, .55, .4}, Ellipsoid{0, -.25, 2.32, .07, .2, .15},
                                Ellipsoid{0, .3, 2.8, .2, .4, .2}, Ellipsoid{0, .75, 2.8, .9, .4, .35},
                                Ellipsoid{-.46, -.3, 2.75, .1, .2, .12}};
  const double x = (column - side / 2 + .5) / (side / 2), y = (row - side / 2 + .5) / (side / 2);
  double nearest = nothing;
  for (const Ellipsoid& e : parts) {
    const double u = (x - e.x) / e.rx, v = (y - e.y) / e.ry, inside = 1 - u * u - v * v;
    if (inside > 0) nearest = std::min(nearest, e.z - e.rz * std::sqrt(inside));
  }
  return nearest;
}

// A way to store depths, which are given in metres.
struct Convention {
  std::string_view name;
  DepthValues kind;
  double step;                          // 1 for integers, 0 for fractions
  std::function<double(double)> value;  // returns the stored value of a depth
  std::vector<float> missing;           // values that may mean that nothing was measured
};

std::vector<Convention> conventions() {
  using enum DepthValues;
  constexpr float inf = std::numeric_limits<float>::infinity();
  const auto whole = [](double factor, double most) {
    return [=](double d) { return std::min(most, std::round(factor * d)); };
  };
  const auto parts = [](double factor, bool is_rounded) {
    return [=](double d) { return is_rounded ? std::round(factor / d) : factor / d; };
  };
  return {{"metres", depth, 0, [](double d) { return d; }, {0, -1, inf, nan, 1e10F, 1e30F, 3.4e38F}},
          {"millimetres", depth, 1, whole(1000, 65535), {0, 65535}},
          {"8 bits", depth, 1, whole(60, 255), {0, 255}},
          {"inverse", inverse, 0, parts(1, false), {0, -1, nan}},
          {"disparity", inverse, 1, parts(1e5, true), {0, 65535}},
          {"8-bit disparity", inverse, 1, parts(500, true), {0, 255}}};
}

// Returns an image of the figure. A slightly tilted wall is behind it, at a distance of 3 m + `wall` from
// the viewer. There is no wall if `wall` is `nothing`.
DepthImage picture(const Convention& how, double wall, float missing,
                   const std::function<double(int, int)>& figure = bust) {
  DepthImage image{{side, side, 1, {}}, how.step, "test"};
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c) {
      const double d = std::min(figure(c, r), wall == nothing ? nothing : 3 + wall + 1e-4 * (c + r));
      image.values.pixels.push_back(d == nothing ? missing : static_cast<float>(how.value(d)));
    }
  return image;
}

std::vector<std::uint8_t> pixels_of(const Cloud& cloud) {
  std::vector<std::uint8_t> is_used(side * side, 0);
  for (const Vec3& p : cloud.points) {
    const double c = p.x() + (side - 1) / 2.0, r = (side - 1) / 2.0 - p.y();
    is_used[static_cast<std::size_t>(std::lround(r) * side + std::lround(c))] = 1;
  }
  return is_used;
}

// Returns the fraction of the figure's pixels that have points. If any point is more than two pixels outside
// the figure, returns a negative number.
double share_used(const DepthCloud& made) {
  const std::vector<std::uint8_t> is_used = pixels_of(made.cloud);
  const auto is_figure = [](int c, int r) {
    return c >= 0 && r >= 0 && c < side && r < side && bust(c, r) < nothing;
  };
  double all = 0, used = 0;
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c) {
      const bool has_point = is_used[static_cast<std::size_t>(r * side + c)] != 0;
      all += is_figure(c, r), used += is_figure(c, r) && has_point;
      bool is_beside = false;
      for (int y = r - 2; y <= r + 2; ++y)
        for (int x = c - 2; x <= c + 2; ++x) is_beside = is_beside || is_figure(x, y);
      if (has_point && !is_beside) return -1;
    }
  return used / all;
}

DepthOptions as(DepthValues kind) {
  return {.values = kind};
}

double depth_range(const Cloud& cloud) {
  const auto [low, high] = std::ranges::minmax(cloud.points, {}, [](const Vec3& p) { return p.z(); });
  return high.z() - low.z();
}

TEST(DepthConventions, TheFigureIsWholeWhateverIsBehindIt) {
  for (const Convention& how : conventions())
    for (const double wall : {nothing, 1.0, 5.0, 50.0})
      for (const float missing : how.missing) {
        SCOPED_TRACE(testing::Message() << how.name << ", wall " << wall << ", missing " << missing);
        const auto made = value_of(depth_cloud(picture(how, wall, missing), as(how.kind)));
        EXPECT_GE(share_used(made), .98);
        if (how.kind == DepthValues::depth) EXPECT_NEAR(depth_range(made.cloud), .5 * side, .03 * side);
      }
}

TEST(DepthConventions, MissingValuesAreCountedAndTheirMarkerNamed) {
  const Convention metres = conventions().front();
  const auto none = value_of(depth_cloud(picture(metres, nothing, 0), DepthOptions()));
  const auto far = value_of(depth_cloud(picture(metres, nothing, 1e10F), DepthOptions()));
  EXPECT_EQ(none.marked, 0U);
  EXPECT_EQ(far.marked, far.missing);
  EXPECT_EQ(far.missing, none.missing);
  EXPECT_EQ(far.marker, 1e10F);
  ASSERT_EQ(far.cloud.size(), none.cloud.size());
  for (std::size_t i = 0; i < far.cloud.size(); ++i) EXPECT_EQ(far.cloud.points[i], none.cloud.points[i]);
}

TEST(DepthConventions, EveryPixelHasItsUse) {
  DepthImage image = picture(conventions().front(), 1, 0);
  for (int r = 0; r < 20; ++r) image.values.at(0, r) = 0;
  const auto made = value_of(depth_cloud(image, DepthOptions()));
  ASSERT_EQ(made.uses.size(), image.values.size());
  const auto number_of = [&](PixelUse use) {
    return static_cast<std::size_t>(std::ranges::count(made.uses.pixels, use));
  };
  EXPECT_EQ(number_of(PixelUse::missing), 20U);
  EXPECT_EQ(number_of(PixelUse::background), made.background);
  EXPECT_GT(made.background, 10000U);
  EXPECT_EQ(number_of(PixelUse::blur), made.blur);
  ASSERT_EQ(number_of(PixelUse::kept), made.cloud.size());
  std::size_t point = 0;
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c) {
      if (made.uses.at(c, r) != PixelUse::kept) continue;
      EXPECT_NE(bust(c, r), nothing) << c << ", " << r;
      const Vec3& p = made.cloud.points[point++];
      EXPECT_EQ(p.head<2>(), Vec2(c - (side - 1) / 2., (side - 1) / 2. - r));
    }
}

// The depths are stored in steps of 10 mm. A tooth, a strip one pixel wide, stands on the upper side of the figure.
TEST(DepthConventions, TeethHaveTheUseOfBlur) {
  DepthImage image{filled_image(120, 90, 0.F), 1, "test"};
  for (int r = 20; r < 90; ++r)
    for (int c = 0; c < 120; ++c) image.values.at(c, r) = 1000.F + 10.F * static_cast<float>(c / 4);
  for (int r = 12; r < 20; ++r) image.values.at(61, r) = 1150;
  DepthOptions options{.camera = DepthCamera{100, 100, 59.5, 44.5}};
  const auto made = value_of(depth_cloud(image, options));
  EXPECT_EQ(made.blur, 8U);
  EXPECT_EQ(made.uses.at(61, 15), PixelUse::blur);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(made.uses.pixels, PixelUse::blur)), made.blur);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(made.uses.pixels, PixelUse::kept)),
            made.cloud.size());
}

TEST(DepthConventions, UnknownHeightsOfTerrainAreMissing) {
  for (const float marker : {-9999.F, -32768.F}) {
    const Convention heights{"heights", DepthValues::height, 0, [](double d) { return 5 - d; }, {}};
    const auto made = value_of(depth_cloud(picture(heights, nothing, marker), as(DepthValues::height)));
    EXPECT_EQ(made.marker, marker);
    EXPECT_EQ(share_used(made), 1);
  }
}

// If the gap between the largest value and the others is smaller than the range of the others, the largest
// value is a depth, not a marker.
TEST(DepthConventions, ALargestValueThatOthersLeadUpToIsADepth) {
  DepthImage image{{side, side, 1, {}}, 1, "test"};
  for (int i = 0; i < side * side; ++i) image.values.pixels.push_back(static_cast<float>(56 + i % side));
  EXPECT_EQ(value_of(depth_cloud(image, DepthOptions())).missing, 0U);
}

TEST(DepthConventions, WithoutAJumpNothingIsBackground) {
  const std::vector<std::function<double(int, int)>> surfaces = {
      [](int c, int r) {
        return 5 - .01 * std::min({c, r, side - 1 - c, side - 1 - r});
      },                                       // a pyramid
      [](int c, int) { return 1 + .01 * c; },  // a slope
      [](int c, int r) {                       // half a ball on a plane
        return 3 - std::sqrt(
                       std::max(0.0, .36 - std::pow((c - 100) / 100.0, 2) - std::pow((r - 100) / 100.0, 2)));
      },
      [](int c, int r) {  // a wall, and a floor with a column on it
        const double ground = r < 120 ? 4 : 4 - .02 * (r - 120);
        return c > 80 && c < 110 && r > 40 && r < 150 ? std::min(ground, 3.4) : ground;
      }};
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (const double factor : {1., 1000.}) {
      const Convention how{"", DepthValues::depth, 0, [&](double d) { return factor * d; }, {}};
      const auto made = value_of(depth_cloud(picture(how, nothing, 0, surfaces[i]), DepthOptions()));
      EXPECT_EQ(made.background + made.blur, 0U) << i;
      EXPECT_EQ(made.cloud.size(), static_cast<std::size_t>(side * side)) << i;
    }
}

TEST(DepthConventions, BackgroundIsKeptIfAskedAndInHeightsUnlessAsked) {
  const Convention metres = conventions().front();
  DepthOptions options{.background = Removal::keep};
  EXPECT_EQ(value_of(depth_cloud(picture(metres, 1, 0), options)).background, 0U);
  options.background = Removal::automatic;
  options.camera = DepthCamera{220, 220, 100, 100};
  EXPECT_EQ(value_of(depth_cloud(picture(metres, 1, 0), options)).background, 0U);
  const Convention heights{"heights", DepthValues::height, 0, [](double d) { return 5 - d; }, {}};
  options = as(DepthValues::height);
  EXPECT_EQ(value_of(depth_cloud(picture(heights, 1, 0), options)).background, 0U);
  options.background = Removal::drop;
  EXPECT_GE(share_used(value_of(depth_cloud(picture(heights, 1, 0), options))), .98);
}

// The column extends to the lower edge of the picture, so there is no jump around it on this side.
TEST(DepthConventions, FarDepthsAreTakenOutIfAsked) {
  const Convention metres = conventions().front();
  const auto column = [](int c, int r) { return c > 80 && c < 110 && r > 40 ? 2 + .001 * c : 4 - .0001 * r; };
  DepthOptions options{.background = Removal::drop};
  const auto made = value_of(depth_cloud(picture(metres, nothing, 0, column), options));
  EXPECT_EQ(made.cloud.size(), 29U * 159U);
}

// Returns a disc of value 200 in front of a wall of value 60. The disc's outline is blurred over `blur`
// pixels inwards and outwards.
DepthImage blurred_disc(double blur) {
  DepthImage image{{side, side, 1, {}}, 1, "test"};
  for (int i = 0; i < side * side; ++i) {
    const double from_rim = std::hypot(i % side - 100, i / side - 100) - 50;
    const double share = std::clamp(.5 - from_rim / (2 * blur), 0.0, 1.0);
    image.values.pixels.push_back(static_cast<float>(std::round(60 + 140 * share)));
  }
  return image;
}

// Returns the number of points that are between the height of the disc and the height of the wall.
std::size_t points_between(const Cloud& cloud) {
  const auto [low, high] = std::ranges::minmax(cloud.points, {}, [](const Vec3& p) { return p.z(); });
  return static_cast<std::size_t>(std::ranges::count_if(cloud.points, [&](const Vec3& p) {
    const double share = (p.z() - low.z()) / (high.z() - low.z());
    return share > .15 && share < .85;
  }));
}

TEST(DepthConventions, BlurIsTakenOutAsFarAsAsked) {
  for (const double blur : {1.0, 1.5, 2.5, 4.0}) {
    SCOPED_TRACE(blur);
    DepthOptions options = as(DepthValues::luminance);
    options.background = Removal::keep;
    const auto narrow = value_of(depth_cloud(blurred_disc(blur), options));
    options.blur = Removal::drop;
    const auto wide = value_of(depth_cloud(blurred_disc(blur), options));
    options.blur = Removal::keep;
    const auto kept = value_of(depth_cloud(blurred_disc(blur), options));
    EXPECT_LT(points_between(wide.cloud), 40U);
    EXPECT_GT(wide.blur, 200U);
    if (blur < 2) EXPECT_LT(points_between(narrow.cloud), 40U);
    EXPECT_EQ(kept.blur, 0U);
    EXPECT_EQ(kept.cloud.size(), static_cast<std::size_t>(side * side));
  }
}

TEST(DepthConventions, ABlurredOutlineSurroundsAFigureBeforeABackground) {
  const auto made = value_of(depth_cloud(blurred_disc(1), as(DepthValues::luminance)));
  const double disc = 3.1416 * 50 * 50;
  EXPECT_NEAR(static_cast<double>(made.cloud.size()), disc, .1 * disc);
  EXPECT_GT(made.background, 30000U);
}

TEST(DepthConventions, RoundSidesAreNoBlur) {
  for (const Convention& how : conventions()) {
    const auto made = value_of(depth_cloud(picture(how, 1, 0), as(how.kind)));
    EXPECT_LT(static_cast<double>(made.blur), .005 * static_cast<double>(made.cloud.size())) << how.name;
  }
}

// In a height map, the walls of letters are steep over one or two pixels. They must not count as blur.
TEST(DepthConventions, WallsOfLettersAreSurface) {
  DepthImage image{{side, side, 1, {}}, 0, "test"};
  for (int i = 0; i < side * side; ++i) {
    const double c = i % side - 100, bulge = 9 - c * c / 1200, depth = std::clamp(12 - std::abs(c), 0.0, 1.5);
    image.values.pixels.push_back(static_cast<float>(bulge - depth / 3));
  }
  for (const Removal background : {Removal::automatic, Removal::keep}) {
    DepthOptions options = as(DepthValues::height);
    options.background = background;
    const auto made = value_of(depth_cloud(image, options));
    EXPECT_EQ(made.cloud.size(), image.values.size());
    EXPECT_LT(std::ranges::min(made.cloud.normals, {}, [](const Vec3f& n) { return n.z(); }).z(), .4F);
  }
}

}  // namespace
}  // namespace relievo
