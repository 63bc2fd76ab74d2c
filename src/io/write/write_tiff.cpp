#include <new>

#include "io/tiff_bytes.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/io/write.h"
#include "relievo/picture/height_map.h"

namespace relievo {
namespace {

// Returns whether there was memory for all tags.
bool set_tags(TIFF* tiff, const HeightsMm& heights) {
  const auto& [width, height, channels, pixels] = heights.image;
  const std::string description =
      cat("heights in mm, mm_per_pixel=", heights.mm_per_pixel, ", lowest point of the front is 0",
          heights.note.empty() ? "" : ", ", heights.note);
  const std::string software = cat("relievo ", version);
  const auto set = [&](std::uint32_t tag, auto value) { return TIFFSetField(tiff, tag, value) == 1; };
  return set(TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(width)) &&
         set(TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(height)) && set(TIFFTAG_BITSPERSAMPLE, 32) &&
         set(TIFFTAG_SAMPLESPERPIXEL, 1) && set(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP) &&
         set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK) && set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) &&
         set(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE) &&
         set(TIFFTAG_PREDICTOR, PREDICTOR_FLOATINGPOINT) && set(TIFFTAG_ROWSPERSTRIP, 64) &&
         set(TIFFTAG_IMAGEDESCRIPTION, description.c_str()) && set(TIFFTAG_SOFTWARE, software.c_str()) &&
         (!(heights.mm_per_pixel > 0) || (set(TIFFTAG_RESOLUTIONUNIT, RESUNIT_CENTIMETER) &&
                                          set(TIFFTAG_XRESOLUTION, 10 / heights.mm_per_pixel) &&
                                          set(TIFFTAG_YRESOLUTION, 10 / heights.mm_per_pixel)));
}

}  // namespace

std::vector<std::byte> write_tiff(const HeightsMm& heights) {
  const auto& image = heights.image;
  const auto width = static_cast<std::size_t>(std::max(0, image.width));
  if (width == 0 || image.height <= 0 ||
      image.pixels.size() != width * static_cast<std::size_t>(image.height))
    return {};
  std::vector<std::byte> bytes;
  io::TiffBytes file(bytes);
  const auto check = [&](bool is_done) {  // writing to memory, libtiff fails only if memory runs out
    if (is_done) return;
    file.abandon();
    throw std::bad_alloc();
  };
  check(file.handle() && set_tags(file.handle(), heights));
  std::vector<float> row(width);  // libtiff's predictor changes the row in place
  for (int r = 0; r < image.height; ++r) {
    std::copy_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(r) * width),
                width, row.begin());
    check(TIFFWriteScanline(file.handle(), row.data(), static_cast<std::uint32_t>(r), 0) == 1);
  }
  check(TIFFFlush(file.handle()) == 1);
  file.close();
  return bytes;
}

}  // namespace relievo
