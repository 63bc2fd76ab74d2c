// Reads LAS 1.0 to 1.5, point formats 0 to 10, not compressed.
#include <algorithm>

#include "io/formats.h"
#include "io/las/las_header.h"
#include "relievo/core/text.h"

namespace relievo::io {

bool is_las(const Source& source) {
  return source.bytes.starts_with("LASF") || has_ending(source.name, ".las");
}

Result<StreamRecords> find_las_rows(const Source& head) {
  RELIEVO_TRY(const LasHeader header, read_las_header(head));
  if (header.is_compressed)
    return head.error_at_byte(104, "expected points that are not compressed, found LAZ");
  return StreamRecords{.records = header.records, .format = "LAS", .may_end_early = true};
}

Result<RawCloud> read_las(const Source& source) {
  RELIEVO_TRY(const LasHeader header, read_las_header(source));
  Records records = header.records;
  const std::size_t left = source.bytes.size() - std::min<std::size_t>(source.bytes.size(), records.offset);
  const std::uint64_t promised = records.count;
  records.count = std::min<std::uint64_t>(promised, left / records.stride);
  if (promised > 0 && records.count == 0)
    return source.error_at_byte(records.offset, cat("expected ", promised, " points of ", records.stride,
                                                    " bytes, found room for 0"));
  RawCloud raw{decode_all(records, source.bytes.data() + records.offset), cat("LAS 1.", header.minor)};
  raw.missing_points = promised - records.count;
  return raw;
}

}  // namespace relievo::io
