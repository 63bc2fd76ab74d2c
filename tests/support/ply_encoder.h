// Encodes a table of numbers in any of the three formats of PLY, independently of the library.
#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <string>
#include <vector>

namespace relievo {

struct PlyColumn {
  std::string type = "float";  // may be any name of a type
  std::string name;
  std::string length_type = {};  // the type of a list's length; empty if this is no list
};

// An element of a PLY file. Each row has one number per column. For a list, the row has the list's length and
// then the list's values.
struct PlyTable {
  std::string name;
  std::vector<PlyColumn> columns;
  std::vector<std::vector<double>> rows;
};

inline const std::vector<PlyColumn> ply_xyz = {{"float", "x"}, {"float", "y"}, {"float", "z"}};

inline PlyTable ply_vertices(const std::vector<std::vector<double>>& rows) {
  return {"vertex", ply_xyz, rows};
}
// Returns a table of faces. Each row is the number of corners, followed by the corners themselves.
inline PlyTable ply_faces(const std::vector<std::vector<double>>& rows) {
  return {"face", {{"int", "vertex_indices", "uchar"}}, rows};
}

enum class PlyEncoding { ascii, little_endian, big_endian };

inline constexpr std::array ply_encodings = {PlyEncoding::ascii, PlyEncoding::little_endian,
                                             PlyEncoding::big_endian};

// Prints the encoding in names and messages of parameterised tests.
inline void PrintTo(PlyEncoding encoding, std::ostream* out) {
  constexpr std::array names{"Ascii", "LittleEndian", "BigEndian"};
  *out << names[static_cast<std::size_t>(encoding)];
}

namespace ply_encoder {

template <typename T>
void put_binary(std::string& out, double value, PlyEncoding encoding) {
  std::array<char, sizeof(T)> bytes;
  const T typed = static_cast<T>(value);
  std::memcpy(bytes.data(), &typed, sizeof(T));
  const bool is_host_big = std::endian::native == std::endian::big;
  if ((encoding == PlyEncoding::big_endian) != is_host_big) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

inline void put(std::string& out, const std::string& type, double value, PlyEncoding encoding) {
  if (encoding == PlyEncoding::ascii) {
    std::array<char, 32> digits;
    out.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
    out += ' ';
  } else if (type == "char" || type == "int8") {
    put_binary<std::int8_t>(out, value, encoding);
  } else if (type == "uchar" || type == "uint8") {
    put_binary<std::uint8_t>(out, value, encoding);
  } else if (type == "short" || type == "int16") {
    put_binary<std::int16_t>(out, value, encoding);
  } else if (type == "ushort" || type == "uint16") {
    put_binary<std::uint16_t>(out, value, encoding);
  } else if (type == "int" || type == "int32") {
    put_binary<std::int32_t>(out, value, encoding);
  } else if (type == "uint" || type == "uint32") {
    put_binary<std::uint32_t>(out, value, encoding);
  } else if (type == "float" || type == "float32") {
    put_binary<float>(out, value, encoding);
  } else {
    put_binary<double>(out, value, encoding);
  }
}

inline void put_row(std::string& out, const PlyTable& table, const std::vector<double>& row,
                    PlyEncoding encoding) {
  std::size_t at = 0;
  for (const PlyColumn& column : table.columns) {
    std::size_t values = 1;
    if (!column.length_type.empty()) {
      values = static_cast<std::size_t>(row.at(at));
      put(out, column.length_type, row.at(at++), encoding);
    }
    for (std::size_t i = 0; i < values; ++i) put(out, column.type, row.at(at++), encoding);
  }
  if (encoding == PlyEncoding::ascii) out += '\n';
}

}  // namespace ply_encoder

inline std::string encode_ply_header(const std::vector<PlyTable>& tables, PlyEncoding encoding) {
  const std::array<std::string, 3> names = {"ascii", "binary_little_endian", "binary_big_endian"};
  std::string out = "ply\nformat " + names[static_cast<std::size_t>(encoding)] + " 1.0\n";
  for (const PlyTable& table : tables) {
    out += "element " + table.name + " " + std::to_string(table.rows.size()) + "\n";
    for (const PlyColumn& c : table.columns)
      out += "property " + (c.length_type.empty() ? "" : "list " + c.length_type + " ") + c.type + " " +
             c.name + "\n";
  }
  return out + "end_header\n";
}

inline std::string encode_ply(const std::vector<PlyTable>& tables, PlyEncoding encoding) {
  std::string out = encode_ply_header(tables, encoding);
  for (const PlyTable& table : tables)
    for (const auto& row : table.rows) ply_encoder::put_row(out, table, row, encoding);
  return out;
}

}  // namespace relievo
