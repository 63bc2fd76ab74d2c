// Clouds too large for memory: read piece by piece, keeping what the viewer sees at the resolution wanted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "relievo/core/progress.h"
#include "relievo/scan/cloud.h"
#include "relievo/view.h"

namespace relievo {

// A file, or what else has bytes at places. Errors of read() are passed on.
class ByteSource {
 public:
  ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  virtual ~ByteSource() = default;

  virtual std::uint64_t size() const = 0;
  // Fills `to` with the bytes from `offset` on; they exist.
  virtual Result<void> read(std::uint64_t offset, std::span<std::byte> to) = 0;
};

// What stays of a large cloud.
struct StreamedCloud {
  Cloud cloud;                     // in the frame of the file
  std::string format;              // for people
  std::uint64_t input_points = 0;  // in the file
};

// True if stream_front() reads what begins with these bytes: binary PLY whose vertices have no lists, nor
// what comes before them; LAS; PCD in binary.
bool can_stream(std::span<const std::byte> head, std::string_view name);

// Returns about `points` points of the side that the view shows: for each square of a grid over the view the
// mean of the front-most points that face the viewer, with their mean normal and colour, which also takes
// away noise. Points without normals count all. Normals that point inwards are turned. The file is read three
// times, and a few pieces more; memory is 80 bytes per square and 40 MB, whatever the file's size. The same
// bits for any number of threads. Errors: kind input as read_cloud() gives them, and for bytes that
// can_stream() refuses; kind option for a number of points not in [1000, 1e7]; kind geometry if no point
// faces the viewer; kind cancelled, at the next piece of 8 MB.
Result<StreamedCloud> stream_front(ByteSource& source, std::string_view name, const View& view, double points,
                                   Progress* progress = nullptr);

}  // namespace relievo
