// Scans from the bytes of a file. The file system belongs to the programs: nothing here opens a file.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/scan/depth_image.h"
#include "relievo/scan/scan_file.h"

namespace relievo {

// Returns the formats that the functions below read, for help and messages: "point cloud (PLY, PCD ...), mesh
// (PLY, STL ...) or depth image (PNG, TIFF)".
std::string readable_formats();

// Returns the endings of the names of such files, with the dot and in lower case.
std::vector<std::string> readable_endings();

// Returns the points in `bytes`, and the triangles if it has any. The format is recognised by the content,
// then by the ending of `name`; anything else is read as text of numbers. src/io/formats.h says what is read of
// each format. Errors name `name`, too.
//
// Polygons become triangle fans, which is right for convex ones.
//
// Text may have LF, CRLF or CR, a UTF-8 byte order mark, plus signs, and nan or inf. A number beyond the
// range of double is infinite.
//
// Errors (kind input) state the line or the byte and what was expected there, or the name of a format that is
// not read, "an E57 file". A file without a point of finite coordinates is an error. A header that promises
// more than the bytes contain is an error before anything is allocated for it. Reading always ends: there is
// no recursion, and the time is linear in the bytes.
Result<CloudFile> read_cloud(std::span<const std::byte> bytes, std::string_view name);

// Returns true for the beginning of a PNG or TIFF file.
bool is_picture(std::span<const std::byte> bytes);

// Returns the depths in a PNG (grey, 8 or 16 bits; colour if all channels are equal) or TIFF (one channel, 8
// or 16 bits or float32, strips or tiles, any compression that libtiff knows). Errors: kind input for
// other or broken pictures, and for more than 2^27 pixels or fewer than 4 x 4.
Result<DepthImage> read_depth_image(std::span<const std::byte> bytes, std::string_view name);

// Returns the camera given as "FX,FY,CX,CY", or as the nine numbers of its matrix, row by row, separated by
// commas or white space. Errors: kind option for any other text, or a focal length that is not positive.
Result<DepthCamera> parse_camera(std::string_view text);

}  // namespace relievo
