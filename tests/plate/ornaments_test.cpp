#include "geometry/plane.h"
#include "plate/plate_surface.h"
#include "support/admesh.h"
#include "support/plate_fronts.h"
#include "support/self_intersections.h"

namespace relievo {
namespace {

Ornament ornament(OrnamentKind kind) {
  return {.kind = kind};
}

using test::ellipse, test::plate_of, test::pyramid_front;

constexpr double margin = 5, thickness = 3, rim_height = 1;

HeightFieldMesh figure() {
  return pyramid_front(ellipse(40, 12, 10), .5);
}

PlateOptions coin(std::vector<Ornament> ornaments) {
  PlateOptions options{margin, thickness, Outline::circle};
  options.rim = {2, rim_height, .3};
  options.ornaments = std::move(ornaments);
  return options;
}

Ornament legend(const std::string& text, TextArc arc = TextArc::top) {
  return {.text = text, .arc = arc};
}

// Returns the steepest slope of the front's triangles. The slope of the rim is 3.33.
double steepest(const Solid& solid) {
  double most = 0;
  for (std::size_t t = 0; t < solid.front_triangles; ++t) {
    const auto& [a, b, c] = solid.triangles[t];
    const Vec3 u = solid.points[b] - solid.points[a], v = solid.points[c] - solid.points[a], n = u.cross(v);
    most = std::max(most, n.head<2>().norm() / n.z());
  }
  return most;
}

TEST(Ornaments, MakeAClosedSolidWithLettersOfTheirHeight) {
  for (const TextArc arc : {TextArc::top, TextArc::bottom, TextArc::around}) {
    Ornament text = legend("LIBERTAS & 1848", arc);
    text.height_mm = 1.2;
    const Solid solid = plate_of(figure(), coin({text}));
    EXPECT_EQ(test::complaint_of_admesh(solid), "");
    EXPECT_NEAR(test::used_box(solid).max.z(), thickness + 1.2, 1e-9);
    EXPECT_EQ(solid.ornaments.highest_mm, 1.2);
    EXPECT_LT(steepest(solid), 1.003 * coin({}).ornament_slope);
  }
}

TEST(Ornaments, AddTheVolumeOfTheirShapes) {
  // A square of side 4 mm with walls of slope 2 and height 0.5 mm is a frustum.
  Ornament square = ornament(OrnamentKind::drawing);
  square.outlines = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  square.size_mm = 4;
  square.height_mm = .5;
  square.at_mm = Vec2(0, -14.5);
  PlateOptions options = coin({square});
  options.ornament_slope = 2;
  const double low = 16, high = 3.5 * 3.5;
  const double frustum = .5 / 3 * (low + high + std::sqrt(low * high));
  const double without = volume_mm3(plate_of(figure(), coin({})));
  EXPECT_NEAR(volume_mm3(plate_of(figure(), options)) - without, frustum, 1e-4);
  // A sunk drawing removes the volume that a raised one adds, and the plate is thicker by the drawing's depth.
  options.ornaments[0].height_mm = -.5;
  const Solid sunk = plate_of(figure(), options);
  const Solid plain = plate_of(figure(), coin({}));
  const double area = (volume_mm3(plate_of(figure(),
                                           [] {
                                             PlateOptions thick = coin({});
                                             thick.thickness_mm += .5;
                                             return thick;
                                           }())) -
                       volume_mm3(plain)) /
                      .5;
  EXPECT_NEAR(volume_mm3(sunk), without + .5 * area - frustum, 1e-3);
}

TEST(Ornaments, LeaveTheReliefAndTheRimAsTheyWere) {
  const HeightFieldMesh front = figure();
  const Solid plain = plate_of(front, coin({})), lettered = plate_of(front, coin({legend("PAX")}));
  const std::size_t shared = std::min(front.points.size(), plain.points.size() / 2);
  for (std::size_t i = 0; i < shared; ++i) EXPECT_EQ(plain.points[i], lettered.points[i]);
  const auto area_of = [](const Solid& solid, Region region) {
    double twice = 0;
    for (std::size_t t = 0; t < solid.front_triangles; ++t) {
      const auto& [a, b, c] = solid.triangles[t];
      if (solid.regions[t] == region)
        twice += cross((solid.points[b] - solid.points[a]).head<2>(),
                       (solid.points[c] - solid.points[a]).head<2>());
    }
    return twice / 2;
  };
  EXPECT_NEAR(area_of(plain, Region::relief), area_of(lettered, Region::relief), 1e-9);
  const double letters = area_of(lettered, Region::bevel) - area_of(plain, Region::bevel);
  EXPECT_GT(letters, 1);
  EXPECT_NEAR(letters, area_of(plain, Region::ground) - area_of(lettered, Region::ground), 1e-6);
}

TEST(Ornaments, OfADieAreSunkByTheHeightOfTheCoins) {
  Ornament text = legend("REX");
  text.height_mm = .5;
  PlateOptions die = coin({text});
  die.is_mirrored = die.is_die = true;
  die.rim = {};
  const HeightFieldMesh flat = test::fan_front(ellipse(40, 12, 10));
  const Solid solid = plate_of(flat, die);
  EXPECT_NEAR(test::used_box(solid).max.z(), thickness + .5, 1e-9);
  die.is_die = false;
  const double sum = volume_mm3(solid) + volume_mm3(plate_of(flat, die));
  const double area = 2 * volume_mm3(plate_of(flat, [&] {
                        PlateOptions plain = die;
                        plain.ornaments.clear();
                        plain.thickness_mm = 1;
                        return plain;
                      }()));
  EXPECT_NEAR(sum, area * (thickness + .25), 1e-3);
}

TEST(Ornaments, AllKindsTogetherDoNotCutEachOther) {
  Ornament beads = ornament(OrnamentKind::beads), line = ornament(OrnamentKind::line),
           text = legend("VERITAS");
  line.inset_mm = .9;
  text.size_mm = 2.4;
  Ornament date = text;
  date.text = "MMXXVI", date.arc = TextArc::bottom;
  const Solid solid = plate_of(figure(), coin({text, date, beads, line}));
  EXPECT_EQ(test::complaint_of_admesh(solid), "");
}

TEST(Ornaments, FollowCurvedBasesAndWraps) {
  PlateOptions dome = coin({legend("DOMUS")});
  dome.base.kind = BaseKind::dome;
  EXPECT_EQ(check_solid(plate_of(figure(), dome)), "");
  PlateOptions wrap = coin({legend("VAS")});
  wrap.rim = {};
  wrap.wrap.kind = WrapKind::cylinder;
  wrap.wrap.diameter_mm = 120;
  const Solid plate = plate_of(figure(), wrap);
  EXPECT_EQ(check_solid(value_of(wrap_plate(plate, wrap))), "");
}

TEST(Ornaments, SayWhatIsInTheirPlace) {
  Ornament large = legend("LIBERTAS");
  large.size_mm = 9;
  expect_error(make_plate(figure(), coin({large})), ErrorKind::option,
               "found the rim and the outline in its place");
  Ornament low = legend("LIBERTAS");
  low.inset_mm = 4;
  expect_error(make_plate(figure(), coin({low})), ErrorKind::option, "found the relief in its place");
  expect_error(make_plate(figure(), coin({legend("A"), legend("A")})), ErrorKind::option,
               "found the text 'A'");
  Ornament disc = ornament(OrnamentKind::drawing);
  disc.outlines = {ellipse(60, 1, 1)};
  disc.size_mm = 29;
  expect_error(make_plate(figure(), coin({disc})), ErrorKind::option, "found the relief in its place");
  PlateOptions cut = coin({legend("A")});
  cut.outline = Outline::none;
  cut.rim = {};
  expect_error(make_plate(figure(), cut), ErrorKind::option, "an outline with ground");
}

}  // namespace
}  // namespace relievo
