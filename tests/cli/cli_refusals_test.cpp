// Tests mistakes that users of the program make. The program must print one line, return an error's exit
// code, and leave no file.
#include "relievo/io/write.h"
#include "support/cli_folder.h"
#include "support/format_samples.h"

namespace relievo {
namespace {

using namespace test;

using CliRefusals = CliFolder;

TEST_F(CliRefusals, TruncatedFilesOfEveryFormatAreRefused) {
  for (const auto& [name, bytes] : format_samples()) {
    write_all(folder_ / name, bytes.substr(0, bytes.size() * 2 / 3));
    expect_refusal("make -o t.stl --preview t.png " + name, name);
  }
}

TEST_F(CliRefusals, IsSilentWhenToldTo) {
  const Outcome outcome = run("make torus.ply -o t.stl --quiet");
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(CliRefusals, RefusesBadInput) {
  write_all(folder_ / "three.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  write_all(folder_ / "equal.xyz", "1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n");
  const std::string torus = read_all(folder_ / "torus.ply");
  write_all(folder_ / "cut.ply", torus.substr(0, torus.size() / 2));
  for (const char* file : {"three.xyz", "equal.xyz", "cut.ply"})
    expect_refusal("make " + std::string(file) + " -o t.stl --preview p.png", file);
  expect_refusal("make torus.ply -o t.stl --height 5000", "at most");
  expect_refusal("info missing.ply", "missing.ply");
  expect_refusal("make torus.ply -o t.stl --height", "--height: expected a value, found none");
}

TEST_F(CliRefusals, LeavesOutPointsThatAreNotFiniteAndSaysSo) {
  std::string text = "nan 0 0\n0 inf 0\n";
  for (const Vec3& p : test::sphere(3000, 1).points)
    text += std::to_string(p.x()) + ' ' + std::to_string(p.y()) + ' ' + std::to_string(p.z()) + '\n';
  write_all(folder_ / "nan.xyz", text);
  const Outcome outcome = must_run("make nan.xyz -o t.stl");
  EXPECT_TRUE(outcome.err.contains("left out 2 points")) << outcome.err;
  EXPECT_TRUE(outcome.err.contains("estimated")) << outcome.err;
}

TEST_F(CliRefusals, RefusesToOverwriteItsInputOrItsOutputs) {
  const std::string torus = read_all(folder_ / "torus.ply");
  expect_refusal("make torus.ply -o ./../$(basename $PWD)/torus.ply", "different files");
  expect_refusal("make torus.ply -o t.stl --preview p.png --heightmap ./p.png", "different files");
  EXPECT_EQ(read_all(folder_ / "torus.ply"), torus);
}

TEST_F(CliRefusals, SaysWhichPointsItLeftOutForTheirNormals) {
  Cloud cloud = test::torus(20000, 1, .4);
  cloud.normals[5].setZero();
  write_all(folder_ / "torus.ply", write_ply(cloud));
  EXPECT_TRUE(run("make torus.ply -o t.stl").err.contains("left out 1 points without a usable normal"));
}

}  // namespace
}  // namespace relievo
