// Reads clouds that are too large for memory, block by block. Reduces them to the points that the viewer
// sees, at the requested resolution.
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

// A file, or another source of bytes with random access. stream_front() returns the errors of read().
class ByteSource {
 public:
  ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  virtual ~ByteSource() = default;

  virtual std::uint64_t size() const = 0;
  // Fills `to` with the bytes from `offset` on. Callers request only bytes within size().
  virtual Result<void> read(std::uint64_t offset, std::span<std::byte> to) = 0;
};

// A large cloud after its reduction.
struct StreamedCloud {
  Cloud cloud;                            // points in the file's axes
  std::string format;                     // name of the format, for messages
  std::uint64_t input_points = 0;         // number of points in the file
  std::uint64_t ignored_faces = 0;        // number of faces in the file, which are not read
  std::uint64_t missing_points = 0;       // number of points that the file promises but does not contain
  std::vector<std::string> remarks = {};  // messages about what was left out, see CloudFile
};

// Returns whether stream_front() can read the file that begins with these bytes. It can read LAS and binary
// PCD. It can also read binary PLY if neither the vertices nor the elements before them contain lists.
bool can_stream(std::span<const std::byte> head, std::string_view name);

// The options of stream_front().
struct StreamOptions {
  // `wanted` is the value of `points`, the approximate number of points of the result. `keeps` is the value
  // of `keeps_doubtful`, see ReadOptions.
  StreamOptions(double wanted, bool keeps = false) : points(wanted), keeps_doubtful(keeps) {}

  double points;
  bool keeps_doubtful;
};

// Returns about `options.points` points of the side that the view shows. The result has a point for each
// square of a grid over the view: the mean of the front-most points that face the viewer, with their mean
// normal and colour. The mean also reduces noise. Points without normals count as facing the viewer. Inward
// normals are reversed. The whole file is read three times, and a few of its blocks are read a fourth time.
// The memory needed is 80 bytes per square plus 40 MB, whatever the size of the file. The result has the same
// bits for any number of threads. Errors: kind input as for read_cloud(), and for bytes that can_stream()
// refuses; kind option for a number of points not in [1000, 1e7]; kind geometry if no point faces the viewer;
// kind cancelled, checked after each block of 8 MB.
Result<StreamedCloud> stream_front(ByteSource& source, std::string_view name, const View& view,
                                   const StreamOptions& options, Progress* progress = nullptr);

}  // namespace relievo
