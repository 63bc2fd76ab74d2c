// Tests the program as its users run it: its outputs, and its messages and reports.
#include <nlohmann/json.hpp>
#include <set>

#include "relievo/core/image.h"
#include "relievo/option_table.h"
#include "relievo/picture/preview.h"
#include "relievo/relief/baseline_grid.h"
#include "support/cli_folder.h"
#include "support/format_samples.h"
#include "support/read_solid.h"

namespace relievo {
namespace {

using namespace test;

using Cli = CliFolder;

Vec3 stl_size(const std::string& file) {
  return solid_in_stl(file).box().size();
}

nlohmann::json json_in(const fs::path& path) {
  return nlohmann::json::parse(read_all(path), nullptr, false);
}

int count(const std::string& text, std::string_view part) {
  int found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++found;
  return found;
}

// The torus is 2.8 units wide, seen along its axis. The relief is 50 mm wide and 3 mm high, on a plate that
// is 3 mm thick and has margins of 5 mm.
TEST_F(Cli, MakesEverythingAskedFor) {
  must_run(
      "make torus.ply -o t.stl --preview t.png --heightmap h.png --heightmap-size 100 --report r.json "
      "--height 3 --width 50");
  const ReadSolid solid = solid_in_stl(read_all(folder_ / "t.stl"));
  const Vec3 size = solid.box().size();
  EXPECT_TRUE(solid.is_closed());
  EXPECT_NEAR(size.head<2>().maxCoeff(), 60, 1e-3);
  EXPECT_NEAR(size.head<2>().minCoeff(), 60, .5);
  EXPECT_NEAR(size.z(), 6, 3e-3);
  EXPECT_GT(solid.volume(), 3 * size.x() * size.y());
  EXPECT_LT(solid.volume(), 6 * size.x() * size.y());

  const auto [width, height] = size_of_png(read_all(folder_ / "h.png"));
  EXPECT_EQ(std::max(width, height), 100U);
  EXPECT_NEAR(width * size.y(), height * size.x(), 60);
  const auto preview = size_of_png(read_all(folder_ / "t.png"));
  EXPECT_NEAR(preview.first, 2 * preview.second, .02 * preview.first);  // two views of a square plate
}

TEST_F(Cli, ReportsWhatItMade) {
  must_run("make torus.ply -o t.stl --report r.json --height 3 --width 50 --quiet");
  const nlohmann::json report = json_in(folder_ / "r.json");
  ASSERT_TRUE(report.is_object());
  const Vec3 size = stl_size(read_all(folder_ / "t.stl"));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(report["size_mm"][i].get<double>(), size[static_cast<Eigen::Index>(i)], 1e-4);
  EXPECT_EQ(report["input_points"], 20000);
  EXPECT_GT(report["visible_points"], 8000);  // a torus shows about half of its points
  EXPECT_LT(report["visible_points"], 12000);
  EXPECT_EQ(report["height_requested_mm"], 3);
  EXPECT_NEAR(report["height_mm"].get<double>(), 3, 3e-3);
  EXPECT_NEAR(report["diagonal"].get<double>(), std::hypot(2.8, 2.8, .8), .1);
  EXPECT_EQ(report["gamma"], .04);
  EXPECT_TRUE(report["version"].is_string());
  EXPECT_GE(report["threads"], 1);
  EXPECT_GT(report["seconds"].size(), 5U);
  const nlohmann::json& to_mm = report["model_to_mm"];
  EXPECT_NEAR(to_mm["scale"].get<double>(), 50 / 2.8, .1);
  EXPECT_EQ(to_mm["rotation"], nlohmann::json({1, 0, 0, 0, 1, 0, 0, 0, 1}));
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(to_mm["offset"][i].get<double>(), 30, .3);  // the centre of the torus
}

TEST_F(Cli, MakesProjects) {
  write_all(folder_ / "p.relievo", R"({"relievo": 1, "input": {"path": "torus.ply"}, "studio": {"any": 1},
    "options": {"height": 3, "width": 50, "tone": "0,0.2;1,0.8", "view": "1,0.5,2", "up": "0,1,0"}})");
  const std::string flags = " --height 3 --width 50 --tone '0,0.2;1,0.8' --view 1,0.5,2 --up 0,1,0";
  must_run("make p.relievo -o p.stl");
  must_run("make torus.ply -o t.stl" + flags);
  EXPECT_EQ(read_all(folder_ / "p.stl"), read_all(folder_ / "t.stl"));
  must_run("make p.relievo -o p.stl --height 2");
  write_all(folder_ / "l.relievo", R"({"relievo": 1, "input": {"path": "torus.ply"},
    "options": {"height": 3, "width": 50, "method": "layered"}})");
  must_run("make l.relievo -o l.stl --alpha 2");  // only the paper's method has an alpha
  must_run("make torus.ply -o t.stl --height 2" + flags.substr(std::string(" --height 3").size()));
  EXPECT_EQ(read_all(folder_ / "p.stl"), read_all(folder_ / "t.stl"));
}

class CliScenes : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write_all(folder_ / "scene.json", R"({"models": [
      {"file": "torus.ply", "rotate": [60, 0, 0], "translate": [0, 0, 1.5]},
      {"file": "torus.ply", "scale": 1.5, "mirror": true}]})");
  }
};

TEST_F(CliScenes, OfSeveralInputsAreARowAsASceneFileDescribesIt) {
  write_all(folder_ / "wedge.stl", ascii_stl());
  must_run("make torus.ply wedge.stl torus.ply -o row.stl --report r.json --points 20000 --quiet");
  const std::string report = read_all(folder_ / "r.json");
  for (const char* key : {"\"models\"", "\"model_to_scene\"", "\"wedge.stl\"", "\"torus.ply\""})
    EXPECT_TRUE(report.contains(key)) << key;
  fs::create_directory(folder_ / "models");
  fs::rename(folder_ / "wedge.stl", folder_ / "models/wedge.stl");
  write_all(folder_ / "models/row.json",
            R"({"models": [{"file": "../torus.ply"}, {"file": "wedge.stl"}, {"file": "../torus.ply"}]})");
  must_run("make models/row.json -o same.stl --points 20000 --quiet");
  EXPECT_EQ(read_all(folder_ / "row.stl"), read_all(folder_ / "same.stl"));
}

TEST_F(CliScenes, AreInputsOfAllCommandsAndOfProjects) {
  must_run("make scene.json -o scene.stl --quiet");
  write_all(folder_ / "p.relievo", R"({"relievo": 1, "input": {"path": "scene.json"}, "options": {}})");
  must_run("make p.relievo -o p.stl --quiet");
  EXPECT_EQ(read_all(folder_ / "p.stl"), read_all(folder_ / "scene.stl"));
  EXPECT_TRUE(run("compare scene.json --height 0.02 --methods layered").out.contains("layered"));
  EXPECT_TRUE(run("info scene.json").out.contains("models     2"));
}

TEST_F(CliScenes, AreRefusedWithOtherInputsWithoutAFileAndOverTheirInputs) {
  expect_refusal("make scene.json -o scene.json", "scene.json");
  expect_refusal("make torus.ply torus.ply -o torus.ply", "torus.ply: expected different files");
  expect_refusal("make scene.json torus.ply -o t.stl", "scene.json: expected a scene file alone");
  expect_refusal("make torus.ply gone.ply -o t.stl", "gone.ply");
}

TEST_F(Cli, WritesPlyAndObjToo) {
  must_run("make torus.ply -o t.ply --quiet");
  must_run("make torus.ply -o t.OBJ --quiet");
  must_run("make torus.ply -o t.stl --quiet");
  const ReadSolid stl = solid_in_stl(read_all(folder_ / "t.stl"));
  const ReadSolid ply = solid_in_ply(read_all(folder_ / "t.ply"));
  const ReadSolid obj = solid_in_obj(read_all(folder_ / "t.OBJ"));
  EXPECT_TRUE(stl.is_closed());
  EXPECT_TRUE(ply.triangles == stl.triangles);
  EXPECT_TRUE(obj.triangles == stl.triangles);
}

TEST_F(Cli, ReadsMeshesAndDepthImages) {
  write_all(folder_ / "t.stl", ascii_stl());
  EXPECT_TRUE(run("info t.stl").out.contains("triangles"));
  must_run("make t.stl -o m.stl --points 2000 --view 1,1,3 --quiet");
  const ReadSolid mesh = solid_in_stl(read_all(folder_ / "m.stl"));
  EXPECT_TRUE(mesh.is_closed());
  EXPECT_NEAR(mesh.box().size().head<2>().maxCoeff(), 100 + 2 * 5, 1e-2);
  Image16 dome{90, 60, 1, {}};
  for (int i = 0; i < 90 * 60; ++i) {
    const int x = i % 90 - 45, y = i / 90 - 30;
    dome.pixels.push_back(static_cast<std::uint16_t>(9000 - 2 * (x * x + y * y)));
  }
  write_all(folder_ / "d.png", write_png(dome));
  write_all(folder_ / "camera.txt", "90 0 45\n0 90 30\n0 0 1\n");
  EXPECT_TRUE(run("info d.png").out.contains("90 x 60"));
  must_run("make d.png -o a.stl --depth-values height --quiet");
  must_run("make d.png -o b.stl --camera camera.txt --quiet");
  for (const char* file : {"a.stl", "b.stl"}) {
    EXPECT_TRUE(solid_in_stl(read_all(folder_ / file)).is_closed()) << file;
    EXPECT_NEAR(stl_size(read_all(folder_ / file)).x(), 100 + 2 * 5, .2) << file;
  }
  expect_refusal("make d.png -o c.stl --camera 1,2", "--camera");
}

TEST_F(Cli, StreamsLargeFiles) {
  const Outcome outcome =
      must_run("make torus.ply -o t.stl --stream-above 0.1 --points 5000 --height 3 --report r.json");
  EXPECT_TRUE(outcome.err.contains("points for the 20000 of the file")) << outcome.err;
  EXPECT_TRUE(read_all(folder_ / "r.json").contains("\"means\""));
}

TEST_F(Cli, TellsWhatIsInAScan) {
  const Outcome outcome = must_run("info torus.ply");
  EXPECT_EQ(line_of(outcome.out, "points"), "20000");
  EXPECT_EQ(line_of(outcome.out, "format"), "PLY binary little endian");
  EXPECT_EQ(line_of(outcome.out, "normals"), "yes, pointing outwards");
  std::istringstream size(line_of(outcome.out, "size"));
  for (const double expected : {2.8, 2.8, .8}) {
    double side = 0;
    char comma = 0;
    size >> side >> comma;
    EXPECT_NEAR(side, expected, .01);
  }
  // The surface of the torus has the area 0.4 * 4 pi^2. The expected spacing is that of a square grid with
  // as many points on the same area.
  const double in_a_grid = 2 * std::numbers::pi * std::sqrt(.4 / 20000);
  EXPECT_NEAR(std::stod("0" + line_of(outcome.out, "spacing")) / in_a_grid, 1, .1);
}

TEST_F(Cli, GeneratesSamplesThatItCanRead) {
  must_run("sample shell -o s.ply --points 5000 --noise 0");
  EXPECT_TRUE(run("info s.ply").out.contains("5000"));
}

TEST_F(Cli, MakesReliefsByEveryMethod) {
  std::set<std::string> different;
  for (const MethodInfo& info : methods) {
    const std::string method(info.name);
    must_run("make torus.ply -o t.stl --height 2 --method " + method + " --report r.json");
    const nlohmann::json report = json_in(folder_ / "r.json");
    EXPECT_EQ(report.value("method", ""), method);
    EXPECT_NEAR(report.value("height_mm", 0.0), 2, 2e-3) << method;
    const std::string file = read_all(folder_ / "t.stl");
    EXPECT_NEAR(stl_size(file).z(), 3 + 2, 2e-3) << method;
    EXPECT_TRUE(solid_in_stl(file).is_closed()) << method;
    EXPECT_TRUE(different.insert(file).second) << method << " makes what another method makes";
  }
}

TEST_F(Cli, ComparesMethods) {
  fs::copy_file(folder_ / "torus.ply", folder_ / "a&b <torus>.ply");
  const Outcome outcome =
      must_run("compare 'a&b <torus>.ply' -o page.html --height 0.02,0.05 --methods layered,linear --json");
  EXPECT_TRUE(outcome.out.contains("\"shading\""));
  const std::string page = read_all(folder_ / "page.html");
  EXPECT_NE(page.find("<title>Reliefs of a&amp;b &lt;torus&gt;.ply</title>"), std::string::npos);
  EXPECT_EQ(count(page, "<tr>"), 1 + 2);  // a row of headings, and a row per height
  EXPECT_EQ(count(page, "src=\"data:image/png;base64,iVBORw0KG"), 1 + 4);  // the model and the reliefs
  EXPECT_EQ(count(page, "alt=\"Relief by linear, 5 % high\""), 1);
  const std::string table = run("compare torus.ply --height 0.05").out;
  for (const std::string_view name : compared_methods()) EXPECT_TRUE(table.contains(name)) << name;
  EXPECT_TRUE(run("compare torus.ply --height 0.05 --methods bounded --json").out.contains("\"weight 0."));
  expect_refusal("compare torus.ply -o c.png", "c.png: expected a file ending in .html");
  expect_refusal("compare torus.ply -o c.html --height 4",
                 "--height: expected fractions of the width, 0.0001 to 1, found 4");
}

TEST_F(Cli, HelpTellsRangesAndDefaults) {
  const std::string help = run("make --help").out;
  for (const char* part : {"--width", "--height", "--saturation", "--view", "[0.1 to 100000]", "=5",
                           "default: 100", "0.02 with method paper"})
    EXPECT_TRUE(help.contains(part)) << part;
  must_run("--help");
  EXPECT_TRUE(run("--version").out.contains("relievo "));
}

TEST_F(Cli, TakesDirectionsThatBeginWithAMinus) {
  must_run("make torus.ply -o t.stl --view -1,0.5,2 --up -1,0,0");
}

TEST_F(Cli, LengthsCarryAUnitOrAreInThatOfAll) {
  const std::string mm =
      "make torus.ply -o mm.stl --quiet --width 101.6 --height 6.35 --margin 10 --thickness 2 ";
  must_run(mm);
  const std::string expected = read_all(folder_ / "mm.stl");
  must_run("make torus.ply -o a.stl --quiet --width 4in --height 1/4in --margin 1cm --thickness 2mm");
  EXPECT_TRUE(read_all(folder_ / "a.stl") == expected);
  const Outcome inches = must_run(
      "make torus.ply -o b.stl --width 4 --height 1/4 --margin 1cm --thickness 2mm --units in --report "
      "r.json");
  EXPECT_TRUE(inches.err.contains("height 0.25 in")) << inches.err;
  EXPECT_TRUE(read_all(folder_ / "r.json").contains("\"units\": \"in\""));
  const std::string file = read_all(folder_ / "b.stl");
  EXPECT_TRUE(file.contains("unit in"));
  EXPECT_LT((25.4 * stl_size(file) - stl_size(expected)).norm(), 1e-4);
  expect_refusal("make torus.ply -o c.stl --width 4ft", "--width: expected a length");
  expect_refusal("make torus.ply -o c.stl --units ft", "--units: expected mm or in");
}

// A shift is two lengths. The option mm-per-value says millimetres in its name, so the unit does not apply to it.
TEST_F(Cli, AppliesTheUnitToAShiftAndNotToAScale) {
  const auto made = [&](const std::string& lengths) {
    must_run(
        "make torus.ply -o s.stl --quiet --method linear --mm-per-value 4 --width 50mm --report r.json " +
        lengths);
    return nlohmann::json::parse(read_all(folder_ / "r.json"));
  };
  const auto mm = made("--plate 127x101.6 --shift 12.7,-2.54"),
             inches = made("--plate 5x4 --shift 0.5,-0.1 --units in");
  EXPECT_EQ(inches["model_to_mm"], mm["model_to_mm"]);
  EXPECT_EQ(inches["height_mm"], mm["height_mm"]);
}

TEST_F(Cli, TellsWhatAToolReaches) {
  const Outcome made = must_run(
      "make torus.ply -o t.stl --height 4 --tool ball:1/8in --tool-picture t.png --report r.json --width 60");
  EXPECT_TRUE(made.err.contains("ball:3.175mm reaches")) << made.err;
  EXPECT_TRUE(read_all(folder_ / "r.json").contains("reached_share"));
  EXPECT_EQ(read_all(folder_ / "t.png").substr(1, 3), "PNG");
}

TEST_F(Cli, KeepsADraftAngleInInchesToo) {
  must_run("make torus.ply -o d.stl --height 8 --draft 40 --units mm --report r.json");
  must_run("make torus.ply -o e.stl --height 8mm --width 100mm --draft 40 --units in --quiet");
  double steepest = 0;
  for (const auto& [a, b, c] : solid_in_stl(read_all(folder_ / "e.stl")).triangles) {
    const Vec3 across = (b - a).cast<double>().cross((c - a).cast<double>());
    if (across.z() > 0) steepest = std::max(steepest, across.head<2>().norm() / across.z());
  }
  EXPECT_GT(steepest, std::tan(48 * std::numbers::pi / 180));
  EXPECT_LT(steepest, std::tan(50.01 * std::numbers::pi / 180));
}

TEST_F(Cli, TheTableOfThePageIsTheProgrammes) {
  const std::string page = read_all(fs::path(__FILE__).parent_path() / "../../docs/options.md");
  const std::string table = run("options --markdown").out;
  EXPECT_TRUE(table.starts_with("| flag | meaning | default |\n"));
  EXPECT_TRUE(page.contains(table)) << "docs/options.md has another table than `relievo options --markdown`";
}

TEST_F(Cli, OptionsAreAManPageAndJsonToo) {
  const std::string man = run("options --man make").out;
  EXPECT_TRUE(man.starts_with(".TH RELIEVO\\-MAKE 1"));
  const auto list = nlohmann::json::parse(run("options --json").out);
  ASSERT_EQ(list.size(), option_table().size());
  for (const auto& option : list) {
    std::string name = option["name"];
    for (std::size_t at = name.find('-'); at != std::string::npos; at = name.find('-', at + 2))
      name.insert(at, "\\");
    EXPECT_TRUE(man.contains(".BI \"\\-\\-" + name + " \" ")) << name;
    if (option["name"] == "detail") {
      EXPECT_EQ(option["default"]["paper"], .02);
      EXPECT_EQ(option["min"], 0);
    }
    if (option["name"] == "outline") EXPECT_EQ(option["choices"].size(), outline_choices.size());
  }
}

TEST_F(Cli, ManPagesAndCompletionAreOfKnownNames) {
  EXPECT_TRUE(run("options --man relievo").out.starts_with(".TH RELIEVO 1"));
  EXPECT_TRUE(run("options --completion fish").out.contains("-l outline"));
}

}  // namespace
}  // namespace relievo
