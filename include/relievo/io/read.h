// Reads scans from the bytes of files. These functions open no files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/scan/depth_image.h"
#include "relievo/scan/scan_file.h"

namespace relievo {

// Returns a text that lists the formats that the functions below read, for help and messages: "point cloud
// (PLY, PCD ...), mesh (PLY, STL ...) or depth image (PNG, TIFF ...)".
std::string readable_formats();

// Returns the file name extensions of readable files, in lower case with the dot.
std::vector<std::string> readable_endings();

// A function that returns the bytes of another file, to which the file being read refers, such as a buffer of
// a glTF. The name is in UTF-8, relative to the folder of the file being read, and inside that folder. If the
// function returns an error, the reader reports only that the other file cannot be read.
using FilesBeside = std::function<Result<std::vector<std::byte>>(const std::string& name)>;

// Returns the points in `bytes`, and the triangles if there are any. The format is recognised by the content
// or, where the content does not show it, by the extension of `name`. Any other file is read as a text of
// numbers. src/io/formats.h lists the supported parts of each format. Errors contain `name`.
//
// Convex and concave polygons are triangulated as if they were flat. A polygon that intersects itself becomes
// a triangle fan. Text may have LF, CRLF or CR, a UTF-8 byte order mark, plus signs, and nan or inf. Numbers
// too large for double are infinite.
//
// `beside` is called at most once for each other file that the file refers to. Without `beside`, a reference
// to another file is an error. If the other file has only colours, the reference leads to a remark instead.
//
// Errors (kind input) state the line or the byte and what was expected there, or name an unsupported format,
// such as "a PTX file". It is an error if no point has finite coordinates. It is also an error if a header
// promises more than the bytes contain; no memory is allocated for the missing part. LAS is an exception: an
// incomplete file is read to its end. Reading uses no recursion. Its time is linear in the number of bytes,
// except that concave polygons of at most 10,000 corners take quadratic time.
Result<CloudFile> read_cloud(std::span<const std::byte> bytes, std::string_view name,
                             const FilesBeside& beside = {});

struct ReadOptions {
  FilesBeside beside = {};
  // Whether to read points that the file marks as noise or withheld (LAS), and splats that are less than half
  // opaque.
  bool keeps_doubtful = false;
};

// Does the same as the function above, with the given options.
Result<CloudFile> read_cloud(std::span<const std::byte> bytes, std::string_view name,
                             const ReadOptions& options);

// Returns messages about points and normals that were left out when the file was read, and the file's
// remarks.
std::vector<std::string> remarks_on(const CloudFile& file);

// Returns whether a file that begins with these bytes has one of the formats of read_depth_image().
bool is_picture(std::span<const std::byte> bytes);

// Selects the value to read from a picture with several values per pixel.
struct PictureChannels {
  bool is_luminance_wanted = false;  // whether to read the luminance of colours (Rec. 709)
  int channel = 0;                   // number of the channel to read, from 1; 0 for the only channel
};

// Returns the depths in a picture; missing ones are NaN.
//
// - PNG: grey with 8 or 16 bits, or colours whose channels are equal. Pixels that are more transparent than
//   opaque are missing.
// - TIFF: grey, or colours whose channels are equal; integers of 64 bits or of 1 to 32 bits, or
//   floating-point numbers of 16, 32 or 64 bits; strips or tiles; any compression that libtiff supports. The
//   first picture that is neither a thumbnail nor a mask is read, and turned as its tag Orientation says.
//   Transparent pixels are missing, and so are pixels with the value in GDAL's no-data tag. If the file
//   states that 0 is white, integers are inverted, so that bright pixels have large values. GeoTIFF's tags
//   give the size of pixels; a size in degrees is converted to metres.
// - JPEG: grey, turned as the tag Orientation of Exif says. Pictures in colour are read if their channels are
//   equal, or if `channels` asks for a channel or the luminance. CMYK is not read.
// - NPY: a two-dimensional array of integers or floating-point numbers.
// - PFM, PGM, PPM; BMP without compression.
// - Esri ASCII grid, with its no-data value and the size of its cells.
// - Text with at least 32 numbers per line, or at least 8 if neighbouring numbers are alike: a line is a row
//   of the picture, from the top. Words that are not numbers are missing values.
//
// Errors: kind input for pictures that are broken or not in this list, for a TIFF with a palette, for a
// missing channel, and for more than 2^27 pixels or fewer than 4 x 4.
Result<DepthImage> read_depth_image(std::span<const std::byte> bytes, std::string_view name,
                                    const PictureChannels& channels = {});

// Returns the camera given as "FX,FY,CX,CY", or as the nine numbers of its matrix, row by row. Commas,
// semicolons or white space separate the numbers. Errors: kind option for any other text, and for a focal
// length that is not positive.
Result<DepthCamera> parse_camera(std::string_view text);

// The size of a scan, determined from the beginning of the file, so that the needed memory is known before
// the scan is read.
struct ScanSize {
  std::uint64_t points = 0, triangles = 0, pixels = 0;
  // Whether the header states these numbers. If not, they are estimated from the size of the file.
  bool is_stated = false;
};

// Returns the numbers of points and triangles of a cloud or mesh, or the number of pixels of a depth image.
// `head` is the beginning of a file of `file_bytes` bytes; 64 kB suffice. PLY, PCD, LAS, binary STL, PNG and
// JPEG state these numbers; for other formats they are estimated. Because a header may promise anything, the
// numbers are limited to what fits into the file. They are all 0 for an empty file.
ScanSize scan_size(std::span<const std::byte> head, std::string_view name, std::uint64_t file_bytes);

}  // namespace relievo
