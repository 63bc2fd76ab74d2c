// Defines the contents of a scan file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/mesh.h"

namespace relievo {

struct CloudFile {
  Cloud cloud;  // only finite points, at least one; normals have unit length, or there are none
  // Name of the format, such as "PLY binary little endian" or "XYZ text, 6 columns with normals".
  std::string format;
  std::size_t dropped_points = 0;  // number of points removed because a coordinate was NaN or infinite
  // Number of points removed because all their coordinates were 0, which devices write for points that they
  // have not measured. The number is 0 if the file has faces, has at most 16 of these points, or has no other
  // points.
  std::size_t unmeasured_points = 0;
  // Number of points with finite coordinates and a zero, non-finite or missing normal. If they are a
  // minority, these points are removed; otherwise all points are kept, and the cloud has no normals.
  std::size_t dropped_normals = 0;
  // Number of points that the header promises, but that are missing because the file ends early.
  std::size_t missing_points = 0;
  // Number of points removed because the file excludes them, such as noise in LAS.
  std::size_t left_out_points = 0;
  std::vector<std::string> remarks =
      {};          // messages about what was left out, such as "left out 40 points ..."
  Mesh mesh = {};  // the file's faces, with their own copy of the points; empty if the file has no faces
};

}  // namespace relievo
