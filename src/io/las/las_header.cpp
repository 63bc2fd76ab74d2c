#include "io/las/las_header.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/formats.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::array<std::size_t, 11> least_record_sizes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
constexpr std::array<std::size_t, 11> colour_places = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
constexpr std::size_t least_header = 227, header_1_4 = 375;

class LasHeaderReader {
 public:
  explicit LasHeaderReader(const Source& source) : source_(source), bytes_(source.bytes) {}

  Result<LasHeader> read() {
    if (!bytes_.starts_with("LASF"))
      return source_.error_at_byte(0, "expected LASF, found " + in_quotes(bytes_.substr(0, 4)));
    if (bytes_.size() < least_header)
      return source_.error_at_byte(bytes_.size(),
                                   "expected a header of at least 227 bytes, found the end of the file");
    RELIEVO_CHECK(check_version());
    RELIEVO_CHECK(take_layout());
    RELIEVO_CHECK(take_count());
    RELIEVO_CHECK(take_position());
    take_colours();
    header_.minor = at<std::uint8_t>(25);
    header_.variable_records = at<std::uint32_t>(100);
    take_classes();
    return header_;
  }

 private:
  template <typename T>
  T at(std::size_t byte) const {
    return little<T>(bytes_.data() + byte);
  }

  Result<void> check_version() const {
    const int major = at<std::uint8_t>(24), minor = at<std::uint8_t>(25);
    if (major == 1 && minor <= 5) return {};
    return source_.error_at_byte(24, cat("expected LAS 1.0 to 1.5, found ", major, ".", minor));
  }

  Result<void> take_layout() {
    const std::size_t header = at<std::uint16_t>(94);
    if (header < least_header)
      return source_.error_at_byte(94, cat("expected a header size of at least 227, found ", header));
    records_.offset = at<std::uint32_t>(96);
    if (records_.offset < header)
      return source_.error_at_byte(
          96, cat("expected points after the header, found them at byte ", records_.offset));
    format_ = at<std::uint8_t>(104);
    header_.is_compressed = format_ >= 128;
    if (header_.is_compressed) format_ -= 128;
    header_.format = format_;
    header_.header_size = header;
    if (format_ >= least_record_sizes.size())
      return source_.error_at_byte(104, cat("expected a point format from 0 to 10, found ", format_));
    records_.stride = at<std::uint16_t>(105);
    if (records_.stride < least_record_sizes[format_])
      return source_.error_at_byte(105, cat("expected records of at least ", least_record_sizes[format_],
                                            " bytes, found ", records_.stride));
    return {};
  }

  Result<void> take_count() {
    records_.count = at<std::uint32_t>(107);
    const bool has_long_count = at<std::uint8_t>(25) >= 4 && at<std::uint16_t>(94) >= header_1_4;
    if (has_long_count && bytes_.size() < header_1_4)
      return source_.error_at_byte(bytes_.size(),
                                   "expected a header of 375 bytes, found the end of the file");
    if (has_long_count && at<std::uint64_t>(247) > 0) records_.count = at<std::uint64_t>(247);
    if (records_.count < no_index) return {};
    return source_.error_at_byte(has_long_count ? 247 : 107,
                                 cat("expected fewer than 4294967295 points, found ", records_.count));
  }

  Result<void> take_position() {
    for (std::size_t i = 0; i < 3; ++i) {
      RecordColumn& column = records_.position[i];
      column = {NumberType::int32, 4 * i, at<double>(131 + 8 * i), at<double>(155 + 8 * i)};
      if (!std::isfinite(column.scale) || column.scale == 0)
        return source_.error_at_byte(131 + 8 * i,
                                     cat("expected a scale that is finite and not 0, found ", column.scale));
      if (!std::isfinite(column.shift))
        return source_.error_at_byte(155 + 8 * i, cat("expected a finite offset, found ", column.shift));
    }
    return {};
  }

  // In point formats up to 5, one byte has the class and the flags; later formats have a byte for each.
  void take_classes() {
    if (source_.keeps_doubtful) return;
    const auto in_one_byte = [](const char* row) {
      const auto byte = little<std::uint8_t>(row + 15);
      return is_left_out(byte & 31U, (byte & 128U) != 0);
    };
    const auto in_two_bytes = [](const char* row) {
      return is_left_out(little<std::uint8_t>(row + 16), (little<std::uint8_t>(row + 15) & 4U) != 0);
    };
    records_.left_out.emplace(format_ < 6 ? LeftOutRows{in_one_byte, what_las_leaves_out}
                                          : LeftOutRows{in_two_bytes, what_las_leaves_out});
  }

  // Finds the columns and the range of colours. Colours should have 16 bits, but some programs write 8 bits.
  void take_colours() {
    const std::size_t place = colour_places[format_];
    if (place == 0) return;
    std::uint16_t highest = header_.is_compressed ? 0xFFFF : 0;
    const std::size_t enough = 4096;
    for (std::size_t i = 0; highest < 256 && i < std::min<std::uint64_t>(records_.count, enough); ++i) {
      const std::uint64_t row = records_.offset + i * records_.stride + place;
      if (row + 6 > bytes_.size()) break;
      for (std::size_t c = 0; c < 3; ++c) highest = std::max(highest, at<std::uint16_t>(row + 2 * c));
    }
    const double scale = highest > 255 ? 1 / 257.0 : 1;
    records_.colour.emplace();
    for (std::size_t c = 0; c < 3; ++c) (*records_.colour)[c] = {NumberType::uint16, place + 2 * c, scale};
  }

  const Source& source_;
  std::string_view bytes_;
  std::size_t format_ = 0;
  LasHeader header_;
  Records& records_ = header_.records;
};

}  // namespace

Result<LasHeader> read_las_header(const Source& source) {
  return LasHeaderReader(source).read();
}

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
  const char* const rows = source.bytes.data() + std::min<std::size_t>(source.bytes.size(), records.offset);
  RawCloud raw{decode_all(records, rows), cat("LAS 1.", header.minor)};
  raw.leave_out(count_left_out(records, rows, records.count), what_las_leaves_out);
  raw.missing_points = promised - records.count;
  return raw;
}

}  // namespace relievo::io
