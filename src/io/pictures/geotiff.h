// Reads the pixel size of a terrain model in GeoTIFF.
#pragma once

#include <tiffio.h>

#include "relievo/core/types.h"

namespace relievo::io {

// Returns the width and height in metres of a pixel of a picture with `rows` rows; 0 if the file has no pixel
// size. Degrees of longitude are converted at the latitude of the middle row.
Vec2 geotiff_pixel_size(TIFF* tiff, std::uint32_t rows);

// Returns the width and height in metres of a pixel with this size in degrees at this latitude.
Vec2 metres_of_degrees(const Vec2& degrees, double latitude_deg);

}  // namespace relievo::io
