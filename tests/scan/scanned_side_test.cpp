#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "relievo/scan/normals.h"
#include "scan/coarse_visibility.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// Returns the height of a scanned object above its ground at (x, y) in [-1, 1]^2; NaN where nothing was
// scanned.
using Height = std::function<double(double, double)>;

struct Scan {
  std::string name;
  Height height;
};

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double hump(Vec2 at, Vec2 radii, double height, double x, double y) {
  const double r_sq = (Vec2(x, y) - at).cwiseQuotient(radii).squaredNorm();
  return r_sq < 1 ? height * std::sqrt(1 - r_sq) : 0;
}

double rising(double t) {
  constexpr double width = .004;
  return 1 / (1 + std::exp(-t / width));
}

double slab(Vec2 at, Vec2 half, double x, double y) {
  return rising(half.x() - std::abs(x - at.x())) * rising(half.y() - std::abs(y - at.y()));
}

// Returns the height at (x, y) of five letters, made of bars of height 1.
double letters(double x, double y) {
  constexpr double size = .14;
  double z = 0;
  for (int i = -2; i <= 2; ++i) {
    const double left = (2.4 * i - .7) * size, middle = 2.4 * i * size;
    z = std::max(z, slab({left, 0}, {.2 * size, size}, x, y));
    z = std::max(z, slab({middle, .3 * size * i}, {.8 * size, .2 * size}, x, y));
    if (i % 2) z = std::max(z, slab({left + 1.4 * size, 0}, {.2 * size, size}, x, y));
  }
  return z;
}

// Returns the height at (x, y) of a head with a nose and shoulders. It is about 1 high.
double head(double x, double y) {
  return std::max({hump({0, .2}, {.25, .35}, 1, x, y) + hump({0, .15}, {.05, .1}, .3, x, y),
                   hump({0, -.15}, {.12, .3}, .6, x, y), hump({0, -.5}, {.55, .22}, .8, x, y)});
}

double rim(double x, double y) {
  return rising((std::hypot(x, y) - .88) / 3);
}

double face(double x, double y) {
  const double r_sq = x * x / .56 + y * y;
  if (r_sq > .97) return nothing;
  const auto dent = [&](double cx, double cy) {
    return std::exp(-((x - cx) * (x - cx) + (y - cy) * (y - cy)) / .02);
  };
  const double nose = std::exp(-x * x / .008 - (y + .05) * (y + .05) / .04);
  return .7 * std::sqrt(1 - r_sq) + .2 * nose - .12 * (dent(.3, .2) + dent(-.3, .2)) - .05 * dent(0, -.5);
}

double bust(double x, double y) {
  const double z = std::max({hump({0, .4}, {.3, .42}, .35, x, y), hump({0, 0}, {.15, .4}, .15, x, y),
                             y > -.75 ? hump({0, -.6}, {.9, .5}, .4, x, y) : 0});
  return z > .02 ? z + hump({0, .36}, {.06, .12}, .1, x, y) : nothing;
}

double petals(double x, double y) {
  double z = hump({0, 0}, {.25, .25}, .2, x, y);
  for (int i = 0; i < 6; ++i)
    z = std::max(z, hump({.55 * std::cos(i * 1.0472), .55 * std::sin(i * 1.0472)}, {.3, .3}, .15, x, y));
  return z;
}

double balls(double x, double y) {
  test::Random random(5);
  double z = 0;
  for (int i = 0; i < 9; ++i) {
    const double radius = random.uniform(.1, .3);
    const Vec2 at(random.uniform(-.8, .8), random.uniform(-.8, .8));
    z = std::max(z, hump(at, {radius, radius}, radius, x, y));
  }
  return z;
}

Height disc(Height f) {
  return [=](double x, double y) { return std::hypot(x, y) < 1 ? f(x, y) : nothing; };
}

Height plate(double width, double height, Height f) {
  return [=](double x, double y) { return std::abs(x) < width && std::abs(y) < height ? f(x, y) : nothing; };
}

Height coin(double rim_height, double of_head) {
  return disc([=](double x, double y) { return std::max(rim_height * rim(x, y), of_head * head(x, y)); });
}

double legend(double x, double y) {
  return .04 * std::max(rim(x, y), letters(x, y));
}

double dish(double x, double y) {
  return .08 * (x * x + y * y) + .15 * head(x, y);
}

double framed_letters(double x, double y) {
  return .05 * std::max(letters(x, y), 1 - slab({0, 0}, {.9, .5}, x, y));
}

double inscription(double x, double y) {
  return .1 * (1 - x * x) * (1 - y * y) - .01 * letters(x, y);
}

double half_ball(double x, double y) {
  return std::sqrt(1 - x * x - y * y);
}

double shell(double x, double y) {
  return .4 * half_ball(x, y) + .05 * std::hypot(x, y) * std::abs(std::sin(8 * std::atan2(y, x)));
}

double mane(double x, double y) {
  return .5 * half_ball(x, y) + .04 * std::hypot(x, y) * std::sin(14 * std::atan2(y, x));
}

double ring(double x, double y) {
  const double d = std::hypot(x, y) - .6;
  return std::abs(d) < .2 ? std::sqrt(.04 - d * d) : 0;
}

double steps(double x, double y) {
  return .1 * (slab({0, 0}, {.6, .5}, x, y) + slab({0, 0}, {.4, .3}, x, y) + slab({0, 0}, {.2, .15}, x, y));
}

Height scaled(double factor, Height f) {
  return [=](double x, double y) { return factor * f(x, y); };
}

// Returns 22 objects that are scanned from one side: coins, plaques, faces, busts and ornaments.
std::vector<Scan> one_sided_scans() {
  const auto low_dome = [](double x, double y) { return .2 * (1 - x * x - y * y); };
  return {{"coin", coin(.06, .1)},
          {"coin without a rim", coin(0, .1)},
          {"coin with a high rim", coin(.15, .1)},
          {"worn coin", coin(.015, .015)},
          {"coin with letters", disc(legend)},
          {"dish", disc(dish)},
          {"letters", plate(1, .6, scaled(.05, letters))},
          {"framed letters", plate(1, .6, framed_letters)},
          {"inscription", plate(1, .6, inscription)},
          {"plaque", plate(.8, 1, scaled(.25, head))},
          {"bust on a wall", plate(1, 1, scaled(.6, head))},
          {"face", face},
          {"part of a face", plate(.5, .65, face)},
          {"bust", bust},
          {"dome", disc(half_ball)},
          {"low dome", disc(low_dome)},
          {"shell", disc(shell)},
          {"mane", disc(mane)},
          {"flower", disc(petals)},
          {"balls", plate(1, 1, balls)},
          {"ring", plate(1, 1, ring)},
          {"steps", plate(1, .7, steps)}};
}

// Returns points on an object, rotated by `turn`, without normals.
Cloud scanned(const Scan& scan, const Mat3& turn, std::uint64_t seed) {
  test::Random random(seed);
  Cloud cloud;
  while (cloud.size() < 14'000) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = scan.height(x, y);
    if (!std::isnan(z)) cloud.points.push_back(turn * Vec3(x, y, z));
  }
  return cloud;
}

Mat3 random_turn(std::uint64_t seed) {
  test::Random random(seed);
  Eigen::Quaterniond turn;
  for (double& x : turn.coeffs()) x = random.gaussian();
  return turn.normalized().toRotationMatrix();
}

Side side_of(const Scan& scan, const Mat3& turn, std::uint64_t seed) {
  Cloud cloud = scanned(scan, turn, seed);
  estimate_normals(cloud);
  return scanned_side(cloud, NormalSigns::unknown).value_or(Side{Vec3::Zero(), Vec3::Zero()});
}

TEST(ScannedSide, IsTheFrontOfScansAlongAnAxis) {
  for (const Scan& scan : one_sided_scans()) {
    const Side side = side_of(scan, Mat3::Identity(), 3);
    EXPECT_EQ(side.towards_viewer, Vec3::UnitZ()) << scan.name;
    EXPECT_EQ(side.up, Vec3::UnitY()) << scan.name;
  }
}

TEST(ScannedSide, IsNeverTheHollowBackWhateverTheAttitude) {
  const double least_cosine = std::cos(26 * std::numbers::pi / 180);  // snaps to an axis within 25 degrees
  std::uint64_t seed = 0;
  for (const Scan& scan : one_sided_scans())
    for (int i = 0; i < 3; ++i) {
      const Mat3 turn = random_turn(++seed);
      const Side side = side_of(scan, turn, seed);
      EXPECT_GT(side.towards_viewer.dot(turn.col(2)), least_cosine) << scan.name << " " << seed;
      EXPECT_NEAR(side.towards_viewer.dot(side.up), 0, 1e-12);
    }
}

TEST(ScannedSide, FlatThingsAreSeenAtRightAngles) {
  const std::vector<Scan> scans = one_sided_scans();
  for (const std::size_t flat : {0, 3, 4, 6, 8}) {
    const Mat3 turn = random_turn(20 + flat);
    EXPECT_GT(side_of(scans[flat], turn, 1).towards_viewer.dot(turn.col(2)), .9998) << scans[flat].name;
  }
}

TEST(ScannedSide, BustsStandOnTheirBroadFoot) {
  const Scan scan{"bust", bust};
  for (int quarter = 0; quarter < 4; ++quarter) {
    const Mat3 turn = Eigen::AngleAxisd(quarter * std::numbers::pi / 2, Vec3::UnitZ()).toRotationMatrix();
    EXPECT_GT(side_of(scan, turn, 1).up.dot(turn.col(1)), .9999) << quarter;
  }
  const Mat3 turn = random_turn(12);
  EXPECT_GT(side_of(scan, turn, 1).up.dot(turn.col(1)), .95);
}

// Returns the side of the bust that a camera sees. The camera is at the origin, and the bust at the given
// distance. The rows of `to_camera` are the axes of the camera in the coordinates of the bust.
Side seen_by_camera(const Mat3& to_camera, double distance) {
  Cloud cloud = scanned({"bust", bust}, to_camera, 1);
  for (Vec3& p : cloud.points) p.z() += distance;
  estimate_normals(cloud);
  return scanned_side(cloud, NormalSigns::unknown).value();
}

TEST(ScannedSide, KnowsTheAxesOfCameras) {
  const Side z_away = seen_by_camera(Vec3(1, -1, -1).asDiagonal(), 3);
  EXPECT_EQ(z_away.towards_viewer, -Vec3::UnitZ());
  EXPECT_EQ(z_away.up, -Vec3::UnitY());
  const Side z_towards = seen_by_camera(Mat3::Identity(), -3);
  EXPECT_EQ(z_towards.towards_viewer, Vec3::UnitZ());
  EXPECT_EQ(z_towards.up, Vec3::UnitY());
}

TEST(ScannedSide, IsMissingForClosedModels) {
  EXPECT_FALSE(scanned_side(test::sphere(20'000, 1), NormalSigns::outward));
}

}  // namespace
}  // namespace relievo
