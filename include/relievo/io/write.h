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

// Return the solid as binary STL, binary little-endian PLY, or OBJ. Coordinates are in single precision and
// in the solid's unit, which a comment in the file states. Only PLY stores colours. The solid must pass
// check_solid().
std::vector<std::byte> write_stl(const Solid& solid);
std::vector<std::byte> write_ply(const Solid& solid);
std::vector<std::byte> write_obj(const Solid& solid);

// Returns the solid as 3MF (core specification 1.3): a single object with the solid's unit and coordinates,
// in single precision. `metadata` becomes the model's metadata; its keys must be names of the specification
// (Title, Description, Designer, Copyright, Application ...). The same solid gives the same bytes, because
// the file contains no dates. The result is empty if memory runs out. The solid must pass check_solid().
std::vector<std::byte> write_3mf(const Solid& solid,
                                 std::span<const std::pair<std::string, std::string>> metadata = {});

// A file in an archive. Its content must outlive the entry.
struct ZipEntry {
  std::string name;  // in UTF-8, including folders
  std::span<const std::byte> content;
};

// Returns a ZIP archive of the files, in order, deflated at `level`: 1 to 9, or 0 for the smallest archive.
// The same files give the same bytes, because the archive contains no dates. The result is empty if memory
// runs out.
std::vector<std::byte> write_zip(std::span<const ZipEntry> entries, unsigned level);

// Returns the cloud as binary little-endian PLY with float properties x y z, and nx ny nz if there are
// normals. x y z are double if float would overflow or lose significant digits, i.e. if the box is farther
// from the origin than 1,000 times its diagonal. `comment` becomes a comment in the header, on one line.
std::vector<std::byte> write_ply(const Cloud& cloud, std::string_view comment = {});

// Keys and values of a PNG's tEXt chunks.
using PngTexts = std::span<const std::pair<std::string, std::string>>;

// The texts and the pixel size in a PNG file. Keys have 1 to 79 Latin-1 characters, and values have at least
// one character. A positive `mm_per_pixel` is stored as the physical pixel size (pHYs).
struct PngLabel {
  PngTexts text = {};
  double mm_per_pixel = 0;
};

// Return the image as PNG. The result is empty if the image has no pixels, if a side has more than a million
// pixels, or if the number of pixels is not width times height. It is also empty if `label` does not satisfy
// the rules of PngLabel.
std::vector<std::byte> write_png(const Image8& image);
std::vector<std::byte> write_png(const Image16& image, const PngLabel& label = {});
std::vector<std::byte> write_labelled_png(const Image8& image, const PngLabel& label);

// Returns the heights as a deflated float32 TIFF. Its resolution tags state the pixels per centimetre; its
// description states mm_per_pixel and the unit of the heights. The result is empty for an image without
// pixels.
std::vector<std::byte> write_tiff(const HeightsMm& heights);

// Returns the grey levels as a deflated TIFF with 8 or 16 bits. Its resolution tags state the pixels per
// centimetre. `description` becomes the description of the file.
std::vector<std::byte> write_tiff(const HeightMap& map, const std::string& description);

}  // namespace relievo
