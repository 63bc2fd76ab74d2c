// Files of other projects' test suites, which are not part of the project because their licences differ: that every
// answer keeps its promises, and the verdicts that the files' names and their validators' reports give.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "relievo/core/json_place.h"
#include "relievo/core/text.h"
#include "support/read_text.h"
#include "support/shared_scans.h"

namespace relievo {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Result<CloudFile> read_at(const fs::path& path) {
  const std::string text = content_of(path);
  const auto beside = [&](const std::string& name) -> Result<std::vector<std::byte>> {
    if (!fs::is_regular_file(path.parent_path() / name))
      return std::unexpected(Error{ErrorKind::input, name, {}, "expected a file"});
    const std::string other = content_of(path.parent_path() / name);
    const auto bytes = std::as_bytes(std::span(other));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  };
  return read_cloud(std::as_bytes(std::span(text)), path.string(), beside);
}

Result<DepthImage> depths_at(const fs::path& path) {
  const std::string text = content_of(path);
  return read_depth_image(std::as_bytes(std::span(text)), path.string());
}

class Corpus : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(folder_)) GTEST_SKIP() << missing_corpus();
  }

  static std::string missing_corpus() { return test::missing_scan("../corpus"); }

  // Returns the files below a folder of the corpus whose names have that ending.
  std::vector<fs::path> files(const std::string& below, const std::string& ending) const {
    std::vector<fs::path> found;
    if (!fs::is_directory(folder_ / below)) return found;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / below))
      if (entry.is_regular_file() && entry.path().string().ends_with(ending)) found.push_back(entry.path());
    return found;
  }

  const fs::path folder_ = test::shared_data() / "../corpus";
};

TEST_F(Corpus, EveryAnswerKeepsItsPromises) {
  std::size_t clouds = 0, pictures = 0;
  for (const std::string& ending : readable_endings())
    for (const fs::path& path : files(".", ending)) {
      const std::string text = content_of(path);
      if (is_picture(std::as_bytes(std::span(text)))) {
        const auto image = depths_at(path);
        pictures += image.has_value() ? 1 : 0;
        EXPECT_TRUE(image || !image.error().expected.empty()) << path;
      } else {
        const auto file = read_at(path);
        clouds += file.has_value() ? 1 : 0;
        EXPECT_EQ(check_answer(file, path.string()), "") << path;
      }
    }
  std::printf("read %zu clouds and meshes, %zu depth images\n", clouds, pictures);
}

// The validator's report says whether a file is right and how many triangles it has. Some right files have no data.
TEST_F(Corpus, RightGltfOfTheValidatorIsRead) {
  std::size_t judged = 0;
  for (const fs::path& path : files("KhronosGroup+glTF-Validator", ".report.json")) {
    const auto report = nlohmann::json::parse(content_of(path), nullptr, false);
    const std::string name =
        path.string().substr(0, path.string().size() - std::string(".report.json").size());
    if (!report.is_object() || report["issues"].value("numErrors", 1) > 0 || !report.contains("info"))
      continue;
    if (report["info"].value("totalTriangleCount", 0) == 0 || !fs::exists(name)) continue;
    const auto file = read_at(name);
    const std::string why = file ? "" : file.error().expected;
    const bool has_no_data = why.starts_with("expected a bufferView, found none") ||
                             why.starts_with("expected as many bytes") || why.ends_with("found none");
    EXPECT_TRUE(file || has_no_data) << name << ": " << why;
    ++judged;
  }
  std::printf("judged %zu right glTF files with triangles\n", judged);
}

TEST_F(Corpus, BrokenPlyIsRefused) {
  for (const fs::path& path : files("mosra+magnum-plugins", ".ply")) {
    const std::string name = path.filename().string();
    for (const char* broken : {"invalid-", "format-", "incomplete-", "positions-missing", "unexpected-"})
      EXPECT_FALSE(name.starts_with(broken) && read_at(path)) << name;
  }
  for (const fs::path& path : files("Fluci+ply-rs", ".ply"))
    EXPECT_FALSE(path.string().contains("_err_") && read_at(path)) << path;
}

TEST_F(Corpus, JsonIsJudgedAsItsNamesSay) {
  for (const fs::path& path : files("nst+JSONTestSuite", ".json")) {
    const std::string name = path.filename().string();
    const std::string text = content_of(path);
    if (text.contains('\0')) continue;  // nlohmann's parser takes it for the end, which is harmless
    const bool is_json = json_error_place(text).empty();
    EXPECT_FALSE(name.starts_with("y_") && !is_json) << name;
    EXPECT_FALSE(name.starts_with("n_") && is_json) << name;
  }
}

// One picture in numbers of many sizes: as shares of the largest number the pictures are equal, but for rounding.
TEST_F(Corpus, OnePictureHasTheSameDepthsInNumbersOfEverySize) {
  const fs::path depth = folder_ / "image-rs+image-tiff/tests/libtiffpic/depth";
  const auto finest = depths_at(depth / "flower-minisblack-16.tif");
  if (!finest) GTEST_SKIP() << missing_corpus();
  for (const int bits : {8, 10, 12, 14, 24, 32}) {
    const auto image = depths_at(depth / cat("flower-minisblack-", bits < 10 ? "0" : "", bits, ".tif"));
    if (!image) continue;  // not every size is in the corpus
    ASSERT_EQ(image->values.size(), finest->values.size());
    // Those above 16 bits were made of 8 bits.
    const double most = std::exp2(bits) - 1, coarsest = bits > 16 ? 1 / 255. : 1 / most;
    for (std::size_t i = 0; i < image->values.size(); ++i)
      ASSERT_NEAR(static_cast<double>(image->values[i]) / most,
                  static_cast<double>(finest->values[i]) / 65535, coarsest)
          << bits << " bits, pixel " << i;
  }
}

TEST_F(Corpus, PredictorsOfHalvesChangeNothing) {
  const fs::path images = folder_ / "image-rs+image-tiff/tests/images";
  const auto plain = depths_at(images / "random-fp16.tiff");
  if (!plain) GTEST_SKIP() << missing_corpus();
  for (const char* other : {"random-fp16-pred2.tiff", "random-fp16-pred3.tiff"})
    EXPECT_EQ(depths_at(images / other)->values.pixels, plain->values.pixels) << other;
}

}  // namespace
}  // namespace relievo
