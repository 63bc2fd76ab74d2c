// Checks that every real scan that is available becomes a valid solid of the requested height.
#include <algorithm>
#include <cctype>
#include <memory>

#include "relievo/io/read.h"
#include "relievo/make_relief.h"
#include "relievo/scan/depth_image.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/surface.h"
#include "relievo/scene.h"
#include "support/results.h"
#include "support/shared_scans.h"

namespace relievo {
namespace {

namespace fs = std::filesystem;

using test::has_shared, test::missing_scan, test::shared_bytes, test::shared_data;

// Returns the paths of the scans in the folder. If there are no scans, returns "none", so that one test
// reports that it was skipped.
std::vector<std::string> scan_names() {
  std::vector<std::string> names;
  for (const fs::path& folder : {shared_data(), shared_data() / "original"})
    if (fs::is_directory(folder))
      for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        for (const char* ending : {".ply", ".obj", ".xyz", ".pts", ".stl", ".pcd"})
          if (entry.path().extension() == ending)
            names.push_back(fs::relative(entry.path(), shared_data()).string());
  std::sort(names.begin(), names.end());
  if (names.empty()) names.push_back("none");
  return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return !std::isalnum(letter); }, '_');
  return name;
}

class RealScan : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Data, RealScan, testing::ValuesIn(scan_names()), test_name);

TEST_P(RealScan, BecomesASolidOfTheHeightAsked) {
  const fs::path path = GetParam();
  if (!has_shared(path)) GTEST_SKIP() << missing_scan("*.ply");
  const CloudFile file = value_of(read_cloud(shared_bytes(path), path.filename().string()));
  ReliefOptions options{{.height_mm = 2.5}};
  options.view.is_best = true;
  const auto made = value_of(make_relief(file, options));
  EXPECT_EQ(check_solid(made.solid), "");
  EXPECT_NEAR(made.report.height_mm, 2.5, 2.5e-3);
  EXPECT_GT(made.report.visible_points, .2 * static_cast<double>(file.cloud.size()));
  // Only two of these scans show a table. Statues on plinths, busts, and depth images of single figures show none.
  const bool has_table =
      path.filename() == "kinect_milk_table.pcd" || path.filename() == "figurines_scene.pcd";
  EXPECT_EQ(made.report.plane.has_value(), has_table);
  if (!file.mesh.empty()) {
    const double usual = std::clamp(15.0 * static_cast<double>(file.mesh.triangles.size()), 1e5, 3e5);
    EXPECT_NEAR(static_cast<double>(made.report.visible_points), usual, .1 * usual);
  }
}

// One scan shows three cartons on a wide table. The table's farthest corner seems to be bent up by 3
// tolerances, because of camera errors. The other scan shows figurines on a board.
TEST(Data, TablesAreLeftOut) {
  for (const auto& [name, share] :
       {std::pair("original/kinect_milk_table.pcd", .77), std::pair("original/figurines_scene.pcd", .25)}) {
    SCOPED_TRACE(name);
    if (!has_shared(name)) GTEST_SKIP() << missing_scan(name);
    const auto file = value_of(read_cloud(shared_bytes(name), name));
    View view;
    const Surface with = find_surface(file.cloud, view).value();
    view.has_plane = false;
    const Surface without = find_surface(file.cloud, view).value();
    ASSERT_TRUE(with.plane && without.plane);
    EXPECT_EQ(with.plane->kind, PlaneKind::table);
    EXPECT_NEAR(with.plane->share, share, .03);
    EXPECT_LT(Box::of(without.points).max.x(), .6);  // all points farther to the right belong to the table
    EXPECT_LT(static_cast<double>(without.visible_points),
              1.03 * (1 - share) * static_cast<double>(with.visible_points));
  }
}

// The list that comes with the scans states their front sides. Most of them face +Z, with Y upwards; two
// face -Y, with Z upwards. For the scan "bimba" without normals, the stated front is between +X and +Z.
// best_side() tries only sides along the axes, so it finds +Z, which is 45 degrees off.
TEST_P(RealScan, IsShownFromItsToldFront) {
  const fs::path path = GetParam();
  if (!has_shared(path)) GTEST_SKIP() << missing_scan("*.ply");
  const auto file = value_of(read_cloud(shared_bytes(path), path.filename().string()));
  const bool has_z_up = path.filename() == "lion_takanawa_raw.ply" || path.filename() == "lionscan1.xyz";
  const ViewGuess best = best_side({{{{}, std::make_shared<const CloudFile>(file)}}});
  EXPECT_EQ(best.name, has_z_up ? "bottom" : "front");
  EXPECT_EQ(best.up, "");
}

TEST(Data, DepthFramesBecomeSolids) {
  for (const auto& [name, camera] :
       {std::pair("original/kinect_kitchen_depth.png", DepthCamera{585, 585, 320, 240}),
        std::pair("original/icl_livingroom_depth.png", DepthCamera{481.2, 480, 319.5, 239.5})}) {
    SCOPED_TRACE(name);
    if (!has_shared(name)) GTEST_SKIP() << missing_scan(name);
    const auto image = value_of(read_depth_image(shared_bytes(name), name));
    DepthOptions depth{.camera = camera};
    const auto cloud = value_of(depth_cloud(image, depth));
    ReliefOptions options{{.height_mm = 5}};
    const auto made = value_of(make_relief(cloud.cloud, options));
    EXPECT_EQ(check_solid(made.solid), "");
    EXPECT_NEAR(made.report.height_mm, 5, 5e-3);
    EXPECT_GT(made.report.visible_points, .9 * static_cast<double>(cloud.cloud.size()));
  }
}

}  // namespace
}  // namespace relievo
