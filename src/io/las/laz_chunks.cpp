#include "io/las/laz_chunks.h"

#include <algorithm>

#include "io/las/integer_decoder.h"
#include "io/numbers.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::size_t record_header = 54;   // size of the header of a variable-length record
constexpr std::uint32_t chunks_vary = ~0U;  // stored instead of the points per chunk if these vary
constexpr std::uint64_t most_points_a_byte =
    256;  // limit; 40 was measured for a row of points at equal steps

class LayoutReader {
 public:
  LayoutReader(const Source& source, const LasHeader& header) : source_(source), header_(header) {}

  Result<LazLayout> read() {
    RELIEVO_CHECK(find_record());
    RELIEVO_CHECK(take_items());
    if (compressor_ == 1) {
      layout_.chunks.push_back({0, header_.records.count, source_.bytes.substr(header_.records.offset)});
      return std::move(layout_);
    }
    RELIEVO_CHECK(find_table());
    RELIEVO_CHECK(take_table());
    return std::move(layout_);
  }

 private:
  template <typename T>
  T at(std::uint64_t byte) const {
    return little<T>(source_.bytes.data() + byte);
  }

  // Finds the record that describes the compression.
  Result<void> find_record() {
    std::uint64_t next = header_.header_size;
    const std::uint64_t end = std::min<std::uint64_t>(header_.records.offset, source_.bytes.size());
    for (std::size_t i = 0; i < header_.variable_records && next + record_header <= end; ++i) {
      const std::uint64_t length = at<std::uint16_t>(next + 20);
      if (length > end - next - record_header) break;
      if (source_.bytes.substr(next + 2).starts_with("laszip encoded") &&
          at<std::uint16_t>(next + 18) == 22204) {
        record_ = next + record_header;
        record_size_ = length;
        return {};
      }
      next += record_header + length;
    }
    return source_.error_at_byte(next,
                                 "expected a record of LASzip, as the points are compressed, found none");
  }

  Result<void> take_items() {
    constexpr std::size_t items_at = 34;
    if (record_size_ < items_at)
      return source_.error_at_byte(record_,
                                   cat("expected a record of 34 bytes or more, found ", record_size_));
    compressor_ = at<std::uint16_t>(record_);
    chunk_size_ = at<std::uint32_t>(record_ + 12);
    const std::size_t count = at<std::uint16_t>(record_ + 32);
    if (compressor_ < 1 || compressor_ > 3 || at<std::uint16_t>(record_ + 2) != 0)
      return source_.error_at_byte(record_, cat("expected a compressor from 1 to 3, found ", compressor_));
    if (count == 0 || count > (record_size_ - items_at) / 6)
      return source_.error_at_byte(record_ + 32, cat("expected items within the record, found ", count));
    layout_.is_layered = compressor_ == 3;
    std::size_t size = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t item = record_ + items_at + 6 * i;
      layout_.items.push_back(
          {at<std::uint16_t>(item), at<std::uint16_t>(item + 2), at<std::uint16_t>(item + 4)});
      RELIEVO_CHECK(check_item(layout_.items[i], i, item));
      size += layout_.items[i].size;
    }
    if (size == header_.records.stride) return {};
    return source_.error_at_byte(
        record_ + 32, cat("expected items of ", header_.records.stride, " bytes a point, found ", size));
  }

  Result<void> check_item(const LazItem& item, std::size_t number, std::uint64_t byte) const {
    constexpr std::array<std::size_t, 15> sizes = {0, 0, 0, 0, 0, 0, 20, 8, 6, 29, 30, 6, 8, 29, 0};
    const bool is_known =
        item.type == LazItem::bytes || (item.type >= LazItem::position && item.type < sizes.size());
    const bool has_right_kind = (item.type >= LazItem::layered_position) == layout_.is_layered;
    const bool is_position = item.type == LazItem::position || item.type == LazItem::layered_position;
    if (!is_known || !has_right_kind || is_position != (number == 0) ||
        (sizes[item.type] != 0 && sizes[item.type] != item.size))
      return source_.error_at_byte(byte, cat("expected items of point formats 0 to 10, found type ",
                                             item.type, " of ", item.size, " bytes"));
    const int least = layout_.is_layered ? 3 : item.type == LazItem::wave_packet ? 1 : 2;
    const int most = layout_.is_layered ? 4 : 2;
    if (item.version >= least && item.version <= most) return {};
    return source_.error_at_byte(byte + 4, cat("expected items of version ", least, " to ", most, ", found ",
                                               item.version, "; newer LASzip can convert the file"));
  }

  // Finds the table of chunks. Writers that cannot seek backwards store its offset at the end of the file.
  Result<void> find_table() {
    const std::uint64_t size = source_.bytes.size(), points = header_.records.offset;
    if (points > size || size - points < 8)
      return source_.error_at_byte(points,
                                   "expected the place of the table of chunks, found the end of the file");
    table_ = at<std::uint64_t>(points);
    if (table_ == ~std::uint64_t{0} || table_ <= points) table_ = at<std::uint64_t>(size - 8);
    if (table_ >= points + 8 && table_ <= size && size - table_ >= 8) return {};
    return source_.error_at_byte(points,
                                 "expected the table of chunks within the file, found it elsewhere; the file "
                                 "was not written to its end");
  }

  Result<void> take_table() {
    const std::uint64_t count = at<std::uint32_t>(table_ + 4);
    std::uint64_t left = header_.records.count, next = header_.records.offset + 8;
    ArithmeticDecoder decoder(source_.bytes.substr(table_ + 8));
    IntegerDecoder numbers(32, 2);
    std::int32_t points = 0, bytes = 0;
    for (std::uint64_t i = 0; i < count && left > 0; ++i) {
      if (chunk_size_ == chunks_vary) points = numbers.next(decoder, points, 0);
      bytes = numbers.next(decoder, bytes, 1);
      const auto size = static_cast<std::uint32_t>(bytes);
      const std::uint64_t here = std::min<std::uint64_t>(
          left, chunk_size_ == chunks_vary ? static_cast<std::uint32_t>(points) : chunk_size_);
      if (size > table_ - next || decoder.is_beyond_end())
        return source_.error_at_byte(
            next, cat("expected chunk ", i + 1, " of ", count, " before its table, found ", size, " bytes"));
      if (here > most_points_a_byte * size)
        return source_.error_at_byte(next, cat("expected ", here, " points in chunk ", i + 1, ", found ",
                                               size, " bytes, which are too few"));
      if (here > 0)
        layout_.chunks.push_back({header_.records.count - left, here, source_.bytes.substr(next, size)});
      next += size;
      left -= here;
    }
    if (left == 0) return {};
    return source_.error_at_byte(table_, cat("expected chunks with ", header_.records.count,
                                             " points, found ", header_.records.count - left));
  }

  const Source& source_;
  const LasHeader& header_;
  LazLayout layout_;
  std::uint64_t record_ = 0, record_size_ = 0, table_ = 0;
  int compressor_ = 0;
  std::uint32_t chunk_size_ = 0;
};

}  // namespace

Result<LazLayout> read_laz_layout(const Source& source, const LasHeader& header) {
  return LayoutReader(source, header).read();
}

}  // namespace relievo::io
