#include <algorithm>

#include "io/pictures.h"
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

}  // namespace relievo
