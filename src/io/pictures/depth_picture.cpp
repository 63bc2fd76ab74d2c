#include <algorithm>
#include <cmath>

#include "io/formats.h"
#include "io/pictures/pictures.h"
#include "io/text.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"

namespace relievo {
namespace {

io::Source source_of(std::span<const std::byte> bytes, std::string_view name = {}) {
  return {{reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name};
}

// Removes the pixel size if it is invalid, or if its proportions are so extreme that they must be a mistake.
void check_pixel_size(DepthImage& image) {
  constexpr double least_share = .01;
  const bool is_size = image.pixel_size.allFinite() && image.pixel_size.minCoeff() > 0;
  if (!is_size || image.pixel_shape().minCoeff() < least_share) image.pixel_size = Vec2::Zero();
}

}  // namespace

namespace io {

Result<void> check_room(const Source& source, const StoredPixels& stored) {
  const std::uint64_t room =
      source.bytes.size() - std::min<std::uint64_t>(stored.offset, source.bytes.size());
  if (stored.height > 0 && stored.width > most_pixels / stored.height)
    return source.error(
        {}, cat("expected at most ", most_pixels, " pixels, found ", stored.width, " x ", stored.height));
  const std::uint64_t needed = stored.width * stored.height * stored.bytes;
  if (needed <= room) return {};
  return source.error_at_byte(stored.offset, cat("expected ", needed, " bytes of pixels, found ", room,
                                                 "; the file is cut, get it anew"));
}

Result<void> check_packing(const Source& source, std::uint64_t pixels, std::uint64_t bytes) {
  if (bytes / best_packing <= source.bytes.size()) return {};
  return source.error({}, cat("expected more data for ", pixels, " pixels, found ", source.bytes.size(),
                              " bytes; the file is cut, get it anew"));
}

Result<void> check_channel(const Source& source, const PictureChannels& wanted, std::size_t channels) {
  if (wanted.channel <= static_cast<int>(channels)) return {};
  return source.error({}, cat("expected a channel from 1 to ", channels, ", found ", wanted.channel));
}

std::unexpected<Error> colours_found(const Source& source, std::size_t column, std::size_t row) {
  return source.error(cat("column ", column + 1, ", row ", row + 1),
                      cat("expected a grey picture of depths, found colours", way_out_of_colours));
}

double step_of(const Image<float>& values) {
  const auto is_whole = [](float v) { return !std::isfinite(v) || v == std::trunc(v); };
  return std::ranges::all_of(values.pixels, is_whole) ? 1 : 0;
}

void turn_upright(DepthImage& image, int orientation) {
  if (orientation < 2 || orientation > 8) return;
  const auto is_one_of = [&](auto... values) { return ((orientation == values) || ...); };
  const bool is_transposed = orientation > 4, is_from_right = is_one_of(2, 3, 7, 8),
             is_from_below = is_one_of(3, 4, 6, 7);
  const Image<float> stored = std::move(image.values);
  image.values.resize(is_transposed ? stored.height : stored.width,
                      is_transposed ? stored.width : stored.height);
  for (int r = 0; r < image.values.height; ++r)
    for (int c = 0; c < image.values.width; ++c) {
      const int x = is_transposed ? r : c, y = is_transposed ? c : r;
      image.values.at(c, r) =
          stored.at(is_from_right ? stored.width - 1 - x : x, is_from_below ? stored.height - 1 - y : y);
    }
  if (is_transposed) std::swap(image.pixel_size.x(), image.pixel_size.y());
}

}  // namespace io

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
    return source.error(
        {}, cat("expected a picture of depths (", io::picture_names(), "), found ",
                io::foreign_format(source).empty() ? "another file" : io::foreign_format(source)));
  Result<DepthImage> image = format->read(source, channels);
  if (!image) return image;
  const auto [width, height] = std::pair(image->values.width, image->values.height);
  if (width < 4 || height < 4)
    return source.error({}, cat("expected at least 4 x 4 pixels, found ", width, " x ", height));
  check_pixel_size(*image);
  return image;
}

Result<DepthCamera> parse_camera(std::string_view text) {
  std::string blanks(text);
  for (char& c : blanks)
    if (c == ',' || c == ';' || c == '\n' || c == '\r') c = ' ';
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
