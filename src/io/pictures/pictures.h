// Declares the formats of depth images, and their readers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "io/readers.h"
#include "relievo/core/text.h"
#include "relievo/scan/depth_image.h"

namespace relievo::io {

// 2^27 depths take 512 MB of memory. A picture that promises more is treated as broken.
inline constexpr std::size_t most_pixels = std::size_t{1} << 27;

// A picture that promises too much for the size of its file is treated as broken. A PNG may promise at most
// this many bytes of pixels per byte of the file, a TIFF or JPEG at most this many pixels per byte. The
// factor is slightly above 1032, the best compression of deflate, and far above 256, the largest number of
// pixels per byte of a JPEG scan.
inline constexpr std::size_t best_packing = 1100;

// Return whether the content begins like a file of this format.
bool is_png(const Source& source);
bool is_tiff(const Source& source);
bool is_jpeg(const Source& source);
bool is_npy(const Source& source);
bool is_pnm(const Source& source);
bool is_bmp(const Source& source);
bool is_esri_grid(const Source& source);
bool is_height_table(const Source& source);  // lines of numbers whose neighbours correlate

// Return the depths of a picture. Errors: kind input.
Result<DepthImage> read_depth_png(const Source& source, const PictureChannels& channels);
Result<DepthImage> read_depth_tiff(const Source& source, const PictureChannels& channels);
Result<DepthImage> read_depth_jpeg(const Source& source, const PictureChannels& channels);
Result<DepthImage> read_depth_npy(const Source& source, const PictureChannels& channels);
Result<DepthImage> read_depth_pnm(const Source& source, const PictureChannels& channels);
Result<DepthImage> read_depth_bmp(const Source& source, const PictureChannels& channels);
Result<DepthImage> read_esri_grid(const Source& source, const PictureChannels& channels);
Result<DepthImage> read_height_table(const Source& source, const PictureChannels& channels);

// Error messages about pictures with several channels end with this advice.
inline constexpr std::string_view way_out_of_colours =
    "; the option channel takes one of them, and depth-values luminance their brightness";

// The weights of red, green and blue in the luminance of Rec. 709.
inline constexpr std::array luminance_shares = {.2126F, .7152F, .0722F};

// The values of an uncompressed picture.
struct StoredPixels {
  std::uint64_t width = 0, height = 0;
  std::uint64_t bytes = 1;   // bytes per pixel
  std::uint64_t offset = 0;  // offset of the first pixel in the file
};

// Returns an error if there are too many pixels, or more than the file contains.
Result<void> check_room(const Source& source, const StoredPixels& stored);

// Returns an error if `bytes`, the size of the unpacked pixels, exceeds best_packing times the size of the
// file.
Result<void> check_packing(const Source& source, std::uint64_t pixels, std::uint64_t bytes);

// Red, green and blue of a pixel; in a grey picture only the first value is used.
using PixelColour = std::array<float, 3>;

// Returns the value of a pixel with `channels` channels. Returns nothing if the channels differ, as in a
// photograph, and neither a channel nor luminance is requested.
inline std::optional<float> pixel_value(const PixelColour& colour, std::size_t channels,
                                        const PictureChannels& wanted) {
  if (wanted.channel > 0) return colour[static_cast<std::size_t>(wanted.channel) - 1];
  const bool is_grey = channels == 1 || (colour[0] == colour[1] && colour[1] == colour[2]);
  if (is_grey) return colour[0];
  if (!wanted.is_luminance_wanted) return std::nullopt;
  return luminance_shares[0] * colour[0] + luminance_shares[1] * colour[1] + luminance_shares[2] * colour[2];
}

// Returns an error if the requested channel does not exist.
Result<void> check_channel(const Source& source, const PictureChannels& wanted, std::size_t channels);

// Returns the error for a pixel for which pixel_value() returns nothing.
std::unexpected<Error> colours_found(const Source& source, std::size_t column, std::size_t row);

// Sets all values from colour_at(i), the colour of pixel i.
template <typename ColourAt>
Result<void> fill_values(const Source& source, const PictureChannels& wanted, std::size_t channels,
                         Image<float>& values, const ColourAt& colour_at) {
  RELIEVO_CHECK(check_channel(source, wanted, channels));
  const auto width = static_cast<std::size_t>(values.width);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::optional<float> value = pixel_value(colour_at(i), channels, wanted);
    if (!value) return colours_found(source, i % width, i / width);
    values[i] = *value;
  }
  return {};
}

// Returns the step between possible values: 1 if all are integers, else 0.
double step_of(const Image<float>& values);

// Turns a picture so that its first row is at the top and its first column is on the left. `orientation` is
// the tag Orientation of TIFF and Exif, 1 to 8. Other values change nothing.
void turn_upright(DepthImage& image, int orientation);

struct PictureFormat {
  std::string_view name;     // for messages
  std::string_view endings;  // endings of file names, separated by blanks
  bool (*is_format)(const Source&);
  Result<DepthImage> (*read)(const Source&, const PictureChannels&);
};

// The first entry that recognises a file reads it. Tables come last, because text may begin with anything.
inline constexpr std::array picture_formats = {
    PictureFormat{"PNG", ".png", is_png, read_depth_png},
    PictureFormat{"TIFF", ".tif .tiff", is_tiff, read_depth_tiff},
    PictureFormat{"JPEG", ".jpg .jpeg", is_jpeg, read_depth_jpeg},
    PictureFormat{"NPY", ".npy", is_npy, read_depth_npy},
    PictureFormat{"PFM, PGM, PPM", ".pfm .pgm .ppm", is_pnm, read_depth_pnm},
    PictureFormat{"BMP", ".bmp", is_bmp, read_depth_bmp},
    PictureFormat{"Esri grid", "", is_esri_grid, read_esri_grid},
    PictureFormat{"table of heights", ".dat", is_height_table, read_height_table}};

struct JpegHeader {
  std::uint64_t width = 0, height = 0;  // 0 if the bytes have no frame
  std::uint64_t channels = 0;
  int orientation = 1;  // Exif tag, see turn_upright()
};

// Returns the information in the segments up to the first frame. `bytes` is a JPEG or the beginning of one.
JpegHeader find_jpeg_header(std::string_view bytes);

}  // namespace relievo::io
