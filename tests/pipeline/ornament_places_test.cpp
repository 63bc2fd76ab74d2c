#include "relievo/ornament_places.h"

#include "relievo/make_relief.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

const ReliefModel& model() {
  static const ReliefModel made = value_of(prepare(test::sphere(3000, 1), View{}));
  return made;
}

Ornament text(TextArc arc) {
  return {.text = "LEX", .arc = arc, .size_mm = 3};
}

ReliefOptions coin(std::vector<Ornament> ornaments) {
  ReliefOptions options{{.width_mm = 40, .height_mm = 2, .margin_mm = 8, .rim_mm = 1.5, .resolution_mm = .8}};
  options.outline = Outline::circle;
  options.ornaments = std::move(ornaments);
  return options;
}

OrnamentPlace place_of(const ReliefOptions& options) {
  return value_of(ornament_places(model().surface(), options)).at(0);
}

void expect_near(const OrnamentPlace& a, const OrnamentPlace& b, double within) {
  ASSERT_EQ(a.outlines.size(), b.outlines.size());
  for (std::size_t i = 0; i < a.outlines.size(); ++i) {
    ASSERT_EQ(a.outlines[i].size(), b.outlines[i].size());
    for (std::size_t k = 0; k < a.outlines[i].size(); ++k)
      EXPECT_LT((a.outlines[i][k] - b.outlines[i][k]).norm(), within);
  }
}

// Expects that the corners of the ornaments' outlines are points of the solid.
void expect_in_solid(const ReliefOptions& options) {
  const Solid solid = value_of(make_relief(model(), options)).solid;
  const Vec2 middle = Box::of(solid.points).centre().head<2>();
  for (const OrnamentPlace& place : value_of(ornament_places(model().surface(), options)))
    for (const std::vector<Vec2>& outline : place.outlines)
      for (const Vec2& corner : outline) {
        double nearest = 1;
        for (const Vec3& p : solid.points)
          nearest = std::min(nearest, (p.head<2>() - middle - corner).norm());
        EXPECT_LT(nearest, 1e-4);
      }
}

TEST(OrnamentPlaces, AreThoseOfTheSolid) {
  Ornament line;
  line.kind = OrnamentKind::line;
  for (const Form form : {Form::relief, Form::mirror, Form::die}) {
    ReliefOptions options = coin({text(TextArc::top), text(TextArc::bottom), line});
    options.form = form;
    expect_in_solid(options);
  }
  ReliefOptions plaque = coin({text(TextArc::straight)});
  plaque.outline = Outline::rectangle;
  plaque.rim_mm.reset();
  expect_in_solid(plaque);
}

TEST(OrnamentPlaces, TellWhereAStraightTextLies) {
  for (const Form form : {Form::relief, Form::mirror}) {
    ReliefOptions options = coin({text(TextArc::straight)});
    options.outline = Outline::rectangle;
    options.form = form;
    const OrnamentPlace usual = place_of(options);
    ASSERT_TRUE(usual.at_mm);
    options.ornaments[0].at_mm = usual.at_mm;
    expect_near(place_of(options), usual, 1e-9);
  }
  EXPECT_FALSE(place_of(coin({text(TextArc::top)})).at_mm);
}

TEST(OrnamentPlaces, TurnWithTheAngleOfAnArc) {
  ReliefOptions options = coin({text(TextArc::top)});
  OrnamentPlace turned = place_of(options);
  for (std::vector<Vec2>& outline : turned.outlines)
    for (Vec2& p : outline) p = Eigen::Rotation2D<double>(std::numbers::pi / 6) * p;
  options.ornaments[0].angle_deg = 120;
  expect_near(place_of(options), turned, 1e-6);
}

TEST(OrnamentPlaces, HaveErrorsOfTheirOwn) {
  Ornament missing = text(TextArc::top);
  missing.text = "\u6F22";
  const auto places = value_of(ornament_places(model().surface(), coin({missing, text(TextArc::bottom)})));
  ASSERT_EQ(places.size(), 2U);
  ASSERT_TRUE(places[0].error);
  EXPECT_EQ(places[0].error->input, "text");
  EXPECT_FALSE(places[1].error);
  EXPECT_EQ(places[1].outlines.size(), 3U);
}

}  // namespace
}  // namespace relievo
