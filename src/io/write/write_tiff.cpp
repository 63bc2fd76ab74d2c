#include "io/tiff_bytes.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/io/write.h"
#include "relievo/picture/height_map.h"

namespace relievo {
namespace {

void set_tags(TIFF* tiff, const HeightsMm& heights) {
  const auto& [width, height, channels, pixels] = heights.image;
  const std::string description =
      cat("heights in mm, mm_per_pixel=", heights.mm_per_pixel, ", lowest point of the front is 0",
          heights.note.empty() ? "" : ", ", heights.note);
  const std::string software = cat("relievo ", version);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(width));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(height));
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff, TIFFTAG_PREDICTOR, PREDICTOR_FLOATINGPOINT);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 64);
  TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, description.c_str());
  TIFFSetField(tiff, TIFFTAG_SOFTWARE, software.c_str());
  if (!(heights.mm_per_pixel > 0)) return;
  TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_CENTIMETER);
  TIFFSetField(tiff, TIFFTAG_XRESOLUTION, 10 / heights.mm_per_pixel);
  TIFFSetField(tiff, TIFFTAG_YRESOLUTION, 10 / heights.mm_per_pixel);
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
  if (!file.handle()) return {};
  set_tags(file.handle(), heights);
  std::vector<float> row(width);  // the predictor works in place
  for (int r = 0; r < image.height; ++r) {
    std::copy_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(r) * width),
                width, row.begin());
    if (TIFFWriteScanline(file.handle(), row.data(), static_cast<std::uint32_t>(r), 0) != 1) return {};
  }
  file.close();
  return bytes;
}

}  // namespace relievo
