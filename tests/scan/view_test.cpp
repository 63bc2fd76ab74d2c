#include "relievo/scan/view.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/shapes.h"

namespace relievo {
namespace {

// Returns the direction `axis` of the model in the coordinates of a view.
Vec3 seen(std::string_view view, const Vec3& axis, std::string_view up = {}) {
  return parse_view(view, up)->R_view_model * axis;
}

TEST(View, FrontLooksAlongMinusZWithYUp) {
  EXPECT_EQ(parse_view("front")->R_view_model, Mat3(Mat3::Identity()));
}

TEST(View, NamedSidesFaceTheViewerUpright) {
  EXPECT_TRUE(seen("back", -Vec3::UnitZ()).isApprox(Vec3::UnitZ()));
  EXPECT_TRUE(seen("back", Vec3::UnitY()).isApprox(Vec3::UnitY()));
  EXPECT_TRUE(seen("right", Vec3::UnitX()).isApprox(Vec3::UnitZ()));
  EXPECT_TRUE(seen("right", -Vec3::UnitZ()).isApprox(Vec3::UnitX()));
  EXPECT_TRUE(seen("left", -Vec3::UnitX()).isApprox(Vec3::UnitZ()));
  EXPECT_TRUE(seen("top", Vec3::UnitY()).isApprox(Vec3::UnitZ()));
  EXPECT_TRUE(seen("top", -Vec3::UnitZ()).isApprox(Vec3::UnitY()));
  EXPECT_TRUE(seen("bottom", -Vec3::UnitY()).isApprox(Vec3::UnitZ()));
}

TEST(View, TakesADirectionAndAnUp) {
  EXPECT_TRUE(seen("0,-2,0", -Vec3::UnitY(), "0,0,1").isApprox(Vec3::UnitZ()));
  EXPECT_TRUE(seen("0,-2,0", Vec3::UnitZ(), "0,0,1").isApprox(Vec3::UnitY()));
  EXPECT_TRUE(seen("1,1,1", Vec3(1, 1, 1)).isApprox(Vec3(0, 0, std::sqrt(3))));
}

TEST(View, RotationsAreProper) {
  for (const char* text :
       {"front", "back", "left", "right", "top", "bottom", "0,1,0", "0,-1,0", "1e-3,5,2", "3,-1,.2"}) {
    const Mat3 R = parse_view(text)->R_view_model;
    EXPECT_TRUE((R * R.transpose()).isIdentity(1e-12)) << text;
    EXPECT_NEAR(R.determinant(), 1, 1e-12) << text;
  }
}

TEST(View, TakesDirectionsOfAnyLength) {
  for (const Vec3& up : {Vec3(0, 1e9, 0), Vec3(0, 1e-9, 0), Vec3(1e9, 1e9, 0)}) {
    const Mat3 R = view_towards(Vec3::UnitY(), up)->R_view_model;
    EXPECT_TRUE((R * R.transpose()).isIdentity(1e-12)) << up;
  }
}

TEST(View, RefusesWhatIsNoDirection) {
  for (const char* text : {"", "up", "1,2", "1,2,3,4", "0,0,0", "a,b,c", "1,2,nan", "1e999,0,0", "1, 2, 3"})
    EXPECT_FALSE(parse_view(text)) << text;
  EXPECT_FALSE(parse_view("front", "sideways"));
  EXPECT_FALSE(parse_view("front", "0,0,0"));
  EXPECT_FALSE(parse_view("front", "0,0,2"));
  EXPECT_FALSE(parse_view("1,2,3", "-1,-2,-3"));
  EXPECT_EQ(parse_view("up").error().kind, ErrorKind::option);
}

TEST(View, TheBestSideIsChosenLaterAndTakesNoUp) {
  EXPECT_TRUE(parse_view("auto")->is_best);
  EXPECT_FALSE(parse_view("front")->is_best);
  EXPECT_EQ(parse_view("auto", "0,0,1").error().input, "up");
}

TEST(View, TurnsPointsAboutTheBoxCentreAndNormalsWithThem) {
  const Cloud cloud{{Vec3(1e6, 5, 0), Vec3(1e6 + 2, 5, 0)}, {Vec3f::UnitX(), Vec3f::UnitZ()}};
  const Cloud seen_cloud = in_view(cloud, *parse_view("right"));
  EXPECT_TRUE(seen_cloud.points[1].isApprox(Vec3(0, 0, 1)));
  EXPECT_TRUE(seen_cloud.normals[0].isApprox(Vec3f::UnitZ()));
}

TEST(Crop, IsFourOrSixAscendingShares) {
  EXPECT_EQ(*parse_crop(""), Crop{});
  EXPECT_EQ(*parse_crop("0,0,1,1"), Crop{});
  const Crop part = *parse_crop(".1,0.2,.7,1,.25,.5");
  EXPECT_EQ(part, (Crop{{.1, .2}, {.7, 1}, .25, .5}));
  for (const char* wrong : {"0,0,1", "0,0,1,1,0", "0,0,1,1.1", "-1,0,1,1", "1,0,1,1", "0,.6,1,.5",
                            "0,0,1,1,1,0", "0,0,1,1,", "a,0,1,1", "nan,0,1,1"}) {
    ASSERT_FALSE(parse_crop(wrong)) << wrong;
    EXPECT_EQ(parse_crop(wrong).error().input, "crop");
  }
}

TEST(Denoise, IsAutoOrANumberUpToOne) {
  EXPECT_EQ(*parse_denoise("auto"), std::nullopt);
  EXPECT_EQ(*parse_denoise("0"), 0);
  EXPECT_EQ(*parse_denoise(".25"), .25);
  EXPECT_EQ(*parse_denoise("1"), 1);
  for (const char* wrong : {"", "yes", "-0.1", "1.1", "nan", "inf", "0.1,0.2", "0.1x"}) {
    ASSERT_FALSE(parse_denoise(wrong)) << wrong;
    EXPECT_EQ(parse_denoise(wrong).error().kind, ErrorKind::option);
  }
}

TEST(Crop, KeepsThePointsInsideInTheirOrder) {
  const Cloud cloud = test::sphere(2000, 1);
  View view = *parse_view("right");  // the view along -X; -Z is to the right
  view.crop = *parse_crop("0,.5,1,1,0,.25");
  const Cloud part = cropped(cloud, view);
  std::vector<Vec3> expected;
  for (const Vec3& p : cloud.points)
    if (p.y() >= 0 && p.x() >= .5) expected.push_back(p);
  EXPECT_NEAR(static_cast<double>(part.size()), static_cast<double>(expected.size()),
              5);  // the points' bounding box is slightly smaller than the sphere's
  EXPECT_EQ(part.normals.size(), part.size());
  for (const Vec3& p : part.points) EXPECT_GT(std::min(p.y(), p.x() - .5), -.01);
  view.crop = {};
  EXPECT_EQ(cropped(cloud, view).points, cloud.points);
}

}  // namespace
}  // namespace relievo
