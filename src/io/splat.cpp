// Reads .splat: Gaussian splats in rows of 32 bytes, without a header. A row has position and scales as
// floats, then red, green, blue and opacity, and a rotation, as bytes.
#include "io/formats.h"
#include "io/numbers.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::size_t row_bytes = 32, colour_at = 24, opacity_at = 27;

Records records_of(std::uint64_t file_bytes, bool keeps_doubtful) {
  using enum NumberType;
  Records records;
  records.count = file_bytes / row_bytes;
  records.stride = row_bytes;
  records.position = {{{float32, 0}, {float32, 4}, {float32, 8}}};
  records.colour = {{{uint8, colour_at}, {uint8, colour_at + 1}, {uint8, colour_at + 2}}};
  if (keeps_doubtful) return records;
  records.left_out = LeftOutRows{[](const char* row) { return little<std::uint8_t>(row + opacity_at) < 128; },
                                 what_splats_leave_out};
  return records;
}

}  // namespace

bool is_splat(const Source& source) {
  return has_ending(source.name, ".splat");
}

Result<RawCloud> read_splat(const Source& source) {
  const std::size_t size = source.bytes.size();
  if (size % row_bytes != 0)
    return source.error_at_byte(size - size % row_bytes,
                                cat("expected a splat of 32 bytes, found ", size % row_bytes));
  const Records records = records_of(size, source.keeps_doubtful);
  RawCloud raw{decode_all(records, source.bytes.data()), "splat, Gaussian splats"};
  raw.leave_out(count_left_out(records, source.bytes.data(), records.count), what_splats_leave_out);
  return raw;
}

}  // namespace relievo::io
