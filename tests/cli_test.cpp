// The program as its users run it: exit codes, what it says and where, what it leaves behind.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "format_samples.h"
#include "relievo/io.h"
#include "relievo/preview.h"
#include "shapes.h"

namespace relievo {
namespace {

namespace fs = std::filesystem;

std::string read_all(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_all(const fs::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

struct Outcome {
  int exit_code = 0;
  std::string out, err;
};

class Cli : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = fs::temp_directory_path() / "relievo-cli-XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    const std::vector<std::byte> bytes = write_ply(test::torus(20000, 1, .4));
    write_all(folder_ / "torus.ply", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  // Runs `relievo ARGUMENTS` in the test's folder.
  Outcome run(const std::string& arguments, const std::string& before = "") const {
    const fs::path out = folder_.string() + ".out", err = folder_.string() + ".err";
    const std::string command = "cd '" + folder_.string() + "' && " + before + " '" RELIEVO_CLI "' " +
                                arguments + " >'" + out.string() + "' 2>'" + err.string() + "' </dev/null";
    const int status = std::system(command.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_all(out), read_all(err)};
    fs::remove(out);
    fs::remove(err);
    return outcome;
  }

  // Expects failure with one line on stderr that holds `part`, and nothing new in the folder.
  void expect_refusal(const std::string& arguments, const std::string& part,
                      const std::string& before = "") const {
    const auto files = [&] { return std::distance(fs::directory_iterator(folder_), {}); };
    const auto before_run = files();
    const Outcome outcome = run(arguments, before);
    EXPECT_GT(outcome.exit_code, 0) << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files(), before_run) << arguments;
  }

  fs::path folder_;
};

TEST_F(Cli, MakesEverythingAskedFor) {
  const Outcome outcome =
      run("make torus.ply -o t.stl --preview t.png --heightmap h.png --heightmap-size 100 --report r.json "
          "--height 3 --width 50");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* file : {"t.stl", "t.png", "h.png", "r.json"})
    EXPECT_GT(fs::file_size(folder_ / file), 100U) << file;
  const std::string report = read_all(folder_ / "r.json");
  for (const char* key : {"input_points", "visible_points", "rho", "diagonal", "alpha", "beta", "gamma",
                          "height_requested_mm", "height_mm", "seconds", "threads", "version", "model_to_mm",
                          "rotation", "scale", "offset", "size_mm"})
    EXPECT_NE(report.find('"' + std::string(key) + '"'), std::string::npos) << key;
}

TEST_F(Cli, MakesProjects) {
  write_all(folder_ / "p.relievo", R"({"relievo": 1, "input": {"path": "torus.ply"}, "studio": {"any": 1},
    "options": {"height": 3, "width": 50, "tone": "0,0.2;1,0.8", "view": "1,0.5,2", "up": "0,1,0"}})");
  const std::string flags = " --height 3 --width 50 --tone '0,0.2;1,0.8' --view 1,0.5,2 --up 0,1,0";
  EXPECT_EQ(run("make p.relievo -o p.stl").exit_code, 0);
  EXPECT_EQ(run("make torus.ply -o t.stl" + flags).exit_code, 0);
  EXPECT_EQ(read_all(folder_ / "p.stl"), read_all(folder_ / "t.stl"));
  EXPECT_EQ(run("make p.relievo -o p.stl --height 2").exit_code, 0);
  EXPECT_EQ(
      run("make torus.ply -o t.stl --height 2" + flags.substr(std::string(" --height 3").size())).exit_code,
      0);
  EXPECT_EQ(read_all(folder_ / "p.stl"), read_all(folder_ / "t.stl"));
}

TEST_F(Cli, RefusesWrongProjects) {
  const auto refuse = [&](const std::string& project, const std::string& part) {
    write_all(folder_ / "p.relievo", project);
    expect_refusal("make p.relievo -o p.stl", part);
  };
  refuse("not json", "p.relievo: expected a project in JSON");
  refuse(R"({"relievo": 2})", "p.relievo, relievo: expected a project of version 1");
  refuse(R"({"relievo": 1, "options": {}})", "p.relievo, input: expected an object");
  refuse(R"({"relievo": 1, "input": {}, "options": {}})", "expected either a path or a sample");
  refuse(R"({"relievo": 1, "input": {"sample": "shell"}, "options": {"heigth": 1}})", "found 'heigth'");
  refuse(R"({"relievo": 1, "input": {"sample": "shell"}, "options": {"height": "1"}})", "options.height");
  refuse(R"({"relievo": 1, "input": {"sample": "shell"}, "options": {"height": -1}})", "--height");
  refuse(R"({"relievo": 1, "input": {"path": "torus.ply", "hash": "fnv1a64:0"}, "options": {}})",
         "expected the file as it was");
  refuse(R"({"relievo": 1, "input": {"path": "gone.ply"}, "options": {}})", "gone.ply");
}

TEST_F(Cli, MakesScenes) {
  write_all(folder_ / "wedge.stl", ascii_stl());
  EXPECT_EQ(
      run("make torus.ply wedge.stl torus.ply -o row.stl --report r.json --points 20000 --quiet").exit_code,
      0);
  const std::string report = read_all(folder_ / "r.json");
  for (const char* key : {"\"models\"", "\"model_to_scene\"", "\"wedge.stl\"", "\"torus.ply\""})
    EXPECT_NE(report.find(key), std::string::npos) << key;
  fs::create_directory(folder_ / "models");
  fs::rename(folder_ / "wedge.stl", folder_ / "models/wedge.stl");
  write_all(folder_ / "models/row.json",
            R"({"models": [{"file": "../torus.ply"}, {"file": "wedge.stl"}, {"file": "../torus.ply"}]})");
  EXPECT_EQ(run("make models/row.json -o same.stl --points 20000 --quiet").exit_code, 0);
  EXPECT_EQ(read_all(folder_ / "row.stl"), read_all(folder_ / "same.stl"));
  write_all(folder_ / "scene.json", R"({"models": [
    {"file": "torus.ply", "rotate": [60, 0, 0], "translate": [0, 0, 1.5]},
    {"file": "torus.ply", "scale": 1.5, "mirror": true}]})");
  EXPECT_EQ(run("make scene.json -o scene.stl --quiet").exit_code, 0);
  write_all(folder_ / "p.relievo", R"({"relievo": 1, "input": {"path": "scene.json"}, "options": {}})");
  EXPECT_EQ(run("make p.relievo -o p.stl --quiet").exit_code, 0);
  EXPECT_EQ(read_all(folder_ / "p.stl"), read_all(folder_ / "scene.stl"));
  EXPECT_NE(run("compare scene.json --height 0.02 --methods ours").out.find("ours"), std::string::npos);
  EXPECT_NE(run("info scene.json").out.find("models     2"), std::string::npos);
  expect_refusal("make scene.json -o scene.json", "scene.json");
  expect_refusal("make torus.ply torus.ply -o torus.ply", "torus.ply: expected different files");
  expect_refusal("make scene.json torus.ply -o t.stl", "scene.json: expected a scene file alone");
  expect_refusal("make torus.ply gone.ply -o t.stl", "gone.ply");
}

TEST_F(Cli, RefusesBrokenScenes) {
  const auto refuse = [&](const std::string& scene, const std::string& part) {
    write_all(folder_ / "s.json", scene);
    expect_refusal("make s.json -o t.stl", "relievo: s.json" + part);
  };
  const auto refuse_model = [&](const std::string& rest, const std::string& part) {
    refuse(R"({"models": [{"file": "torus.ply"}, {"file": "torus.ply", )" + rest + "}]}",
           ", models[1]" + part);
  };
  refuse("", ": expected a scene in JSON");
  refuse("{\"models\": [", ": expected a scene in JSON");
  refuse("[]", ": expected a scene in JSON");
  refuse("{}", ", models: expected a list of at least one model");
  refuse(R"({"models": []})", ", models: expected a list of at least one model");
  refuse(R"({"models": {"file": "torus.ply"}})", ", models: expected a list");
  refuse(R"({"models": [{"file": "torus.ply"}], "model": 1})",
         ": expected only the key models, found 'model'");
  refuse(R"({"models": ["torus.ply"]})", ", models[0]: expected an object");
  refuse(R"({"models": [{"scale": 1}]})", ", models[0].file: expected the name of a file");
  refuse(R"({"models": [{"file": 1}]})", ", models[0].file: expected the name of a file");
  refuse(R"({"models": [{"file": "gone.ply"}]})",
         ", models[0].file: expected a file that is there, found no 'gone.ply'");
  refuse_model(R"("rotation": [0, 0, 0])",
               ": expected only the keys file, rotate, translate, scale, mirror, found 'rotation'");
  refuse_model(R"("rotate": 60)", ".rotate: expected three angles in degrees");
  refuse_model(R"("rotate": [0, 60])", ".rotate: expected three angles in degrees");
  refuse_model(R"("rotate": [0, "60", 0])", ".rotate: expected three angles in degrees");
  refuse_model(R"("translate": [1, 2, null])", ".translate: expected three lengths");
  refuse_model(R"("scale": "2")", ".scale: expected a number from 1e-06 to 1e+06");
  refuse_model(R"("scale": 0)", ".scale: expected a number from 1e-06 to 1e+06");
  refuse_model(R"("mirror": 1)", ".mirror: expected true or false");
  write_all(folder_ / "cut.ply", "ply\n");
  write_all(folder_ / "s.json", R"({"models": [{"file": "torus.ply"}, {"file": "cut.ply"}]})");
  expect_refusal("make s.json -o t.stl", "cut.ply");
}

TEST_F(Cli, WritesPlyAndObjToo) {
  EXPECT_EQ(run("make torus.ply -o t.ply --quiet").exit_code, 0);
  EXPECT_EQ(run("make torus.ply -o t.OBJ --quiet").exit_code, 0);
  EXPECT_EQ(read_all(folder_ / "t.ply").substr(0, 4), "ply\n");
  EXPECT_NE(read_all(folder_ / "t.OBJ").find("\nv "), std::string::npos);
}

TEST_F(Cli, IsTheSameForAnyNumberOfThreads) {
  EXPECT_EQ(run("make torus.ply -o a.stl --threads 1").exit_code, 0);
  EXPECT_EQ(run("make torus.ply -o b.stl --threads 2").exit_code, 0);
  EXPECT_EQ(read_all(folder_ / "a.stl"), read_all(folder_ / "b.stl"));
}

TEST_F(Cli, Writes3mfAndTiff) {
  EXPECT_EQ(
      run("make torus.ply -o t.3mf --heightmap h.tif --tolerance 0.05 --report r.json --quiet").exit_code, 0);
  EXPECT_EQ(read_all(folder_ / "t.3mf").substr(0, 4), "PK\3\4");
  EXPECT_EQ(read_all(folder_ / "h.tif").substr(0, 2), "II");
  EXPECT_NE(read_all(folder_ / "r.json").find("\"simplification_error_mm\": 0.0"), std::string::npos);
}

TEST_F(Cli, MakesEveryForm) {
  for (const std::string form : {"mirror", "die", "lithophane"})
    EXPECT_EQ(run("make torus.ply --quiet --height 2 --form " + form + " -o " + form + ".stl").exit_code, 0)
        << form;
  EXPECT_NE(read_all(folder_ / "mirror.stl"), read_all(folder_ / "die.stl"));
  expect_refusal("make torus.ply -o t.stl --form coin", "--form");
}

TEST_F(Cli, ReadsMeshesAndDepthImages) {
  write_all(folder_ / "t.stl", ascii_stl());
  EXPECT_NE(run("info t.stl").out.find("triangles"), std::string::npos);
  EXPECT_EQ(run("make t.stl -o m.stl --points 2000 --view 1,1,1 --quiet").exit_code, 0);
  Image16 dome{90, 60, 1, {}};
  for (int i = 0; i < 90 * 60; ++i) {
    const int x = i % 90 - 45, y = i / 90 - 30;
    dome.pixels.push_back(static_cast<std::uint16_t>(9000 - 2 * (x * x + y * y)));
  }
  const std::vector<std::byte> png = write_png(dome);
  write_all(folder_ / "d.png", {reinterpret_cast<const char*>(png.data()), png.size()});
  write_all(folder_ / "camera.txt", "90 0 45\n0 90 30\n0 0 1\n");
  EXPECT_NE(run("info d.png").out.find("90 x 60"), std::string::npos);
  EXPECT_EQ(run("make d.png -o a.stl --depth-values height --quiet").exit_code, 0);
  EXPECT_EQ(run("make d.png -o b.stl --camera camera.txt --quiet").exit_code, 0);
  expect_refusal("make d.png -o c.stl --camera 1,2", "--camera");
  expect_refusal("make d.png -o c.stl --depth-values far", "--depth-values");
  expect_refusal("make d.png -o c.stl --background cut", "--background");
}

TEST_F(Cli, StreamsLargeFiles) {
  EXPECT_EQ(run("make torus.ply -o whole.stl --quiet --height 3").exit_code, 0);
  const Outcome outcome =
      run("make torus.ply -o t.stl --stream-above 0.1 --points 5000 --height 3 --report r.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("points for the 20000 of the file"), std::string::npos) << outcome.err;
  EXPECT_NE(read_all(folder_ / "r.json").find("\"means\""), std::string::npos);
}

TEST_F(Cli, TruncatedFilesOfEveryFormatAreRefused) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.stl", binary_stl()}, {"b.stl", ascii_stl()},      {"a.off", off()},
      {"a.glb", glb()},        {"a.gltf", embedded_gltf()}, {"a.pcd", ascii_pcd()},
      {"b.pcd", binary_pcd()}, {"c.pcd", compressed_pcd()}, {"a.las", las(2)},
      {"b.las", las(4)}};
  for (const auto& [name, text] : files) {
    write_all(folder_ / name, text.substr(0, text.size() * 2 / 3));
    expect_refusal("make -o t.stl --preview t.png " + name, name);
  }
}

TEST_F(Cli, IsSilentWhenToldTo) {
  const Outcome outcome = run("make torus.ply -o t.stl --quiet");
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(Cli, TellsWhatIsInAScan) {
  const Outcome outcome = run("info torus.ply");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("20000"), std::string::npos);
  EXPECT_NE(outcome.out.find("outwards"), std::string::npos);
}

TEST_F(Cli, GeneratesSamplesThatItCanRead) {
  EXPECT_EQ(run("sample shell -o s.ply --points 5000 --noise 0").exit_code, 0);
  EXPECT_NE(run("info s.ply").out.find("5000"), std::string::npos);
}

TEST_F(Cli, MakesReliefsByEveryMethod) {
  for (const std::string method : {"ours", "raised", "paper", "linear", "equalise", "gradient", "detail"}) {
    const Outcome outcome = run("make torus.ply -o t.stl --height 2 --method " + method + " --report r.json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(read_all(folder_ / "r.json").find("\"method\": \"" + method + '"'), std::string::npos);
  }
  expect_refusal("make torus.ply -o u.stl --method linear", "--height");
}

TEST_F(Cli, ComparesMethods) {
  const Outcome outcome = run("compare torus.ply -o s.png --height 0.02,0.05 --methods ours,linear --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\"shading\""), std::string::npos);
  EXPECT_EQ(read_all(folder_ / "s.png").substr(1, 3), "PNG");
  EXPECT_NE(run("compare torus.ply --height 0.05").out.find("gradient"), std::string::npos);
  expect_refusal("compare torus.ply -o c.png --methods carving", "carving");
  expect_refusal("compare torus.ply -o c.jpg", "c.jpg");
  expect_refusal("compare torus.ply -o c.png --height 0", "--height");
}

TEST_F(Cli, HelpTellsRangesAndDefaults) {
  const std::string help = run("make --help").out;
  for (const char* part :
       {"--width", "--height", "--saturation", "--view", "[0.1 to 100000]", "=100", "default 0.02"})
    EXPECT_NE(help.find(part), std::string::npos) << part;
  EXPECT_EQ(run("--help").exit_code, 0);
  EXPECT_NE(run("--version").out.find("relievo "), std::string::npos);
}

TEST_F(Cli, RefusesMisuse) {
  expect_refusal("", "A subcommand is required");
  expect_refusal("carve", "carve");
  expect_refusal("make", "required");
  expect_refusal("make torus.ply -o t.stl --width -5", "--width");
  expect_refusal("make torus.ply -o t.stl --height 0", "--height");
  expect_refusal("make torus.ply -o t.stl --height 3 --alpha 2", "--alpha");
  expect_refusal("make torus.ply -o t.stl --thickness abc", "--thickness");
  expect_refusal("make torus.ply -o t.stl --view sideways", "sideways");
  expect_refusal("make torus.ply -o t.xyz", "t.xyz");
  expect_refusal("make torus.ply -o t.stl --preview t.jpg", "t.jpg");
  expect_refusal("sample nothing -o s.ply", "shell");
  expect_refusal("sample shell -o s.ply --points 3", "points");
}

TEST_F(Cli, RefusesBadInput) {
  write_all(folder_ / "empty.ply", "");
  write_all(folder_ / "huge.ply",
            "ply\nformat binary_little_endian 1.0\nelement vertex 1152921504606846976\nproperty float "
            "x\nproperty float y\n"
            "property float z\nend_header\n");
  write_all(folder_ / "three.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  write_all(folder_ / "equal.xyz", "1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n");
  write_all(folder_ / "line.xyz", "0 0 0\n1 1 1\n2 2 2\n3 3 3\n4 4 4\n");
  const std::string torus = read_all(folder_ / "torus.ply");
  write_all(folder_ / "cut.ply", torus.substr(0, torus.size() / 2));
  for (const char* file :
       {"missing.ply", "empty.ply", "huge.ply", "three.xyz", "equal.xyz", "line.xyz", "cut.ply"})
    expect_refusal("make " + std::string(file) + " -o t.stl --preview p.png", file);
  expect_refusal("make torus.ply -o t.stl --height 5000", "at most");
  expect_refusal("info missing.ply", "missing.ply");
}

TEST_F(Cli, LeavesOutPointsThatAreNotFiniteAndSaysSo) {
  std::string text = "nan 0 0\n0 inf 0\n";
  for (const Vec3& p : test::sphere(3000, 1).points)
    text += std::to_string(p.x()) + ' ' + std::to_string(p.y()) + ' ' + std::to_string(p.z()) + '\n';
  write_all(folder_ / "nan.xyz", text);
  const Outcome outcome = run("make nan.xyz -o t.stl");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("left out 2 points"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("estimated"), std::string::npos) << outcome.err;
}

TEST_F(Cli, RefusesAPlaceItCannotWriteTo) {
  expect_refusal("make torus.ply -o nowhere/t.stl", "nowhere");
  fs::create_directory(folder_ / "folder.stl");
  expect_refusal("make torus.ply -o folder.stl", "folder");
  if (::geteuid() == 0) GTEST_SKIP() << "root may write to read-only folders";
  fs::create_directory(folder_ / "locked");
  fs::permissions(folder_ / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  expect_refusal("make torus.ply -o locked/t.stl", "locked");
}

// A limit on the size of files stands for a full disk.
TEST_F(Cli, LeavesNothingHalfWrittenOnAFullDisk) {
  expect_refusal("make torus.ply -o t.stl", "t.stl", "trap '' XFSZ; ulimit -f 100;");
}

// The limit lets the solid pass and stops the height map, which is larger.
TEST_F(Cli, WritesAllFilesOrNone) {
  const std::string limit = "trap '' XFSZ; ulimit -f 4000;";
  EXPECT_EQ(run("make torus.ply -o t.stl", limit).exit_code, 0);
  fs::remove(folder_ / "t.stl");
  expect_refusal("make torus.ply -o t.stl --heightmap h.png --heightmap-size 4096", "h.png", limit);
}

// The signal of a file that grows too large stands for Ctrl-C: it comes in the middle of writing for sure.
TEST_F(Cli, LeavesNothingHalfWrittenWhenASignalEndsIt) {
  EXPECT_NE(run("make torus.ply -o t.stl", "ulimit -c 0; ulimit -f 100;").exit_code, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(Cli, RefusesToOverwriteItsInputOrItsOutputs) {
  const std::string torus = read_all(folder_ / "torus.ply");
  expect_refusal("make torus.ply -o torus.ply", "different files");
  expect_refusal("make torus.ply -o ./../$(basename $PWD)/torus.ply", "different files");
  expect_refusal("make torus.ply -o t.stl --preview p.png --heightmap ./p.png", "different files");
  expect_refusal("make torus.ply -o t.stl --report /dev/null", "device");
  EXPECT_EQ(read_all(folder_ / "torus.ply"), torus);
}

TEST_F(Cli, TakesDirectionsThatBeginWithAMinus) {
  EXPECT_EQ(run("make torus.ply -o t.stl --view -1,0.5,2 --up -1,0,0").exit_code, 0);
}

TEST_F(Cli, SaysWhichPointsItLeftOutForTheirNormals) {
  Cloud cloud = test::torus(20000, 1, .4);
  cloud.normals[5].setZero();
  const std::vector<std::byte> bytes = write_ply(cloud);
  write_all(folder_ / "torus.ply", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  EXPECT_NE(run("make torus.ply -o t.stl").err.find("left out 1 points without a usable normal"),
            std::string::npos);
}

TEST_F(Cli, KeepsTheOldFileOnFailure) {
  write_all(folder_ / "t.stl", "old");
  EXPECT_GT(run("make torus.ply -o t.stl", "trap '' XFSZ; ulimit -f 100;").exit_code, 0);
  EXPECT_EQ(read_all(folder_ / "t.stl"), "old");
}

// Extent of a binary STL's corners.
Vec3 stl_size(const std::string& file) {
  Box box;
  for (std::size_t at = 84; at + 50 <= file.size(); at += 50) {
    std::array<float, 9> v{};
    std::memcpy(v.data(), file.data() + at + 12, sizeof v);
    for (std::size_t i = 0; i < 9; i += 3) box.extend(Vec3f(v[i], v[i + 1], v[i + 2]).cast<double>());
  }
  return box.size();
}

TEST_F(Cli, LengthsCarryAUnitOrAreInThatOfAll) {
  const std::string mm =
      "make torus.ply -o mm.stl --quiet --width 76.2 --height 6.35 --margin 10 --thickness 2 ";
  ASSERT_EQ(run(mm).exit_code, 0);
  const std::string expected = read_all(folder_ / "mm.stl");
  ASSERT_EQ(run("make torus.ply -o a.stl --quiet --width 3in --height 1/4in --margin 1cm --thickness 2mm")
                .exit_code,
            0);
  EXPECT_EQ(read_all(folder_ / "a.stl"), expected);
  const Outcome inches =
      run("make torus.ply -o b.stl --width 3 --height 1/4 --margin 1cm --thickness 2mm --units in --report "
          "r.json");
  ASSERT_EQ(inches.exit_code, 0) << inches.err;
  EXPECT_NE(inches.err.find("height 0.25 in"), std::string::npos) << inches.err;
  EXPECT_NE(read_all(folder_ / "r.json").find("\"units\": \"in\""), std::string::npos);
  const std::string file = read_all(folder_ / "b.stl");
  EXPECT_NE(file.find("unit in"), std::string::npos);
  EXPECT_LT((25.4 * stl_size(file) - stl_size(expected)).norm(), 1e-4);
  expect_refusal("make torus.ply -o c.stl --width 4ft", "--width: expected a length");
  expect_refusal("make torus.ply -o c.stl --units ft", "--units: expected mm or in");
}

TEST_F(Cli, TellsWhatAToolReaches) {
  const Outcome made = run(
      "make torus.ply -o t.stl --height 4 --tool ball:1/8in --tool-picture t.png --report r.json --width 60");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("ball:3.175mm reaches"), std::string::npos) << made.err;
  EXPECT_NE(read_all(folder_ / "r.json").find("reached_share"), std::string::npos);
  EXPECT_EQ(read_all(folder_ / "t.png").substr(1, 3), "PNG");
  expect_refusal("make torus.ply -o u.stl --tool drill:3", "--tool");
  expect_refusal("make torus.ply -o u.stl --surface reachable", "--surface");
  expect_refusal("make torus.ply -o u.stl --tool-picture u.png", "--tool-picture");
}

TEST_F(Cli, KeepsADraftAngleInInchesToo) {
  ASSERT_EQ(run("make torus.ply -o d.stl --height 9 --draft 40 --units mm --report r.json").exit_code, 0);
  ASSERT_EQ(run("make torus.ply -o e.stl --height 9mm --width 100mm --draft 40 --units in --quiet").exit_code,
            0);
  const std::string file = read_all(folder_ / "e.stl");
  double steepest = 0;
  for (std::size_t at = 84; at + 50 <= file.size(); at += 50) {
    std::array<float, 9> v{};
    std::memcpy(v.data(), file.data() + at + 12, sizeof v);
    const Vec3 p(v[3] - v[0], v[4] - v[1], v[5] - v[2]), q(v[6] - v[0], v[7] - v[1], v[8] - v[2]);
    const double area = p.x() * q.y() - p.y() * q.x();  // of walls and bottom 0 or less
    const Vec2 slope(p.z() * q.y() - q.z() * p.y(), q.z() * p.x() - p.z() * q.x());
    if (area > 0) steepest = std::max(steepest, slope.norm() / area);
  }
  EXPECT_GT(steepest, std::tan(48 * std::numbers::pi / 180));
  EXPECT_LT(steepest, std::tan(50.01 * std::numbers::pi / 180));
}

}  // namespace
}  // namespace relievo
