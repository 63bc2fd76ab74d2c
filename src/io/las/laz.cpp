// Reads LAZ: LAS compressed by LASzip 2 or later (M. Isenburg, "LASzip: lossless compression of LiDAR data",
// 2013, and the specification of LAZ 1.4), point formats 0 to 10, in chunks or as a whole.
#include <atomic>
#include <memory>

#include "io/formats.h"
#include "io/las/laz_chunks.h"
#include "io/las/point_layers.h"
#include "io/numbers.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

struct LazPoints {
  const Records& records;
  Cloud& cloud;
  std::vector<LazColour>& colours;  // empty, or one per point

  void set(std::size_t i, const std::array<std::int32_t, 3>& position) const {
    for (std::size_t c = 0; c < 3; ++c)
      cloud.points[i][static_cast<Eigen::Index>(c)] =
          records.position[c].scale * position[c] + records.position[c].shift;
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

// Decodes a chunk point by point. Returns false if the chunk ends before its points.
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
    to.set(chunk.first_point + i, position->position());
    if (!to.colours.empty()) to.colours[chunk.first_point + i] = colour->colour();
    if (decoder.is_beyond_end()) return false;
  }
  return true;
}

// The layers of a chunk. The first point is followed by the number of points, the size of each layer, and the
// layers.
class LayerSizes {
 public:
  LayerSizes(std::string_view bytes, std::size_t first_size, std::size_t layers)
      : bytes_(bytes), sizes_at_(first_size + 4), next_(sizes_at_ + 4 * layers) {}

  bool has_sizes() const { return next_ <= bytes_.size(); }

  // Returns the next layer; nothing if it does not lie within the chunk.
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

std::optional<PointLayers> find_layers(const LazLayout& layout, const LazChunk& chunk) {
  std::size_t count = 0;
  for (const LazItem& item : layout.items) count += layers_of(item);
  LayerSizes sizes(chunk.bytes, size_of_point(layout), count);
  if (!sizes.has_sizes()) return std::nullopt;
  PointLayers layers;
  for (std::size_t i = 0; i < 9; ++i) {
    const auto layer = sizes.take();
    if (!layer) return std::nullopt;
    if (i == 0) layers.xy = *layer;
    if (i == 1) layers.z = *layer;
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
    to.set(chunk.first_point + i, point->position());
    if (!to.colours.empty()) to.colours[chunk.first_point + i] = point->colour();
    if (point->is_beyond_end()) return false;
  }
  return true;
}

// Sets the colours as bytes. They should be stored with 16 bits, but some programs write 8.
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
  RELIEVO_TRY(const LazLayout layout, read_laz_layout(source, header));
  RawCloud raw;
  raw.format = cat("LAZ 1.", header.minor);
  std::vector<LazColour> colours(has_colours(layout) ? header.records.count : 0);
  raw.cloud.points.resize(header.records.count);
  const LazPoints points{header.records, raw.cloud, colours};
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
  return raw;
}

}  // namespace relievo::io
