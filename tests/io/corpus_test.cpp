// Reads files from the test suites of other projects. The files are not part of this project, because
// their licences do not allow it. Every result must pass check_answer(), and agree with the verdicts in
// the files' names and with the reports of validators.
#include <nlohmann/json.hpp>

#include "io/numbers.h"
#include "relievo/core/json_place.h"
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
    return bytes_of(content_of(path.parent_path() / name));
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

  // Returns the files in and below a folder of the corpus whose names have the given ending.
  std::vector<fs::path> files(const std::string& below, const std::string& ending) const {
    std::vector<fs::path> found;
    if (!fs::is_directory(folder_ / below)) return found;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / below))
      if (entry.is_regular_file() && entry.path().string().ends_with(ending)) found.push_back(entry.path());
    return found;
  }

  const fs::path folder_ = test::shared_data() / "../corpus";
};

// Prints, for each format, how many files are read and how many are refused.
TEST_F(Corpus, EveryAnswerKeepsItsPromises) {
  for (const std::string& ending : readable_endings()) {
    std::size_t read = 0, refused = 0;
    for (const fs::path& path : files(".", ending)) {
      const std::string text = content_of(path);
      bool is_read = false;
      if (is_picture(std::as_bytes(std::span(text)))) {
        const auto image = depths_at(path);
        is_read = image.has_value();
        EXPECT_TRUE(image || !image.error().expected.empty()) << path;
      } else {
        const auto file = read_at(path);
        is_read = file.has_value();
        EXPECT_EQ(check_answer(file, path.string()), "") << path;
      }
      ++(is_read ? read : refused);
    }
    std::printf("%-6s %4zu read, %4zu refused\n", ending.c_str(), read, refused);
  }
}

// Returns the number of all points in the file. Points that were left out because coordinates or normals were
// missing count, too.
std::size_t all_points(const CloudFile& file) {
  return file.cloud.size() + file.dropped_points + file.left_out_points + file.unmeasured_points +
         (file.cloud.has_normals() ? file.dropped_normals : 0);
}

// Returns the number after `beginning` in the first line that begins with it; nothing if no line does.
std::optional<std::size_t> number_after(const std::string& text, const std::string& beginning) {
  const std::size_t found = text.find("\n" + beginning);
  if (found == std::string::npos) return std::nullopt;
  return std::strtoull(text.c_str() + found + 1 + beginning.size(), nullptr, 10);
}

TEST_F(Corpus, FilesHaveAsManyPointsAsTheirHeadersSay) {
  std::size_t counted = 0;
  const auto expect_count = [&](const fs::path& path, std::optional<std::size_t> count) {
    const auto file = read_at(path);
    if (!file || !count) return;
    EXPECT_EQ(all_points(*file) + file->missing_points, *count) << path;
    ++counted;
  };
  for (const fs::path& path : files(".", ".ply"))
    expect_count(path, number_after(content_of(path), "element vertex "));
  for (const fs::path& path : files(".", ".pcd"))
    expect_count(path, number_after(content_of(path), "POINTS "));
  for (const char* const ending : {".las", ".laz"})
    for (const fs::path& path : files(".", ending)) {
      const std::string text = content_of(path);
      if (text.size() < 375) continue;
      const auto few = io::little<std::uint32_t>(text.data() + 107);
      const auto many = text[25] < 4 ? 0 : io::little<std::uint64_t>(text.data() + 247);
      expect_count(path, many > 0 ? many : few);
    }
  EXPECT_GT(counted, 0U);
}

TEST_F(Corpus, LasWithPointsIsRead) {
  for (const fs::path& path : files(".", ".las")) {
    const bool has_points = !path.string().contains("no-points");
    EXPECT_EQ(read_at(path).has_value(), has_points) << path;
  }
}

TEST_F(Corpus, BrokenStlIsRefused) {
  for (const fs::path& path : files("openscad+openscad", ".stl")) {
    const std::string name = path.filename().string();
    for (const char* broken : {"empty", "invalidvertex", "toomanyvertices", "unparseable"})
      EXPECT_FALSE(name.starts_with(broken) && read_at(path)) << name;
  }
}

// The values of these pictures count up pixel by pixel, and restart at 0 after the largest value.
TEST_F(Corpus, TiffOfOneChannelHasItsPixels) {
  std::size_t judged = 0;
  for (const fs::path& path : files("image-rs+image-tiff/tests/images/seq", ".tiff")) {
    const std::string name = path.filename().string();
    if (!name.starts_with("seq-1c-") || name.contains("palette")) continue;
    const auto image = value_of(depths_at(path));
    const bool is_signed = name[7] == 'i';
    const int bits = std::atoi(name.c_str() + (is_signed ? 8 : 7));
    const bool is_fraction = name.starts_with(cat("seq-1c-", bits, "f"));
    for (std::size_t i = 0; i < image.values.size(); ++i) {
      const auto number = static_cast<double>(i % 256);
      const double expected = is_fraction  ? number / 255
                              : is_signed  ? number - 128
                              : bits == 24 ? number * 65536
                                           : std::fmod(number, std::exp2(bits));
      ASSERT_NEAR(image.values[i], expected, is_fraction ? 1e-6 : 0) << name << i;
    }
    ++judged;
  }
  EXPECT_GT(judged, 0U);
}

TEST_F(Corpus, LuminanceIsThatOfTheChannels) {
  std::size_t judged = 0;
  for (const fs::path& path : files("image-rs+image-tiff/tests/images/seq", ".tiff")) {
    const std::string text = content_of(path);
    const auto read = [&](bool is_luminance, int channel) {
      return read_depth_image(std::as_bytes(std::span(text)), path.string(), {is_luminance, channel});
    };
    const auto bright = read(true, 0), red = read(false, 1), green = read(false, 2), blue = read(false, 3);
    if (!path.filename().string().starts_with("seq-3c-") || !bright || !blue) continue;
    for (std::size_t i = 0; i < bright->values.size(); ++i) {
      const double expected = .2126 * red->values[i] + .7152 * green->values[i] + .0722 * blue->values[i];
      ASSERT_NEAR(bright->values[i], expected, 1e-5 * std::abs(expected) + 1e-6) << path << i;
    }
    ++judged;
  }
  EXPECT_GT(judged, 0U);
}

// A glTF file, and numbers from the validator's report on it.
struct JudgedGltf {
  std::string name;
  std::size_t errors, draws, triangles;
};

std::vector<JudgedGltf> judged_gltf(const std::vector<fs::path>& reports) {
  std::vector<JudgedGltf> all;
  for (const fs::path& path : reports) {
    const auto report = nlohmann::json::parse(content_of(path), nullptr, false);
    const std::string name = path.string().substr(0, path.string().rfind(".report.json"));
    if (!fs::exists(name) || !report.is_object()) continue;
    const auto info = report.value("info", nlohmann::json::object());
    all.push_back({name, report["issues"].value("numErrors", std::size_t{1}),
                   info.value("drawCallCount", std::size_t{0}),
                   info.value("totalTriangleCount", std::size_t{0})});
  }
  return all;
}

// Files for which a test need not hold, and the reason. The files are given by the ends of their names.
struct Exceptions {
  const char* reason;
  std::vector<std::string> names;
};

bool is_among(const std::vector<Exceptions>& all, const std::string& name) {
  return std::ranges::any_of(all, [&](const Exceptions& one) {
    return std::ranges::any_of(one.names, [&](const std::string& end) { return name.ends_with("/" + end); });
  });
}

TEST_F(Corpus, RightGltfOfTheValidatorIsRead) {
  const std::vector<Exceptions> exceptions = {
      {"the file has no data", {"root/named_objects.gltf", "root/unused_objects.gltf"}},
      {"no primitive has positions",
       {"mesh/primitive_no_position.gltf", "json/integer_written_as_float.gltf"}}};
  const auto all = judged_gltf(files("KhronosGroup+glTF-Validator", ".report.json"));
  std::size_t read = 0;
  for (const auto& [name, errors, draws, triangles] : all) {
    if (errors > 0 || draws == 0) continue;
    const auto file = read_at(name);
    EXPECT_EQ(file.has_value(), !is_among(exceptions, name))
        << name << (file ? " is no exception any more" : file.error().expected);
    if (!file) continue;
    ++read;
    if (file->mesh.empty()) continue;  // in two files, every triangle has two equal corners and is left out
    EXPECT_EQ(file->mesh.triangles.size(), triangles) << name;
  }
  EXPECT_TRUE(all.empty() || read > 0);
}

TEST_F(Corpus, BrokenGltfOfTheValidatorIsRefused) {
  const std::vector<Exceptions> exceptions = {
      {"the fault is in morphs, skins, joints or weights, which are not read",
       {"mesh/morph_attribute_invalid_count.gltf", "mesh/morph_attribute_no_base.gltf",
        "mesh/morph_position_accessor_no_bounds.gltf", "mesh/morph_unequal_targets_count.gltf",
        "mesh/morph_weights_wrong_count.gltf", "mesh/unequal_joints.gltf",
        "mesh/unresolved_morph_positions.gltf", "node/node_skin_without_skinned_mesh.gltf",
        "node/node_weights_invalid.gltf", "skin/no_joints_in_scene.gltf"}},
      {"the fault is in materials, textures, tangents or attributes of a program's own, which are not read",
       {"mesh/accessor_attribute_uint32.gltf", "mesh/invalid_attribute.gltf",
        "mesh/invalid_attribute_escaped_name.gltf", "mesh/invalid_indexed_attribute.gltf",
        "mesh/unresolved_material.gltf", "mesh/uv.gltf", "material/no_tangent_space.gltf",
        "KHR_materials_variants/data/primitive/dependency.gltf",
        "KHR_materials_variants/data/primitive/empties.gltf",
        "KHR_materials_variants/data/primitive/non_unique.gltf",
        "KHR_materials_variants/data/primitive/unexpected_extension.gltf",
        "KHR_materials_variants/data/primitive/unresolved_references.gltf", "textureInfo/uv_sets.gltf"}},
      {"normals become unit vectors and colours are cut off at 1",
       {"mesh_data/normals_tangents_non_unit_invalid_sign.gltf", "mesh_data/colors_non_clamped.gltf"}},
      {"the bounds that the file lacks are measured", {"mesh/position_accessor_no_bounds.gltf"}},
      {"the vertex exists that the number 255 names", {"mesh_data/index_buffer_primitive_restart.gltf"}},
      {"the file has whole numbers as coordinates, but does not announce them",
       {"KHR_mesh_quantization/data/primitive/non_required.gltf",
        "KHR_mesh_quantization/data/primitive/unexpected_extension.gltf"}}};
  std::vector<std::string> read;
  for (const auto& one : judged_gltf(files("KhronosGroup+glTF-Validator", ".report.json")))
    if (one.errors > 0 && read_at(one.name)) read.push_back(one.name);
  for (const std::string& name : read) EXPECT_TRUE(is_among(exceptions, name)) << name;
  for (const auto& [reason, names] : exceptions)
    for (const std::string& end : names)
      EXPECT_TRUE(read.empty() ||
                  std::ranges::any_of(read, [&](auto& name) { return name.ends_with("/" + end); }))
          << end << " is no exception any more";
}

// In PngSuite, the names of corrupt pictures begin with x.
TEST_F(Corpus, BrokenPngIsRefused) {
  for (const fs::path& path : files("nothings+stb", ".png"))
    EXPECT_FALSE(path.filename().string().starts_with("x") && depths_at(path)) << path;
}

TEST_F(Corpus, RightPlyWithVerticesIsRead) {
  for (const fs::path& path : files("Fluci+ply-rs", ".ply")) {
    const bool is_right =
        path.string().contains("_ok_") && number_after(content_of(path), "element vertex ").value_or(0) > 0;
    EXPECT_TRUE(!is_right || read_at(path)) << path;
  }
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

// libE57Format and the reference implementation of E57 wrote these scans of one model. The scans differ in
// the widths of their integers.
TEST_F(Corpus, OneModelHasTheSamePointsInE57OfEveryNumber) {
  const fs::path rust = folder_ / "cry-inc+e57/testdata";
  const auto finest = read_at(rust / "bunnyDouble.e57");
  if (!finest) GTEST_SKIP() << missing_corpus();
  ASSERT_EQ(finest->cloud.size(), 30571U);
  for (const char* other : {"bunnyFloat", "bunnyInt19", "bunnyInt21", "bunnyInt24", "bunnyInt32"}) {
    const auto file = value_of(read_at(rust / cat(other, ".e57")));
    ASSERT_EQ(file.cloud.size(), finest->cloud.size()) << other;
    for (std::size_t i = 0; i < finest->cloud.size(); ++i)
      ASSERT_LT((file.cloud.points[i] - finest->cloud.points[i]).norm(), 1e-6) << other << i;
  }
}

TEST_F(Corpus, E57IsReadOrRefusedAsItsNameSays) {
  if (files("cry-inc+e57", ".e57").empty()) GTEST_SKIP() << missing_corpus();
  const std::vector<std::pair<const char*, std::size_t>> counts = {{"tiny_spherical", 180},
                                                                   {"tinyCartesianFloatRgb", 2090},
                                                                   {"read_error", 2651},
                                                                   {"las2e57_no_images_tag", 153},
                                                                   {"tiny_pc_with_extension", 1},
                                                                   {"tiny_pc_and_images", 2},
                                                                   {"cartesian_invalid_state_single", 1}};
  for (const auto& [name, points] : counts) {
    const auto file = value_of(read_at(folder_ / "cry-inc+e57/testdata" / cat(name, ".e57")));
    EXPECT_EQ(file.cloud.size(), points) << name;
  }
  const fs::path self = folder_ / "asmaloney+libE57Format-test-data/self";
  for (const char* name : {"ColouredCubeDouble.e57", "ColouredCubeFloat.e57"}) {
    const auto file = value_of(read_at(self / name));
    EXPECT_EQ(file.cloud.size(), 7680U);
    EXPECT_TRUE(file.cloud.has_colours());
  }
  for (const char* broken : {"bad-crc.e57", "InvalidCVHeader.e57", "ZeroPointsInvalid.e57"})
    EXPECT_FALSE(read_at(self / broken)) << broken;
  EXPECT_FALSE(read_at(folder_ / "cry-inc+e57/testdata/corrupt_crc.e57"));
}

// The files have point formats 4 to 10, with extra bytes and wave packets. Some files have points from
// several scanners.
TEST_F(Corpus, LazHasThePointsOfItsLas) {
  std::size_t compared = 0;
  for (const fs::path& path : files("visgl+loaders.gl", ".laz")) {
    const auto packed = value_of(read_at(path));
    const fs::path other = fs::path(path).replace_extension(".las");
    if (!fs::exists(other)) continue;
    const auto plain = value_of(read_at(other));
    EXPECT_EQ(packed.cloud.points, plain.cloud.points) << path;
    EXPECT_EQ(packed.cloud.colours, plain.cloud.colours) << path;
    ++compared;
  }
  EXPECT_GT(compared, 0U);
}

TEST_F(Corpus, JsonIsJudgedAsItsNamesSay) {
  for (const fs::path& path : files("nst+JSONTestSuite", ".json")) {
    const std::string name = path.filename().string();
    const std::string text = content_of(path);
    if (text.contains('\0')) continue;  // nlohmann's parser stops at a zero byte, which is harmless
    const bool is_json = json_error_place(text).empty();
    EXPECT_FALSE(name.starts_with("y_") && !is_json) << name;
    EXPECT_FALSE(name.starts_with("n_") && is_json) << name;
  }
}

// All files contain the same picture, but with different numbers of bits per value. After division by the
// largest value of that number of bits, the pictures are equal up to rounding.
TEST_F(Corpus, OnePictureHasTheSameDepthsInNumbersOfEverySize) {
  const fs::path depth = folder_ / "image-rs+image-tiff/tests/libtiffpic/depth";
  const auto finest = depths_at(depth / "flower-minisblack-16.tif");
  if (!finest) GTEST_SKIP() << missing_corpus();
  for (const int bits : {8, 10, 12, 14, 24, 32}) {
    const auto image = depths_at(depth / cat("flower-minisblack-", bits < 10 ? "0" : "", bits, ".tif"));
    if (!image) continue;  // not every width is in the corpus
    ASSERT_EQ(image->values.size(), finest->values.size());
    // Pictures of more than 16 bits were made from pictures of 8 bits, so their values are as coarse as 8 bits.
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
