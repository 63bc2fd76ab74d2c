#include "support/ply_encoder.h"
#include "support/read_text.h"

namespace relievo {
namespace {

const PlyTable three_vertices = ply_vertices({{1, 2, 3}, {4, 5, 6}, {-7.5, 8.25, 1e6}});
const std::vector<Vec3> three_points = {{1, 2, 3}, {4, 5, 6}, {-7.5, 8.25, 1e6}};

// An ASCII file with three vertices. Tests change parts of it.
const std::string small_ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nend_header\n"
    "1 2 3\n4 5 6\n-7.5 8.25 1e6\n";

std::string change(std::string_view what, std::string_view by) {
  return replaced(small_ply, what, by);
}

std::vector<Vec3> points_of(std::string_view text) {
  return file_of(text, "scan.ply").cloud.points;
}

class Ply : public testing::TestWithParam<PlyEncoding> {
 protected:
  std::string encode(const std::vector<PlyTable>& tables) const { return encode_ply(tables, GetParam()); }
};

TEST_P(Ply, ReadsExtremesOfTheIntegerTypes) {
  const PlyTable lowest{
      "vertex", {{"char", "x"}, {"short", "y"}, {"int", "z"}}, {{-128, -32768, -2147483648.0}}};
  EXPECT_EQ(points_of(encode({lowest})), (std::vector<Vec3>{{-128, -32768, -2147483648.0}}));
  const PlyTable highest{
      "vertex", {{"uchar", "x"}, {"ushort", "y"}, {"uint", "z"}}, {{255, 65535, 4294967295.0}}};
  EXPECT_EQ(points_of(encode({highest})), (std::vector<Vec3>{{255, 65535, 4294967295.0}}));
}

TEST_P(Ply, NamesMayBeInUpperCase) {
  PlyTable table{"vertex", {}, {{9, 2, 3, 2, 0, 0, 1, 2, 3, 1}, {9, 5, 6, 0, 0, 1, 4, 5, 6, 4}}};
  for (const char* name : {"X", "Y", "Z", "NX", "NY", "NZ", "Red", "Green", "Blue", "x"})
    table.columns.push_back({"uchar", name});
  const CloudFile file = file_of(encode({table}), "scan.ply");
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}})) << "x comes before X";
  EXPECT_EQ(file.cloud.normals, (std::vector<Vec3f>{{1, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(file.cloud.colours, (std::vector<Colour>{{1, 2, 3}, {4, 5, 6}}));
}

TEST_P(Ply, AcceptsAnEmptyFaceElement) {
  const PlyTable faces = ply_faces({});
  EXPECT_EQ(points_of(encode({faces, three_vertices, faces})), three_points);
}

TEST_P(Ply, KeepsGeoReferencedCoordinates) {
  const Vec3 far(3456789.123456789, 5678901.987654321, 1234.000000001);
  const PlyTable table{
      "vertex", {{"double", "x"}, {"double", "y"}, {"double", "z"}}, {{far.x(), far.y(), far.z()}}};
  EXPECT_EQ(points_of(encode({table})), (std::vector<Vec3>{far}));
}

TEST_P(Ply, WithOnlyTwoComponentsOfTheNormalsHasNone) {
  const PlyTable table{"vertex",
                       {{"float", "x"}, {"float", "y"}, {"float", "z"}, {"float", "nx"}, {"float", "nz"}},
                       {{1, 2, 3, 0, 1}}};
  const auto file = file_of(encode({table}), "scan.ply");
  EXPECT_FALSE(file.cloud.has_normals());
  EXPECT_EQ(file.dropped_normals, 0U);
}

TEST_P(Ply, HeaderMayHaveCommentsAndCrlf) {
  const PlyTable table = three_vertices;
  const std::string header = encode_ply_header({table}, GetParam());
  const std::string body = encode({table}).substr(header.size());
  const std::string talkative =
      replaced(header, "element", "comment made\nobj_info num_cols 5\ncomment\n\nelement");
  EXPECT_EQ(points_of(talkative + body), three_points);
  EXPECT_EQ(points_of(replaced(talkative, "\n", "\r\n") + body), three_points);
  EXPECT_EQ(points_of(replaced(talkative, "\n", " \t\n") + body), three_points);
  EXPECT_EQ(points_of("\xEF\xBB\xBF" + header + body), three_points);
}

TEST_P(Ply, TruncatedVerticesAreAnError) {
  const std::string whole = encode({three_vertices});
  const std::size_t header = encode_ply_header({three_vertices}, GetParam()).size();
  // If an ASCII file is cut within its last number or after it, the reader cannot notice the cut.
  const std::size_t least =
      GetParam() == PlyEncoding::ascii ? whole.rfind(' ', whole.size() - 3) + 1 : whole.size();
  for (std::size_t size = header; size < least; ++size)
    EXPECT_NE(message_of(whole.substr(0, size), "scan.ply"), "no error") << size;
}

TEST_P(Ply, FormatIsNamed) {
  const std::array names = {"PLY ascii", "PLY binary little endian", "PLY binary big endian"};
  EXPECT_EQ(file_of(encode({three_vertices}), "").format, names[static_cast<std::size_t>(GetParam())]);
}

INSTANTIATE_TEST_SUITE_P(Encodings, Ply, testing::ValuesIn(ply_encodings), testing::PrintToStringParamName());

TEST(PlyBinary, AfterAHeaderWithCrMayBeginWithLf) {
  const PlyTable table{"vertex", {{"uchar", "x"}, {"uchar", "y"}, {"uchar", "z"}}, {{10, 13, 10}}};
  const std::string header = encode_ply_header({table}, PlyEncoding::little_endian);
  EXPECT_EQ(points_of(replaced(header, "\n", "\r") + "\n\r\n"), (std::vector<Vec3>{{10, 13, 10}}));
  EXPECT_EQ(points_of(header + "\n\r\n"), (std::vector<Vec3>{{10, 13, 10}}));
}

TEST(PlyAscii, RowsMayBeWrappedIndentedAndSpacedOut) {
  const std::string wild = "\n  1\t2\n3  \r\n\n4 5 6\n\t-7.5\n8.25\n\n+1e6";
  EXPECT_EQ(points_of(change("1 2 3\n4 5 6\n-7.5 8.25 1e6\n", wild)), three_points);
  EXPECT_EQ(points_of(replaced(small_ply, "\n", "\r\n")), three_points);
  EXPECT_EQ(points_of(replaced(small_ply, "\n", "\r")), three_points);
}

TEST(PlyAscii, OnlyRowsOfVerticesMustHaveTheRightLength) {
  const std::string faces = "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  const auto file =
      file_of(change("end_header\n", faces) + "3 0 1 2 255 0 0 255 9 9\n3 2 1 0 7\n", "scan.ply");
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}}));
}

TEST(PlyAscii, NumbersMayHaveExponentsOfFortran) {
  EXPECT_EQ(points_of(replaced(change("1e6", "1.0D+06"), "8.25", "0.825d1")), three_points);
}

TEST(PlyAscii, PropertiesThatAreNotReadMayBeTexts) {
  const std::string header = small_ply.substr(0, small_ply.find("end_header"));
  const std::string body = "end_header\n1 2 3 True\n4 5 6 False\n-7.5 8.25 1e6 1\n";
  EXPECT_EQ(points_of(header + "property bool is_edge\n" + body), three_points);
}

TEST(PlyHeader, CommentsMayStandBetweenProperties) {
  EXPECT_EQ(points_of(change("property float y", "comment one\nobj_info two\n\nproperty float y")),
            three_points);
}

TEST(PlyAscii, ColoursOfFractionsReachToOne) {
  for (const char* type : {"float", "double"}) {
    std::string header = "ply\nformat ascii 1.0\nelement vertex 1\n";
    for (const char* name : {"x", "y", "z"}) header += cat("property float ", name, "\n");
    for (const char* name : {"red", "green", "blue"}) header += cat("property ", type, " ", name, "\n");
    const auto file = file_of(header + "end_header\n1 2 3 0 0.2 1\n", "a");
    EXPECT_EQ(file.cloud.colours, (std::vector<Colour>{{0, 51, 255}})) << type;
  }
}

TEST(PlyHeader, LinesBeforeTheFirstElementMayBeComments) {
  EXPECT_EQ(points_of(change("element vertex", "Created by Blender\nelement vertex")), three_points);
}

TEST(PlyAscii, RowWithTooManyNumbersIsAnError) {
  EXPECT_EQ(message_of(change("4 5 6", "4 5 6 7"), "scan.ply"),
            "scan.ply, line 9: expected the line to end after the last property, z, found '7'");
}

struct Corruption {
  std::string what, by, message;
};

void expect_named(const std::vector<Corruption>& all) {
  for (const auto& [what, by, message] : all)
    EXPECT_EQ(message_of(change(what, by), "scan.ply"), "scan.ply, " + message);
}

TEST(PlyHeader, EachCorruptedFieldIsNamed) {
  expect_named({
      {"format ascii 1.0", "format text 1.0",
       "line 2: expected ascii, binary_little_endian or binary_big_endian, found 'text'"},
      {"format ascii 1.0", "format ascii 2.0", "line 2: expected version 1.0 of PLY, found '2.0'"},
      {"format ascii 1.0", "format ascii", "line 2: expected version 1.0 of PLY, found nothing"},
      {"format ascii 1.0\n", "", "line 6: expected a line 'format ...' before end_header, found none"},
      {"format ascii 1.0\n", "format ascii 1.0\nformat ascii 1.0\n",
       "line 3: expected one format line, found a second"},
      {"element vertex 3", "element vertex", "line 3: expected the number of elements, found nothing"},
      {"element vertex 3", "element vertex -3", "line 3: expected the number of elements, found '-3'"},
      {"element vertex 3", "element vertex 3.5", "line 3: expected the number of elements, found '3.5'"},
      {"element vertex 3", "element", "line 3: expected 'element <name> <count>', found no name"},
      {"element vertex 3", "element point 3",
       "line 7: expected an element vertex before end_header, found none"},
      {"element vertex 3\n", "", "line 3: expected an element before its first property, found none"},
      {"property float y", "property flaot y",
       "line 5: expected a type such as float, uchar or int32, found 'flaot'"},
      {"property float y", "property list float int y",
       "line 5: expected an integer type for the length of the list, found 'float'"},
      {"property float y", "property list uchar what y",
       "line 5: expected a type such as float, uchar or int32, found 'what'"},
      {"property float y", "property float",
       "line 5: expected the name of the property, found the end of the line"},
      {"property float y", "property list uchar float y",
       "line 3: expected element vertex to have a numeric property y, found x, y, z"},
      {"property float y\n", "", "line 3: expected element vertex to have a numeric property y, found x, z"},
      {"property float z", "porperty float z",
       "line 6: expected format, element, property, comment, obj_info or end_header, found 'porperty'"},
      {"end_header", "end_of_header",
       "line 7: expected format, element, property, comment, obj_info or end_header, found 'end_of_header'"},
      {small_ply, "ply", "line 2: expected end_header, found the end of the file"},
      {small_ply, "ply\nformat ascii 1.0\n", "line 3: expected end_header, found the end of the file"},
      {"vertex 3", "vertex 1152921504606846976",
       "line 3: expected fewer than 4294967295 vertices, found 1152921504606846976"},
      {"vertex 3", "vertex 18446744073709551617",
       "line 3: expected the number of elements, found '18446744073709551617'"},
      {"vertex 3", "vertex 4000000000",
       "line 10: expected 4000000000 rows of element vertex, found the end of the file after 3"},
  });
}

TEST(PlyHeader, PromisesOfHugeSkippedElementsAreErrors) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement first 1152921504606846976\nproperty double a\nproperty "
      "double b\n"
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_EQ(message_of(header + std::string(40, '\0'), "scan.ply"),
            "scan.ply, byte " + std::to_string(header.size()) +
                ": expected 1152921504606846976 rows of element first of 16 bytes, found 40 bytes, "
                "enough for 2");
  const std::string without_properties = replaced(header, "property double a\nproperty double b\n", "");
  EXPECT_EQ(points_of(without_properties + std::string(12, '\0')), (std::vector<Vec3>{{0, 0, 0}}));
}

TEST(PlyAscii, BadBodyIsNamed) {
  expect_named({
      {"4 5 6", "4 five 6", "line 9: expected a number for y, found 'five'"},
      {"4 5 6", "4 5,0 6", "line 9: expected a number for y, found '5,0'"},
      {"8.25 1e6", "8.25", "line 10: expected 3 rows of element vertex, found the end of the file after 2"},
      {"4 5 6\n-7.5 8.25 1e6\n", "",
       "line 8: expected 3 rows of element vertex, found the end of the file after 1"},
  });
}

TEST(PlyAscii, BadListLengthIsNamed) {
  const std::string header = replaced(small_ply.substr(0, small_ply.find("1 2 3")), "property float x\n",
                                      "property list uchar int l\nproperty float x\n");
  for (const std::string length : {"-1", "1.5", "x"})
    EXPECT_EQ(message_of(header + length + " 0 1 2 3\n", "scan.ply"),
              "scan.ply, line 9: expected the length of the list l, found '" + length + "'");
  EXPECT_EQ(message_of(header + "9000000000000000000 0 1 2 3\n", "scan.ply"),
            "scan.ply, line 9: expected 3 rows of element vertex, found the end of the file after 0");
}

TEST(PlyBinary, TruncationIsNamed) {
  const std::string whole = encode_ply({three_vertices}, PlyEncoding::little_endian);
  const std::size_t header = whole.size() - 36;
  EXPECT_EQ(message_of(whole.substr(0, header + 30), "scan.ply"),
            "scan.ply, byte " + std::to_string(header) +
                ": expected 3 rows of element vertex of 12 bytes, found 30 bytes, enough for 2");
}

TEST(PlyBinary, BadListLengthIsNamed) {
  const PlyTable lists{"first", {{"int", "l", "int"}}, {{1, 5}}};
  const std::string whole = encode_ply({lists, three_vertices}, PlyEncoding::big_endian);
  const std::size_t at = whole.size() - 36 - 8;
  const auto with_length = [&](std::string_view bytes) { return std::string(whole).replace(at, 4, bytes); };
  const std::string place =
      "scan.ply, byte " + std::to_string(at) + ": expected the length of the list l, found ";
  EXPECT_EQ(message_of(with_length("\xFF\xFF\xFF\xFE"), "scan.ply"), place + "-2, and there is room for 10");
  EXPECT_EQ(message_of(with_length("\x7F\xFF\xFF\xFF"), "scan.ply"),
            place + "2147483647, and there is room for 10");
}

TEST(PlyBinary, ListInTheLastVertexThatEndsEarlyIsNamed) {
  const PlyTable table{"vertex",
                       {{"float", "x"}, {"uchar", "l", "uchar"}, {"float", "y"}, {"float", "z"}},
                       {{1, 8, 1, 2, 3, 4, 5, 6, 7, 8, 2, 3}}};
  const std::string whole = encode_ply({table}, PlyEncoding::little_endian);
  EXPECT_EQ(message_of(whole.substr(0, whole.size() - 3), "scan.ply"),
            "scan.ply, byte " + std::to_string(whole.size() - 4) +
                ": expected property z, found the end of the file");
}

TEST(PlyBinary, CutOffFacesAreAnError) {
  const PlyTable faces = ply_faces({{3, 0, 1, 2}});
  const std::string whole = encode_ply({three_vertices, faces}, PlyEncoding::little_endian);
  EXPECT_EQ(message_of(whole.substr(0, whole.size() - 5), "scan.ply"),
            "scan.ply, byte " + std::to_string(whole.size() - 13) +
                ": expected the length of the list vertex_indices, found 3, and there is room for 1");
}

}  // namespace
}  // namespace relievo
