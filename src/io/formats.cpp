#include "io/formats.h"

#include <algorithm>

#include "io/pictures/pictures.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo {
namespace io {
namespace {

void append_name(std::string& names, std::string_view name) {
  if (!names.empty()) names += ", ";
  names += name;
}

}  // namespace

bool has_control_bytes(std::string_view bytes) {
  const auto is_control = [](char c) {
    return static_cast<unsigned char>(c) < ' ' && !is_blank(c) && c != '\n' && c != '\r' && c != '\x1A';
  };
  const std::size_t enough = 4096;  // bytes to examine; binary numbers have a control byte much earlier
  bytes = bytes.substr(0, enough);
  return std::any_of(bytes.begin(), bytes.end(), is_control);
}

bool has_ending(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() &&
         equals_ignoring_case(name.substr(name.size() - ending.size()), ending);
}

std::string remark_on_left_out(std::uint64_t points, std::string_view which) {
  return cat("left out ", points, points == 1 ? " point " : " points ", which);
}

std::string foreign_format(const Source& source) {
  for (const ForeignFormat& format : foreign_names)
    if (has_ending(source.name, format.mark)) return std::string(format.what);
  for (const ForeignFormat& format : foreign_contents) {
    const std::string_view bytes = source.bytes.substr(std::min(format.at, source.bytes.size()));
    if (bytes.starts_with(format.mark)) return std::string(format.what);
  }
  for (const ForeignFormat& format : foreign_endings)
    if (has_ending(source.name, format.mark)) return std::string(format.what);
  return has_control_bytes(source.bytes) ? "binary data" : "";
}

std::string format_names(Content content) {
  std::string names;
  for (const Format& format : formats)
    if (format.content == content || format.content == Content::both) append_name(names, format.name);
  return names;
}

std::string picture_names() {
  std::string names;
  for (const PictureFormat& format : picture_formats) append_name(names, format.name);
  return names;
}

std::string row_format_names() {
  std::string names;
  for (const Format& format : formats)
    if (format.find_rows) append_name(names, format.name);
  const std::size_t last = names.rfind(", ");
  return last == std::string::npos ? names : names.replace(last, 2, " or ");
}

}  // namespace io

std::string readable_formats() {
  return "point cloud (" + io::format_names(io::Content::points) + "), mesh (" +
         io::format_names(io::Content::triangles) + ") or depth image (" + io::picture_names() + ")";
}

std::vector<std::string> readable_endings() {
  std::vector<std::string> endings;
  const auto add = [&](std::string_view of_format) {
    io::Words words(of_format);
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
      if (std::ranges::find(endings, word) == endings.end()) endings.emplace_back(word);
  };
  for (const io::Format& format : io::formats) add(format.endings);
  for (const io::PictureFormat& format : io::picture_formats) add(format.endings);
  return endings;
}

}  // namespace relievo
