#include "core/srgb.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

TEST(Srgb, LuminanceIsThatOfTheStandard) {
  EXPECT_NEAR(luminance({255, 255, 255}), 1, 1e-12);
  EXPECT_EQ(luminance({0, 0, 0}), 0);
  EXPECT_NEAR(luminance({255, 0, 0}), .2126, 1e-12);
  EXPECT_NEAR(luminance({188, 188, 188}), .5029, 1e-4);
}

TEST(Srgb, LightnessIsThatOfTheStandard) {
  EXPECT_NEAR(lightness({255, 255, 255}), 1, 1e-12);
  EXPECT_EQ(lightness({0, 0, 0}), 0);
  EXPECT_NEAR(lightness({119, 119, 119}), .5003, 1e-4);
  EXPECT_NEAR(lightness({255, 0, 0}), .5324, 1e-4);
  EXPECT_NEAR(lightness({10, 10, 10}), .0274, 1e-4);
}

}  // namespace
}  // namespace relievo
