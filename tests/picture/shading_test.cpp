#include "picture/shading.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace relievo {
namespace {

const Vec3f to_lamp = direction_of(upper_left_lamp);
constexpr std::array mirroring{Material::silver, Material::bronze, Material::walnut, Material::porcelain};

Shader shader_of(Material material) {
  return {material, to_lamp, Vec3f::UnitZ()};
}

Lit level_at(float x, float y) {
  Lit lit{Vec3f::UnitZ(), {1, 1}, Vec3f::Zero()};
  lit.from_middle = {x, y};
  return lit;
}

float brightness(Material material, const Lit& lit) {
  return shader_of(material).colour(lit).sum() / 3;
}

TEST(EnvironmentLight, IsBrightestWhereTheLampIs) {
  const EnvironmentLight environment(to_lamp);
  const float at_lamp = environment(to_lamp.head<2>());
  for (float x = -1; x <= 1; x += .125F)
    for (float y = -1; y <= 1; y += .125F) {
      const float light = environment({x, y});
      EXPECT_GT(light, 0);
      EXPECT_LE(light, at_lamp * 1.03F)
          << x << " " << y;  // some directions are a little brighter than that to the lamp
    }
}

TEST(EnvironmentLight, IsContinuous) {
  const EnvironmentLight environment(to_lamp);
  for (float x = -1; x <= .99F; x += .01F)
    EXPECT_NEAR(environment({x, .3F}), environment({x + .01F, .3F}), .1F) << x;
  EXPECT_EQ(environment({2, 0}), environment({1, 0}));
}

TEST(Shading, LevelGroundIsOfOneToneInPlasterAlone) {
  const Lit left = level_at(-.7F, .7F), middle = level_at(0, 0), right = level_at(.7F, -.7F);
  EXPECT_EQ(brightness(Material::plaster, left), brightness(Material::plaster, right));
  for (const Material material : {Material::silver, Material::bronze}) {
    EXPECT_GT(brightness(material, left), 1.1F * brightness(material, middle));
    EXPECT_GT(std::abs(brightness(material, right) / brightness(material, middle) - 1), .05F);
  }
  EXPECT_GT(brightness(Material::porcelain, middle), 1.1F * brightness(Material::porcelain, right));
}

TEST(Shading, HollowsKeepTheirPatinaAndStain) {
  for (const Material material : {Material::silver, Material::bronze, Material::walnut})
    for (float sky = .1F; sky <= .9F; sky += .1F) {
      Lit hollow = level_at(0, 0), open = hollow;
      hollow.light.sky = sky;
      open.light.sky = sky + .1F;
      EXPECT_LT(brightness(material, hollow), brightness(material, open)) << sky;
    }
}

TEST(Shading, NothingIsClippedOnLevelGround) {
  for (const Material material : mirroring)
    for (const float x : {-1.F, 0.F, 1.F})
      for (const float y : {-1.F, 0.F, 1.F}) {
        const Vec3f colour = shader_of(material).colour(level_at(x, y));
        EXPECT_LT(colour.maxCoeff(), 1.05F);
        EXPECT_GT(colour.minCoeff(), .01F);
      }
}

// The pattern of patina repeats every 64 mm, without a seam at the centre of the plate.
TEST(Shading, PatinaHasNoSeamInTheMiddle) {
  Lit place = level_at(0, 0), again = place;
  for (const float x : {-1.F, 0.F, 5.5F, -.95F, 5.47F}) {
    place.place = {x, 2, 0};
    again.place = {x - 64, 2 + 64, 0};
    EXPECT_NEAR(brightness(Material::bronze, place), brightness(Material::bronze, again), 1e-4);
  }
}

}  // namespace
}  // namespace relievo
