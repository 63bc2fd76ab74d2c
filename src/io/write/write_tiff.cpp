#include <algorithm>
#include <new>
#include <type_traits>

#include "io/pictures/tiff_bytes.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/io/write.h"
#include "relievo/picture/height_map.h"

namespace relievo {
namespace {

// The tags that depend on the picture.
struct Tags {
  double mm_per_pixel = 0;
  std::string description;
};

// Returns whether there was enough memory for all tags.
template <typename T>
bool set_tags(TIFF* tiff, const Image<T>& image, const Tags& tags) {
  constexpr bool is_float = std::is_floating_point_v<T>;
  const std::string software = cat("relievo ", version);
  const auto set = [&](std::uint32_t tag, auto value) { return TIFFSetField(tiff, tag, value) == 1; };
  return set(TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(image.width)) &&
         set(TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(image.height)) &&
         set(TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * sizeof(T))) && set(TIFFTAG_SAMPLESPERPIXEL, 1) &&
         set(TIFFTAG_SAMPLEFORMAT, is_float ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT) &&
         set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK) && set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) &&
         set(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE) &&
         set(TIFFTAG_PREDICTOR, is_float ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL) &&
         set(TIFFTAG_ROWSPERSTRIP, 64) && set(TIFFTAG_IMAGEDESCRIPTION, tags.description.c_str()) &&
         set(TIFFTAG_SOFTWARE, software.c_str()) &&
         (!(tags.mm_per_pixel > 0) || (set(TIFFTAG_RESOLUTIONUNIT, RESUNIT_CENTIMETER) &&
                                       set(TIFFTAG_XRESOLUTION, 10 / tags.mm_per_pixel) &&
                                       set(TIFFTAG_YRESOLUTION, 10 / tags.mm_per_pixel)));
}

template <typename T>
std::vector<std::byte> encode(const Image<T>& image, const Tags& tags) {
  const auto width = static_cast<std::size_t>(std::max(0, image.width));
  if (width == 0 || image.height <= 0 ||
      image.pixels.size() != width * static_cast<std::size_t>(image.height))
    return {};
  std::vector<std::byte> bytes;
  io::TiffBytes file(bytes);
  const auto check = [&](bool is_done) {  // when writing to memory, libtiff fails only if memory runs out
    if (is_done) return;
    file.abandon();
    throw std::bad_alloc();
  };
  check(file.handle() && set_tags(file.handle(), image, tags));
  std::vector<T> row(width);  // a copy, because libtiff's predictor changes the row in place
  for (int r = 0; r < image.height; ++r) {
    std::copy_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(image.index(0, r)), width, row.begin());
    check(TIFFWriteScanline(file.handle(), row.data(), static_cast<std::uint32_t>(r), 0) == 1);
  }
  check(TIFFFlush(file.handle()) == 1);
  file.close();
  return bytes;
}

std::string name_of_zero(const HeightMapOptions& options) {
  if (options.is_inverted) return "highest point is 0, depths below it";
  return options.zero == MapZero::ground ? "ground is 0" : "lowest point of the front is 0";
}

}  // namespace

std::vector<std::byte> write_tiff(const HeightsMm& heights) {
  return encode(heights.image,
                {heights.mm_per_pixel,
                 cat("heights in mm, mm_per_pixel=", heights.mm_per_pixel, ", ",
                     name_of_zero(heights.options), heights.note.empty() ? "" : ", ", heights.note)});
}

std::vector<std::byte> write_tiff(const HeightMap& map, const std::string& description) {
  const Tags tags{map.mm_per_pixel, description};
  return map.bits == 8 ? encode(in_8_bits(map), tags) : encode(map.image, tags);
}

}  // namespace relievo
