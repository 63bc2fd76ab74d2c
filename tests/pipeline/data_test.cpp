// Real scans, where they are at hand: every file becomes a sound solid of the height asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "relievo/depth_image.h"
#include "relievo/io.h"
#include "relievo/make_relief.h"

namespace relievo {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> readable_scans() {
  std::vector<fs::path> scans;
  for (const fs::path& folder : {fs::path(RELIEVO_SHARED_DATA), fs::path(RELIEVO_SHARED_DATA) / "original"})
    if (fs::is_directory(folder))
      for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        for (const char* ending : {".ply", ".obj", ".xyz", ".pts", ".stl", ".pcd"})
          if (entry.path().extension() == ending) scans.push_back(entry.path());
  std::sort(scans.begin(), scans.end());
  return scans;
}

std::vector<std::byte> bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

TEST(Data, EveryScanBecomesASolidOfTheHeightAsked) {
  const std::vector<fs::path> scans = readable_scans();
  if (scans.empty()) GTEST_SKIP() << "no scans in " RELIEVO_SHARED_DATA;
  for (const fs::path& path : scans) {
    SCOPED_TRACE(path.filename().string());
    const Result<CloudFile> file = read_cloud(bytes_of(path), path.filename().string());
    ASSERT_TRUE(file) << file.error().message();
    ReliefOptions options;
    options.height_mm = 2.5;
    if (path.filename() == "lion_takanawa_raw.ply" || path.filename() == "lionscan1.xyz") {
      options.view = "0,-1,0";
      options.up = "0,0,1";
    }
    if (path.extension() == ".stl") options.view = "top";
    const Result<MadeRelief> made = make_relief(*file, options);
    ASSERT_TRUE(made) << made.error().message();
    EXPECT_EQ(check_solid(made->solid), "");
    EXPECT_NEAR(made->report.height_mm, 2.5, 2.5e-3);
    EXPECT_GT(made->report.visible_points, .2 * static_cast<double>(file->cloud.size()));
    if (!file->mesh.empty()) {
      EXPECT_NEAR(static_cast<double>(made->report.visible_points), options.points, .1 * options.points);
    }
  }
}

TEST(Data, DepthFramesBecomeSolids) {
  const fs::path folder = fs::path(RELIEVO_SHARED_DATA) / "original";
  if (!fs::exists(folder / "kinect_kitchen_depth.png"))
    GTEST_SKIP() << "no depth frames in " RELIEVO_SHARED_DATA;
  for (const auto& [name, camera] :
       {std::pair("kinect_kitchen_depth.png", DepthCamera{585, 585, 320, 240}),
        std::pair("icl_livingroom_depth.png", DepthCamera{481.2, 480, 319.5, 239.5})}) {
    SCOPED_TRACE(name);
    const auto image = read_depth_image(bytes_of(folder / name), name);
    ASSERT_TRUE(image) << image.error().message();
    DepthOptions depth;
    depth.camera = camera;
    const auto cloud = depth_cloud(*image, depth);
    ASSERT_TRUE(cloud) << cloud.error().message();
    ReliefOptions options;
    options.height_mm = 5;
    const Result<MadeRelief> made = make_relief(cloud->cloud, options);
    ASSERT_TRUE(made) << made.error().message();
    EXPECT_EQ(check_solid(made->solid), "");
    EXPECT_NEAR(made->report.height_mm, 5, 5e-3);
    EXPECT_GT(made->report.visible_points, .9 * static_cast<double>(cloud->cloud.size()));
  }
}

}  // namespace
}  // namespace relievo
