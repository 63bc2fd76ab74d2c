// The formats of depth images, and their readers.
#pragma once

#include <array>

#include "io/readers.h"
#include "relievo/scan/depth_image.h"

namespace relievo::io {

// 2^27 depths take 512 MB of memory; a picture that promises more is treated as broken.
inline constexpr std::size_t most_pixels = std::size_t{1} << 27;

// A picture that promises more than this factor times the bytes of its file is treated as broken: a PNG more
// bytes, a TIFF more pixels. The factor is a little above 1032, the best that deflate can reach.
inline constexpr std::size_t best_packing = 1100;

// Return true if the content begins like a file of this format.
bool is_png(const Source& source);
bool is_tiff(const Source& source);

// Return the depths of a picture. Errors: kind input.
Result<DepthImage> read_depth_png(const Source& source, const PictureChannels& channels);
Result<DepthImage> read_depth_tiff(const Source& source, const PictureChannels& channels);

// Messages about several channels end with this advice.
inline constexpr std::string_view way_out_of_colours =
    "; the option channel takes one of them, and depth-values luminance their brightness";

// The shares of red, green and blue in the luminance of Rec. 709.
inline constexpr std::array luminance_shares = {.2126F, .7152F, .0722F};

struct PictureFormat {
  std::string_view name;     // shown to people
  std::string_view endings;  // endings of file names, separated by blanks
  bool (*is_format)(const Source&);
  Result<DepthImage> (*read)(const Source&, const PictureChannels&);
};

inline constexpr std::array picture_formats = {PictureFormat{"PNG", ".png", is_png, read_depth_png},
                                               PictureFormat{"TIFF", ".tif .tiff", is_tiff, read_depth_tiff}};

}  // namespace relievo::io
