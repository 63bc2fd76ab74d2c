// Tests NumPy arrays of points. tests/io/depth_formats_test.cpp tests arrays that are depth images.
#include "support/format_samples.h"
#include "support/read_text.h"

namespace relievo {
namespace {

// Returns the numbers value(row, column) of an array as bytes. Rows are the positions in all dimensions but
// the last, numbered consecutively. A column is an index of the last dimension.
template <typename Number, typename Value>
std::string numbers(std::size_t rows, std::size_t columns, const Value& value) {
  std::string data;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) data += raw(static_cast<Number>(value(r, c)));
  return data;
}

double counted(std::size_t row, std::size_t column) {
  return 10. * static_cast<double>(row) + static_cast<double>(column);
}

std::vector<Vec3> counted_points(std::size_t count) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(counted(i, 0), counted(i, 1), counted(i, 2));
  return points;
}

TEST(NpyPoints, RowsOfThreeNumbersAreCoordinatesInAnyTypeAndOrder) {
  const auto points_in = [](const std::string& file) { return file_of(file, "scan").cloud.points; };
  const std::string floats = numbers<float>(5, 3, counted);
  EXPECT_EQ(points_in(npy("<f4", floats, "5, 3")), counted_points(5));
  EXPECT_EQ(points_in(npy("<f8", numbers<double>(5, 3, counted), "5, 3")), counted_points(5));
  EXPECT_EQ(points_in(npy("<i2", numbers<std::int16_t>(5, 3, counted), "5, 3")), counted_points(5));
  EXPECT_EQ(points_in(npy("<f4", floats, "5, 1, 3")), counted_points(5)) << "as OpenCV shapes them";
  const auto by_columns = [](std::size_t column, std::size_t row) { return counted(row, column); };
  EXPECT_EQ(points_in(npy("<f4", numbers<float>(3, 5, by_columns), "5, 3", true)), counted_points(5));
  EXPECT_EQ(file_of(npy("<f4", floats, "5, 3"), "scan").format, "NPY, 32 bits, 3 columns");
}

TEST(NpyPoints, KeepTheDigitsOfLargeCoordinates) {
  const auto far = [](std::size_t r, std::size_t c) { return 5'600'000.25 + counted(r, c); };
  EXPECT_EQ(file_of(npy("<f8", numbers<double>(2, 3, far), "2, 3"), "scan").cloud.points[1],
            Vec3(far(1, 0), far(1, 1), far(1, 2)));
}

// The array contains two pictures of 3 x 4 points. In Fortran's order, the first index changes fastest.
TEST(NpyPoints, SeveralPicturesAreOneCloudInBothOrders) {
  const auto far = [](std::size_t row, std::size_t column) { return counted(row + 100, column); };
  std::vector<Vec3> points = counted_points(124);
  points.erase(points.begin(), points.begin() + 100);
  EXPECT_EQ(file_of(npy("<f4", numbers<float>(24, 3, far), "2, 3, 4, 3"), "scan").cloud.points, points);
  std::string data;
  for (std::size_t column = 0; column < 3; ++column)
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t picture = 0; picture < 2; ++picture)
          data += raw(static_cast<float>(far((picture * 3 + r) * 4 + c, column)));
  EXPECT_EQ(file_of(npy("<f4", data, "2, 3, 4, 3", true), "scan").cloud.points, points);
}

// In rows of more than three numbers, the reader recognises normals and colours by their values. A short
// table is a depth image.
TEST(NpyPoints, NormalsAndColoursAreFoundByTheirValues) {
  const auto value = [](std::size_t r, std::size_t c) {
    const double turn = .1 * static_cast<double>(r);
    const double values[] = {turn, turn * turn, 1, std::cos(turn), std::sin(turn), 0, 0, 128, 255};
    return values[c];
  };
  const auto all = file_of(npy("<f4", numbers<float>(200, 9, value), "200, 9"), "scan");
  ASSERT_EQ(all.cloud.size(), 200U);
  EXPECT_EQ(all.format, "NPY, 32 bits, 9 columns with normals and colours");
  EXPECT_NEAR(all.cloud.normals[7].y(), std::sin(.7), 1e-6);
  EXPECT_EQ(all.cloud.colours[7], (Colour{0, 128, 255}));
  const auto normals = file_of(npy("<f4", numbers<float>(200, 6, value), "200, 6"), "scan");
  EXPECT_TRUE(normals.cloud.has_normals());
  EXPECT_FALSE(normals.cloud.has_colours());
  const auto plain = file_of(npy("<f4", numbers<float>(200, 6, counted), "200, 6"), "scan");
  EXPECT_EQ(plain.cloud.points, counted_points(200));
  EXPECT_FALSE(plain.cloud.has_normals() || plain.cloud.has_colours());
  EXPECT_TRUE(is_picture(bytes_of(npy("<f4", numbers<float>(20, 6, value), "20, 6"))));
  EXPECT_TRUE(is_picture(bytes_of(npy("<u2", numbers<std::uint16_t>(200, 6, counted), "200, 6"))));
}

// Returns an array of the points that a camera sees. The camera looks at a plane at distance 2, and its y
// axis points down. The depths have errors of up to 0.03 times the width of a pixel.
std::string point_map(float missing) {
  constexpr int columns = 24, rows = 18;
  std::string data;
  for (int i = 0; i < columns * rows; ++i) {
    const double depth = 2 + .002 * (i * 37 % 11 - 5) / 5;
    const Vec3 point = depth * Vec3((i % columns - 11.5) / 30, (i / columns - 8.5) / 30, 1);
    for (const double x : point) data += raw(i < 40 ? missing : static_cast<float>(x));
  }
  return npy("<f4", data, "1, 18, 24, 3");
}

TEST(NpyPoints, APointMapIsSmoothedAndLosesMissingPoints) {
  for (const float missing : {NAN, INFINITY, 0.F}) {
    const auto map = file_of(point_map(missing), "scan");
    ASSERT_EQ(map.cloud.size(), 18 * 24 - 40U) << missing;
    EXPECT_EQ(map.dropped_points, 40U);
    EXPECT_TRUE(map.remarks.at(0).starts_with("an organised cloud of 24 x 18 points, smoothed within "))
        << missing;
    for (const Vec3f& n : map.cloud.normals) EXPECT_LT(n.z(), -.99F);
  }
}

TEST(NpyPoints, PicturesOfNormalsAndColoursAreRefused) {
  const auto unit = [](std::size_t r, std::size_t c) {
    const double turn = .1 * static_cast<double>(r);
    return c == 0 ? std::cos(turn) : c == 1 ? std::sin(turn) : 0;
  };
  const auto share = [](std::size_t r, std::size_t c) { return static_cast<double>(r * 3 + c) / 200; };
  const std::string normals = numbers<float>(60, 3, unit), colours = numbers<float>(60, 3, share);
  EXPECT_EQ(
      message_of(npy("<f4", normals, "6, 10, 3"), "scan"),
      "scan: expected a picture of points, found one of normals; in Python a.reshape(-1, 3) makes a list of "
      "points of it");
  EXPECT_EQ(
      message_of(npy("<f4", colours, "6, 10, 3"), "scan"),
      "scan: expected a picture of points, found one of colours; in Python a.reshape(-1, 3) makes a list of "
      "points of it");
  EXPECT_EQ(file_of(npy("<f4", colours, "60, 3"), "scan").cloud.size(), 60U);
}

TEST(NpyPoints, AreRefusedIfTheFileIsCut) {
  const std::string whole = npy("<f4", numbers<float>(5, 3, counted), "5, 3");
  EXPECT_EQ(message_of(whole.substr(0, whole.size() - 1), "scan"),
            cat("scan, byte ", whole.size() - 60,
                ": expected the points of an array (5, 3), found room for 4; the file is cut, get it anew"));
  EXPECT_EQ(message_of(npy("<f8", "", "4000000000, 4000000000, 3"), "scan"),
            "scan, byte 94: expected the points of an array (4000000000, 4000000000, 3), found room for 0; "
            "the file is cut, get it anew");
  EXPECT_EQ(message_of(npy("<f4", "", "0, 3"), "scan"), "scan: expected points, found none");
}

}  // namespace
}  // namespace relievo
