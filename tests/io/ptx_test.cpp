// Tests PTX files. Each of their scans has a transformation matrix.
#include "support/read_text.h"

namespace relievo {
namespace {

std::string header(int columns, int rows, const std::string& matrix) {
  return std::to_string(columns) + "\n" + std::to_string(rows) + "\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + matrix;
}

const std::string identity = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

// Maps x to y and y to -x, then moves by (10, 20, 30). Points are row vectors.
const std::string turned = "0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n";

TEST(Ptx, ScansAreMovedByTheirMatrices) {
  const auto file = file_of(
      header(1, 2, identity) + "1 2 3 0.5\n4 5 6 0.5\n" + header(2, 1, turned) + "1 2 3 0.5\r\n0 0 0 0.5\r\n",
      "a.ptx");
  EXPECT_EQ(file.format, "PTX, 2 scans");
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {8, 21, 33}}));
  EXPECT_FALSE(file.cloud.has_colours());
  EXPECT_EQ(file.left_out_points, 1U);
  EXPECT_EQ(file.remarks[0],
            "left out 1 point at 0, 0, 0 of their scanner, as scanners write what they have not measured");
}

TEST(Ptx, ColoursFollowTheIntensity) {
  const auto file = file_of(header(1, 2, identity) + "1 2 3 0.5 10 20 30\n4 5 6 0.25 255 0 7\n", "scan");
  EXPECT_EQ(file.cloud.colours, (std::vector<Colour>{{10, 20, 30}, {255, 0, 7}}));
}

TEST(Ptx, BrokenFieldsAreNamed) {
  expect_messages(
      "a.ptx",
      {{"hello", ", line 1: expected the number of columns or rows of a scan, found 'hello'"},
       {"4000000000\n4000000000\n",
        ", line 2: expected fewer than 4294967295 points, found 4000000000 x 4000000000"},
       {"1\n1\n0 0\n", ", line 3: expected 3 numbers, found '0 0'"},
       {"1\n1\n0 0 0\n", ", line 4: expected 3 numbers, found the end of the file"},
       {header(1, 1, "1 0 0\n"), ", line 7: expected 4 numbers, found '1 0 0'"},
       {header(1, 2, identity) + "1 2 3 0\n",
        ", line 12: expected 2 points, found the end of the file after 1"},
       {header(1, 1, identity) + "1 2 x\n", ", line 11: expected x, y, z and further numbers, found '1 2 x'"},
       {header(1, 1, identity) + "1 2 3 0\n7 8\n",
        ", line 12: expected the number of columns or rows of a scan, found '7 8'"}});
}

}  // namespace
}  // namespace relievo
