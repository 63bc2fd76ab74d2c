// Tests plates on curved bases.
#include <set>

#include "support/admesh.h"
#include "support/plate_fronts.h"
#include "support/shapes.h"

namespace relievo {
namespace {

constexpr const char* base_shapes[] = {"plane",           "fold", "wave:direction=30", "cylinder", "dome",
                                       "cylinder:hollow", "image"};

double bump(double x, double y) {
  const double to_middle = std::hypot(x - 15, y - 10);
  return to_middle < 8 ? 1 + std::cos(to_middle * std::numbers::pi / 8) : 0;
}

// Returns a hill in the middle of flat ground, as a grid.
HeightFieldMesh hill() {
  HeightFieldMesh front = test::grid_front({30, 20, 30, 20}, bump);
  for (const Triangle& t : front.triangles)
    front.is_relief.push_back(std::ranges::any_of(t, [&](Index i) { return front.points[i].z() > 0; }));
  return front;
}

// Returns the same hill on flat ground, as a Delaunay triangulation of scattered points.
HeightFieldMesh scattered_hill() {
  test::Random random(7);
  std::vector<Vec3> points;
  for (int i = 0; i < 1500; ++i) {
    const double x = random.uniform(0, 30), y = random.uniform(0, 20);
    points.emplace_back(x, y, bump(x, y));
  }
  return test::front_over(points);
}

// Returns the same hill with many points on it, and few around it. It is a Delaunay triangulation of points with
// shorter x, so a Delaunay triangulation of the points themselves has other edges.
HeightFieldMesh hill_in_large_triangles() {
  constexpr double stretch = 8;
  test::Random random(7);
  std::vector<Vec3> points = {{0, 0, 0}, {30, 0, 0}, {30, 20, 0}, {0, 20, 0}};
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(0, 30), y = random.uniform(0, 20);
    if (bump(x, y) > 0 || i < 60) points.emplace_back(x, y, bump(x, y));
  }
  for (Vec3& p : points) p.x() /= stretch;
  HeightFieldMesh front = test::front_over(points);
  for (Vec3& p : front.points) p.x() *= stretch;
  return front;
}

PlateOptions plate_on(std::string_view shape, Outline outline = Outline::rectangle, double rim = 0) {
  PlateOptions options{2, 1.5, outline, 3, {rim, .8, .4}, *parse_base(shape)};
  Image<float> grid = filled_image(40, 30, 0.F);
  for (std::size_t i = 0; i < 1200; ++i)
    grid[i] = std::sin(.2F * static_cast<float>(i % 40)) + std::cos(.15F * static_cast<float>(i / 40));
  options.base.image = std::make_shared<const Image<float>>(grid);
  return options;
}

// Calls f at seven points of each triangle of the front: its corners, the midpoints of its sides, and one inside.
void each_place(const Solid& solid, const std::function<void(const Vec3&)>& f) {
  for (std::size_t t = 0; t < solid.front_triangles; ++t) {
    const auto& [a, b, c] = solid.triangles[t];
    const Vec3 &p = solid.points[a], &q = solid.points[b], &r = solid.points[c];
    for (const Vec3& w : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(.5, .5, 0), Vec3(0, .5, .5),
                          Vec3(.5, 0, .5), Vec3(.4, .3, .3)})
      f(w.x() * p + w.y() * q + w.z() * r);
  }
}

// Finds heights of a plate's front. Each cell of a grid lists the triangles whose bounding boxes meet the cell.
class Heights {
 public:
  explicit Heights(const Solid& solid) : solid_(solid), cells_(80 * 80) {
    for (Index t = 0; t < solid.front_triangles; ++t) {
      Box box;
      for (const Index i : solid.triangles[t]) box.extend(solid.points[i]);
      for (int y = cell(box.min.y()); y <= cell(box.max.y()); ++y)
        for (int x = cell(box.min.x()); x <= cell(box.max.x()); ++x)
          cells_[static_cast<std::size_t>(80 * y + x)].push_back(t);
    }
  }

  // Returns the height at a point; NaN outside the front.
  double at(const Vec2& place) const {
    for (const Index t : cells_[static_cast<std::size_t>(80 * cell(place.y()) + cell(place.x()))]) {
      const auto& [a, b, c] = solid_.triangles[t];
      const Vec3 p = solid_.points[b] - solid_.points[a], q = solid_.points[c] - solid_.points[a];
      const Vec2 d = place - solid_.points[a].head<2>();
      const double area = p.x() * q.y() - p.y() * q.x(), u = (d.x() * q.y() - d.y() * q.x()) / area,
                   v = (p.x() * d.y() - p.y() * d.x()) / area;
      if (u >= -1e-6 && v >= -1e-6 && u + v <= 1 + 1e-6) return solid_.points[a].z() + u * p.z() + v * q.z();
    }
    return std::nan("");
  }

 private:
  static int cell(double x) { return std::clamp(static_cast<int>(x), 0, 79); }
  const Solid& solid_;
  std::vector<std::vector<Index>> cells_;
};

// ------------------------------------------------------------------------------------------------------ shape

// The height on a curved base minus the height of the base must be the height on a plane base, everywhere: on
// the hill, the ground and the rim.
TEST(PlateBase, ReliefMinusBaseIsThePlanarRelief) {
  for (const HeightFieldMesh& front : {scattered_hill()})
    for (const Outline outline : {Outline::rectangle, Outline::circle})
      for (const char* shape : base_shapes) {
        const PlateOptions options = plate_on(shape, outline, 1);
        PlateOptions planar = options;
        planar.base = {};
        const Solid solid = test::plate_of(front, options), flat = test::plate_of(front, planar);
        const Base base = *plate_base(front, options);
        const Heights heights(flat);
        const double lift = solid.ground_mm - flat.ground_mm;
        double worst = 0;
        std::size_t seen = 0;
        each_place(solid, [&](const Vec3& p) {
          const Vec2 in_front = (p - solid.shift).head<2>();
          const double expected = heights.at(in_front + flat.shift.head<2>()) + lift + base.height(in_front);
          if (std::isnan(expected)) return;
          worst = std::max(worst, std::abs(p.z() - expected));
          ++seen;
        });
        EXPECT_GT(seen, 6 * solid.front_triangles) << shape;
        EXPECT_LT(worst, .011) << shape;  // 0.5 % of 2 mm
        EXPECT_LE(solid.error_mm, .01) << shape;
      }
}

TEST(PlateBase, KeepsTheLeastThicknessOnAFlatBack) {
  for (const char* shape : base_shapes) {
    const Solid solid = test::plate_of(hill(), plate_on(shape, Outline::circle));
    double lowest = 1e9;
    each_place(solid, [&](const Vec3& p) { lowest = std::min(lowest, p.z()); });
    EXPECT_EQ(lowest, 1.5) << shape;
    std::set<double> backs;
    for (std::size_t t = solid.front_triangles; t < solid.triangles.size(); ++t)
      for (const Index i : solid.triangles[t])
        if (solid.points[i].z() < 1.5) backs.insert(solid.points[i].z());
    EXPECT_EQ(backs, std::set<double>{0}) << shape;
  }
}

TEST(PlateBase, AFoldHasItsRidgeInTheMesh) {
  const HeightFieldMesh front = hill();
  const PlateOptions options = plate_on("fold:angle=30");
  const Solid solid = test::plate_of(front, options);
  // No triangle may have corners on both sides of the ridge.
  const double middle = 17;
  for (std::size_t t = 0; t < solid.front_triangles; ++t) {
    double left = 0, right = 0;
    for (const Index i : solid.triangles[t]) {
      left = std::max(left, middle - solid.points[i].x());
      right = std::max(right, solid.points[i].x() - middle);
    }
    EXPECT_LT(std::min(left, right), .05) << t;
  }
}

TEST(PlateBase, ASteepDomeOverEmptyGroundIsRoundEverywhere) {
  const HeightFieldMesh front = test::flat_front({4, 4, 1, 1});
  const PlateOptions options{20, 2, Outline::circle, 5, {}, *parse_base("dome:height=12")};
  const Solid solid = test::plate_of(front, options);
  const Base base = *plate_base(front, options);
  each_place(solid, [&](const Vec3& p) {
    EXPECT_NEAR(p.z() - solid.ground_mm, base.height((p - solid.shift).head<2>()), .011);
  });
  const double radius = std::sqrt(8.) + 20, height = 12, pi = std::numbers::pi;
  const double cap = pi * height / 6 * (3 * radius * radius + height * height);
  EXPECT_NEAR(volume_mm3(solid), pi * radius * radius * 2 + cap, .01 * pi * radius * radius);
}

// ------------------------------------------------------------------------------------------------- watertight

TEST(PlateBase, IsWatertightForEveryOutlineBaseAndRim) {
  const HeightFieldMesh front = hill(), scattered = scattered_hill();
  for (const auto& [outline_name, outline] : outline_choices)
    for (const char* shape : base_shapes)
      for (const double rim : {0., 1.5}) {
        if (outline == Outline::none && rim > 0) continue;
        const std::string name = std::string(outline_name) + " " + shape;
        EXPECT_EQ(check_solid(test::plate_of(front, plate_on(shape, outline, rim))), "") << name;
        if (outline == Outline::none) continue;
        const Solid solid = test::plate_of(scattered, plate_on(shape, outline, rim));
        EXPECT_EQ(test::complaint_of_admesh(solid), "") << name;
      }
}

// ------------------------------------------------------------------------------------------ fewer triangles

TEST(PlateBase, SimplerPlatesKeepTheirToleranceAndTellTheirError) {
  const HeightFieldMesh front = scattered_hill();
  for (const char* shape : base_shapes) {
    if (std::string_view(shape) == "plane") continue;
    for (const double rim : {0., 1.5}) {
      PlateOptions options = plate_on(shape, Outline::circle, rim);
      options.tolerance_mm = .004;
      const Solid full = test::plate_of(front, options);
      options.simplify_mm = .03;
      const Solid solid = test::plate_of(front, options);
      EXPECT_LT(solid.front_triangles, full.front_triangles / 2) << shape;
      EXPECT_LE(solid.error_mm, .034) << shape;
      // Each surface may bend between the points of the other one, so they are compared at the points of both.
      double worst = 0;
      for (const auto& [one, other] : {std::pair(&solid, &full), std::pair(&full, &solid)}) {
        const Heights heights(*other);
        each_place(*one, [&](const Vec3& p) {
          const double off = p.z() - one->ground_mm - heights.at(p.head<2>()) + other->ground_mm;
          if (!std::isnan(off)) worst = std::max(worst, std::abs(off));
        });
      }
      EXPECT_LE(worst, solid.error_mm + 1e-4) << shape;
      EXPECT_GE(worst, solid.error_mm / 2) << shape;
    }
  }
}

// Simplification may add points inside large triangles. There, too, the curved surface must be followed.
TEST(PlateBase, SimplerPlatesOfAWrapKeepTheirHeightsInsideLargeTriangles) {
  const HeightFieldMesh front = hill_in_large_triangles();
  for (const char* wrap :
       {"cylinder:turn=200", "cylinder:turn=200,inside", "cone:turn=200", "sphere:turn=100"}) {
    PlateOptions options{2, 1.5};
    options.wrap = *parse_wrap(wrap);
    options.tolerance_mm = .004;
    const Solid full = test::plate_of(front, options);
    options.simplify_mm = .03;
    const Solid solid = test::plate_of(front, options);
    EXPECT_LT(solid.front_triangles, full.front_triangles) << wrap;
    const Heights heights(full);
    double worst = 0;
    for (std::size_t t = 0; t < solid.front_triangles; ++t)
      for (const Index i : solid.triangles[t]) {
        const double off = solid.points[i].z() - heights.at(solid.points[i].head<2>());
        if (!std::isnan(off)) worst = std::max(worst, std::abs(off));
      }
    EXPECT_LE(worst, .034) << wrap;
  }
}

// The bent front is compared with the exact one along lines through the cylinder's axis, also inside triangles.
TEST(PlateBase, SimplerPlatesOnACylinderTellTheirError) {
  PlateOptions options{2, 1.5};
  options.wrap = *parse_wrap("cylinder:turn=200");
  options.tolerance_mm = .004;
  for (const HeightFieldMesh& front : {scattered_hill(), hill_in_large_triangles()}) {
    options.simplify_mm = 0;
    const Solid full = test::plate_of(front, options);
    const Heights heights(full);
    for (const double simplify_mm : {0., .03}) {
      options.simplify_mm = simplify_mm;
      const Solid bent = value_of(wrap_plate(test::plate_of(front, options), options));
      const Box box = Box::of(bent.points), flat = Box::of(full.points);
      const double half = 100 * std::numbers::pi / 180, radius = flat.size().x() / 2 / half;
      const Vec2 axis(box.centre().x(),
                      -radius * std::cos(half));  // the lowest points are at the plate's sides
      double worst = 0;
      each_place(bent, [&](const Vec3& p) {
        const Vec2 from_axis(p.x() - axis.x(), p.z() - axis.y());
        const double x = flat.centre().x() + radius * std::atan2(from_axis.x(), from_axis.y());
        const double off = from_axis.norm() - radius + full.ground_mm - heights.at({x, p.y()});
        if (!std::isnan(off)) worst = std::max(worst, std::abs(off));
      });
      EXPECT_LE(worst, 4. / 3 * bent.error_mm);  // inside triangles it may be larger than on their edges
    }
  }
}

TEST(PlateBase, RefusesABaseThatThePlateIsTooLargeFor) {
  expect_error(make_plate(hill(), plate_on("cylinder:diameter=30")), ErrorKind::option,
               "base: expected a diameter of at least ");
}

}  // namespace
}  // namespace relievo
