// Reads LAZ: LAS compressed by LASzip 2 or later (M. Isenburg, "LASzip: lossless compression of LiDAR data",
// 2013, and the specification of LAZ 1.4). Point formats 0 to 10 are read, in chunks or as a whole.
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "io/formats.h"
#include "io/las/arithmetic_decoder.h"
#include "io/las/las_header.h"
#include "io/las/point_items.h"
#include "io/numbers.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// A part of each point. The values of Type are LASzip's.
struct LazItem {
  enum Type : std::uint16_t {
    bytes = 0,
    position = 6,
    time = 7,
    colour = 8,
    wave_packet = 9,
    layered_position = 10,
    layered_colour = 11,
    layered_colour_and_infrared = 12,
    layered_wave_packet = 13,
    layered_bytes = 14
  };
  std::uint16_t type = 0, size = 0, version = 0;
};

struct LazChunk {
  std::uint64_t first_point = 0, points = 0;
  std::string_view bytes;
};

struct LazLayout {
  std::vector<LazItem> items;
  bool is_layered = false;
  std::vector<LazChunk> chunks;
};

constexpr std::size_t record_header = 54;  // size of the header of a variable-length record
// This value (or 0) is stored as the number of points per chunk if that number varies.
constexpr std::uint32_t chunks_vary = ~0U;
// The largest number of points per byte of a chunk; a chunk that promises more is an error. A row of points
// with equal steps was measured to have 40 points per byte.
constexpr std::uint64_t most_points_a_byte = 256;

// Reads the variable-length record of LASzip and the table of chunks. Checks that all chunks are within the
// file, and that together they have as many points as the header promises. Errors name the byte.
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
    if (chunk_size_ == 0) chunk_size_ = chunks_vary;
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

struct LazPoints {
  const Records& records;
  Cloud& cloud;
  std::vector<LazColour>& colours;     // empty, or one per point
  std::atomic<std::size_t>& left_out;  // number of points left out
  bool keeps_doubtful;

  // Sets point i. If the point is left out, its coordinates become NaN.
  template <typename Point>
  void set(std::size_t i, const Point& point) const {
    const bool counts = keeps_doubtful || !is_left_out(point.classification(), point.is_withheld());
    if (!counts) ++left_out;
    for (std::size_t c = 0; c < 3; ++c)
      cloud.points[i][static_cast<Eigen::Index>(c)] =
          counts ? records.position[c].scale * point.position()[c] + records.position[c].shift
                 : std::numeric_limits<double>::quiet_NaN();
  }
};

std::size_t size_of_point(const LazLayout& layout) {
  std::size_t size = 0;
  for (const LazItem& item : layout.items) size += item.size;
  return size;
}

std::unique_ptr<PointItem> make_item(const LazItem& item) {
  switch (item.type) {
    case LazItem::time:
      return std::make_unique<TimeItem>();
    case LazItem::wave_packet:
      return std::make_unique<WavePacketItem>();
    default:
      return std::make_unique<ExtraBytesItem>(item.size);
  }
}

// Decodes a chunk point by point. Returns false if the chunk ends too early.
bool decode_items(const LazLayout& layout, const LazChunk& chunk, const LazPoints& to) {
  auto position = std::make_unique<PositionItem>();
  auto colour = std::make_unique<ColourItem>();
  std::vector<std::unique_ptr<PointItem>> others;
  std::vector<PointItem*> items;
  std::size_t offset = 0;
  for (const LazItem& item : layout.items) {
    if (item.type != LazItem::position && item.type != LazItem::colour) others.push_back(make_item(item));
    items.push_back(item.type == LazItem::position ? position.get()
                    : item.type == LazItem::colour ? static_cast<PointItem*>(colour.get())
                                                   : others.back().get());
    items.back()->start(chunk.bytes.data() + offset);
    offset += item.size;
  }
  ArithmeticDecoder decoder(chunk.bytes.substr(offset));
  for (std::uint64_t i = 0; i < chunk.points; ++i) {
    if (i > 0)
      for (PointItem* const item : items) item->next(decoder);
    to.set(chunk.first_point + i, *position);
    if (!to.colours.empty()) to.colours[chunk.first_point + i] = colour->colour();
    if (decoder.is_beyond_end()) return false;
  }
  return true;
}

// Splits a chunk into layers. A chunk consists of the first point, the number of points, the sizes of the
// layers, and the layers.
class LayerSizes {
 public:
  LayerSizes(std::string_view bytes, std::size_t first_size, std::size_t layers)
      : bytes_(bytes), sizes_at_(first_size + 4), next_(sizes_at_ + 4 * layers) {}

  bool has_sizes() const { return next_ <= bytes_.size(); }

  // Returns the next layer; nothing if it exceeds the chunk.
  std::optional<std::string_view> take() {
    const std::size_t size = little<std::uint32_t>(bytes_.data() + sizes_at_ + 4 * number_++);
    if (size > bytes_.size() - next_) return std::nullopt;
    const std::string_view layer = bytes_.substr(next_, size);
    next_ += size;
    return layer;
  }

 private:
  std::string_view bytes_;
  std::size_t sizes_at_, next_, number_ = 0;
};

std::size_t layers_of(const LazItem& item) {
  if (item.type == LazItem::layered_position) return 9;
  if (item.type == LazItem::layered_colour_and_infrared) return 2;
  return item.type == LazItem::layered_bytes ? item.size : 1;
}

std::optional<LazLayers> find_layers(const LazLayout& layout, const LazChunk& chunk) {
  std::size_t count = 0;
  for (const LazItem& item : layout.items) count += layers_of(item);
  LayerSizes sizes(chunk.bytes, size_of_point(layout), count);
  if (!sizes.has_sizes()) return std::nullopt;
  LazLayers layers;
  for (std::size_t i = 0; i < 9; ++i) {
    const auto layer = sizes.take();
    if (!layer) return std::nullopt;
    if (i == 0) layers.xy = *layer;
    if (i == 1) layers.z = *layer;
    if (i == 2) layers.classes = *layer;
    if (i == 3) layers.flags = *layer;
  }
  if (layout.items.size() < 2) return layers;
  const LazItem& second = layout.items[1];
  if (second.type != LazItem::layered_colour && second.type != LazItem::layered_colour_and_infrared)
    return layers;
  const auto layer = sizes.take();
  if (!layer) return std::nullopt;
  layers.colours = *layer;
  layers.are_colours_mixed = second.version == 3;
  return layers;
}

bool decode_layers(const LazLayout& layout, const LazChunk& chunk, const LazPoints& to) {
  const auto layers = find_layers(layout, chunk);
  if (!layers) return false;
  const char* const first = chunk.bytes.data();
  const auto point = std::make_unique<LayeredPoint>(
      *layers, first, to.colours.empty() ? nullptr : first + layout.items[0].size);
  for (std::uint64_t i = 0; i < chunk.points; ++i) {
    if (i > 0) point->next();
    to.set(chunk.first_point + i, *point);
    if (!to.colours.empty()) to.colours[chunk.first_point + i] = point->colour();
    if (point->is_beyond_end()) return false;
  }
  return true;
}

// Sets the colours as bytes. Colours should have 16 bits, but some programs write 8 bits.
void set_colours(Cloud& cloud, const std::vector<LazColour>& colours) {
  std::uint16_t highest = 0;
  for (const LazColour& colour : colours) highest = std::max(highest, std::ranges::max(colour));
  cloud.colours.resize(colours.size());
  const double scale = highest > 255 ? 1 / 257. : 1;
  parallel_for(colours.size(), [&](std::size_t i) {
    for (std::size_t c = 0; c < 3; ++c)
      cloud.colours[i][c] = static_cast<std::uint8_t>(scale * colours[i][c] + .5);
  });
}

bool has_colours(const LazLayout& layout) {
  return std::ranges::any_of(layout.items, [](const LazItem& item) {
    return item.type == LazItem::colour || item.type == LazItem::layered_colour ||
           item.type == LazItem::layered_colour_and_infrared;
  });
}

}  // namespace

bool is_laz(const Source& source) {
  constexpr std::size_t format = 104;
  const bool is_las = source.bytes.starts_with("LASF");
  if (is_las && source.bytes.size() > format) return static_cast<unsigned char>(source.bytes[format]) >= 128;
  return has_ending(source.name, ".laz");
}

Result<RawCloud> read_laz(const Source& source) {
  RELIEVO_TRY(const LasHeader header, read_las_header(source));
  if (!header.is_compressed) return read_las(source);
  RELIEVO_TRY(const LazLayout layout, LayoutReader(source, header).read());
  RawCloud raw;
  raw.format = cat("LAZ 1.", header.minor);
  std::vector<LazColour> colours(has_colours(layout) ? header.records.count : 0);
  raw.cloud.points.resize(header.records.count);
  std::atomic<std::size_t> left_out = 0;
  const LazPoints points{header.records, raw.cloud, colours, left_out, source.keeps_doubtful};
  std::atomic<std::size_t> damaged = layout.chunks.size();
  parallel_for(
      layout.chunks.size(),
      [&](std::size_t i) {
        const LazChunk& chunk = layout.chunks[i];
        const bool is_right = chunk.bytes.size() >= header.records.stride &&
                              (layout.is_layered ? decode_layers : decode_items)(layout, chunk, points);
        std::size_t first = damaged;
        while (!is_right && i < first && !damaged.compare_exchange_weak(first, i)) continue;
      },
      1);
  if (damaged < layout.chunks.size()) {
    const LazChunk& chunk = layout.chunks[damaged];
    return source.error_at_byte(static_cast<std::size_t>(chunk.bytes.data() - source.bytes.data()),
                                cat("expected ", chunk.points, " points in chunk ", damaged + 1, " of ",
                                    layout.chunks.size(), ", found the end of the chunk"));
  }
  if (!colours.empty()) set_colours(raw.cloud, colours);
  raw.leave_out(left_out, what_las_leaves_out);
  return raw;
}

}  // namespace relievo::io
