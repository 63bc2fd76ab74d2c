// Frames of every model at hand: the generated samples, and real scans where there are any.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "relievo/io.h"
#include "relievo/relief/frame.h"
#include "relievo/samples/sample.h"

namespace relievo {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> models() {
  std::vector<std::string> names = {"shell", "still_life", "green_man"};
  if (fs::is_directory(RELIEVO_SHARED_DATA))
    for (const fs::directory_entry& entry : fs::directory_iterator(RELIEVO_SHARED_DATA))
      if (entry.path().extension() == ".ply") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Cloud cloud_of(const std::string& name) {
  std::ifstream file(fs::path(RELIEVO_SHARED_DATA) / (name + ".ply"), std::ios::binary);
  if (!file) return make_sample(name, {100000}).value();
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return read_cloud(std::as_bytes(std::span(text)), name)->cloud;
}

class FrameOfModel : public testing::TestWithParam<std::string> {};

// Single precision against double.
TEST_P(FrameOfModel, AgreesWithTheExactReliefToAPartInAHundredThousand) {
  const ReliefModel model = ReliefModel::prepare(find_surface(cloud_of(GetParam()), {}).value()).value();
  FrameMaker maker(model);
  Frame frame;
  for (const Shape& shape : {Shape{{.05, 0}, .04}, Shape{Compression::from_alpha(4, .01), .02}}) {
    FrameOptions options;
    options.shape = shape;
    maker.make(options, frame);
    const Relief exact = model.make(shape);
    double worst = 0;
    for (std::size_t i = 0; i < exact.heights.size(); ++i)
      worst = std::max(worst, std::abs(static_cast<double>(frame.heights[i]) - exact.heights[i]));
    EXPECT_LT(worst, 1e-5 * exact.height);
  }
}

// Heights in shares of L_d by saturations, as a slider goes through them. Heights out of reach are told.
TEST_P(FrameOfModel, KeepsALockedHeight) {
  const ReliefModel model = ReliefModel::prepare(find_surface(cloud_of(GetParam()), {}).value()).value();
  FrameMaker maker(model);
  Frame frame;
  FrameOptions options;
  int met = 0;
  for (const double share : {.2, .1, .05, .025, .0125})
    for (const double beta : {0.0, .01, 1.0}) {
      options.height = share * model.surface().diagonal;
      options.shape = {{1, beta}, .04};
      maker.make(options, frame);
      met += frame.is_height_met;
      if (frame.is_height_met)
        ASSERT_NEAR(frame.height / *options.height, 1, 1e-3) << share << ' ' << beta;
      else
        ASSERT_LT(frame.height, *options.height) << share << ' ' << beta;
    }
  EXPECT_GE(met, 6);
}

INSTANTIATE_TEST_SUITE_P(Models, FrameOfModel, testing::ValuesIn(models()),
                         [](const auto& model) { return model.param; });

}  // namespace
}  // namespace relievo
