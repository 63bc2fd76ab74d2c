// Reads scans from texts, and checks that the results keep the promises of the readers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "relievo/io/read.h"
#include "relievo/scan/depth_image.h"
#include "relievo/scan/scan_file.h"
#include "support/results.h"

namespace relievo {

// Reads the text from an allocation of exactly the text's size, so that the address sanitizer detects every
// read after the end.
inline Result<CloudFile> read(std::string_view text, std::string_view name) {
  std::vector<std::byte> bytes(text.size());
  if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
  return read_cloud(bytes, name);
}

inline CloudFile file_of(std::string_view text, std::string_view name) {
  return value_of(read(text, name));
}

inline std::string message_of(std::string_view text, std::string_view name) {
  return message_of(read(text, name));
}

struct BrokenText {
  std::string text, message;
};

// Expects that each text is refused with its message, preceded by the name.
inline void expect_messages(const std::string& name, const std::vector<BrokenText>& all) {
  for (const auto& [text, message] : all) EXPECT_EQ(message_of(text, name), name + message);
}

inline std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

inline std::string as_string(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// Reads a picture of depths with the name "d".
inline Result<DepthImage> read_image(std::string_view text, const PictureChannels& channels = {}) {
  return read_depth_image(bytes_of(text), "d", channels);
}
inline DepthImage image_in(std::string_view text, const PictureChannels& channels = {}) {
  return value_of(read_image(text, channels));
}
inline std::string image_message(std::string_view text, const PictureChannels& channels = {}) {
  return message_of(read_image(text, channels));
}

// Expects that each picture is refused with its message, preceded by the name.
inline void expect_image_messages(const std::vector<BrokenText>& all) {
  for (const auto& [text, message] : all) EXPECT_EQ(image_message(text), "d" + message);
}

// Returns a function that reads `files` by their names, as if they were beside a scan.
inline FilesBeside files_beside(const std::map<std::string, std::string>& files) {
  return [files](const std::string& name) -> Result<std::vector<std::byte>> {
    if (const auto found = files.find(name); found != files.end()) return bytes_of(found->second);
    return std::unexpected(Error{ErrorKind::input, name, {}, "expected a file"});
  };
}

// Returns the first promise of read_cloud() that its answer breaks; an empty text if it breaks none.
inline std::string check_answer(const Result<CloudFile>& answer, std::string_view name) {
  if (!answer) {
    const Error& error = answer.error();
    if (error.kind != ErrorKind::input) return "error of another kind";
    if (error.input != name) return "error does not name the file";
    if (error.expected.empty()) return "error without expectation";
    const bool is_printable = std::all_of(error.expected.begin(), error.expected.end(),
                                          [](char c) { return c >= ' ' && c <= '~'; });
    return is_printable ? "" : "error is not one printable line";
  }
  const Cloud& cloud = answer->cloud;
  if (cloud.points.empty()) return "no points";
  if (cloud.has_normals() && cloud.normals.size() != cloud.size()) return "not one normal per point";
  for (const Vec3& p : cloud.points)
    if (!p.allFinite()) return "point is not finite";
  for (const Vec3f& n : cloud.normals)
    if (!(std::abs(n.norm() - 1) < 1e-6F)) return "normal is not unit";
  if (cloud.has_colours() && cloud.colours.size() != cloud.size()) return "not one colour per point";
  const Mesh& mesh = answer->mesh;
  for (const Triangle& t : mesh.triangles)
    for (const Index i : t)
      if (i >= mesh.points.size() || !mesh.points[i].allFinite()) return "triangle without a finite corner";
  const bool has_normals = !mesh.corner_normals.empty(), has_colours = !mesh.colours.empty();
  if (has_normals && mesh.corner_normals.size() != mesh.triangles.size())
    return "not three normals per triangle";
  if (has_colours && mesh.colours.size() != mesh.points.size()) return "not one colour per point of the mesh";
  return answer->format.empty() ? "no format" : "";
}

}  // namespace relievo
