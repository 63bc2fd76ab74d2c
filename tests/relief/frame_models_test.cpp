// Tests frames of the generated samples. Also tests frames of real scans, if these are available.
#include "relievo/io/read.h"
#include "relievo/relief/frame.h"
#include "relievo/samples/sample.h"
#include "support/differences.h"
#include "support/shared_scans.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

const std::string sample_names[] = {"shell", "still_life", "green_man"};
const std::string scan_names[] = {"armadillo",     "bimba",
                                  "dragon",        "falcon",
                                  "gargoyle",      "gutenberg",
                                  "happy_buddha",  "happy_buddha_rawscans_front",
                                  "horse",         "igea",
                                  "lion_takanawa", "lion_takanawa_raw",
                                  "nefertiti",     "scene_menagerie_front",
                                  "squirrel"};

// Makes the cloud of a sample, or reads a scan. If the scan is missing, the test is skipped.
class FrameOfModel : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const std::string name = GetParam(), file = name + ".ply";
    if (std::ranges::find(sample_names, name) != std::end(sample_names))
      cloud_ = make_sample(name, {100000}).value();
    else if (test::has_shared(file))
      cloud_ = read_cloud(test::shared_bytes(file), name)->cloud;
    else
      GTEST_SKIP() << test::missing_scan(file);
  }

  Cloud cloud_;
};

// Frames are computed in single precision, exact reliefs in double precision.
TEST_P(FrameOfModel, AgreesWithTheExactReliefToAPartInAHundredThousand) {
  const ReliefModel model = test::prepared(cloud_);
  FrameMaker maker(model);
  Frame frame;
  for (const Shape& shape : {Shape{{.05, 0}, .04}, Shape{Compression::from_alpha(4, .01), .02}}) {
    FrameOptions options{.shape = shape};
    maker.make(options, frame);
    const Relief exact = model.make(shape);
    EXPECT_LT(test::largest_difference(frame.heights, exact.heights), 1e-5 * exact.height);
  }
}

// The locked heights are fractions of L_d. If a frame is lower than its locked height, it must report that
// the height is out of reach.
TEST_P(FrameOfModel, KeepsALockedHeight) {
  const ReliefModel model = test::prepared(cloud_);
  FrameMaker maker(model);
  Frame frame;
  FrameOptions options{Shape{}};
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

INSTANTIATE_TEST_SUITE_P(Samples, FrameOfModel, testing::ValuesIn(sample_names),
                         [](const auto& model) { return model.param; });
INSTANTIATE_TEST_SUITE_P(Models, FrameOfModel, testing::ValuesIn(scan_names),
                         [](const auto& model) { return model.param; });

}  // namespace
}  // namespace relievo
