#include "plate/height_field.h"

#include "relievo/make_relief.h"
#include "support/plate_fronts.h"
#include "support/surfaces.h"
#include "support/triangles.h"

namespace relievo {
namespace {

using test::grid_front, test::plate_of;

// Expects that the field has the heights of the front above the front's lowest point, and 0 outside
// the front. The expected heights are computed by testing all triangles.
void expect_heights_of(const Solid& solid) {
  const HeightField field = measure_height_field(solid, {97});
  ASSERT_FALSE(field.z.empty());
  std::vector<Vec3> rounded = solid.points;
  for (Vec3& p : rounded) p = p.cast<float>().cast<double>();
  const auto front = std::span(solid.triangles).first(solid.front_triangles);
  for (int y = 0; y < field.z.height; ++y)
    for (int x = 0; x < field.z.width; ++x) {
      const double height = test::height_at(rounded, front, field.to_mm(x + .5, y + .5)) - field.box.min.z();
      ASSERT_NEAR(field.z.at(x, y), std::isnan(height) ? 0 : height, 2e-5) << x << ", " << y;
    }
}

double waves(double x, double y) {
  return 2 + std::sin(x) + std::sin(1.3 * y);
}

// Earlier versions smoothed flat bevels such as these, and the folds of the next test, by up to 0.7 mm.
TEST(HeightField, IsTheTrianglesHeightUnderEachCentre) {
  for (const auto& [name, outline] : outline_choices)
    for (const double bevel : {.1, .6, 2.}) {
      PlateOptions options{.outline = outline};
      if (outline != Outline::none) options.rim = {2, bevel == .1 ? -1. : 1., bevel};
      SCOPED_TRACE(testing::Message() << name << ", bevel " << bevel);
      expect_heights_of(plate_of(grid_front({20, 20, 20, 20}, waves), options));
    }
}

TEST(HeightField, IsTheTrianglesHeightOnBases) {
  for (const char* base : {"fold:angle=20", "fold:angle=15,direction=30", "wave:height=5,length=12",
                           "cylinder:diameter=60", "dome:height=4,hollow"}) {
    PlateOptions options{.base = parse_base(base).value()};
    for (const double tolerance : {0., .05}) {
      options.simplify_mm = tolerance;
      SCOPED_TRACE(base);
      expect_heights_of(plate_of(grid_front({20, 20, 20, 20}, waves), options));
    }
  }
}

TEST(HeightField, IsTheTrianglesHeightOfAllForms) {
  const ReliefModel model = test::prepared(test::torus(2500, 1.5, .4));
  for (const auto& [name, form] : form_choices)
    for (const double draft : {0., 20.}) {
      ReliefOptions options{{.width_mm = 20, .height_mm = .9, .rim_mm = 1.5, .resolution_mm = .3}};
      options.outline = Outline::circle;
      options.form = form;
      if (draft > 0) options.draft_deg = draft;
      if (draft > 0 && form == Form::lithophane) continue;
      SCOPED_TRACE(testing::Message() << name << ", draft " << draft);
      const Solid full = value_of(make_relief(model, options)).solid;
      expect_heights_of(full);
      options.triangles = .8 * static_cast<double>(full.triangles.size());
      expect_heights_of(value_of(make_relief(model, options)).solid);
    }
}

// The wall is so steep that rounding its corners to fractions of a pixel could move it to the wrong side
// of a pixel's centre. The field must not round corners so coarsely.
TEST(HeightField, TellsOnWhichSideOfAWallAPixelIs) {
  const auto wall = [](double x, double) { return x < 10 ? 3. : 0.; };
  HeightFieldMesh front = grid_front({20, 20, 20, 20}, wall);
  for (Vec3& p : front.points)
    if (p.x() == 9) p.x() = 10 - 1e-5;
  expect_heights_of(plate_of(front, {5}));
}

}  // namespace
}  // namespace relievo
