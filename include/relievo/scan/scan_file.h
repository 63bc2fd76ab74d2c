// The contents of a scan file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/mesh.h"

namespace relievo {

struct CloudFile {
  Cloud cloud;         // finite points only, at least one; normals are unit length, or absent
  std::string format;  // for people: "PLY binary little endian", "XYZ text, 6 columns with normals"
  std::size_t dropped_points = 0;  // points removed because a coordinate was NaN or infinite
  // Number of points removed because all their coordinates were 0, which devices write for points they have
  // not measured. It stays 0 if the file has faces, at most 16 such points, or no other points.
  std::size_t unmeasured_points = 0;
  // Number of further points with a normal that was zero, not finite or missing. These points are removed,
  // too, unless they are the majority: then all points are kept and the cloud has no normals.
  std::size_t dropped_normals = 0;
  std::size_t missing_points = 0;  // promised by the header, but missing because the file ends early
  // Number of points removed because the file itself says that they do not count, such as noise in LAS.
  std::size_t left_out_points = 0;
  std::vector<std::string> remarks =
      {};          // what of the file is left out, for people: "left out 40 points ..."
  Mesh mesh = {};  // the file's faces, with points of their own; empty if it has none
};

}  // namespace relievo
