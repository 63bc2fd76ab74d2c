// Tests heights in text files: grids of GIS programs, and tables of numbers, which must not be read as clouds.
#include <span>

#include "support/read_text.h"

namespace relievo {
namespace {

bool is_picture_text(const std::string& text) {
  return is_picture(bytes_of(text));
}

const std::string grid_header =
    "ncols 5\r\nnrows 4\r\nxllcorner 500000\r\nyllcorner 6647000\r\ncellsize 31\r\nNODATA_value -9999\r\n";

TEST(EsriGrid, ReadsHeightsWhereverLinesBreak) {
  const auto image = image_in(grid_header + "1 2 3 4 5 6 7\n8 9 -9999 11 12.5 13\n14 15 16 17 18 19 20\n");
  EXPECT_EQ(image.format, "Esri grid");
  EXPECT_EQ(image.values.width, 5);
  EXPECT_EQ(image.values.height, 4);
  EXPECT_EQ(image.values[0], 1);
  EXPECT_TRUE(std::isnan(image.values[9]));
  EXPECT_EQ(image.values[11], 12.5);
  EXPECT_EQ(image.step, 0);
  EXPECT_EQ(image.pixel_size, Vec2(31, 31));
}

TEST(EsriGrid, ReadsOtherSpellings) {
  const auto image = image_in("NROWS 4\nNCOLS 4\nXLLCENTER 0\nYLLCENTER 0\nDX 2\nDY 3\n" +
                              std::string("1 2 3 4 5 6 7 8 1 2 3 4 5 6 7 8"));
  EXPECT_EQ(image.pixel_size, Vec2(2, 3));
  EXPECT_EQ(image.step, 1);
  const auto commas =
      image_in("ncols 4\nnrows 4\nxllcorner 0,5\nyllcorner 7\ncellsize 2,5\nNODATA_value -1,5\n" +
               std::string("1,25 2 3 4 5 6 7 8 1 2 3 4 5 6 7 -1,5"));
  EXPECT_EQ(commas.pixel_size, Vec2(2.5, 2.5));
  EXPECT_EQ(commas.values.at(0, 0), 1.25F);
  EXPECT_TRUE(std::isnan(commas.values.at(3, 3)));
}

// A grid counts as in degrees under two conditions: its corner is a position on the globe, and its heights
// would be far too large for its width if heights and width were in metres.
TEST(EsriGrid, ConvertsDegrees) {
  const std::string heights = " 0 300 200 100 0 300 200 100 0 300 200 100 0 300 200 100";
  const auto size_at = [&](const std::string& corner, const std::string& cell) {
    return image_in("ncols 4\nnrows 4\nxllcorner 10\nyllcorner " + corner + "\ncellsize " + cell + "\n" +
                    heights)
        .pixel_size;
  };
  const Vec2 degrees = size_at("59", "0.5");  // the centre of the grid is at 60 degrees north
  EXPECT_NEAR(degrees.x() / degrees.y(), .5, 1e-12);
  EXPECT_EQ(size_at("59", "100"), Vec2(100, 100));
  EXPECT_EQ(size_at("100", "0.5"), Vec2(.5, .5));
}

TEST(EsriGrid, SaysWhatIsWrong) {
  const std::string many = replaced(std::string(21, '1'), "1", "1 ");
  expect_image_messages(
      {{"ncols 5\nrows 4\n1 2 3\n",
        ", line 2: expected ncols, nrows, cellsize or another entry of an Esri grid with its number, found "
        "'rows 4'"},
       {"ncols 5\ncellsize 1\n1 2 3\n", ": expected ncols and nrows of an Esri grid, found 5 and 0"},
       {"ncols 5\n", ", line 2: expected the heights of an Esri grid, found the end of the file"},
       {grid_header + "1 2 x\n", ", line 7: expected a height, found 'x'"},
       {grid_header + "1 2 3\n4 5\n", ", line 9: expected 20 heights, found the end of the file after 5"},
       {grid_header + many, ", line 7: expected 20 heights, found more"},
       {"ncols 500\nnrows 400\ncellsize 1\n1 2 3\n",
        ": expected 500 x 400 heights, found 37 bytes; the file is cut, get it anew"},
       {"ncols 50000\nnrows 40000\ncellsize 1\n1\n",
        ": expected at most 134217728 pixels, found 50000 x 40000"}});
}

// Returns a table of the heights of a hill, as text.
std::string hill(int columns, int rows, const std::string& separator, char point = '.') {
  std::string text;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double x = 2. * c / (columns - 1) - 1, y = 2. * r / (rows - 1) - 1;
      const auto tenths = static_cast<int>(std::lround(100 * std::exp(-2 * (x * x + y * y))));
      text += cat(c > 0 ? separator : "", tenths / 10, point, tenths % 10);
    }
    text += '\n';
  }
  return text;
}

TEST(HeightTable, ReadsAllSeparators) {
  const auto image = image_in(hill(12, 9, " "));
  EXPECT_EQ(image.format, "table of heights");
  EXPECT_EQ(image.values.width, 12);
  EXPECT_EQ(image.values.height, 9);
  for (const char* separator : {",", ";", "\t", ", ", "   "})
    EXPECT_EQ(image_in(hill(12, 9, separator)).values.pixels, image.values.pixels) << separator;
  EXPECT_EQ(image_in(hill(12, 9, ";", ',')).values.pixels, image.values.pixels);
  EXPECT_EQ(image_in("# Channel: Height\n" + hill(12, 9, "\t")).values.pixels, image.values.pixels);
}

// The example is from OpenSCAD's manual for surface().
TEST(HeightTable, ReadsOpenScadsExample) {
  const auto image = image_in(
      "# 10x10 surface data\n10 9 8 7 6 5 5 5 5 5\n9 8 7 6 6 4 3 2 1 0\n\n8 7 6 6 4 3 2 1 0 0\n"
      "7 6 6 4 3 2 1 0 0 0\n6 6 4 3 2 1 1 0 0 0\n6 6 3 2 1 1 1 0 0 0\n6 6 2 1 1 1 1 0 0 0\n"
      "6 6 1 0 0 0 0 0 0 0\n3 1 0 0 0 0 0 0 0 0\n3 0 0 0 0 0 0 0 0 0\n");
  EXPECT_EQ(image.values.height, 10);
  EXPECT_EQ(image.values.at(0, 9), 3);
  EXPECT_EQ(image.step, 1);
}

TEST(HeightTable, OtherWordsAreMissing) {
  std::string text = hill(12, 9, ",");
  text.replace(text.find(','), 1, ",BAD");  // the second number of the first line
  EXPECT_TRUE(std::isnan(image_in(text).values[1]));
}

TEST(HeightTable, IsNotTakenForACloudNorACloudForIt) {
  EXPECT_TRUE(is_picture_text(hill(8, 8, " ")));
  EXPECT_FALSE(is_picture_text(hill(7, 8, " "))) << "seven columns are a cloud";
  std::string cloud, named = "x,y,z,nx,ny,nz,a,b,c\n";
  for (int i = 0; i < 300; ++i) {
    const double x = (i * 37 % 101) / 101., y = (i * 53 % 103) / 103., z = x * y;
    const std::string row =
        cat(x, ",", y, ",", z, ",", i % 7, ",", 100 + i % 5, ",", i % 3, ",", i % 11, ",", x, ",", y);
    cloud += row + '\n', named += row + '\n';
  }
  EXPECT_FALSE(is_picture_text(cloud));
  EXPECT_FALSE(is_picture_text(named));
  EXPECT_FALSE(is_picture_text("9\n" + hill(9, 9, " "))) << "the number of points of a PTS";
  EXPECT_FALSE(is_picture_text("v 1 2 3\n"));
  EXPECT_FALSE(is_picture_text(""));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    lines.push_back(text.substr(at, end - at));
  return lines;
}

// Returns the table of hill() with headings. The position of each row is before the row, the position
// of each column above the column. `corner` is in the first cell.
std::string with_places(const std::string& corner, double wide, double high) {
  const std::vector<std::string> rows = lines_of(hill(12, 9, ","));
  std::string text = corner;
  for (int c = 0; c < 12; ++c) text += cat(",", wide * c);
  text += '\n';
  for (std::size_t r = 0; r < rows.size(); ++r)
    text += cat(high * static_cast<double>(r), ",", rows[r], "\n");
  return text;
}

TEST(HeightTable, LeavesOutTheNumbersOfRowsAndColumns) {
  const auto plain = image_in(hill(12, 9, ","));
  for (const char* const corner : {"", "y/x", "\"\""}) {
    const auto image = image_in(with_places(corner, 1, 1));  // as pandas writes it
    EXPECT_EQ(image.values.pixels, plain.values.pixels) << corner;
    EXPECT_EQ(image.values.width, 12);
    EXPECT_EQ(image.pixel_size, Vec2(0, 0));
    EXPECT_EQ(image.format, "table of heights, without the numbers or places of its rows and columns");
  }
  const auto places = image_in(with_places("um", .5, -.25));
  EXPECT_EQ(places.values.pixels, plain.values.pixels);
  EXPECT_EQ(places.pixel_size, Vec2(.5, .25));
  const auto above = image_in("0,1,2,3,4,5,6,7,8,9,10,11\n" + hill(12, 9, ","));
  EXPECT_EQ(above.values.pixels, plain.values.pixels);
  std::string left;
  for (std::size_t r = 0; r < 9; ++r) left += cat(r + 1, ",", lines_of(hill(12, 9, ","))[r], "\n");
  EXPECT_EQ(image_in(left).values.pixels, plain.values.pixels);
}

TEST(HeightTable, KeepsHeightsThatCount) {
  std::string ramp;
  for (int r = 0; r < 9; ++r)
    for (int c = 0; c < 12; ++c) ramp += cat(c + .1 * r, c < 11 ? "," : "\n");
  EXPECT_EQ(image_in(ramp).values.height, 9);
  EXPECT_EQ(image_in(ramp).values.width, 12);
}

TEST(HeightTable, BeginsBehindTheLinesOfAnInstrument) {
  const auto plain = image_in(hill(12, 9, ";"));
  const std::string words = "Height data\nunit;um\nSize;12;9\nDate;2026-11-29;10:30\n\n";
  EXPECT_EQ(image_in(words + hill(12, 9, ";")).values.pixels, plain.values.pixels);
  EXPECT_EQ(image_in("north: 9\nsouth: 0\nrows: 9\ncols: 12\n" + hill(12, 9, " ")).values.pixels,
            plain.values.pixels);
  EXPECT_FALSE(is_picture_text("ply\nformat ascii 1.0\n" + hill(40, 9, " "))) << "a format with a mark";
  EXPECT_FALSE(is_picture_text("Some words\nand no table, 1 2 3\n"));
}

TEST(HeightTable, EmptyFieldsAreMissing) {
  const auto plain = image_in(hill(12, 9, ","));
  for (const char* const word : {"", "BAD", "---", "***"}) {
    std::string row = word;
    for (int c = 1; c < 12; ++c) row += cat(",", word);
    const auto image = image_in(row + "\n" + row + "\n" + hill(12, 9, ","));
    ASSERT_EQ(image.values.height, 11) << word;
    EXPECT_TRUE(
        std::ranges::all_of(std::span(image.values.pixels).first(24), [](float v) { return std::isnan(v); }));
    EXPECT_TRUE(std::ranges::equal(std::span(image.values.pixels).subspan(24), plain.values.pixels));
  }
  std::string margins =
      "---,---,---,---,---,---,---,---,---,---,---,---,---,---\n---,1,---,---,---,---,---,---,---,---,---,---"
      ",---,2\n";
  for (const std::string& row : lines_of(hill(12, 9, ","))) margins += "---," + row + ",---\n";
  const auto image_with_margins = image_in(margins);
  EXPECT_EQ(image_with_margins.values.width, 14);
  EXPECT_EQ(image_with_margins.values.height, 11);
  EXPECT_EQ(image_with_margins.values.at(13, 1), 2);
  EXPECT_EQ(image_with_margins.values.at(1, 2), plain.values[0]);
  std::string text = hill(12, 9, ",");
  const std::size_t last = text.find('\n', text.find('\n') + 1), comma = text.rfind(',', last);
  const auto image = image_in(text.erase(comma + 1, last - comma - 1));
  EXPECT_TRUE(std::isnan(image.values.at(11, 1)));
  EXPECT_EQ(image.values.at(0, 2), plain.values.at(0, 2));
}

TEST(HeightTable, NamesTheLineOfAnotherLength) {
  EXPECT_EQ(image_message(hill(12, 5, " ") + "1 2 3\n"),
            "d, line 6: expected 12 heights as in line 1, found 3");
}

}  // namespace
}  // namespace relievo
