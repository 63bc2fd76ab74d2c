#include "relievo/depth_image.h"

#include <array>
#include <cmath>

#include "io/pictures.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

std::unexpected<Error> option_error(std::string option, std::string expected) {
  return std::unexpected(Error{ErrorKind::option, std::move(option), {}, std::move(expected)});
}

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool is_png(std::string_view bytes) {
  return bytes.starts_with("\x89PNG");
}

template <std::size_t n>
bool is_one_of(const std::string& word, const std::array<std::string_view, n>& words) {
  for (const std::string_view known : words)
    if (word == known) return true;
  return false;
}

}  // namespace

bool is_picture(std::span<const std::byte> bytes) {
  const std::string_view text = as_text(bytes);
  const bool is_tiff =
      text.starts_with(std::string_view("II*\0", 4)) || text.starts_with(std::string_view("MM\0*", 4)) ||
      text.starts_with(std::string_view("II+\0", 4)) || text.starts_with(std::string_view("MM\0+", 4));
  return is_png(text) || is_tiff;
}

Result<DepthImage> read_depth_image(std::span<const std::byte> bytes, std::string_view name) {
  const io::Source source{as_text(bytes), name};
  if (!is_picture(bytes))
    return source.error({}, "expected a PNG or TIFF picture of depths, found another file");
  Result<DepthImage> image = is_png(source.bytes) ? io::read_depth_png(source) : io::read_depth_tiff(source);
  if (image && (image->width < 4 || image->height < 4))
    return source.error({},
                        cat("expected at least 4 x 4 pixels, found ", image->width, " x ", image->height));
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
      return option_error("--camera", "expected FX,FY,CX,CY or the nine numbers of a camera matrix, found " +
                                          io::in_quotes(text));
    n.push_back(*number);
  }
  if (n.size() == 9) n = {n[0], n[4], n[2], n[5]};
  if (n.size() != 4 || !(n[0] > 0) || !(n[1] > 0))
    return option_error("--camera",
                        "expected FX,FY,CX,CY with positive focal lengths, found " + io::in_quotes(text));
  return DepthCamera{n[0], n[1], n[2], n[3]};
}

Result<void> check(const DepthOptions& options) {
  if (!is_one_of<3>(options.values, {"depth", "height", "inverse"}))
    return option_error("--depth-values",
                        "expected depth, height or inverse, found '" + options.values + "'");
  if (!is_one_of<3>(options.background, {"keep", "remove", "auto"}))
    return option_error("--background", "expected keep, remove or auto, found '" + options.background + "'");
  if (!(options.range >= .01 && options.range <= 10))
    return option_error("--depth-range", cat("expected a number from 0.01 to 10, found ", options.range));
  if (!(options.points >= 1000 && options.points <= 1e7))
    return option_error("--points", cat("expected a number from 1000 to 1e+07, found ", options.points));
  return {};
}

}  // namespace relievo
