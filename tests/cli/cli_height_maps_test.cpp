// Tests the height maps that the program writes: the size and the meaning of their pixels, as the files and
// the report state them.
#include <nlohmann/json.hpp>
#include <set>

#include "support/cli_folder.h"
#include "support/results.h"

namespace relievo {
namespace {

using namespace test;

class CliHeightMaps : public CliFolder {
 protected:
  // Makes a height map of the torus on a plate of 120 x 80 mm with a rim. Returns its values.
  Image<float> map(const std::string& options, const std::string& file = "h.png") {
    const Outcome outcome = must_run("make torus.ply --plate 120x80 --height 3 --rim 4 --rim-height 1 -o " +
                                     file + " " + options);
    err_ = outcome.err;
    bytes_ = read_all(folder_ / file);
    return value_of(read_depth_image(std::as_bytes(std::span(bytes_)), file)).values;
  }

  // Returns the pixels per metre, horizontally and vertically, in the chunk pHYs of a PNG.
  std::pair<unsigned, unsigned> pixels_per_metre() const {
    const std::size_t at = bytes_.find("pHYs") + 4;
    const auto number = [&](std::size_t from) {
      unsigned value = 0;
      for (std::size_t i = from; i < from + 4; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes_[i]);
      return value;
    };
    EXPECT_EQ(bytes_[at + 8], 1) << "unit: metre";
    return {number(at), number(at + 4)};
  }

  std::string bytes_, err_;  // the file, and the program's messages
};

TEST_F(CliHeightMaps, HavePixelsOfExactSizeWithoutASolid) {
  for (const char* pixel : {"--pixel 0.1mm", "--pixel 0.1", "--dpi 254"}) {
    const Image<float> image = map(pixel);
    EXPECT_EQ(image.width, 1200) << pixel;
    EXPECT_EQ(image.height, 800) << pixel;
    EXPECT_EQ(pixels_per_metre(), std::pair(10000U, 10000U)) << pixel;
    EXPECT_TRUE(bytes_.contains(std::string("mm_per_pixel\0000.1", 16))) << pixel;
  }
  const std::set<std::string> kinds{".png", ".ply"};
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_TRUE(kinds.contains(entry.path().extension())) << entry.path();
  EXPECT_EQ(map("--pixel 0.01in").width, 473);  // 472.4 pixels, so the outer columns are incomplete
  EXPECT_EQ(map("--pixel 0.5", "h.tif").width, 240);
}

// If the given size of a pixel divides the plate evenly, the map is the same as with the corresponding
// number of pixels.
TEST_F(CliHeightMaps, OfAPitchAreThoseOfTheSameNumberOfPixels) {
  const Image<float> by_pitch = map("--pixel 0.5");
  EXPECT_EQ(by_pitch.pixels, map("--heightmap-size 240").pixels);
}

TEST_F(CliHeightMaps, OfTheReliefAloneHaveNeitherMarginNorRim) {
  const Image<float> plate = map("--pixel 0.25", "h.tif"),
                     relief = map("--pixel 0.25 --heightmap-area relief", "h.tif");
  EXPECT_EQ(plate.height, 320);
  EXPECT_NEAR(relief.height, (80 - 2 * 4 - 2 * 5) * 4, 4);  // the plate without rim and margin
  // The relief is at the centre of the plate. So the map of the relief agrees with the central part of the plate's map.
  const int left = (plate.width - relief.width) / 2, top = (plate.height - relief.height) / 2;
  double difference = 0;
  for (int y = 0; y < relief.height; ++y)
    for (int x = 0; x < relief.width; ++x)
      difference += std::abs(double{relief.at(x, y)} - double{plate.at(x + left, y + top)});
  EXPECT_LT(difference / static_cast<double>(relief.size()), .05);
  EXPECT_EQ(plate.at(2, 2), 1) << "the rim";
  EXPECT_EQ(relief.at(0, 0), 0);
}

TEST_F(CliHeightMaps, CanBeInverted) {
  const Image<float> up = map("--pixel 0.5"), down = map("--pixel 0.5 --heightmap-high black");
  for (std::size_t i = 0; i < up.size(); ++i) ASSERT_NEAR(up[i] + down[i], 65535, 1);
  const Image<float> mm = map("--pixel 0.5", "h.tif"),
                     depth = map("--pixel 0.5 --heightmap-high black", "h.tif");
  for (std::size_t i = 0; i < mm.size(); ++i) ASSERT_NEAR(mm[i] + depth[i], 3, 1e-5);
}

TEST_F(CliHeightMaps, OfEightBitsSayHowHighAGreyIs) {
  const Image<float> fine = map("--pixel 0.5 --report r.json");
  const auto facts = [&] { return nlohmann::json::parse(read_all(folder_ / "r.json")).at("height_map"); };
  EXPECT_EQ(facts().at("bits"), 16);
  EXPECT_EQ(facts().at("greys"), std::set<float>(fine.pixels.begin(), fine.pixels.end()).size());
  const Image<float> coarse = map("--pixel 0.5 --heightmap-bits 8 --report r.json");
  EXPECT_EQ(bytes_[24], 8) << "bits in the header of the PNG";
  EXPECT_NEAR(facts().at("mm_per_grey"), 3. / 255, 1e-6);
  EXPECT_EQ(facts().at("greys"), 256);
  EXPECT_TRUE(err_.contains("8 bits, 256 greys used, 0.0117647 mm each")) << err_;
  for (std::size_t i = 0; i < fine.size(); ++i) ASSERT_NEAR(coarse[i], fine[i] / 257, .51);
  for (const char* bits : {"8", "16"}) {
    const Image<float> tiff = map(std::string("--pixel 0.5 --heightmap-bits ") + bits, "h.tif");
    EXPECT_EQ(tiff.pixels, bits[0] == '8' ? coarse.pixels : fine.pixels);
  }
}

// A batch can make height maps without solids.
TEST_F(CliHeightMaps, AreMadeByABatch) {
  std::filesystem::create_directory(folder_ / "scans");
  std::filesystem::copy_file(folder_ / "torus.ply", folder_ / "scans" / "a.ply");
  must_run("batch scans -o out --files heightmap,report --width 40 --margin 5 --dpi 127");
  bytes_ = read_all(folder_ / "out" / "a-heights.png");
  EXPECT_EQ(value_of(read_depth_image(std::as_bytes(std::span(bytes_)), "a.png")).values.width, 250);
  EXPECT_EQ(pixels_per_metre(), std::pair(5000U, 5000U));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "a.stl"));
}

}  // namespace
}  // namespace relievo
