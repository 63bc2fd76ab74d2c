// Makes small valid files of every format, independently of the library's readers. Tests change and damage them.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the bytes of a number in little-endian order, as on all machines that run these tests.
template <typename T>
std::string raw(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

// Returns `text` with the bytes of a number in place of the bytes at `at`.
template <typename T>
std::string patched(std::string text, std::size_t at, T value) {
  for (const char byte : raw(value)) text.at(at++) = byte;
  return text;
}

// The corners of a tetrahedron and its four triangles, which face outwards.
inline const std::vector<Vec3> tetrahedron_points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline const std::vector<Triangle> tetrahedron_triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

inline std::string binary_stl() {
  std::string file(80, ' ');
  file += raw(static_cast<std::uint32_t>(tetrahedron_triangles.size()));
  for (const Triangle& t : tetrahedron_triangles) {
    file += std::string(12, '\0');
    for (const Index i : t)
      for (const double x : tetrahedron_points[i]) file += raw(static_cast<float>(x));
    file += std::string(2, '\0');
  }
  return file;
}

inline std::string ascii_stl() {
  std::string file = "solid tetrahedron\n";
  for (const Triangle& t : tetrahedron_triangles) {
    file += " facet normal 0 0 0\n  outer loop\n";
    for (const Index i : t) {
      file += "   vertex";
      for (const double x : tetrahedron_points[i]) file += ' ' + std::to_string(x);
      file += '\n';
    }
    file += "  endloop\n endfacet\n";
  }
  return file + "endsolid tetrahedron\n";
}

inline std::string off() {
  return "OFF # a tetrahedron\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3 255 0 0\n\n3 0 3 2\n3 1 2 "
         "3\n";
}

inline std::string padded(std::string text, char by) {
  text.resize((text.size() + 3) / 4 * 4, by);
  return text;
}

// Returns the tetrahedron's positions as float32, followed by its indices as uint16.
inline std::string gltf_buffer() {
  std::string buffer;
  for (const Vec3& p : tetrahedron_points)
    for (const double x : p) buffer += raw(static_cast<float>(x));
  for (const Triangle& t : tetrahedron_triangles)
    for (const Index i : t) buffer += raw(static_cast<std::uint16_t>(i));
  return buffer;
}

// Returns the JSON of a glTF file whose buffer is gltf_buffer(). `uri` is empty, or it consists of the member
// "uri" of the buffer and a comma.
inline std::string gltf_json(const std::string& uri = "") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
         R"("nodes":[{"translation":[10,0,0],"children":[1]},{"mesh":0,"scale":[2,2,2]}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
         R"("buffers":[{)" +
         uri + R"("byteLength":72}]})";
}

// Returns the sample's JSON without scenes, and with the nodes `nodes` instead of the sample's nodes.
inline std::string gltf_with_nodes(std::string_view nodes) {
  std::string json = gltf_json();
  const std::size_t begin = json.find(R"("scene":0)"), end = json.find(R"("meshes")");
  return json.replace(begin, end - begin, nodes);
}

inline std::string glb_of(const std::string& json, const std::string& buffer = gltf_buffer()) {
  const std::string text = padded(json, ' '), binary = padded(buffer, '\0');
  const auto size = [](std::size_t n) { return raw(static_cast<std::uint32_t>(n)); };
  return "glTF" + size(2) + size(12 + 8 + text.size() + 8 + binary.size()) + size(text.size()) + "JSON" +
         text + size(binary.size()) + std::string("BIN\0", 4) + binary;
}

inline std::string glb() {
  return glb_of(gltf_json());
}

inline std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

inline std::string embedded_gltf() {
  return gltf_json(R"("uri":"data:application/octet-stream;base64,)" + base64(gltf_buffer()) + R"(",)");
}

// Returns a PCD header for three points with normals along x, y and z and the colours red, green and blue.
// `data` is the encoding.
inline std::string pcd_header(const std::string& data) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb normal_x normal_y "
         "normal_z tag\n"
         "SIZE 4 8 4 4 4 4 4 2\nTYPE F F F U F F F I\nCOUNT 1 1 1 1 1 1 1 2\nWIDTH 3\nHEIGHT 1\n"
         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA " +
         data + "\n";
}

inline std::vector<std::vector<std::string>> pcd_rows() {
  std::vector<std::vector<std::string>> rows;
  for (int i = 0; i < 3; ++i) {
    const auto unit = [&](int axis) { return raw(axis == i ? 1.F : 0.F); };
    rows.push_back({raw(static_cast<float>(i)), raw(i + .5), raw(static_cast<float>(-i)),
                    raw(std::uint32_t{255} << (16 - 8 * i)), unit(0), unit(1), unit(2),
                    raw(std::int16_t{7}) + raw(std::int16_t{8})});
  }
  return rows;
}

inline std::string ascii_pcd() {
  return pcd_header("ascii") +
         "0 0.5 0 16711680 1 0 0 7 8\n1 1.5 -1 65280 0 1 0 7 8\n2 2.5 -2 255 0 0 1 7 8\n";
}

inline std::string binary_pcd() {
  std::string file = pcd_header("binary");
  for (const auto& row : pcd_rows())
    for (const std::string& field : row) file += field;
  return file;
}

// Compresses bytes by LZF, with literal runs alone.
inline std::string pack_lzf(const std::string& bytes) {
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::string run = bytes.substr(at, 32);
    out += static_cast<char>(run.size() - 1) + run;
  }
  return out;
}

inline std::string compressed_pcd() {
  std::string fields;
  for (std::size_t f = 0; f < 8; ++f)
    for (const auto& row : pcd_rows()) fields += row[f];
  const std::string packed = pack_lzf(fields);
  const auto size = [](std::size_t n) { return raw(static_cast<std::uint32_t>(n)); };
  return pcd_header("binary_compressed") + size(packed.size()) + size(fields.size()) + packed;
}

// Returns a LAS file with the points (1000000, 2000000, 100) in red and (1000000.5, 2000000.25, 99) in blue.
// The point format is 2, or 7 in LAS 1.4.
inline std::string las(int minor = 2) {
  const bool is_new = minor == 4;
  const std::size_t header = is_new ? 375 : 227, record = is_new ? 36 : 26, colours = is_new ? 30 : 20;
  std::string file(header, '\0');
  file.replace(0, 4, "LASF");
  file = patched(file, 24, std::uint8_t{1});
  file = patched(file, 25, static_cast<std::uint8_t>(minor));
  file = patched(file, 94, static_cast<std::uint16_t>(header));
  file = patched(file, 96, static_cast<std::uint32_t>(header));
  file = patched(file, 104, static_cast<std::uint8_t>(is_new ? 7 : 2));
  file = patched(file, 105, static_cast<std::uint16_t>(record));
  if (is_new)
    file = patched(file, 247, std::uint64_t{2});
  else
    file = patched(file, 107, std::uint32_t{2});
  const double origin[] = {1e6, 2e6, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    file = patched(file, 131 + 8 * i, .25);
    file = patched(file, 155 + 8 * i, origin[i]);
  }
  const std::int32_t points[2][3] = {{0, 0, 400}, {2, 1, 396}};
  for (std::size_t p = 0; p < 2; ++p) {
    std::string row(record, '\0');
    for (std::size_t i = 0; i < 3; ++i) row = patched(row, 4 * i, points[p][i]);
    row = patched(row, colours + (p == 0 ? 0 : 4), std::uint16_t{65535});
    file += row;
  }
  return file;
}

// Returns an array as NumPy saves it. `type` is such as "<f4", `data` are the array's bytes, and `shape` is
// such as "5, 6".
inline std::string npy(const std::string& type, const std::string& data, const std::string& shape = "5, 6",
                       bool is_by_columns = false, char version = 1) {
  const std::string quoted = type.starts_with('[') ? type : "'" + type + "'";
  const std::string header = "{'descr': " + quoted +
                             ", 'fortran_order': " + (is_by_columns ? "True" : "False") + ", 'shape': (" +
                             shape + "), }   \n";
  const auto size = static_cast<std::uint32_t>(header.size());
  return std::string("\x93NUMPY") + version + '\0' +
         (version == 1 ? raw(static_cast<std::uint16_t>(size)) : raw(size)) + header + data;
}

struct FileSample {
  std::string name, bytes;
};

// Returns files of every format except PLY, which has its own encoder. A new format needs a row here.
inline std::vector<FileSample> format_samples() {
  return {{"scan.obj", "# hand\nv 0 0 0\nv 1 0 0\nv 0 1 \\\n0\nvn 0 0 1\nvn 0 1 0\nf 1/1/1 2//2 -1//-1\n"},
          {"scan.xyz", "1 2 3 0 0 1\n4 5 6 0 0.6 0.8\n# end\n7 8 9 1 0 0\n"},
          {"scan.pts", "3\r\n1 2 3 9 255 0 0\r\n4 5 6 9 0 255 0\r\n7 8 nan 9 0 0 255\r\n"},
          {"scan.csv", "nx,ny,nz,x,y,z\n0,0,1,1,2,3\n0,1,0,4,5,6\n"},
          {"scan.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n"},
          {"scan.stl", binary_stl()},
          {"scan.stl", ascii_stl()},
          {"scan.off", off()},
          {"scan.glb", glb()},
          {"scan.gltf", embedded_gltf()},
          {"scan.pcd", ascii_pcd()},
          {"scan.pcd", binary_pcd()},
          {"scan.pcd", compressed_pcd()},
          {"scan.npy", npy("<f4", gltf_buffer().substr(0, 48), "4, 3")},
          {"scan.npy", npy("<f4", gltf_buffer().substr(0, 48), "2, 2, 3")},
          {"scan.las", las(2)},
          {"scan.las", las(4)}};
}

}  // namespace relievo
