// Writes solids, clouds, pictures and height maps as the bytes of files.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "relievo/core/image.h"
#include "relievo/picture/height_map.h"
#include "relievo/plate/solid.h"
#include "relievo/scan/cloud.h"

namespace relievo {

// Return the solid as binary STL, binary little-endian PLY, or OBJ. Coordinates are in single precision, in
// the solid's unit, which a comment in the file states. Only PLY stores colours. The solid must pass
// check_solid().
std::vector<std::byte> write_stl(const Solid& solid);
std::vector<std::byte> write_ply(const Solid& solid);
std::vector<std::byte> write_obj(const Solid& solid);

// Returns the solid as 3MF (core specification 1.3): one object with the solid's unit and coordinates, in
// single precision. `metadata` becomes the model's metadata, whose keys must be names of the specification
// (Title, Description, Designer, Copyright, Application ...). The same solid gives the same bytes, because
// the file contains no dates. The result is empty if memory does not suffice. The solid must pass
// check_solid().
std::vector<std::byte> write_3mf(const Solid& solid,
                                 std::span<const std::pair<std::string, std::string>> metadata = {});

// A file in an archive. Its content must outlive the entry.
struct ZipEntry {
  std::string name;  // in UTF-8, with its folders
  std::span<const std::byte> content;
};

// Returns a ZIP archive of the files, in their order, deflated at `level`, from 1 to 9; level 0 gives the
// smallest archive. The same files give the same bytes, because the archive contains no dates. The result is
// empty if memory does not suffice.
std::vector<std::byte> write_zip(std::span<const ZipEntry> entries, unsigned level);

// Returns the cloud as binary little-endian PLY with float properties x y z, and nx ny nz if present. x y z
// are double where float would overflow or lose digits that matter, i.e. if the box lies more than 1,000
// times its diagonal from the origin. `comment` goes into the header, in one line.
std::vector<std::byte> write_ply(const Cloud& cloud, std::string_view comment = {});

// Keys and values of a PNG's tEXt chunks.
using PngTexts = std::span<const std::pair<std::string, std::string>>;

// The texts and the size of a pixel that a PNG file states. Keys have 1 to 79 Latin-1 characters, values at
// least one character. A positive `mm_per_pixel` is stored as the physical size of a pixel (pHYs).
struct PngLabel {
  PngTexts text = {};
  double mm_per_pixel = 0;
};

// Return the image as PNG. The result is empty for an image without pixels or with a side of more than a
// million, for a number of pixels other than width times height, and for other keys and values than PngLabel
// allows.
std::vector<std::byte> write_png(const Image8& image);
std::vector<std::byte> write_png(const Image16& image, const PngLabel& label = {});
std::vector<std::byte> write_labelled_png(const Image8& image, const PngLabel& label);

// Returns the heights as a deflated float32 TIFF, with pixels per centimetre in its resolution tags, and
// mm_per_pixel and the unit of the heights in its description. The result is empty for an image without
// pixels.
std::vector<std::byte> write_tiff(const HeightsMm& heights);

// Returns the greys as a deflated TIFF of 8 or 16 bits with the same tags. `description` becomes its
// description.
std::vector<std::byte> write_tiff(const HeightMap& map, const std::string& description);

}  // namespace relievo
