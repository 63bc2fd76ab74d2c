// The program as its users misuse it: exit codes, one line about what is wrong, nothing left behind.
#include <cstring>

#include "relievo/io/write.h"
#include "support/cli_folder.h"
#include "support/format_samples.h"

namespace relievo {
namespace {

using namespace test;

using CliRefusals = CliFolder;

TEST_F(CliRefusals, TruncatedFilesOfEveryFormatAreRefused) {
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

TEST_F(CliRefusals, IsSilentWhenToldTo) {
  const Outcome outcome = run("make torus.ply -o t.stl --quiet");
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(CliRefusals, RefusesBadInput) {
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

TEST_F(CliRefusals, LeavesOutPointsThatAreNotFiniteAndSaysSo) {
  std::string text = "nan 0 0\n0 inf 0\n";
  for (const Vec3& p : test::sphere(3000, 1).points)
    text += std::to_string(p.x()) + ' ' + std::to_string(p.y()) + ' ' + std::to_string(p.z()) + '\n';
  write_all(folder_ / "nan.xyz", text);
  const Outcome outcome = run("make nan.xyz -o t.stl");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("left out 2 points"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("estimated"), std::string::npos) << outcome.err;
}

TEST_F(CliRefusals, RefusesAPlaceItCannotWriteTo) {
  expect_refusal("make torus.ply -o nowhere/t.stl", "nowhere");
  fs::create_directory(folder_ / "folder.stl");
  expect_refusal("make torus.ply -o folder.stl", "folder");
  if (::geteuid() == 0) GTEST_SKIP() << "root may write to read-only folders";
  fs::create_directory(folder_ / "locked");
  fs::permissions(folder_ / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  expect_refusal("make torus.ply -o locked/t.stl", "locked");
}

// A limit on the size of files stands for a full disk.
TEST_F(CliRefusals, LeavesNothingHalfWrittenOnAFullDisk) {
  expect_refusal("make torus.ply -o t.stl", "t.stl", "trap '' XFSZ; ulimit -f 100;");
}

// The limit lets the solid pass and stops the height map, which is larger.
TEST_F(CliRefusals, WritesAllFilesOrNone) {
  const std::string limit = "trap '' XFSZ; ulimit -f 4000;";
  EXPECT_EQ(run("make torus.ply -o t.stl --resolution 2", limit).exit_code, 0);
  fs::remove(folder_ / "t.stl");
  expect_refusal("make torus.ply -o t.stl --resolution 2 --heightmap h.png --heightmap-size 4096", "h.png",
                 limit);
}

// The signal of a file that grows too large stands for Ctrl-C: it comes in the middle of writing for sure.
TEST_F(CliRefusals, LeavesNothingHalfWrittenWhenASignalEndsIt) {
  EXPECT_NE(run("make torus.ply -o t.stl", "ulimit -c 0; ulimit -f 100;").exit_code, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(CliRefusals, RefusesToOverwriteItsInputOrItsOutputs) {
  const std::string torus = read_all(folder_ / "torus.ply");
  expect_refusal("make torus.ply -o torus.ply", "different files");
  expect_refusal("make torus.ply -o ./../$(basename $PWD)/torus.ply", "different files");
  expect_refusal("make torus.ply -o t.stl --preview p.png --heightmap ./p.png", "different files");
  expect_refusal("make torus.ply -o t.stl --report /dev/null", "device");
  EXPECT_EQ(read_all(folder_ / "torus.ply"), torus);
}

TEST_F(CliRefusals, SaysWhichPointsItLeftOutForTheirNormals) {
  Cloud cloud = test::torus(20000, 1, .4);
  cloud.normals[5].setZero();
  const std::vector<std::byte> bytes = write_ply(cloud);
  write_all(folder_ / "torus.ply", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  EXPECT_NE(run("make torus.ply -o t.stl").err.find("left out 1 points without a usable normal"),
            std::string::npos);
}

TEST_F(CliRefusals, KeepsTheOldFileOnFailure) {
  write_all(folder_ / "t.stl", "old");
  EXPECT_GT(run("make torus.ply -o t.stl", "trap '' XFSZ; ulimit -f 100;").exit_code, 0);
  EXPECT_EQ(read_all(folder_ / "t.stl"), "old");
}

}  // namespace
}  // namespace relievo
