#include <functional>

#include "support/read_text.h"

namespace relievo {
namespace {

const std::vector<Vec3> two_points = {{1, 2.5, -3}, {4, 5, 6e3}};

CloudFile file_of(std::string_view text) {
  return relievo::file_of(text, "scan.xyz");
}

std::vector<Vec3> points_of(std::string_view text) {
  return file_of(text).cloud.points;
}

const std::vector<Vec3f> xz = {Vec3f::UnitX(), Vec3f::UnitZ()};

// Expects that each text is read as the two points, with the given normals and colours.
void expect_two_points(const std::vector<std::string>& texts, const std::vector<Vec3f>& normals,
                       const std::vector<Colour>& colours = {}) {
  for (const std::string& text : texts) {
    const CloudFile file = file_of(text);
    EXPECT_EQ(file.cloud.points, two_points) << text;
    EXPECT_EQ(file.cloud.normals, normals) << text;
    EXPECT_EQ(file.cloud.colours, colours) << text;
  }
}

TEST(Xyz, ReadsEverySeparator) {
  for (const auto* text :
       {"1 2.5 -3\n4 5 6e3\n", "1\t2.5\t-3\n4\t5\t6e3", "1,2.5,-3\n4,5,6e3\n", "1;2.5;-3\n4;5;6e3\n",
        " 1,  2.5, -3 \n4 ,5,6e3\n", "1 ; 2.5;\t-3\r\n4;5;6e3\r\n", "1,2.5,-3,\n4,5,6e3,\n",
        "  +1   2.5 \t -3  \r\n\r\n4 5 6e3", "1 2.5 -3\r4 5 6e3\r",
        "\xEF\xBB\xBF"
        "1 2.5 -3\n4 5 6e3\n"}) {
    EXPECT_EQ(points_of(text), two_points) << text;
  }
}

TEST(Xyz, SkipsCommentsAndEmptyLines) {
  EXPECT_EQ(points_of("# a scan\n// of mine\n\n1 2.5 -3 # first\n \t\n#1 1 1\n4 5 6e3 // second\n"),
            two_points);
}

TEST(Xyz, FormatNamesTheColumns) {
  EXPECT_EQ(file_of("1 2 3\n").format, "XYZ text, 3 columns");
  EXPECT_EQ(file_of("1 2 3 0 0 1\n").format, "XYZ text, 6 columns with normals");
  EXPECT_EQ(file_of("1\n1 2 3 9\n").format, "PTS text, 4 columns");
  EXPECT_EQ(file_of("1 2 3 50 60 70\n").format, "XYZ text, 6 columns with colours");
  EXPECT_EQ(file_of("1 2 3 0 0 1 50 60 70\n").format, "XYZ text, 9 columns with normals and colours");
}

TEST(Xyz, FirstLineMayPromiseTheNumberOfPoints) {
  EXPECT_EQ(points_of("2\r\n1 2.5 -3\r\n4 5 6e3\r\n"), two_points);
  EXPECT_EQ(points_of("1\n1 2.5 -3\n4 5 6e3\n"), two_points) << "more than promised are taken";
  EXPECT_EQ(message_of("3\n1 2.5 -3\n4 5 6e3\n", "scan.pts"),
            "scan.pts, line 4: expected 3 points as line 1 says, found the end of the file after 2");
  EXPECT_EQ(message_of("1152921504606846976\n1 2 3\n", "scan.pts"),
            "scan.pts, line 3: expected 1152921504606846976 points as line 1 says, found the end of the file "
            "after 1");
}

TEST(Xyz, FourthColumnIsIgnored) {
  EXPECT_EQ(points_of("1 2.5 -3 0.7\n4 5 6e3 ground\n"), two_points);
}

TEST(Xyz, SixColumnsAreNormalsIfTheyAreUnitVectorsAndColoursOtherwise) {
  expect_two_points({"1 2.5 -3 1 0 0\n4 5 6e3 0 0 1\n"}, xz);
  expect_two_points({"1 2.5 -3 255 0 10\n4 5 6e3 0 51 1\n", "1;2,5;-3;255;0;10\n4;5;6e3;0;51;1\n",
                     "1 2.5 -3 1.0 0 0.0392\n4 5 6e3 0 0.2 0.00392\n"},
                    {}, {{255, 0, 10}, {0, 51, 1}});
}

TEST(Xyz, RoundedNormalsAreRecognisedAndNormalised) {
  const CloudFile file = file_of("0 0 0 0.58 0.58 0.58\n1 1 1 -0.71 0.00 0.71\n");
  ASSERT_TRUE(file.cloud.has_normals());
  EXPECT_TRUE(file.cloud.normals[0].isApprox(Vec3f(1, 1, 1).normalized()));
  EXPECT_NEAR(file.cloud.normals[1].norm(), 1, 1e-7);
}

// The colour of each point is a function of the point's position. So a wrong row, column or scale would be noticed.
TEST(Xyz, ColoursOfARampAreThoseOfItsPlaces) {
  std::string bytes, fractions, words;
  std::vector<Colour> expected;
  for (int i = 0; i < 256; ++i) {
    const int red = i, green = 255 - i, blue = i * 7 % 256;
    const std::string place = std::to_string(i) + ",0.5,-2.25,";
    const auto row = [&](auto value) {
      return place + std::to_string(value(red)) + "," + std::to_string(value(green)) + "," +
             std::to_string(value(blue)) + "\n";
    };
    bytes += row([](int c) { return c; });
    fractions += row([](int c) { return c / 255.0; });
    words += row([](int c) { return c * 257; });
    expected.push_back(
        {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green), static_cast<std::uint8_t>(blue)});
  }
  EXPECT_EQ(file_of(bytes).cloud.colours, expected);
  EXPECT_EQ(file_of(fractions).cloud.colours, expected);
  EXPECT_EQ(file_of("X,Y,Z,Red,Green,Blue\n" + words).cloud.colours, expected) << "16 bits, as in LAS";
  EXPECT_EQ(file_of("//X,Y,Z,Rf,Gf,Bf\n" + fractions).cloud.colours, expected)
      << "as CloudCompare writes them";
}

TEST(Xyz, NormalsAndColoursAreFoundAmongOtherColumns) {
  expect_two_points(
      {"1 2.5 -3 255 0 10 1 0 0\n4 5 6e3 0 9 1 0 0 1\n", "1 2.5 -3 1 0 0 255 0 10\n4 5 6e3 0 0 1 0 9 1\n",
       "2\n1 2.5 -3 77 255 0 10 1 0 0\n4 5 6e3 78 0 9 1 0 0 1\n",
       "nx ny nz B G R x y z\n1 0 0 10 0 255 1 2.5 -3\n0 0 1 1 9 0 4 5 6e3\n"},
      xz, {{255, 0, 10}, {0, 9, 1}});
  expect_two_points({"1 2.5 -3 77 1 0 0\n4 5 6e3 78 0 0 1\n", "1 2.5 -3 1 0 0 77\n4 5 6e3 0 0 1 77\n"}, xz);
}

TEST(Xyz, ColumnsOfOtherNumbersAreNoColours) {
  for (const char* const text : {"1 2.5 -3 -1 0 10\n4 5 6e3 0 0 1\n", "1 2.5 -3 300 0 10\n4 5 6e3 0 0 1\n",
                                 "1 2.5 -3 2 1 4\n4 5 6e3 5 2 3\n", "1 2.5 -3 10.5 0 10\n4 5 6e3 0 0 99\n",
                                 "x y z a b c\n1 2.5 -3 255 0 10\n4 5 6e3 0 0 1\n"})
    EXPECT_FALSE(file_of(text).cloud.has_colours()) << text;
}

TEST(Xyz, APointWithoutColourIsBlack) {
  expect_two_points({"x,y,z,r,g,b\n1,2.5,-3,none,none,none\n4,5,6e3,0,200,1\n"}, {},
                    {{0, 0, 0}, {0, 200, 1}});
}

TEST(Xyz, AFewRowsWithoutUnitNormalDoNotHideTheOthers) {
  std::string text;
  for (int i = 0; i < 99; ++i) text += std::to_string(i) + " 0 0 0.6 0 0.8\n";
  const CloudFile file = file_of(text + "99 0 0 0 0 0\n");
  EXPECT_EQ(file.cloud.normals.size(), 99U);
  EXPECT_EQ(file.dropped_normals, 1U);
}

TEST(Xyz, SevenColumnsOfPtsAreIntensityAndColour) {
  expect_two_points(
      {"2\n1 2.5 -3 -1023 255 0 10\n4 5 6e3 7 0 0 1\n", "2\n1 2.5 -3 102 255 0 10\n4 5 6e3 7 0 0 1\n"}, {},
      {{255, 0, 10}, {0, 0, 1}});
}

// Each scan is a block of lines, and a line with the number of its points precedes each block.
TEST(Xyz, PtsMayHaveSeveralBlocks) {
  const auto file = relievo::file_of("2\n1 2 3 9\n4 5 6 9\n1\n7 8 9 9\n\n0\n", "a.pts");
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
  EXPECT_EQ(message_of("1\n1 2 3 9\n2\n7 8 9 9\n", "a.pts"),
            "a.pts, line 5: expected 2 points as line 3 says, found the end of the file after 1");
  EXPECT_EQ(message_of("3\n1 2 3 9\n4 5 6 9\n1\n7 8 9 9\n", "a.pts"),
            "a.pts, line 4: expected 4 columns as in line 2, found 1");
}

// Returns a table of 20 lines. Each line consists of `before`, three coordinates with fractions, and `after`.
std::string table(const std::function<std::string(int)>& before, const std::string& after) {
  std::string text;
  for (int i = 0; i < 20; ++i)
    text += before(i) + std::to_string(i + .5) + " " + std::to_string(1.25 * i) + " -" +
            std::to_string(i + .75) + after + "\n";
  return text;
}

TEST(Xyz, NumbersOfPointsAreNoCoordinates) {
  std::string numbered, commas, profiles;
  for (int i = 0; i < 400; ++i) {
    const std::string place = cat(.5 + i % 20, ",", .25 + i / 20, ",", .125 * (i % 7));
    commas += cat(i + 1, ",", place, ",", i % 256, "\n");
    std::string words = place;
    std::ranges::replace(words, ',', ' ');
    numbered += cat(1000 + 3 * i, " ", words, "\n");
    profiles += cat(i / 20, " ", .5 + i % 20, " .25 ", 7 + i % 9, "\n");  // x differs from the point's number
  }
  for (const std::string& text : {numbered, commas}) {
    const auto file = file_of(text);
    EXPECT_EQ(file.cloud.points[21], Vec3(1.5, 1.25, 0));
    EXPECT_TRUE(file.format.ends_with(" after the point's number")) << file.format;
  }
  EXPECT_EQ(file_of(profiles).cloud.points[21], Vec3(1, 1.5, .25));
}

TEST(Xyz, RowAndColumnOfAScannerAreNoCoordinates) {
  const auto row_and_column = [](int i) { return cat(i / 5, " ", 700 + i % 5, " "); };
  const auto none = [](int) { return std::string(); };
  for (const std::string after : {"", " 0.25", " 10 20 200"}) {
    const auto file = relievo::file_of(table(row_and_column, after), "a.xyz"),
               plain = relievo::file_of(table(none, after), "a.xyz");
    EXPECT_EQ(file.cloud.points, plain.cloud.points) << after;
    EXPECT_EQ(file.cloud.colours, plain.cloud.colours) << after;
    EXPECT_TRUE(file.format.ends_with(" after row and column")) << file.format;
  }
  // Here x and y are integers, and each line ends with a normal or a colour. The integers must be read as coordinates.
  std::string with_normals, with_colours;
  for (int i = 0; i < 20; ++i) {
    with_normals += cat(i % 5, " ", i / 5, " ", i + .5, " 0.6 0 0.8\n");
    with_colours += cat(i % 5, " ", i / 5, " ", i + .5, " 0.25 0.5 ", i / 20., "\n");
  }
  for (const std::string& text : {with_normals, with_colours})
    EXPECT_EQ(relievo::file_of(text, "a.xyz").cloud.points[7], Vec3(2, 1, 7.5));
}

TEST(Xyz, NamesOfColumnsDecide) {
  expect_two_points(
      {"nx,ny,nz,label,Z,Y,X\n1,0,0,a,-3,2.5,1\n0,0,1,b,6e3,5,4\n",
       "\"NX\"; \"NY\"; \"NZ\"; \"label\"; \"z\"; \"y\"; \"x\"\n1;0;0;a;-3;2.5;1\n0;0;1;b;6e3;5;4\n",
       "//Nx Ny Nz Label Z Y X\n2\n1 0 0 9 -3 2.5 1\n0 0 1 9 6e3 5 4\n"},
      xz);
  expect_two_points({"x y z a b c\n1 2.5 -3 1 0 0\n4 5 6e3 0 0 1\n"}, {});
}

TEST(Xyz, CommentThatDoesNotFitTheColumnsNamesNothing) {
  EXPECT_EQ(points_of("# z y x of the scan\n1 2.5 -3\n4 5 6e3\n"), two_points);
}

TEST(Xyz, NotFiniteCoordinatesAreDroppedAndCounted) {
  const CloudFile file = file_of("1 2.5 -3\nnan 0 0\n0 -inf 0\n0 0 1e999\n1.#QNAN 0 0\n4 5 6e3\n");
  EXPECT_EQ(file.cloud.points, two_points);
  EXPECT_EQ(file.dropped_points, 4U);
}

TEST(Xyz, DecimalCommasAreNeverMisread) {
  const std::string message = ": expected numbers with a decimal point, separated in one way, found ";
  for (const std::string text :
       {"1,5 2,5 3,5", "1,5\t2,5\t3.5,4", "1,5, 2,5, 3,5", "1,5  2,5  3,5  0,1  0,2  0,3"}) {
    EXPECT_TRUE(message_of(text + "\n", "scan.xyz").starts_with("scan.xyz, line 1" + message)) << text;
  }
  EXPECT_EQ(message_of("1 2 3\n1,5 2,5 3,5\n", "scan.xyz"),
            "scan.xyz, line 2: expected a number in column 1, found '1,5'");
}

TEST(Xyz, SemicolonsMaySeparateNumbersWithDecimalCommas) {
  EXPECT_EQ(points_of("1,0;2,5;-3\n4;5;6,0e3\n"), two_points);
  expect_two_points({"x;y;z;nx;ny;nz\n1,0;2,5;-3,0;1,0;0;0\n4;5;6e3;0;0;1,0\n"}, xz);
  EXPECT_EQ(message_of("1.5;2,5;3\n", "scan.xyz"),
            "scan.xyz, line 1: expected a number in column 2, found '2,5'");
}

TEST(Xyz, TabsMaySeparateNumbersWithDecimalCommas) {
  EXPECT_EQ(points_of("1,0\t2,5\t-3\n4\t5\t6,0e3\n"), two_points);
  EXPECT_EQ(points_of("x\ty\tz\n1,0\t2,5\t-3\n4\t5\t6e3\n"), two_points);
  EXPECT_EQ(message_of("1.5\t2,5\t3\n", "scan.xyz"),
            "scan.xyz, line 1: expected a number in column 2, found '2,5'");
}

TEST(Xyz, ALaterLineMayHaveTheFirstDecimalComma) {
  EXPECT_EQ(points_of("4;5;6000\n1;2,5;-3\n"), (std::vector<Vec3>{two_points[1], two_points[0]}));
  EXPECT_EQ(points_of("4\t5\t6000\n1\t2,5\t-3\n"), (std::vector<Vec3>{two_points[1], two_points[0]}));
}

TEST(Xyz, OtherColumnsMayBeTexts) {
  EXPECT_EQ(points_of("1,2.5,-3,a wall\n4,5,6e3,b c d\n"), two_points);
  EXPECT_EQ(points_of("name,x,y,z\nfirst one,1,2.5,-3\nb,4,5,6e3\n"), two_points);
  EXPECT_EQ(points_of("\"1\",\"2.5\",\" -3 \",\"a\"\n\"4\",\"5\",\"6e3\",\"b c\"\n"), two_points);
}

TEST(Xyz, TheFirstColumnMayBeANameWithoutAHeader) {
  for (const char* const text :
       {"P1 1 2.5 -3\nP2 4 5 6e3\n", "P1,1,2.5,-3\nP2,4,5,6e3\n", "P1, 1, 2.5, -3\nP2, 4, 5, 6e3\n",
        "a;1,0;2,5;-3;wall\nb;4;5;6,0e3;door\n", "a\t1,0\t2,5\t-3\nb\t4\t5\t6,0e3\n",
        "first one,1,2.5,-3\nb,4,5,6e3\n", "2\nP1 1 2.5 -3\nP2 4 5 6e3\n"})
    EXPECT_EQ(points_of(text), two_points) << text;
  expect_two_points({"P1 1 2.5 -3 1 0 0 255 0 10\nP2 4 5 6e3 0 0 1 0 9 1\n"}, xz, {{255, 0, 10}, {0, 9, 1}});
  EXPECT_EQ(message_of("none,2,3,255\n4,5,6,255\n", "scan.xyz"),
            "scan.xyz, line 1: expected a number in column 1, found 'none'")
      << "a missing coordinate is no name";
  EXPECT_EQ(
      message_of("Point 1 10 20 30\nPoint 2 11 20 30\n", "scan.xyz"),
      "scan.xyz, line 1: expected numbers, or names of columns with x, y and z, found 'Point 1 10 20 30'")
      << "its number is no coordinate";
  EXPECT_EQ(message_of("1.o,2,3,255\n", "scan.xyz"),
            "scan.xyz, line 1: expected numbers, or names of columns with x, y and z, found '1.o,2,3,255'");
}

TEST(Xyz, SeparatorsInQuotationMarksSeparateNothing) {
  for (const char* const text :
       {"\"a, b\",1,2.5,-3\n\"c, d\",4,5,6e3\n", "\"a; b\",1,2.5,-3\n\"c\",4,5,6e3\n",
        "1,2.5,-3,\"a, b\"\n4,5,6e3,\"c \"\"d, e\"\" f\"\n", "\"a, b\",1,2.5,-3\n\"c \"\"d, e\",4,5,6e3\n",
        "name,x,y,z\n\"a, b\",1,2.5,-3\nc,4,5,6e3\n", "x;y;z;name\n1;2,5;-3;\"a; b\"\n4;5;6e3;c\n"})
    EXPECT_EQ(points_of(text), two_points) << text;
  EXPECT_EQ(points_of("\"a, b\",1,2,3\n"), (std::vector<Vec3>{{1, 2, 3}}));
  for (const char* const text : {"1,2.5,-3,\"open\n4,5,6e3,5\" pipe\n", "a 5\" pipe,1,2.5,-3\nb,4,5,6e3\n"})
    EXPECT_EQ(points_of(text), two_points) << "a lone mark is a character: " << text;
}

TEST(Xyz, CoordinatesHaveNamesOfOtherPrograms) {
  for (const char* const text :
       {"Point ID,Easting,Northing,Elevation\na,1,2.5,-3\nb,4,5,6e3\n", "P,N,E,H\n7,2.5,1,-3\n8,5,4,6e3\n",
        "POINT_X,POINT_Y,POINT_Z\n1,2.5,-3\n4,5,6e3\n", "X_coord;Y_coord;Z_coord\n1;2,5;-3\n4;5;6e3\n",
        "X [m],Y [m],Height [m]\n1,2.5,-3\n4,5,6e3\n", "East North Altitude Z\n1 2.5 7 -3\n4 5 7 6e3\n",
        "Latitude,Longitude,Northing,Easting,Elev\n51,7,2.5,1,-3\n51,7,5,4,6e3\n",
        "n,e,height,x,y\n7,7,-3,1,2.5\n7,7,6e3,4,5\n", "'x' 'y' 'z'\n1 2.5 -3\n4 5 6e3\n",
        "Punkt;Rechtswert;Hochwert;H\xC3\xB6he\na;1;2,5;-3\nb;4;5;6e3\n"})
    EXPECT_EQ(points_of(text), two_points) << text;
  for (const char* const names : {"Longitude,Latitude,Altitude", "id;Lat;Lon;Height", "lng lat z"})
    EXPECT_EQ(
        message_of(std::string(names) + "\n7.1,51.2,90\n", "scan.csv"),
        "scan.csv, line 1: expected coordinates that are lengths, found degrees of longitude and latitude; "
        "a program for maps, such as QGIS, projects them to metres");
}

TEST(Xyz, ReadsExponentsOfFortran) {
  EXPECT_EQ(points_of("1.0D+00 0.25d1 -3D0\n4.0 5D+00 6.0D+03\n"), two_points);
  EXPECT_EQ(message_of("1 2 3\n1D 2 3\n", "a.xyz"),
            "a.xyz, line 2: expected a number in column 1, found '1D'");
}

TEST(Xyz, BadLinesAreNamed) {
  expect_messages(
      "scan.xyz",
      {
          {"1 2 3\n4 5\n", ", line 2: expected 3 columns as in line 1, found 2"},
          {"\n1 2 3\n\n4 5 6 7\n", ", line 4: expected 3 columns as in line 2, found 4"},
          {"1 2 3\n4 five 6\n", ", line 2: expected a number in column 2, found 'five'"},
          {"1 2 3\n4 5 6x\n", ", line 2: expected a number in column 3, found '6x'"},
          {"1,2,3\n4,,6\n", ", line 2: expected a number in column 2, found nothing"},
          {"1,2,3\n4 5 6\n", ", line 2: expected a number in column 1, found '4 5 6'"},
          {"1 2\n3 4\n", ", line 1: expected at least 3 numbers, found '1 2'"},
          {"1 2 x\n", ", line 1: expected a number in column 3, found 'x'"},
          {"7\n8\n", ", line 2: expected at least 3 numbers, found '8'"},
          {"hello world\n",
           ", line 1: expected numbers, or names of columns with x, y and z, found 'hello world'"},
          {"east north up\n1 2 3\n",
           ", line 1: expected numbers, or names of columns with x, y and z, found 'east north up'"},
          {"x y z\nx y z\n1 2 3\n",
           ", line 2: expected numbers, or names of columns with x, y and z, found 'x y z'"},
          {"x y z w\n1 2 3\n", ", line 2: expected 4 columns as named in line 1, found 3"},
          {"# nothing\n", ", line 2: expected a line of numbers, found the end of the file"},
          {"x y z\n", ", line 2: expected a line of numbers, found the end of the file"},
          {"5\n", ", line 2: expected a line of numbers, found the end of the file"},
          {";;;\n", ", line 1: expected numbers, or names of columns with x, y and z, found ';;;'"},
      });
}

TEST(Xyz, NamesOfColumnsMayHaveUnits) {
  const std::vector<Vec3> expected = {{4376914.25, 1, 2}, {3, 4, 5}};
  for (const char* const text : {"\"X (m)\";\"Y (m)\";\"Z (m)\";\"R\"\n4376914,25;1;2;0,5\n3;4;5;1,0\n",
                                 "X[m] Y[m] Z[m]\n4376914.25 1 2\n3 4 5\n",
                                 "Intensity (dB), x (mm), y (mm), z (mm)\n7, 4376914.25, 1, 2\n7, 3, 4, 5\n",
                                 "x [m], y [m], z [m\n4376914.25,1,2\n3,4,5\n"})
    EXPECT_EQ(points_of(text), expected) << text;
}

}  // namespace
}  // namespace relievo
