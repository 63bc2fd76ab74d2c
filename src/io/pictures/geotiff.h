// The size of the pixels of a terrain model, as GeoTIFF states it.
#pragma once

#include <tiffio.h>

#include "relievo/core/types.h"

namespace relievo::io {

// Returns the width and height in metres of a pixel of a picture with `rows` rows; 0 if the file states none.
// Degrees of longitude are converted at the latitude of the middle row.
Vec2 geotiff_pixel_size(TIFF* tiff, std::uint32_t rows);

// Returns the width and height in metres of a pixel that is given in degrees, at that latitude.
Vec2 metres_of_degrees(const Vec2& degrees, double latitude_deg);

}  // namespace relievo::io
