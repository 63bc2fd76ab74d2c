#include "relievo/scene.h"

#include <rapidcheck.h>

#include "relievo/core/parallel.h"
#include "relievo/scan/spacing.h"
#include "relievo/scan/surface.h"
#include "support/scene_parts.h"

namespace relievo {
namespace {

using namespace test;

TEST(PlaceModels, TurnsScalesAndMirrorsAboutTheMiddleOfTheBox) {
  const Vec3 middle(1.5, 1, .5);
  const auto image = [&](const Pose& pose, const Vec3& from_middle) {
    return Vec3(placed({{model_of(wedge(), pose)}})[0](middle + from_middle) - middle);
  };
  const double tiny = 1e-12;
  EXPECT_TRUE(image({}, {1, 2, 3}).isApprox(Vec3(1, 2, 3), tiny));
  EXPECT_TRUE(image({{0, 0, 90}}, {1, 0, 3}).isApprox(Vec3(0, 1, 3), tiny));
  EXPECT_TRUE(image({{0, 90, 0}}, {0, 2, 1}).isApprox(Vec3(1, 2, 0), tiny));
  EXPECT_TRUE(image({{90, 0, 0}}, {1, 1, 0}).isApprox(Vec3(1, 0, 1), tiny));
  // The rotation about x comes first and maps y to z. The rotation about z then leaves z unchanged.
  EXPECT_TRUE(image({{90, 0, 90}}, {1, 1, 0}).isApprox(Vec3(0, 1, 1), tiny));
  EXPECT_TRUE(image({Vec3::Zero(), Vec3(10, 20, 30), 2}, {1, 2, 3}).isApprox(Vec3(12, 24, 36), tiny));
  // Mirroring comes before the rotation: it maps x to -x, and the rotation maps -x to -y.
  EXPECT_TRUE(image({{0, 0, 90}, {}, 1, true}, {1, 0, 3}).isApprox(Vec3(0, -1, 3), tiny));
}

TEST(PlaceModels, StraysDoNotMoveTheMiddle) {
  Cloud cloud = test::sphere(1000, 1);
  const auto clean = placed({{model_of(cloud, {{0, 90, 0}})}})[0].offset;
  test::add(cloud, {1e4, 0, 0}, {1, 0, 0});
  EXPECT_EQ(placed({{model_of(cloud, {{0, 90, 0}})}})[0].offset, clean);
}

TEST(PlaceModels, FilesOfOneFrameFitTogether) {
  const std::vector<PlacedModel> places =
      placed({{model_of(wedge(), at(0, 0, 0)), model_of(test::sphere(100, 5))}});
  for (const PlacedModel& place : places) EXPECT_EQ(place(Vec3(1, 2, 3)), Vec3(1, 2, 3));
}

Cloud box_corners(const Vec3& size, const Vec3& from) {
  Cloud cloud;
  for (int i = 0; i < 8; ++i)
    test::add(cloud, from + Vec3(i & 1, i >> 1 & 1, i >> 2 & 1).cwiseProduct(size), Vec3::UnitZ());
  return cloud;
}

Box box_in_view(const SceneModel& model, const PlacedModel& place, const View& view) {
  Box box;
  for (const Vec3& p : model.file->cloud.points) box.extend(view.R_view_model * place(p));
  return box;
}

TEST(PlaceModels, ARowIsDisjointGroundedAndInOrderInEveryView) {
  ASSERT_TRUE(rc::check([] {
    const auto number = [](int low, int high) { return *rc::gen::inRange(low, high) / 10.0; };
    const View view = *view_towards({number(-50, 50), number(-50, 50), number(1, 50)});
    Scene scene;
    const int models = *rc::gen::inRange(2, 6);
    for (int i = 0; i < models; ++i) {
      const Cloud cloud = box_corners({number(1, 300), number(1, 300), number(1, 300)},
                                      {number(-900, 900), number(-900, 900), number(-900, 900)});
      scene.models.push_back(model_of(cloud, {{number(0, 3600), number(0, 3600), number(0, 3600)}}));
    }
    const std::vector<PlacedModel> places = *place_models(scene, view);
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < places.size(); ++i)
      boxes.push_back(box_in_view(scene.models[i], places[i], view));
    RC_ASSERT(std::abs(places[0].scale - 1) < 1e-12);
    const double height = std::max(boxes[0].size().y(), boxes[0].size().x() / 1.5),
                 tiny = 1e-9 * (900 + height);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      RC_ASSERT(std::abs(boxes[i].min.y() - boxes[0].min.y()) < tiny);
      RC_ASSERT(std::abs(boxes[i].centre().z() - boxes[0].centre().z()) < tiny);
      const bool is_as_high = std::abs(boxes[i].size().y() - height) < tiny;
      const bool is_as_wide = std::abs(boxes[i].size().x() - 1.5 * height) < tiny;
      RC_ASSERT(is_as_high || is_as_wide);
      RC_ASSERT(boxes[i].size().y() < height + tiny && boxes[i].size().x() < 1.5 * height + tiny);
      if (i > 0) RC_ASSERT(std::abs(boxes[i].min.x() - boxes[i - 1].max.x() - .08 * height) < tiny);
    }
  }));
}

TEST(PlaceModels, InARowTheScaleIsOnTopOfTheCommonHeight) {
  const Scene scene{
      {model_of(test::sphere(500, 2)), model_of(test::sphere(500, 30), {Vec3::Zero(), {}, .5})}};
  const std::vector<PlacedModel> places = placed(scene);
  EXPECT_NEAR(box_in_view(scene.models[1], places[1], front).size().y(),
              .5 * box_in_view(scene.models[0], places[0], front).size().y(), 1e-9);
}

TEST(PlaceModels, TheFirstOfARowKeepsItsPlace) {
  const std::vector<PlacedModel> places =
      placed({{model_of(moved(test::sphere(500, 2), {1e6, 2e6, 50})), model_of(wedge())}});
  EXPECT_TRUE(places[0](Vec3(1e6, 2e6, 50)).isApprox(Vec3(1e6, 2e6, 50), 1e-14));
}

TEST(PlaceModels, RefusesWhatIsNoPlace) {
  const auto message = [](const Pose& pose) {
    return message_of(place_models({{model_of(wedge(), pose)}}, front));
  };
  EXPECT_EQ(message({Vec3::Zero(), {}, 0}), "mesh: expected a scale from 1e-06 to 1e+06, found 0");
  EXPECT_NE(message({Vec3::Zero(), {}, std::nan("")}), "no error");
  EXPECT_NE(message({{0, std::nan(""), 0}}), "no error");
  EXPECT_NE(message(at(0, HUGE_VAL, 0)), "no error");
  EXPECT_FALSE(place_models({}, front));
}

}  // namespace
}  // namespace relievo
