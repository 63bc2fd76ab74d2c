#include "relievo/io/read.h"
#include "relievo/io/write.h"

#include <cctype>

#include "support/read_text.h"
#include "support/shared_scans.h"

namespace relievo {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();

TEST(ReadCloud, UnreadableFormatsAreToldByName) {
  const std::vector<std::array<std::string, 3>> all = {
      {"", "scan.ply", "an empty file"},
      {"\xEF\xBB\xBF", "scan.ply", "an empty file"},
      {"\x89PNG\r\n\x1A\n", "scan.ply", "a PNG picture"},
      {"\xFF\xD8\xFF\xE0", "scan", "a JPEG picture"},
      {"\x76\x2F\x31\x01", "a.exr", "an OpenEXR picture; save it as a TIFF of 32-bit fractions"},
      {"RIFF\1\1\1\1WEBPVP8 ", "a.webp", "a WebP picture; save it as PNG"},
      {"\1\1\1\x18"
       "ftypheic",
       "a.heic", "a HEIC or AVIF picture, or a video; save a picture as PNG"},
      {"12", "a.raw", "numbers or a photo without a header; save heights as NPY or TIFF, a photo as PNG"},
      {"PK\x03\x04", "scan.zip", "a ZIP archive"},
      {"\x1F\x8B\x08", "scan.ply.gz", "a gzip archive"},
      {"PK\x03\x04", "a.npz", "a NumPy archive; np.save writes one of its arrays as NPY"},
      {"PK\x03\x04", "scan.usdz", "a USD file; Blender exports it as glTF or PLY"},
      {"<COLLADA/>", "scan.dae", "a COLLADA file; Blender exports it as glTF or PLY"},
      {"ISO-10303-21;", "scan.step", "a STEP file; FreeCAD exports it as STL"},
      {"<!doctype html>\n", "scan.ply", "an XML or HTML file"},
      {"1 2 3\n", "scan.ply", "a file that does not begin with the line 'ply'"},
      {std::string("1 2\0 3\n", 7), "scan.xyz", "binary data"},
      {"\xFF\xFE"
       "1",
       "scan.xyz", "UTF-16 text"},
  };
  for (const auto& [text, name, what] : all) {
    const std::string message = message_of(text, name);
    EXPECT_TRUE(message.starts_with(name + ": expected a point cloud (PLY, ")) << message;
    EXPECT_TRUE(message.contains("), mesh (PLY, ") && message.ends_with("), found " + what)) << message;
  }
}

TEST(ReadCloud, ContentGoesBeforeTheName) {
  Cloud cloud{{{1, 2, 3}}, {}};
  EXPECT_EQ(read(as_string(write_ply(cloud)), "scan.xyz")->format, "PLY binary little endian");
  EXPECT_EQ(read("1 2 3\n", "")->format, "XYZ text, 3 columns");
  EXPECT_EQ(read("1 2 3\n", "scan.csv")->format, "XYZ text, 3 columns");
  EXPECT_EQ(read("v 1 2 3\n", "scan.OBJ")->format, "OBJ");
}

// Writes a cloud by write_ply(), which does not check the cloud. Returns the file as the reader reads it.
CloudFile through_ply(const Cloud& cloud) {
  return file_of(as_string(write_ply(cloud)), "scan.ply");
}

TEST(ReadCloud, DropsAndCountsPointsThatAreNotFinite) {
  const CloudFile file = through_ply({{{0, 1, 2}, {nan, 1, 2}, {3, inf, 4}, {5, 6, 7}, {0, 0, -inf}}, {}});
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{0, 1, 2}, {5, 6, 7}}));
  EXPECT_EQ(file.dropped_points, 3U);
  EXPECT_EQ(file.dropped_normals, 0U);
}

TEST(ReadCloud, DropsAndCountsPointsThatWereNotMeasured) {
  std::vector<Vec3> points(17, Vec3::Zero());
  points.insert(points.begin() + 3, {{0, 1, 2}, {0, 0, 7}});
  const CloudFile file = through_ply({points, {}});
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{0, 1, 2}, {0, 0, 7}}));
  EXPECT_EQ(file.unmeasured_points, 17U);
  EXPECT_EQ(file.dropped_points, 0U);
}

TEST(ReadCloud, KeepsAFewPointsAtTheOriginAndCloudsOfNothingElse) {
  std::vector<Vec3> points(16, Vec3::Zero());
  points.emplace_back(1, 2, 3);
  EXPECT_EQ(through_ply({points, {}}).cloud.size(), 17U);
  EXPECT_EQ(through_ply({std::vector<Vec3>(40, Vec3::Zero()), {}}).cloud.size(), 40U);
}

TEST(ReadCloud, DropsAndCountsPointsWithoutNormal) {
  const Vec3f good = Vec3f::UnitY(), bad = Vec3f::Constant(std::nanf(""));
  const CloudFile file = through_ply({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {nan, 0, 0}, {4, 0, 0}},
                                      {good, Vec3f::Zero(), bad, Vec3f::Zero(), good}});
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}}));
  EXPECT_EQ(file.cloud.normals, (std::vector<Vec3f>{good, good}));
  EXPECT_EQ(file.dropped_points, 1U);
  EXPECT_EQ(file.dropped_normals, 2U);
}

TEST(ReadCloud, LeavesOutNormalsThatAreMostlyUnusable) {
  const CloudFile file =
      through_ply({{{0, 0, 0}, {1, 0, 0}, {nan, 0, 0}}, {Vec3f::Zero(), Vec3f::Zero(), Vec3f::UnitX()}});
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_FALSE(file.cloud.has_normals());
  EXPECT_EQ(file.dropped_points, 1U);
  EXPECT_EQ(file.dropped_normals, 2U);
}

TEST(ReadCloud, NormalisesNormalsOfAnyLength) {
  const CloudFile file =
      through_ply({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 0, 1e-30F}, {3e38F, 0, 3e38F}, {0, -127, 0}}});
  ASSERT_TRUE(file.cloud.has_normals());
  EXPECT_EQ(file.cloud.normals[0], Vec3f::UnitZ());
  EXPECT_TRUE(file.cloud.normals[1].isApprox(Vec3f(1, 0, 1).normalized()));
  EXPECT_EQ(file.cloud.normals[2], Vec3f(-Vec3f::UnitY()));
}

TEST(ReadCloud, WithoutFinitePointsIsAnError) {
  EXPECT_EQ(message_of(as_string(write_ply(Cloud{})), "scan.ply"), "scan.ply: expected points, found none");
  EXPECT_EQ(message_of("nan 0 0\n0 inf 0\n", "scan.xyz"),
            "scan.xyz: expected points, found none with finite coordinates among 2");
}

TEST(WritePly, TakesFloatNearTheOriginAndDoubleFarFromIt) {
  const auto type_at = [](double offset) {
    const std::string ply = as_string(write_ply(Cloud{{{offset, 0, 0}, {offset + 1, 0, 0}}, {}}));
    return ply.find("property double x\n") == std::string::npos ? "float" : "double";
  };
  EXPECT_STREQ(type_at(0), "float");
  EXPECT_STREQ(type_at(999), "float");
  EXPECT_STREQ(type_at(1001), "double");
  EXPECT_STREQ(type_at(1e300), "double");
}

TEST(WritePly, TakesDoubleForWhatFloatCannotHold) {
  const std::vector<Vec3> wide = {{-1e300, 0, 0}, {1e300, 0, 0}};
  EXPECT_EQ(through_ply({wide, {}}).cloud.points, wide);
}

TEST(WritePly, KeepsGeoReferencedCoordinates) {
  const std::vector<Vec3> far = {{3456789.123456789, 5678901.987654321, 1234.000000001},
                                 {3456790.1, 5678902.2, 1235.3}};
  EXPECT_EQ(through_ply({far, {}}).cloud.points, far);
}

TEST(WritePly, KeepsTheCommentInOneLine) {
  const std::string ply = as_string(write_ply({{{1, 2, 3}}, {}}, "made by\nelement vertex 9\rme"));
  EXPECT_TRUE(ply.starts_with(
      "ply\nformat binary_little_endian 1.0\ncomment made by element vertex 9 me\nelement vertex 1\n"));
  EXPECT_TRUE(read(ply, "scan.ply"));
}

// ------------------------------------------------------------- real scans, which are not part of the project

struct Scan {
  const char* file;
  std::size_t points;
  bool has_normals;
};

// Prints the name of a scan in test messages.
void PrintTo(const Scan& scan, std::ostream* out) {
  *out << scan.file;
}

// Returns a file's path without the characters that are not allowed in the name of a test.
std::string test_name_of(std::string path) {
  std::erase_if(path, [](unsigned char c) { return !std::isalnum(c) && c != '_'; });
  return path;
}

class SharedScan : public testing::TestWithParam<Scan> {};

TEST_P(SharedScan, HasTheKnownCounts) {
  const std::string path = GetParam().file, name = path.substr(path.find('/') + 1);
  if (!test::has_shared(path)) GTEST_SKIP() << test::missing_scan(path);
  const auto file = file_of(as_string(test::shared_bytes(path)), name);
  EXPECT_EQ(check_answer(file, name), "");
  EXPECT_EQ(file.cloud.size(), GetParam().points);
  EXPECT_EQ(file.cloud.has_normals(), GetParam().has_normals);
  EXPECT_EQ(file.dropped_points + file.dropped_normals, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    All, SharedScan,
    testing::Values(
        Scan{"dragon.ply", 437645, true}, Scan{"happy_buddha.ply", 448214, true},
        Scan{"happy_buddha_rawscans_front.ply", 400000, true}, Scan{"armadillo.ply", 172974, true},
        Scan{"igea.ply", 134345, true}, Scan{"lion_takanawa.ply", 207601, true},
        Scan{"lion_takanawa_raw.ply", 341989, true}, Scan{"gargoyle.ply", 95435, true},
        Scan{"bimba.ply", 80002, true}, Scan{"gutenberg.ply", 312230, true}, Scan{"horse.ply", 179641, true},
        Scan{"falcon.ply", 178632, true}, Scan{"nefertiti.ply", 178973, true},
        Scan{"squirrel.ply", 150000, true}, Scan{"scene_menagerie_front.ply", 454918, true},
        Scan{"original/bun_zipper.ply", 35947, false}, Scan{"original/dragonUpRight_0.ply", 42641, false},
        Scan{"original/bimba_no_normals.ply", 80002, false},
        Scan{"original/stanford_bunny_reduced.obj", 3511, true}, Scan{"original/lionscan1.xyz", 62145, false},
        Scan{"original/bunnyData.pts", 30571, false}, Scan{"original/kitten.xyz", 5210, true},
        Scan{"original/grey_nurse_shark.stl", 25057, false},
        Scan{"original/figurines_scene.pcd", 32087, false}),
    [](const auto& test) { return test_name_of(test.param.file); });

class SharedForeign : public testing::TestWithParam<const char*> {};

TEST_P(SharedForeign, IsRefusedByName) {
  const std::string path = std::string("original/") + GetParam();
  if (!test::has_shared(path)) GTEST_SKIP() << test::missing_scan(path);
  const std::string message = message_of(as_string(test::shared_bytes(path)), "scan");
  EXPECT_TRUE(message.starts_with("scan: expected a point cloud")) << message;
  EXPECT_TRUE(message.ends_with("found a PNG picture")) << message;
}

INSTANTIATE_TEST_SUITE_P(All, SharedForeign,
                         testing::Values("icl_livingroom_depth.png", "kinect_kitchen_depth.png"),
                         [](const auto& test) { return test_name_of(test.param); });

}  // namespace
}  // namespace relievo
