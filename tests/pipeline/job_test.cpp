// Tests a job and its live model. They must make the same solids, frames and pictures as the functions that they call.
#include "relievo/job.h"

#include <gtest/gtest.h>

#include "relievo/io/write.h"
#include "relievo/relief/relief.h"
#include "relievo/samples/sample.h"

namespace relievo {
namespace {

Job job() {
  Job made = *load(write_ply(*make_sample("still_life", {.points = 8000})), "scan.ply");
  made.options.view.is_best = true;
  made.options.height_mm = 2;
  return made;
}

TEST(Job, IsMadeAsInOneCall) {
  const Job wanted = job();
  const auto model = prepare(wanted);
  ASSERT_TRUE(model) << model.error().message();
  const auto relief = model->relief(wanted.options), whole = make_relief(wanted.inputs, wanted.options);
  ASSERT_TRUE(relief && whole);
  EXPECT_EQ(write_stl(relief->solid), write_stl(whole->solid));
  EXPECT_EQ(relief->report.sample, whole->report.sample);
}

TEST(Job, NamesTheScanThatItCannotRead) {
  EXPECT_EQ(load({}, "scan.ply").error().input, "scan.ply");
}

TEST(Job, SaysWhatOfTheScanIsLeftOut) {
  const std::string scan = "0 0 0\n1 0 0\nnan 0 0\n0 1 0\n1 1 0\n";
  const Job made = *load(std::as_bytes(std::span(scan)), "scan.xyz");
  EXPECT_EQ(made.inputs.models[0].remarks,
            (std::vector<std::string>{"scan.xyz: left out 1 points with coordinates that are not finite"}));
  EXPECT_TRUE(job().inputs.models[0].remarks.empty());
}

TEST(LiveModel, MakesTheFramesOfAFrameMaker) {
  LiveModel live = *prepare(job());
  ReliefOptions options{{.height_mm = 2}};
  options.tone = *parse_tone_curve("0,0.1;0.5,0.6;1,0.3");
  const LiveFrame made = *live.frame(options);
  Frame frame;
  FrameMaker(live.model()).make({shape_of(options), 2 / live.mm_per_unit(options)}, frame);
  EXPECT_EQ(made.frame->heights, frame.heights);
  EXPECT_TRUE(made.is_new);
  EXPECT_FALSE(live.frame(options)->is_new);
}

TEST(LiveModel, StretchesQuickFramesToTheirHeight) {
  LiveModel live = *prepare(job());
  ReliefOptions options;
  for (const double height : {1., 1.1, 1.4, .7}) {
    options.height_mm = height;
    const LiveFrame made = live.make_frame(options, {std::nullopt, true});
    EXPECT_NEAR(made.frame->height * made.stretch * made.mm_per_unit, height, 1e-9);
    EXPECT_NEAR(made.stretch, 1, .031);
  }
  EXPECT_GT(live.highest_mm(options), 1.4);
}

TEST(LiveModel, KnowsTheWidthThatAPlateLeaves) {
  LiveModel live = *prepare(job());
  ReliefOptions options;
  options.outline = Outline::circle;
  for (const double diameter : {40., 40., 70.}) {
    options.diameter_mm = diameter;
    EXPECT_EQ(live.with_width(options)->width_mm, with_width(live.model().surface(), options)->width_mm);
    EXPECT_EQ(live.most_width_mm(), live.with_width(options)->width_mm);
  }
  options.width_mm = 100;
  EXPECT_EQ(live.with_width(options).error().message(),
            with_width(live.model().surface(), options).error().message());
}

TEST(LiveModel, FramesOnAPlateAreAsHighAsTheSolidWhereNoHeightIsGiven) {
  LiveModel live = *prepare(job());
  ReliefOptions options{{.diameter_mm = 40}};
  options.outline = Outline::circle;
  const LiveFrame made = *live.frame(options);
  EXPECT_NEAR(made.frame->height * made.stretch * made.mm_per_unit, live.relief(options)->report.height_mm,
              1e-4);
}

TEST(LiveModel, DrawsAndRefuses) {
  LiveModel live = *prepare(job());
  RenderOptions render{.width = 80};
  const auto picture = live.picture({}, render);
  ASSERT_TRUE(picture) << picture.error().message();
  EXPECT_EQ(picture->image.width, 80);
  render.camera.zoom = 0;
  EXPECT_EQ(live.picture({}, render).error().input, "zoom");
  ReliefOptions options;
  options.method = Method::linear;
  EXPECT_EQ(live.frame(options).error().input, "method");
}

}  // namespace
}  // namespace relievo
