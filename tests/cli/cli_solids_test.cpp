// Tests the solids and height maps that the program writes. The solids are read without the library's
// code, and their volumes are compared with closed forms.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "common/archive.h"
#include "support/cli_folder.h"
#include "support/read_solid.h"
#include "support/read_text.h"

namespace relievo {
namespace {

using namespace test;

using CliSolids = CliFolder;

ReadSolid solid_in_3mf(const std::string& file) {
  const auto archive = app::Archive::open(std::as_bytes(std::span(file)), "t.3mf");
  const std::vector<std::byte> model = *archive->content("3D/3dmodel.model");
  const std::string text(reinterpret_cast<const char*>(model.data()), model.size());
  std::vector<Vec3f> points;
  ReadSolid solid;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    Vec3f p;
    std::array<std::size_t, 3> t{};
    if (std::sscanf(line.c_str(), R"(<vertex x="%f" y="%f" z="%f"/>)", &p.x(), &p.y(), &p.z()) == 3)
      points.push_back(p);
    if (std::sscanf(line.c_str(), R"(<triangle v1="%zu" v2="%zu" v3="%zu"/>)", &t[0], &t[1], &t[2]) == 3)
      solid.triangles.push_back({points.at(t[0]), points.at(t[1]), points.at(t[2])});
  }
  return solid;
}

// The 3MF file has the same solid as the STL file. The values of the height map range from the height of the
// ground to the relief's highest point.
TEST_F(CliSolids, Writes3mfAndTiff) {
  const std::string options = "make torus.ply --height 3 --tolerance 0.05 --quiet";
  must_run(options + " -o t.3mf --heightmap h.tif --report r.json");
  must_run(options + " -o t.stl");
  const ReadSolid solid = solid_in_3mf(read_all(folder_ / "t.3mf"));
  EXPECT_TRUE(solid.is_closed());
  EXPECT_TRUE(solid.triangles == solid_in_stl(read_all(folder_ / "t.stl")).triangles);
  const Image<float> map = image_in(read_all(folder_ / "h.tif")).values;
  const auto [lowest, highest] = std::ranges::minmax(map.pixels);
  EXPECT_NEAR(highest - lowest, 3, .02);
  EXPECT_NEAR(map.pixels.front(), lowest, 1e-4);  // the corner is in the margin
  const nlohmann::json report = nlohmann::json::parse(read_all(folder_ / "r.json"), nullptr, false);
  EXPECT_LE(report.value("simplification_error_mm", 1.0), .05);
  EXPECT_GT(report.value("simplification_error_mm", 0.0), 0);
}

// The relief and its die together fill a block. The plate of a lithophane is 0.8 mm thick.
TEST_F(CliSolids, MakesEveryForm) {
  const auto made = [&](const std::string& form) {
    const std::string file = form + ".stl";
    EXPECT_EQ(run("make torus.ply --quiet --height 2 --form " + form + " -o " + file).exit_code, 0) << form;
    ReadSolid solid = solid_in_stl(read_all(folder_ / file));
    EXPECT_TRUE(solid.is_closed()) << form;
    return solid;
  };
  const ReadSolid relief = made("relief"), mirror = made("mirror"), die = made("die"),
                  lithophane = made("lithophane");
  const Vec3 size = relief.box().size();
  EXPECT_LT((mirror.box().size() - size).norm(), 1e-4);
  EXPECT_LT((die.box().size() - size).norm(), 1e-4);
  EXPECT_NEAR(size.z(), 3 + 2, 2e-3);
  EXPECT_NEAR(lithophane.box().size().z(), .8 + 2, 2e-3);
  EXPECT_NEAR(mirror.volume() / relief.volume(), 1, 1e-5);
  const double block = size.x() * size.y() * (2 * 3 + 2);
  EXPECT_NEAR((relief.volume() + die.volume()) / block, 1, 1e-4);
}

// The thickness of a lithophane depends linearly on the values of the photo, from 0.8 mm at the brightest
// value to 3.2 mm at the darkest.
TEST_F(CliSolids, MakesALithophaneOfAPhoto) {
  Image8 photo{60, 40, 3, {}};
  for (int i = 0; i < 60 * 40; ++i)
    photo.pixels.insert(photo.pixels.end(), 3, static_cast<std::uint8_t>(255 * (i % 60) / 59));
  write_all(folder_ / "photo.png", write_png(photo));
  const Outcome outcome = must_run(
      "make photo.png -o l.stl --form lithophane --depth-values luminance --width 60 "
      "--heightmap l.tif --heightmap-size 140");
  EXPECT_TRUE(outcome.err.contains("photo.png: 60 x 40 pixels, whose brightness becomes thickness"))
      << outcome.err;
  const ReadSolid solid = solid_in_stl(read_all(folder_ / "l.stl"));
  EXPECT_TRUE(solid.is_closed());
  EXPECT_NEAR(solid.box().size().z(), 3.2, 2e-3);
  EXPECT_NEAR(solid.box().size().x(), 60 + 2 * 5, 1e-3);
  const Image<float> map = image_in(read_all(folder_ / "l.tif")).values;
  // The map has 2 pixels per millimetre, and the photo has 1.
  const float bright = map.at(2 * (5 + 59), 50);
  for (int c = 1; c < 59; ++c) {
    const double darker = static_cast<double>(map.at(2 * (5 + c), 50) - bright);
    EXPECT_NEAR(darker, 2.4 * (59 - c) / 59., .05) << c;
  }
}

// The bent ground is as long along its arc as the flat plate. The chord of this arc is the width of the bent solid.
TEST_F(CliSolids, TellsHowWideASphereLeavesTheGround) {
  const Outcome made =
      must_run("make torus.ply -o s.stl --wrap sphere:turn=100 --outline circle --diameter 110 --height 2");
  const double pi = std::numbers::pi, chord = 110 * 360 / (100 * pi) * std::sin(50 * pi / 180);
  const std::string_view before = "which leaves it ";
  const std::size_t at = made.err.find(before);
  ASSERT_NE(at, std::string::npos) << made.err;
  EXPECT_NEAR(std::stod(made.err.substr(at + before.size())), chord, .01);
  EXPECT_NEAR(solid_in_stl(read_all(folder_ / "s.stl")).box().size().x(), chord, .05);
}

}  // namespace
}  // namespace relievo
