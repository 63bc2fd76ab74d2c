// Draws depth pictures of clouds in many conventions. Compares the reliefs of these pictures with the reliefs of the
// clouds.
#include <map>

#include "relievo/io/read.h"
#include "relievo/make_relief.h"
#include "relievo/picture/height_map.h"
#include "relievo/samples/sample.h"
#include "support/depth_renderer.h"
#include "support/picture_similarity.h"
#include "support/results.h"
#include "support/shared_scans.h"

namespace relievo {
namespace {

using test::BesideFigure, test::DepthStorage, test::PictureCamera;

constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

MadeRelief relief_of(Cloud cloud) {
  ReliefOptions options{{.width_mm = 80, .height_mm = 4, .resolution_mm = .25}};
  return value_of(make_relief(std::move(cloud), options));
}

// Returns the heights of a relief, in mm, at the centres of the pixels of the picture that the relief was
// made from.
Image<double> heights_mm(const MadeRelief& made, int side) {
  constexpr double mm_per_pixel = .2;
  const HeightsMm map = make_heights_mm(made.solid, {.mm_per_pixel = mm_per_pixel, .zero = MapZero::ground});
  const Vec3 centre = Box::of(made.solid.points).centre();
  Image<double> heights = filled_image(side, side, 0.);
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c) {
      const Vec3 pixel(c - (side - 1) / 2., (side - 1) / 2. - r, 0);
      const Vec3 p = (made.report.scale * pixel + made.report.offset - centre) / mm_per_pixel;
      const double x = map.image.width / 2. + p.x() - .5, y = map.image.height / 2. - p.y() - .5;
      const int left = static_cast<int>(std::floor(x)), upper = static_cast<int>(std::floor(y));
      if (!map.image.contains(left, upper) || !map.image.contains(left + 1, upper + 1)) continue;
      const auto along = [&](int row) {
        return std::lerp(double{map.image.at(left, row)}, double{map.image.at(left + 1, row)}, x - left);
      };
      heights.at(c, r) = std::lerp(along(upper), along(upper + 1), y - upper);
    }
  return heights;
}

// Returns a picture of the relief under a lamp. Its resolution is half that of the depth picture, because the
// depth picture has no details smaller than two pixels.
Image8 shading_of(const MadeRelief& made, int side) {
  const Image<double> heights = heights_mm(made, side);
  const Vec3 lamp = Vec3(-1, 1, 1.5).normalized();
  Image8 shading = filled_image(side / 2 - 1, side / 2 - 1, std::uint8_t{255}, 4);
  for (int r = 0; r < shading.height; ++r)
    for (int c = 0; c < shading.width; ++c) {
      double sum = 0;
      for (int y = 2 * r + 1; y < 2 * r + 3; ++y)
        for (int x = 2 * c + 1; x < 2 * c + 3; ++x) {
          const double right = heights.at(x + 1, y) - heights.at(x - 1, y),
                       up = heights.at(x, y - 1) - heights.at(x, y + 1);
          sum += std::max(0., Vec3(-right, -up, 2 * made.report.scale).normalized().dot(lamp));
        }
      std::fill_n(&shading.at(c, r), 3, static_cast<std::uint8_t>(std::lround(255 * sum / 4)));
    }
  return shading;
}

// The heights of a cloud as a camera's picture shows them, and the relief of the cloud itself.
struct Figure {
  Image<double> heights;
  double range_px = 0;
  Image8 shading;
  double exact_similarity = 0;  // similarity of the reliefs of cloud and exact heights

  double similarity_of(Cloud read) const {
    return test::structural_similarity(shading_of(relief_of(std::move(read)), heights.width), shading);
  }
};

Figure figure_of(const Cloud& cloud, const PictureCamera& camera) {
  Cloud drawn = test::in_picture(cloud, camera), exact;
  Figure figure{test::heights_in_picture(drawn, camera.side), 0, {}};
  for (int r = 0; r < camera.side; ++r)
    for (int c = 0; c < camera.side; ++c)
      if (const double z = figure.heights.at(c, r); z != test::no_figure)
        exact.points.emplace_back(c - (camera.side - 1) / 2., (camera.side - 1) / 2. - r, z);
  exact.is_height_field = true;
  figure.range_px = Box::of(exact.points).size().z();
  figure.shading = shading_of(relief_of(std::move(drawn)), camera.side);
  figure.exact_similarity = figure.similarity_of(std::move(exact));
  return figure;
}

struct Judgement {
  double share_used = 0;  // share of the figure's pixels that are used
  int farthest_px = 0;    // largest distance of a used pixel from the figure, or the reverse
  int crumbs = 0;         // number of used parts below 0.5 %, minus number of such parts of the figure
  double similarity = 0;  // between the relief of the read picture and that of the cloud
};

Judgement judge(const Figure& figure, const DepthStorage& how, const BesideFigure& beside) {
  DepthOptions options{.values = how.kind};
  const int side = figure.heights.width;
  options.range = figure.range_px / side;
  if (how.is_pinhole && how.kind == DepthValues::depth) {
    options.camera = PictureCamera{side, true}.as_depth_camera();
    if (beside.wall_m > 0) options.background = Removal::drop;  // the default with a camera keeps walls
  }
  DepthCloud read = value_of(depth_cloud(test::depth_picture(figure.heights, how, beside), options));
  test::Mask drawn = filled_image(side, side, std::uint8_t{0}), used = drawn;
  double count = 0, both = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    drawn[i] = figure.heights[i] != test::no_figure, used[i] = read.uses[i] == PixelUse::kept;
    count += drawn[i], both += drawn[i] && used[i];
  }
  return {both / count, std::max(test::farthest_px(drawn, used), test::farthest_px(used, drawn)),
          test::count_crumbs(used) - test::count_crumbs(drawn), figure.similarity_of(std::move(read.cloud))};
}

std::vector<DepthStorage> storages() {
  using enum DepthValues;
  const auto metres = [](double d) { return d; };
  const auto whole = [](double factor, double most) {
    return [=](double d) { return std::min(most, std::round(factor * d)); };
  };
  return {{"metres", depth, 0, metres},
          {"disparity of 16 bits", inverse, 1, [](double d) { return std::round(3e4 / d); }, true},
          {"8 bits", depth, 1, whole(100, 255)},
          {"millimetres of a pinhole camera", depth, 1, whole(1000, 65535), true},
          {"millimetres", depth, 1, whole(1000, 65535)},
          {"inverse", inverse, 0, [](double d) { return 1 / d; }, true},
          {"metres of a pinhole camera", depth, 0, metres, true},
          {"disparity of 8 bits", inverse, 1, [](double d) { return std::round(200 / d); }, true}};
}

// Returns values that can mark missing depths in a picture of this storage.
std::vector<float> markers_of(const DepthStorage& how) {
  const float most = how.name.contains("8 bits") ? 255.F : 65535.F;
  if (how.step > 0) return {0, most, nan};  // NaN stands for transparent pixels
  return how.kind == DepthValues::depth ? std::vector<float>{0, inf, nan, 1e10F} : std::vector<float>{0, nan};
}

// Makes pictures of a cloud, and judges how they are read. The pictures are numbered from `first`. The
// number of a picture determines its storage, wall and marker.
void judge_pictures(const Cloud& cloud, int side, int first, int count) {
  std::map<bool, Figure> figures;
  for (int i = first; i < first + count; ++i) {
    const auto number = static_cast<std::size_t>(i);
    const DepthStorage how = storages()[number % storages().size()];
    const double wall_m = std::array{0., 1., 5., 0., 50.}[number % 5];
    const std::vector<float> markers = markers_of(how);
    const BesideFigure beside{wall_m, markers[number / 5 % markers.size()]};
    if (!figures.contains(how.is_pinhole)) figures[how.is_pinhole] = figure_of(cloud, {side, how.is_pinhole});
    const Figure& figure = figures[how.is_pinhole];
    const Judgement found = judge(figure, how, beside);
    SCOPED_TRACE(cat(i, ": ", how.name, ", wall ", wall_m, " m, missing ", beside.missing));
    EXPECT_GE(found.share_used, .98);
    EXPECT_LE(found.farthest_px, 2);
    EXPECT_LE(found.crumbs, 0);
    // Pictures of 8 bits lose details that are lower than a step.
    const double lost = how.name.contains("8 bits") ? .16 : .03;
    EXPECT_GT(found.similarity, std::min(.9, figure.exact_similarity) - lost);
  }
}

TEST(DepthPictures, OfSamplesBecomeTheReliefsOfTheirClouds) {
  int first = 0;
  for (const std::string_view name : {"green_man", "shell"}) {
    SCOPED_TRACE(name);
    judge_pictures(value_of(make_sample(name, {150000, 0})), 200, first, 6);
    first += 6;
  }
}

TEST(DepthPictures, OfScansBecomeTheReliefsOfTheirClouds) {
  int first = 0;
  for (const std::string name : {"armadillo", "igea", "dragon", "gargoyle", "bimba", "gutenberg", "horse",
                                 "falcon", "nefertiti", "squirrel"}) {
    const std::string file = name + ".ply";
    if (!test::has_shared(file)) GTEST_SKIP() << test::missing_scan(file);
    SCOPED_TRACE(name);
    judge_pictures(value_of(read_cloud(test::shared_bytes(file), file)).cloud, 200, first, 4);
    first += 4;
  }
}

}  // namespace
}  // namespace relievo
