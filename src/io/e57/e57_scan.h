// The description of one scan in the XML of an E57 file.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "io/e57/packed_columns.h"
#include "io/e57/xml.h"

namespace relievo::io {

struct E57Scan {
  using Triple = std::array<std::size_t, 3>;  // indices of columns

  E57Section section;
  std::vector<PackedColumn> columns;
  Triple position = {};  // x, y and z, or range, azimuth and elevation
  bool is_spherical = false;
  std::optional<Triple> normal, colour;  // colours scaled to [0, 255]
  std::optional<std::size_t> invalid;    // column that is not 0 for points the scanner could not measure
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  // rotation from scanner's to file's frame,
  Vec3 origin = Vec3::Zero();                                // and the translation that follows it
};

// Returns the scan that an element of data3D describes. Errors name the element.
Result<E57Scan> parse_e57_scan(const Source& source, const XmlElements& elements, std::size_t element);

}  // namespace relievo::io
