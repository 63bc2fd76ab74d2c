// Tests properties of the readers with generated files, some whole and some broken.
#include <rapidcheck.h>

#include "relievo/io/write.h"
#include "support/e57_encoder.h"
#include "support/laz_encoder.h"
#include "support/ply_encoder.h"
#include "support/read_text.h"

namespace relievo {
namespace {

using rc::gen::arbitrary;
using rc::gen::container;
using rc::gen::element;
using rc::gen::inRange;
using rc::gen::map;

// Returns numbers that all types from int8 to double can represent.
rc::Gen<double> small_number() {
  return map(inRange(0, 128), [](int i) { return static_cast<double>(i); });
}

rc::Gen<std::string> type_name() {
  return element<std::string>("char", "int8", "uchar", "uint8", "short", "int16", "ushort", "uint16", "int",
                              "int32", "uint", "uint32", "float", "float32", "double", "float64");
}

rc::Gen<std::string> length_type_name() {
  return element<std::string>("char", "uint8", "short", "uint16", "int", "uint");
}

rc::Gen<PlyEncoding> encoding() {
  return rc::gen::elementOf(ply_encodings);
}

rc::Gen<float> finite_float() {
  return map(arbitrary<std::uint32_t>(), [](std::uint32_t bits) {
    const auto value = std::bit_cast<float>(bits);
    return std::isfinite(value) ? value : static_cast<float>(bits);
  });
}

// Returns columns with the given names and some extra columns, shuffled. All columns have random types;
// the extra columns may be lists.
std::vector<PlyColumn> any_columns(std::vector<std::string> names) {
  const int extras = *inRange(0, 4);
  for (int i = 0; i < extras; ++i) names.push_back("extra" + std::to_string(i));
  std::vector<PlyColumn> columns;
  while (!names.empty()) {
    const auto at = names.begin() + *inRange<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(names.size()));
    const bool is_list = at->starts_with("extra") && *inRange(0, 3) == 0;
    columns.push_back({*type_name(), *at, is_list ? *length_type_name() : ""});
    names.erase(at);
  }
  return columns;
}

std::vector<double> any_row(const std::vector<PlyColumn>& columns) {
  std::vector<double> row;
  for (const PlyColumn& column : columns) {
    const int values = column.length_type.empty() ? 1 : *inRange(0, 5);
    if (!column.length_type.empty()) row.push_back(values);
    for (int i = 0; i < values; ++i) row.push_back(*small_number());
  }
  return row;
}

PlyTable any_table(const std::string& name, const std::vector<std::string>& columns) {
  PlyTable table{name, any_columns(columns), {}};
  const int rows = *inRange(1, 20);
  for (int i = 0; i < rows; ++i) table.rows.push_back(any_row(table.columns));
  return table;
}

// Returns the value of a row in the column `name`. The column must not be a list.
double value_of(const PlyTable& table, const std::vector<double>& row, std::string_view name) {
  std::size_t at = 0;
  for (const PlyColumn& column : table.columns) {
    if (column.name == name) return row[at];
    at += column.length_type.empty() ? 1 : 1 + static_cast<std::size_t>(row[at]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(PlyProperty, PointsAreReadFromAnyTable) {
  ASSERT_TRUE(rc::check([] {
    const PlyTable before = any_table("before", {}), vertex = any_table("vertex", {"x", "y", "z"});
    const auto file = read(encode_ply({before, vertex, before}, *encoding()), "scan.ply");
    RC_ASSERT(file.has_value());
    RC_ASSERT(file->cloud.size() == vertex.rows.size());
    for (std::size_t i = 0; i < vertex.rows.size(); ++i) {
      const auto value = [&](const char* name) { return value_of(vertex, vertex.rows[i], name); };
      RC_ASSERT(file->cloud.points[i] == Vec3(value("x"), value("y"), value("z")));
    }
  }));
}

TEST(PlyProperty, NormalsAreReadFromAnyTable) {
  ASSERT_TRUE(rc::check([] {
    PlyTable vertex = any_table("vertex", {"x", "y", "z", "nx", "ny", "nz"});
    const auto file = read(encode_ply({vertex}, *encoding()), "scan.ply");
    RC_ASSERT(file.has_value());
    std::vector<Vec3> normals;
    for (const auto& row : vertex.rows) {
      const Vec3 n(value_of(vertex, row, "nx"), value_of(vertex, row, "ny"), value_of(vertex, row, "nz"));
      if (!n.isZero()) normals.push_back(n.normalized());
    }
    RC_ASSERT(file->dropped_normals == vertex.rows.size() - normals.size());
    if (!file->cloud.has_normals()) {
      RC_ASSERT(2 * normals.size() < vertex.rows.size());
      return;
    }
    RC_ASSERT(file->cloud.normals.size() == normals.size());
    for (std::size_t i = 0; i < normals.size(); ++i)
      RC_ASSERT((file->cloud.normals[i].cast<double>() - normals[i]).norm() < 1e-6);
  }));
}

TEST(WritePlyProperty, IsReadBackBitByBit) {
  ASSERT_TRUE(rc::check([] {
    Cloud cloud;
    const int points = *inRange(1, 50);
    const bool has_normals = *arbitrary<bool>();
    for (int i = 0; i < points; ++i) {
      cloud.points.emplace_back(*finite_float(), *finite_float(), *finite_float());
      const Vec3 n(*inRange(-99, 100), *inRange(-99, 100), *inRange(1, 100));
      if (has_normals) cloud.normals.push_back(n.normalized().cast<float>());
    }
    const auto file = read(as_string(write_ply(cloud, *rc::gen::string<std::string>())), "scan.ply");
    RC_ASSERT(file.has_value());
    RC_ASSERT(file->cloud.points == cloud.points);
    RC_ASSERT(file->cloud.normals == cloud.normals);
  }));
}

TEST(TextProperty, EverySeparatorGivesTheSamePoints) {
  ASSERT_TRUE(rc::check([] {
    const auto separator = *element<std::string>(" ", "\t", ",", ";", ", ", " ; ", "  \t ");
    const auto line_end = *element<std::string>("\n", "\r\n", "\r", " \n", "\n\n");
    const bool promises = *arbitrary<bool>();
    const int extra_columns = *inRange(0, 3);
    std::vector<Vec3> points(static_cast<std::size_t>(*inRange(1, 20)));
    std::string text = promises ? std::to_string(points.size()) + line_end : "";
    for (Vec3& p : points) {
      for (double& value : p) value = *finite_float();
      for (const double value : p) {
        std::array<char, 32> digits;
        text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
        text += separator;
      }
      for (int i = 0; i < extra_columns; ++i) text += "255" + separator;
      text.resize(text.size() - separator.size());
      text += line_end;
    }
    const auto file = read(text, "scan.txt");
    RC_ASSERT(file.has_value());
    RC_ASSERT(file->cloud.points == points);
  }));
}

// Returns small valid files of every format: format_samples() and more PLY files. Tests break these files.
std::vector<FileSample> valid_files() {
  const PlyTable strips{"strips", {{"int", "i", "uchar"}, {"short", "s"}}, {{2, 0, 1, 7}, {0, 9}}};
  const PlyTable vertex{
      "vertex",
      {{"float", "x"}, {"double", "y"}, {"int", "z"}, {"float", "nx"}, {"float", "ny"}, {"char", "nz"}},
      {{1.5, 2, 3, 0, 0, 1}, {4, 5.25, 6, 0, 1, 0}, {7, 8, 9, 1, 0, 0}}};
  const PlyTable lists{"vertex",
                       {{"float", "x"}, {"uchar", "l", "ushort"}, {"float", "y"}, {"float", "z"}},
                       {{1, 2, 7, 7, 2, 3}, {4, 0, 5, 6}}};
  const PlyTable coloured{"vertex",
                          {{"float", "x"},
                           {"float", "y"},
                           {"float", "z"},
                           {"uchar", "red"},
                           {"float", "green"},
                           {"ushort", "blue"}},
                          {{0, 0, 0, 255, 0, 0}, {1, 0, 0, 0, 1, 0}, {0, 1, 0, 0, 0, 65535}}};
  const PlyTable faces = ply_faces({{3, 0, 1, 2}, {3, 2, 1, 0}});
  const PlyTable triangle_strips{"tristrips", {{"short", "vertex_indices", "int"}}, {{5, 0, 1, 2, -1, 0}}};
  std::vector<FileSample> all = format_samples();
  all.push_back({"scan.e57", e57_sample()});
  for (const bool is_layered : {false, true})
    all.push_back({"scan.laz", laz({any_points(5, 1), any_points(20, 2)}, is_layered)});
  for (const PlyEncoding encoding : ply_encodings) {
    all.push_back({"scan.ply", encode_ply({strips, vertex, strips}, encoding)});
    all.push_back({"scan.ply", encode_ply({coloured, faces, triangle_strips}, encoding)});
    all.push_back({"scan.ply", encode_ply({lists}, encoding)});
  }
  return all;
}

TEST(BrokenFiles, TheUnbrokenOnesAreRead) {
  for (const auto& [name, text] : valid_files()) EXPECT_EQ(check_answer(file_of(text, name), name), "");
}

TEST(BrokenFiles, TruncatedAnywhereGiveAnAnswer) {
  for (const auto& [name, text] : valid_files())
    for (std::size_t size = 0; size < text.size(); ++size)
      EXPECT_EQ(check_answer(read(text.substr(0, size), name), name), "") << name << ' ' << size;
}

TEST(BrokenFiles, WithAnyByteChangedGiveAnAnswer) {
  for (const auto& [name, text] : valid_files()) {
    for (std::size_t at = 0; at < text.size(); ++at) {
      for (const char by : {'\0', ' ', '\n', '\r', '9', '-', 'e', '.', ',', '/', '#', '\\', '\x7F', '\xFF'}) {
        std::string broken = text;
        broken[at] = by;
        EXPECT_EQ(check_answer(read(broken, name), name), "")
            << name << ' ' << at << ' ' << static_cast<int>(by);
      }
    }
  }
}

// Changes a text by up to 5 edits. Each removes, duplicates or inserts bytes, or inserts a number, a word
// or a line that may break the format.
std::string mutated(std::string text) {
  const auto place = [&] { return *inRange<std::size_t>(0, text.size() + 1); };
  const int edits = *inRange(1, 6);
  for (int i = 0; i < edits; ++i) {
    const std::size_t at = place();
    const std::size_t length = std::min(text.size() - at, *inRange<std::size_t>(0, 12));
    switch (*inRange(0, 4)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(place(), text.substr(at, length));
        break;
      case 2:
        text.insert(at, *container<std::string>(arbitrary<char>()));
        break;
      default:
        text.insert(at, *element<std::string>("list uchar int ", "999999999999", "-1 ", "1e400 ",
                                              "\nelement vertex 3\n", "\nproperty list int double q\n",
                                              "nan ", "\nend_header\n", "\r", "//-9"));
    }
  }
  return text;
}

TEST(BrokenFiles, MutatedGiveAnAnswer) {
  const auto files = valid_files();
  ASSERT_TRUE(rc::check([&] {
    for (const auto& [name, text] : files) {
      const auto answer = read(mutated(text), name);
      RC_ASSERT(check_answer(answer, name) == "");
    }
  }));
}

TEST(BrokenFiles, RandomBytesGiveAnAnswer) {
  const std::vector<std::string> starts = {"",
                                           "ply\n",
                                           "ply\nformat ascii 1.0\n",
                                           "v ",
                                           "1 2 3\n",
                                           "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty "
                                           "list char int l\nproperty float x\nproperty "
                                           "float y\nproperty float z\nend_header\n"};
  ASSERT_TRUE(rc::check([&] {
    for (const std::string& start : starts) {
      const auto name = *element<std::string>("scan.ply", "scan.obj", "scan.xyz", "");
      const auto answer = read(start + *container<std::string>(arbitrary<char>()), name);
      RC_ASSERT(check_answer(answer, name) == "");
    }
  }));
}

}  // namespace
}  // namespace relievo
