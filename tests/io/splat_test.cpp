// Tests files of Gaussian splats: PLY files with the properties of splats, and .splat files.
#include "core/angle.h"
#include "relievo/io/stream.h"
#include "support/format_samples.h"
#include "support/ply_encoder.h"
#include "support/read_text.h"

namespace relievo {
namespace {

const std::vector<std::string> splat_properties = {
    "x",       "y",       "z",       "nx",      "ny",    "nz",    "f_dc_0", "f_dc_1", "f_dc_2",
    "opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2",  "rot_3"};

// Returns the row of a splat at a point. `opacity` is the logit of the splat's opacity.
std::vector<double> splat(const Vec3& at, const Vec3& f_dc, double opacity) {
  return {at.x(), at.y(), at.z(), 0, 0, 0, f_dc.x(), f_dc.y(), f_dc.z(), opacity, -3, -3, -3, 1, 0, 0, 0};
}

PlyTable splats(const std::vector<std::vector<double>>& rows) {
  PlyTable table{"vertex", {}, rows};
  for (const std::string& name : splat_properties) table.columns.push_back({"float", name});
  return table;
}

class Splats : public testing::TestWithParam<PlyEncoding> {};

TEST_P(Splats, FaintOnesAreLeftOutAndColoursAreHarmonics) {
  const double brightest = .5 / .28209479177387814;  // f_dc of byte 255; that of byte 0 is its negative
  const auto file =
      file_of(encode_ply({splats({splat({1, 2, 3}, {brightest, 0, -brightest}, .01),
                                  splat({4, 5, 6}, {0, 0, 0}, -.01), splat({7, 8, 9}, {9, -9, 0}, 8)})},
                         GetParam()),
              "a.ply");
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{1, 2, 3}, {7, 8, 9}}));
  EXPECT_EQ(file.cloud.colours, (std::vector<Colour>{{255, 128, 0}, {255, 0, 128}}));
  EXPECT_FALSE(file.cloud.has_normals());
  EXPECT_EQ(file.left_out_points, 1U);
  EXPECT_EQ(file.dropped_points, 0U);
  EXPECT_EQ(file.remarks,
            (std::vector<std::string>{
                "left out 1 point of splats that are less than half opaque; --doubtful keep keeps them"}));
  EXPECT_TRUE(file.format.ends_with(", Gaussian splats"));
}

TEST_P(Splats, OpacityOfOtherVerticesIsIgnored) {
  PlyTable table = splats({splat({1, 2, 3}, {0, 0, 0}, -5)});
  table.columns[10].name = "size";  // instead of scale_0
  const auto file = file_of(encode_ply({table}, GetParam()), "a.ply");
  EXPECT_EQ(file.cloud.size(), 1U);
  EXPECT_FALSE(file.cloud.has_colours());
  EXPECT_TRUE(file.remarks.empty());
}

TEST_P(Splats, FaintOnesAreKeptOnRequest) {
  const std::string text =
      encode_ply({splats({splat({1, 2, 3}, {0, 0, 0}, .01), splat({4, 5, 6}, {0, 0, 0}, -5)})}, GetParam());
  const auto file = value_of(read_cloud(bytes_of(text), "a.ply", ReadOptions{{}, true}));
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(file.left_out_points, 0U);
  EXPECT_TRUE(file.remarks.empty());
}

// The splat is thin along z and turned by 30 degrees around x. So its axis is (0, -sin 30, cos 30).
TEST_P(Splats, AxesAreThoseOfTheSmallestScale) {
  const double half = to_radians(15);
  const auto turned = [&](const Vec3& log_scales, double length) {
    std::vector<double> row = splat({1, 2, 3}, {0, 0, 0}, 1);
    std::copy(log_scales.begin(), log_scales.end(), row.begin() + 10);
    row[13] = length * std::cos(half), row[14] = length * std::sin(half);
    return row;
  };
  const PlyTable table = splats(
      {turned({-2, -2, -6}, 1), turned({-2, -6, -2}, 9), turned({-2, -6, -6.3}, 1), turned({-1, -2, -3}, 0)});
  const auto file = file_of(encode_ply({table}, GetParam()), "a.ply");
  ASSERT_EQ(file.cloud.axes.size(), 4U);
  EXPECT_LT((file.cloud.axes[0] - Vec3f(0, -.5F, std::sqrt(.75F))).norm(), 1e-6F);
  EXPECT_LT((file.cloud.axes[1] - Vec3f(0, std::sqrt(.75F), .5F)).norm(), 1e-6F);
  EXPECT_EQ(file.cloud.axes[2], Vec3f::Zero());  // two small scales are nearly equal
  EXPECT_EQ(file.cloud.axes[3], Vec3f::Zero());  // no rotation
}

TEST_P(Splats, NormalsOfTheFileCountMoreThanAxes) {
  std::vector<double> row = splat({1, 2, 3}, {0, 0, 0}, 1);
  row[5] = 1, row[12] = -9;
  const auto file = file_of(encode_ply({splats({row})}, GetParam()), "a.ply");
  EXPECT_EQ(file.cloud.normals, std::vector<Vec3f>{Vec3f::UnitZ()});
  EXPECT_TRUE(file.cloud.axes.empty());
}

TEST_P(Splats, FlatOnesHaveTwoScales) {
  PlyTable table = splats({splat({1, 2, 3}, {0, 0, 0}, 1), splat({1, 2, 3}, {0, 0, 0}, -1)});
  table.columns.erase(table.columns.begin() + 12);
  for (auto& row : table.rows) row.erase(row.begin() + 12);
  const auto file = file_of(encode_ply({table}, GetParam()), "a.ply");
  EXPECT_EQ(file.left_out_points, 1U);
  EXPECT_TRUE(file.cloud.has_colours());
  EXPECT_EQ(file.cloud.axes, std::vector<Vec3f>{Vec3f::UnitZ()});
}

INSTANTIATE_TEST_SUITE_P(All, Splats, testing::ValuesIn(ply_encodings), testing::PrintToStringParamName());

TEST(SplatFile, RowsOfBytesAreRead) {
  const auto row = [](float x, std::uint8_t opacity) {
    return raw(x) + raw(2.F) + raw(3.F) + std::string(12, '\1') + raw(std::uint8_t{10}) +
           raw(std::uint8_t{20}) + raw(std::uint8_t{30}) + raw(opacity) + std::string(4, '\x80');
  };
  const auto file = file_of(row(1, 128) + row(5, 127) + row(6, 255), "a.splat");
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{1, 2, 3}, {6, 2, 3}}));
  EXPECT_EQ(file.cloud.colours, (std::vector<Colour>{{10, 20, 30}, {10, 20, 30}}));
  EXPECT_EQ(file.remarks[0],
            "left out 1 point of splats that are less than half opaque; --doubtful keep keeps them");
  EXPECT_EQ(value_of(read_cloud(bytes_of(row(1, 128) + row(5, 127)), "a.splat", ReadOptions{{}, true}))
                .cloud.points,
            (std::vector<Vec3>{{1, 2, 3}, {5, 2, 3}}));
  EXPECT_EQ(message_of(row(1, 255) + "abc", "a.splat"),
            "a.splat, byte 32: expected a splat of 32 bytes, found 3");
  EXPECT_EQ(
      message_of(row(1, 0), "a.splat"),
      "a.splat: expected points that count, found none: left out 1 point of splats that are less than half "
      "opaque; --doubtful keep keeps them");
}

// A quarter turn around x, given in bytes, turns the thin y axis to z.
TEST(SplatFile, AxesAreThoseOfTheSmallestScale) {
  const std::string row = raw(1.F) + raw(2.F) + raw(3.F) + raw(.1F) + raw(.001F) + raw(.2F) +
                          std::string(3, '\1') + '\xFF' + raw(std::uint8_t{218}) + raw(std::uint8_t{218}) +
                          std::string(2, '\x80');
  const auto axes = file_of(row, "a.splat").cloud.axes;
  ASSERT_EQ(axes.size(), 1U);
  EXPECT_LT((axes[0] - Vec3f::UnitZ()).norm(), 1e-6F);
}

TEST(Splats, PackedOnesAreRefusedByName) {
  const std::string text =
      "ply\nformat binary_little_endian 1.0\nelement chunk 1\nproperty float min_x\nelement vertex 1\n"
      "property uint packed_position\nproperty uint packed_rotation\nend_header\n";
  EXPECT_EQ(
      message_of(text + std::string(12, '\0'), "a.ply"),
      "a.ply, line 5: expected splats that are not packed, found those of a compressed PLY; SuperSplat opens "
      "it and exports a PLY that is not compressed");
  for (const char* const ending : {"spz", "ksplat", "sog"})
    EXPECT_TRUE(message_of("\x1F\x8B", cat("a.", ending)).ends_with("SuperSplat exports them as PLY"));
}

}  // namespace
}  // namespace relievo
