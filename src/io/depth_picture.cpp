#include <algorithm>
#include <cmath>

#include "io/pictures.h"
#include "io/text.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"

namespace relievo {
namespace {

io::Source source_of(std::span<const std::byte> bytes, std::string_view name = {}) {
  return {{reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name};
}

}  // namespace

bool is_picture(std::span<const std::byte> bytes) {
  return std::ranges::any_of(io::picture_formats,
                             [&](const auto& format) { return format.is_format(source_of(bytes)); });
}

Result<DepthImage> read_depth_image(std::span<const std::byte> bytes, std::string_view name,
                                    const PictureChannels& channels) {
  const io::Source source = source_of(bytes, name);
  const auto format =
      std::ranges::find_if(io::picture_formats, [&](const auto& known) { return known.is_format(source); });
  if (format == io::picture_formats.end())
    return source.error({}, "expected a PNG or TIFF picture of depths, found another file");
  Result<DepthImage> image = format->read(source, channels);
  if (!image) return image;
  const auto [width, height] = std::pair(image->values.width, image->values.height);
  if (width < 4 || height < 4)
    return source.error({}, cat("expected at least 4 x 4 pixels, found ", width, " x ", height));
  return image;
}

Result<DepthCamera> parse_camera(std::string_view text) {
  std::string blanks(text);
  for (char& c : blanks)
    if (c == ',' || c == '\n' || c == '\r') c = ' ';
  std::vector<double> n;
  io::Words words(blanks);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    const auto number = io::parse_number(word);
    if (!number || !std::isfinite(*number) || n.size() == 9)
      return option_error(
          "camera",
          "expected FX,FY,CX,CY, the nine numbers of a camera matrix or a file with either, found " +
              io::in_quotes(text));
    n.push_back(*number);
  }
  if (n.size() == 9) n = {n[0], n[4], n[2], n[5]};
  if (n.size() != 4 || !(n[0] > 0) || !(n[1] > 0))
    return option_error("camera",
                        "expected FX,FY,CX,CY with positive focal lengths, found " + io::in_quotes(text));
  return DepthCamera{n[0], n[1], n[2], n[3]};
}

}  // namespace relievo
