// Reads clouds that are too large for memory piece by piece, and reduces them to the points that the viewer
// sees, at the desired resolution.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/progress.h"
#include "relievo/io/read.h"
#include "relievo/scan/cloud.h"
#include "relievo/scan/view.h"

namespace relievo {

// A file, or anything else with random access to its bytes. Errors of read() are passed on.
class ByteSource {
 public:
  ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  virtual ~ByteSource() = default;

  virtual std::uint64_t size() const = 0;
  // Fills `to` with the bytes from `offset` on. Callers ask only for bytes within size().
  virtual Result<void> read(std::uint64_t offset, std::span<std::byte> to) = 0;
};

// A large cloud after its reduction.
struct StreamedCloud {
  Cloud cloud;                            // points in the frame of the file
  std::string format;                     // name of the format, for people
  std::uint64_t input_points = 0;         // number of points in the file
  std::uint64_t ignored_faces = 0;        // faces of the file, which are not read
  std::uint64_t missing_points = 0;       // points missing because the file ends early
  std::vector<std::string> remarks = {};  // what of the file is left out, as in CloudFile
};

// Returns true if stream_front() reads the file that begins with these bytes: binary PLY without lists in the
// vertices and the elements before them, LAS, or binary PCD.
bool can_stream(std::span<const std::byte> head, std::string_view name);

// Says how much of a file stream_front() reads.
struct StreamOptions {
  // The number of points; see ReadOptions about those that are doubtful.
  StreamOptions(double wanted, bool keeps = false) : points(wanted), keeps_doubtful(keeps) {}

  double points;
  bool keeps_doubtful;
};

// Returns about `options.points` points of the side that the view shows. For each square of a grid over the view, the
// result has the mean of the front-most points that face the viewer, with their mean normal and colour;
// averaging also reduces noise. Without normals, all points are taken to face the viewer. Normals that point
// inwards are reversed. The file is read three times, and a few pieces once more. Memory is 80 bytes per
// square plus 40 MB, whatever the file's size. The result has the same bits for any number of threads.
// Errors: kind input as for read_cloud(), and for bytes that can_stream() refuses; kind option for a number
// of points not in [1000, 1e7]; kind geometry if no point faces the viewer; kind cancelled, checked after
// each piece of 8 MB.
Result<StreamedCloud> stream_front(ByteSource& source, std::string_view name, const View& view,
                                   const StreamOptions& options, Progress* progress = nullptr);

}  // namespace relievo
