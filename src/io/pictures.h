// Readers of single pictures.
#pragma once

#include "io/readers.h"
#include "relievo/depth_image.h"

namespace relievo::io {

inline constexpr std::size_t most_pixels = std::size_t{1} << 27;

// No compression that is known packs better: a picture that promises more bytes than this many times its
// file is broken.
inline constexpr std::size_t best_packing = 1100;

Result<DepthImage> read_depth_png(const Source& source);
Result<DepthImage> read_depth_tiff(const Source& source);

}  // namespace relievo::io
