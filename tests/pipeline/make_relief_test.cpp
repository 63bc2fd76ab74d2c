#include "relievo/make_relief.h"
#include "relievo/io/write.h"

#include "relievo/relief/relief.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/surface.h"
#include "support/plate_fronts.h"
#include "support/same_bits.h"
#include "support/shapes.h"

namespace relievo {
namespace {

Cloud figure() {
  return test::joined(test::torus(30000, 1.5, .4), test::sphere(20000, .8));
}

Cloud small_figure() {
  return test::joined(test::torus(8000, 1.5, .4), test::sphere(4000, .8));
}

TEST(MakeRelief, IsAsLargeAndHighAsAsked) {
  ReliefOptions options{{.width_mm = 60, .height_mm = 2.5, .margin_mm = 4, .thickness_mm = 1.5}};
  const auto made = value_of(make_relief(figure(), options));
  EXPECT_EQ(check_solid(made.solid), "");
  const Box box = Box::of(made.solid.points);
  EXPECT_NEAR(std::max(box.size().x(), box.size().y()), 60 + 2 * 4, 1e-9);
  EXPECT_NEAR(box.size().z(), 1.5 + 2.5, 2.5e-3);
  EXPECT_NEAR(made.report.height_mm, 2.5, 2.5e-3);
  EXPECT_NEAR(box.size().z(), 1.5 + made.report.height_mm, 1e-9);
}

TEST(MakeRelief, IsAsHighAsAShareOfTheDiagonal) {
  const Cloud cloud = small_figure();
  ReliefOptions options{{.width_mm = 60, .resolution_mm = .5}};
  for (const Method method : {Method::layered, Method::paper}) {
    options.method = method;
    options.height_of_diagonal = .02;
    const auto made = value_of(make_relief(cloud, options));
    EXPECT_NEAR(*made.report.height_requested_mm, .02 * Box::of(cloud.points).diagonal() * made.report.scale,
                1e-9);
    ReliefOptions in_mm = options;
    in_mm.height_of_diagonal.reset();
    in_mm.height_mm = made.report.height_requested_mm;
    EXPECT_EQ(write_stl(made.solid), write_stl(make_relief(cloud, in_mm)->solid));
    options.height_of_diagonal = .9;
    expect_error(make_relief(cloud, options), "; normals alone reach 0.");
  }
}

TEST(MakeRelief, SolvesForControlPointsInProportionToTheNumberAsked) {
  ReliefOptions options;
  options.mode = Mode::subspace;
  for (const View& view : {View(), View().for_paper()}) {
    const auto points_for = [&](double count) {
      options.control_points = count;
      return static_cast<double>(
          value_of(prepare(small_figure(), view, options.effective_model())).control_points());
    };
    const double few = points_for(500), many = points_for(1000);
    EXPECT_NEAR(many / few, 2, .3);
    EXPECT_GT(many, .5 * 1000);
    EXPECT_LT(many, 1.1 * 1000);
  }
}

// Expects that the relief is as large as the margin allows, on a plate of size `size`: a relief that is
// 0.1 % wider must be refused.
void expect_fitted(const ReliefModel& model, const ReliefOptions& options, const Vec2& size) {
  const auto made = value_of(make_relief(model, options));
  EXPECT_EQ(check_solid(made.solid), "");
  const std::string_view name = name_in(outline_choices, options.outline);
  EXPECT_LT((Box::of(made.solid.points).size().head<2>() - size).cwiseAbs().maxCoeff(), 1e-9) << name;
  const double width = with_width(model.surface(), options)->effective_width_mm();
  ReliefOptions larger = options;
  larger.width_mm = width * 1.001;
  expect_error(make_relief(model, larger), "width: expected ");
  // `free` lets the plate adapt to a relief of this width. This plate must have the same size as `size` in
  // one direction, and must not be larger in the other.
  ReliefOptions free = options;
  free.width_mm = width;
  free.diameter_mm.reset();
  free.plate_mm.reset();
  const Vec2 share = Box::of(make_relief(model, free)->solid.points).size().head<2>().cwiseQuotient(size);
  if (options.outline == Outline::ellipse) return;  // the plate that adapts has another ratio of axes
  EXPECT_NEAR(share.maxCoeff(), 1, 1e-3) << name;
}

TEST(MakeRelief, FitsIntoAPlateOfTheSizeAskedFor) {
  const auto model = value_of(prepare(small_figure(), View{}));
  ReliefOptions options{{.height_mm = 2, .margin_mm = 3, .rim_mm = 2}};
  options.plate_mm = Vec2(120, 70);
  for (const Outline outline : {Outline::rectangle, Outline::round, Outline::ellipse}) {
    options.outline = outline;
    expect_fitted(model, options, *options.plate_mm);
  }
  options.plate_mm.reset();
  options.diameter_mm = 80;
  options.outline = Outline::circle;
  expect_fitted(model, options, Vec2(80, 80));
  options.width_mm = 20;  // a smaller relief keeps the plate's size
  const auto made = make_relief(model, options);
  EXPECT_NEAR(Box::of(made->solid.points).size().x(), 80, 1e-9);
  EXPECT_NEAR(made->report.scale * model.surface().longer_side(), 20, 1e-9);
  options.form = Form::die;  // a die has a border around the rim's groove, as wide as rim and bevel
  const Vec3 die = Box::of(make_relief(model, options)->solid.points).size();
  EXPECT_GT(die.x(), 80 + 2 * 2);
}

// Returns the heights at which a vertical line crosses the solid. Tests every triangle.
std::vector<double> crossings(const Solid& solid, const Vec2& place) {
  std::vector<double> heights;
  for (const Triangle& t : solid.triangles) {
    const Vec3 a = solid.points[t[0]], b = solid.points[t[1]], c = solid.points[t[2]];
    const auto side = [&](const Vec3& p, const Vec3& q) {
      return (q.x() - p.x()) * (place.y() - p.y()) - (q.y() - p.y()) * (place.x() - p.x());
    };
    const double ab = side(a, b), bc = side(b, c), ca = side(c, a), sum = ab + bc + ca;
    if ((ab > 0) != (bc > 0) || (bc > 0) != (ca > 0) || sum == 0) continue;
    heights.push_back((bc * a.z() + ca * b.z() + ab * c.z()) / sum);
  }
  std::ranges::sort(heights);
  return heights;
}

// The figure is scanned only from -Y, with Z upwards. All other sides are empty.
TEST(MakeRelief, ShowsTheBestSideWhereThatIsAskedFor) {
  Cloud standing;
  const Cloud whole = figure();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const Vec3& p = whole.points[i];
    const Vec3f& n = whole.normals[i];
    if (n.z() > .2F) test::add(standing, {p.x(), -p.z(), p.y()}, {n.x(), -n.z(), n.y()});
  }
  ReliefOptions options, told;
  options.height_mm = told.height_mm = 2;
  options.view.is_best = true;
  told.view = *parse_view("bottom");
  const auto found = value_of(make_relief(standing, options)), wanted = value_of(make_relief(standing, told));
  EXPECT_EQ(found.solid.points, wanted.solid.points);
}

TEST(MakeRelief, IsNowhereThinnerThanAsked) {
  const Cloud cloud = test::joined(test::torus(4000, 1.5, .4), test::sphere(2000, .8));
  const auto model = prepare(cloud, View{});
  test::Random random(5);
  for (const auto& [form_name, form] : form_choices)
    for (const Outline outline : {Outline::rectangle, Outline::circle, Outline::none}) {
      ReliefOptions options{{.height_mm = 6, .thickness_mm = 1.25}};
      options.form = form;
      options.outline = outline;
      const auto made = value_of(make_relief(*model, options));
      const Vec3 size = Box::of(made.solid.points).size();
      int lines = 0;
      for (int trial = 0; trial < 100; ++trial) {
        const auto at = crossings(made.solid, {random.uniform(0, size.x()), random.uniform(0, size.y())});
        ASSERT_EQ(at.size() % 2, 0U);
        for (std::size_t i = 0; i < at.size(); i += 2, ++lines)
          EXPECT_GE(at[i + 1] - at[i], 1.25 - 1e-9) << form_name << " " << name_in(outline_choices, outline);
      }
      EXPECT_GT(lines, 30);
    }
}

TEST(MakeRelief, HasTheUsualHeightWhereNoneIsAskedFor) {
  ReliefOptions options{{.width_mm = 60}};
  const auto made = value_of(make_relief(figure(), options));
  EXPECT_EQ(made.report.method, Method::layered);
  EXPECT_NEAR(made.report.height_mm, 3, 1e-9);
  EXPECT_FALSE(made.report.height_requested_mm);
  EXPECT_EQ(made.report.height_usual_mm, 3);
  options.method = Method::linear;
  EXPECT_NEAR(make_relief(figure(), options)->report.height_mm, 3, 1e-9);
  options.method.reset();
  options.alpha = 4;
  const auto paper = make_relief(figure(), options);
  EXPECT_EQ(paper->report.method, Method::paper);
  EXPECT_FALSE(paper->report.height_usual_mm);
}

// The default height is a twentieth of the relief's width. The dome is too shallow for this height, with or
// without a draft angle.
TEST(MakeRelief, IsAsHighAsTheViewReachesWhereTheUsualHeightIsTooHigh) {
  Cloud shallow = test::sphere(20000, 1);
  for (Vec3& p : shallow.points) p.z() *= .02;
  for (Vec3f& n : shallow.normals) n = n.cwiseQuotient(Vec3f(1, 1, .02F)).normalized();
  ReliefOptions options;
  for (const bool has_draft : {false, true}) {
    if (has_draft) options.draft_deg = 10;
    const auto made = value_of(make_relief(shallow, options));
    EXPECT_GT(made.report.height_mm, .1);
    EXPECT_LT(made.report.height_mm, 5);
    EXPECT_EQ(made.report.height_usual_mm, 5);
    ReliefOptions asked = options;
    asked.height_mm = 5;
    EXPECT_FALSE(make_relief(shallow, asked));
  }
}

TEST(MakeRelief, ReachesTheHighestWithADraftAngleAndNoMore) {
  const auto model = prepare(figure(), View{});
  ReliefOptions options{{.width_mm = 60}};
  const double free = *highest_with_draft(*model, options);
  options.draft_deg = 50;
  const double highest = *highest_with_draft(*model, options);
  EXPECT_GT(highest, 1);
  EXPECT_LT(highest, .9 * free);
  options.height_mm = .999 * highest;
  EXPECT_NEAR(value_of(make_relief(*model, options)).report.height_mm, .999 * highest, 1e-3);
  EXPECT_EQ(*highest_with_draft(*model, options), highest);  // it does not depend on the requested height
  options.height_mm = 1.001 * highest;
  expect_error(make_relief(*model, options), "draft: expected ");
}

// Lines sink by millimetres of the relief, whatever the unit of the scan is.
TEST(MakeRelief, SinksLinesEquallyDeepAtEachScaleOfTheScan) {
  Cloud scan = test::height_field(
      10'000, 1, [](double x, double) { return .4 * std::cos(2 * x); },
      [](double x, double) { return Vec2(-.8 * std::sin(2 * x), 0); });
  for (const Vec3& p : scan.points)
    scan.colours.push_back(std::abs(p.x()) < .05 ? Colour{20, 20, 20} : Colour{230, 230, 230});
  ReliefOptions steep{{.width_mm = 60, .draft_deg = 30}};
  steep.colour_mm = 1;
  ReliefOptions high{{.width_mm = 60}};
  high.colour_mm = 1;
  high.height_of_diagonal = .9;
  const auto at_scale = [&](double scale) {
    const ReliefModel model = prepare(test::scaled(scan, scale), View{}).value();
    return std::pair(value_of(highest_with_draft(model, steep)), message_of(make_relief(model, high)));
  };
  const auto [height, message] = at_scale(1);
  EXPECT_NE(message.find("; normals alone reach 0."), std::string::npos) << message;
  for (const double scale : {1. / 64, 64.}) {
    EXPECT_NEAR(at_scale(scale).first, height, 1e-6 * height);
    EXPECT_EQ(at_scale(scale).second, message);
  }
}

TEST(MakeRelief, RefusesAModelThatIsPreparedForLess) {
  const auto error_of = [](Method prepared, Method wanted) {
    ReliefOptions options;
    options.method = prepared;
    const auto model =
        value_of(prepare(test::torus(8000, 1.5, .4), options.effective_view(), options.effective_model()));
    options.method = wanted;
    return message_of(make_relief(model, options));
  };
  const std::string end = ", as the model was prepared for that; prepare it again with this method";
  EXPECT_EQ(error_of(Method::layered, Method::gradient), "no error");
  EXPECT_EQ(error_of(Method::gradient, Method::equalise), "no error");
  EXPECT_EQ(error_of(Method::linear, Method::layered), "no error");
  EXPECT_EQ(error_of(Method::layered, Method::paper), "method: expected another than paper" + end);
  EXPECT_EQ(error_of(Method::paper, Method::linear), "method: expected paper" + end);
}

TEST(MakeRelief, RefusesARimThatDoesNotLeanAsCheckRimSays) {
  const auto model = prepare(test::torus(8000, 1.5, .4), View{});
  ReliefOptions options{{.height_mm = 2, .draft_deg = 20, .rim_mm = 3}};
  for (const double share : {.9, 1.1}) {  // relative to the bevel that has the draft angle
    options.rim_bevel_mm = share * 2 * std::tan(20 * std::numbers::pi / 180);
    EXPECT_EQ(check_rim(options, 2).has_value(), share > 1);
    const auto made = make_relief(*model, options);
    ASSERT_EQ(made.has_value(), share > 1);
    if (!made) EXPECT_EQ(made.error().input, "rim-bevel");
  }
}

TEST(MakeRelief, TellsWhereThereIsNoPlaneToLeaveOut) {
  const Cloud ring = test::torus(8000, 1.5, .4);
  for (const bool has_plane : {true, false}) {
    View view{.has_plane = has_plane};
    const auto model = prepare(ring, view);
    const auto made = value_of(make_relief(*model, {}));
    EXPECT_FALSE(made.report.plane);
    EXPECT_EQ(made.report.lacks_plane, !has_plane);
  }
}

// The relief's bounding box must move by the whole shift, and stay inside the margin.
TEST(MakeRelief, MovesOnAPlateOfAGivenSize) {
  const auto model = prepare(test::torus(8000, 1.5, .4), View{});
  ReliefOptions options{{.width_mm = 40, .height_mm = 2}};
  options.outline = Outline::round;
  options.plate_mm = Vec2(120, 90);
  const auto place = [&](const ReliefOptions& o) {
    return make_relief(*model, o)->report.offset.head<2>().eval();
  };
  const Vec2 middle = place(options);
  options.shift_mm = Vec2(12, -7);
  EXPECT_LT((place(options) - middle - options.shift_mm).norm(), 1e-9);
  EXPECT_LT((Box::of(make_relief(*model, options)->solid.points).size().head<2>() - *options.plate_mm).norm(),
            1e-9);
  options.form = Form::mirror;  // the mirrored relief moves to the left
  const Vec2 mirrored = place(options);
  EXPECT_LT((mirrored - Vec2(120 - middle.x() - 12, middle.y() - 7)).norm(), 1e-6);
  options.form = Form::relief;
  options.width_mm.reset();
  options.shift_mm = Vec2(20, 0);
  EXPECT_NEAR(with_width(model->surface(), options)->effective_width_mm(), 2 * (60 - 20 - 5), 1e-6);
  options.width_mm = 71;
  EXPECT_EQ(make_relief(*model, options).error().input, "width");
}

TEST(MakeRelief, ReportsThePapersParametersAndU) {
  ReliefOptions options;
  options.method = Method::paper;
  const auto paper = value_of(make_relief(figure(), options));
  EXPECT_EQ(paper.report.alpha, 4);
  EXPECT_EQ(paper.report.beta, .01);
  EXPECT_EQ(paper.report.gamma, .02);
  EXPECT_NEAR(paper.report.u, std::pow(4, -.01), 1e-12);
  options.height_mm = 3;
  options.saturation = .5;
  const auto to_order = value_of(make_relief(figure(), options));
  EXPECT_NEAR(to_order.report.u, std::pow(to_order.report.alpha, -.5), 1e-9);
  options = {};
  options.method = Method::paper;
  options.saturation = 0;
  EXPECT_TRUE(std::isnan(make_relief(figure(), options)->report.alpha));
}

// Two level sheets, one in front of the other, have no slopes. So the paper's method gives the relief no
// height. By default the step between the sheets gets all of the height.
TEST(MakeRelief, GivesStepsTheHeightThatSlopesDoNotReach) {
  const Cloud sheets = test::joined(test::sheet(20000, 1, 0), test::sheet(10000, .4, .3, 9));
  ReliefOptions options;
  options.method = Method::paper;
  expect_error(make_relief(sheets, options), "0 mm");
  options.method.reset();
  options.height_mm = 2;
  const auto made = value_of(make_relief(sheets, options));
  EXPECT_TRUE(made.report.has_needed_steps);
  EXPECT_NEAR(made.report.steps, 1, .01);
  EXPECT_NEAR(made.report.height_mm, 2, 1e-9);
}

TEST(MakeRelief, RefusesBadOptionsBeforeTheWork) {
  ReliefOptions options{{.margin_mm = -1}};
  EXPECT_EQ(make_relief(Cloud{}, options).error().kind, ErrorKind::option);
}

TEST(MakeRelief, FromAPreparedModelIsTheSame) {
  ReliefOptions options{{.height_mm = 2}};
  options.view = *parse_view("1,0.5,2");
  options.tone = *parse_tone_curve("0,0.1;0.5,0.6;1,0.3");
  options.steepest_deg = 60;
  options.boundary_width = 5;
  const auto whole = value_of(make_relief(figure(), options));
  const auto model = prepare(figure(), options.view);
  EXPECT_EQ(write_stl(value_of(make_relief(*model, options)).solid), write_stl(whole.solid));
}

TEST(MakeRelief, ASofterRimAndGentlerWallsLowerIt) {
  ReliefOptions options;
  options.method = Method::paper;
  const double plain = make_relief(figure(), options)->report.height_mm;
  options.boundary_width = 10;
  EXPECT_LT(make_relief(figure(), options)->report.height_mm, plain);
  options.boundary_width = 2;
  options.steepest_deg = 10;
  EXPECT_LT(make_relief(figure(), options)->report.height_mm, plain);
}

// The bits must not depend on whether the processor's wide vector instructions are used. For other
// compilers and targets, scripts/compare-builds allows differences of 1e-5 of the height.
TEST(MakeRelief, HasTheSameBitsWithAndWithoutWideVectors) {
  for (const Method method : {Method::layered, Method::paper, Method::gradient}) {
    ReliefOptions options{{.height_mm = 2, .resolution_mm = 1}};
    options.method = method;
    test::expect_same_without_avx2(
        [&] { return value_of(make_relief(test::torus(6000, 1.5, .4), options)).solid.points; });
  }
}

TEST(MakeRelief, AToneCurveReplacesTheSaturation) {
  ReliefOptions options{{.saturation = 1}};
  options.tone = *parse_tone_curve("0.5,0");
  // This tone curve flattens all slopes, so making the relief must fail.
  expect_error(make_relief(figure(), options), ErrorKind::geometry);
}

}  // namespace
}  // namespace relievo
