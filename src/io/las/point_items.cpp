// Decodes the parts of points ("items") as LASzip has written them since 2011. In the formats 0 to 5 these
// are items of version 2, or version 1 for wave packets; in the formats 6 to 10 they have version 3 or 4.
#include "io/las/point_items.h"

#include <algorithm>

#include "io/numbers.h"

namespace relievo::io {
namespace {

// The index of a point's models in formats 0 to 5. The row is the number of returns of the point's pulse; the
// column is the number of the point's own return. Similar returns share models.
constexpr std::uint8_t return_contexts[8][8] = {
    {15, 14, 13, 12, 11, 10, 9, 8},  {14, 0, 1, 3, 6, 10, 10, 9},   {13, 1, 2, 4, 7, 11, 11, 10},
    {12, 3, 4, 5, 8, 12, 12, 11},    {11, 6, 7, 8, 9, 13, 13, 12},  {10, 10, 11, 12, 13, 14, 14, 13},
    {9, 10, 11, 12, 13, 14, 15, 14}, {8, 9, 10, 11, 12, 13, 14, 15}};

int clamped(int byte) {
  return std::clamp(byte, 0, 255);
}

int low(std::uint16_t value) {
  return value & 255;
}
int high(std::uint16_t value) {
  return value >> 8;
}

// The index of a point's models in formats 6 to 10, with the same rows and columns as `return_contexts`.
constexpr std::array<std::string_view, 16> layered_return_contexts = {
    "0123453445555555", "1013333333333333", "2124444444433333", "3345444444444444",
    "4344544444444444", "5344454444444444", "3344445444444444", "4344444544444444",
    "4344444454444444", "5344444445444444", "5344444444544444", "5334444444455444",
    "5334444444455544", "5334444444445554", "5334444444444555", "5334444444444455"};

constexpr std::uint32_t changes_scanner_bit = 64;  // set in `changes` if the scanner differs

std::uint32_t symbol_of(std::optional<SymbolModel>& model, ArithmeticDecoder& decoder,
                        std::uint32_t symbols = 16) {
  if (!model) model.emplace(symbols);
  return decoder.symbol(*model);
}

}  // namespace

std::uint8_t ColourModels::byte(ArithmeticDecoder& decoder, std::size_t which, int prediction) {
  return static_cast<std::uint8_t>(decoder.symbol(bytes_[which]) + static_cast<std::uint32_t>(prediction));
}

void ColourModels::next(ArithmeticDecoder& decoder, LazColour& colour) {
  const LazColour last = colour;
  const std::uint32_t changes = decoder.symbol(changes_);
  const auto has = [&](unsigned bit) { return (changes >> bit & 1) != 0; };
  const int red_low = has(0) ? byte(decoder, 0, low(last[0])) : low(last[0]);
  const int red_high = has(1) ? byte(decoder, 1, high(last[0])) : high(last[0]);
  colour[0] = static_cast<std::uint16_t>(red_high << 8 | red_low);
  if (!has(6)) {  // green and blue equal red
    colour[1] = colour[2] = colour[0];
    return;
  }
  int step = red_low - low(last[0]);
  const int green_low = has(2) ? byte(decoder, 2, clamped(step + low(last[1]))) : low(last[1]);
  step = (step + green_low - low(last[1])) / 2;
  const int blue_low = has(4) ? byte(decoder, 4, clamped(step + low(last[2]))) : low(last[2]);
  step = red_high - high(last[0]);
  const int green_high = has(3) ? byte(decoder, 3, clamped(step + high(last[1]))) : high(last[1]);
  step = (step + green_high - high(last[1])) / 2;
  const int blue_high = has(5) ? byte(decoder, 5, clamped(step + high(last[2]))) : high(last[2]);
  colour[1] = static_cast<std::uint16_t>(green_high << 8 | green_low);
  colour[2] = static_cast<std::uint16_t>(blue_high << 8 | blue_low);
}

void ColourItem::start(const char* raw) {
  for (std::size_t c = 0; c < 3; ++c) colour_[c] = little<std::uint16_t>(raw + 2 * c);
}

void PositionItem::ByteModels::next(ArithmeticDecoder& decoder, std::uint8_t& value) {
  SymbolModel& model = models_.try_emplace(value, 256U).first->second;
  value = static_cast<std::uint8_t>(decoder.symbol(model));
}

void PositionItem::start(const char* raw) {
  for (std::size_t i = 0; i < 3; ++i) position_[i] = little<std::int32_t>(raw + 4 * i);
  returns_ = little<std::uint8_t>(raw + 14);
  classification_ = little<std::uint8_t>(raw + 15);
  user_data_ = little<std::uint8_t>(raw + 17);
  source_ = little<std::uint16_t>(raw + 18);
}

std::size_t PositionItem::return_context() const {
  return return_contexts[returns_ >> 3 & 7][returns_ & 7];
}

void PositionItem::decode_attributes(ArithmeticDecoder& decoder, std::uint32_t changes) {
  if ((changes & 32) != 0) returns_models_.next(decoder, returns_);
  if ((changes & 16) != 0) {
    const std::size_t context = return_context();
    intensities_[context] = static_cast<std::uint16_t>(intensity_.next(
        decoder, intensities_[context], static_cast<std::uint32_t>(std::min<std::size_t>(context, 3))));
  }
  if ((changes & 8) != 0) classification_models_.next(decoder, classification_);
  if ((changes & 4) != 0) decoder.symbol(angle_models_[returns_ >> 6 & 1]);  // decoded only to advance
  if ((changes & 2) != 0) user_data_models_.next(decoder, user_data_);
  if ((changes & 1) != 0) source_ = static_cast<std::uint16_t>(source_decoder_.next(decoder, source_));
}

void PositionItem::next(ArithmeticDecoder& decoder) {
  decode_attributes(decoder, decoder.symbol(changes_));
  const unsigned number = returns_ & 7U, count = returns_ >> 3 & 7U;
  const std::size_t context = return_context(), level = number > count ? number - count : count - number;
  const std::uint32_t is_single = count == 1 ? 1 : 0;

  const std::int32_t dx = x_.next(decoder, median_x_[context].get(), is_single);
  position_[0] = wrapping_sum(position_[0], dx);
  median_x_[context].add(dx);

  const std::int32_t dy =
      y_.next(decoder, median_y_[context].get(), is_single + size_context(x_.last_bits(), 20));
  position_[1] = wrapping_sum(position_[1], dy);
  median_y_[context].add(dy);

  position_[2] =
      z_.next(decoder, heights_[level], is_single + size_context((x_.last_bits() + y_.last_bits()) / 2, 18));
  heights_[level] = position_[2];
}

void TimeItem::start(const char* raw) {
  sequences_[0].time = little<std::uint64_t>(raw);
}

void TimeItem::next(ArithmeticDecoder& decoder) {
  while (!decoder.is_beyond_end())
    if (sequences_[now_].step == 0 ? decode_first_step(decoder) : decode_multiple(decoder)) return;
}

void TimeItem::decode_whole(ArithmeticDecoder& decoder) {
  newest_ = (newest_ + 1) & 3;
  const auto high_word = static_cast<std::int32_t>(sequences_[now_].time >> 32);
  const auto high_bits = static_cast<std::uint32_t>(steps_.next(decoder, high_word, 8));
  const std::uint32_t first = decoder.bits(16), second = decoder.bits(16);
  sequences_[newest_] = {std::uint64_t{high_bits} << 32 | second << 16 | first, 0, 0};
  now_ = newest_;
}

// Decodes the first step of a sequence. Returns false if the time belongs to another sequence, which becomes
// the current one.
bool TimeItem::decode_first_step(ArithmeticDecoder& decoder) {
  const std::uint32_t kind = decoder.symbol(first_steps_);
  Sequence& now = sequences_[now_];
  if (kind == 1) {
    now.step = steps_.next(decoder, 0, 0);
    now.time += static_cast<std::uint64_t>(std::int64_t{now.step});
    now.extremes = 0;
  } else if (kind == 2) {
    decode_whole(decoder);
  } else if (kind > 2) {
    now_ = (now_ + kind - 2) & 3;
    return false;
  }
  return true;
}

// Decodes a step as a multiple of the usual step. After several extreme steps the usual step is replaced.
bool TimeItem::decode_multiple(ArithmeticDecoder& decoder) {
  constexpr std::int32_t most = 500, least = -10, unchanged = most - least + 1, whole = unchanged + 1;
  const auto kind = static_cast<std::int32_t>(decoder.symbol(multiples_));
  Sequence& now = sequences_[now_];
  if (kind == unchanged) return true;
  if (kind == whole) {
    decode_whole(decoder);
    return true;
  }
  if (kind > whole) {
    now_ = (now_ + static_cast<std::size_t>(kind - whole)) & 3;
    return false;
  }
  const std::int32_t multiple = kind <= most ? kind : most - kind;
  const std::uint32_t context = multiple == 1      ? 1
                                : multiple == 0    ? 7
                                : multiple == most ? 4
                                : multiple >= 10   ? 3
                                : multiple > 0     ? 2
                                : multiple > least ? 5
                                                   : 6;
  const auto prediction =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(multiple) * static_cast<std::uint32_t>(now.step));
  const std::int32_t step = steps_.next(decoder, prediction, context);
  now.time += static_cast<std::uint64_t>(std::int64_t{step});
  if (multiple == 1) now.extremes = 0;
  if (multiple != 0 && multiple != most && multiple != least) return true;
  if (++now.extremes <= 3) return true;
  now.step = step;
  now.extremes = 0;
  return true;
}

void WavePacketItem::start(const char* raw) {
  size_ = little<std::int32_t>(raw + 9);
  return_point_ = little<std::int32_t>(raw + 13);
  for (std::size_t i = 0; i < 3; ++i) direction_[i] = little<std::int32_t>(raw + 17 + 4 * i);
}

void WavePacketItem::next(ArithmeticDecoder& decoder) {
  decoder.symbol(index_);
  offset_kind_ = decoder.symbol(offset_kinds_[offset_kind_]);
  if (offset_kind_ == 2) offset_step_ = offset_.next(decoder, offset_step_);
  if (offset_kind_ == 3)
    for (int i = 0; i < 4; ++i) decoder.bits(16);
  size_ = size_decoder_.next(decoder, size_);
  return_point_ = return_decoder_.next(decoder, return_point_);
  for (std::uint32_t i = 0; i < 3; ++i) direction_[i] = direction_decoder_.next(decoder, direction_[i], i);
}

LayeredPoint::LayeredPoint(const LazLayers& layers, const char* first, const char* colour)
    : xy_(layers.xy),
      are_colours_mixed_(layers.are_colours_mixed),
      channel_(little<std::uint8_t>(first + 15) >> 4 & 3) {
  if (!layers.z.empty()) z_.emplace(layers.z);
  if (!layers.classes.empty()) classes_.emplace(layers.classes);
  if (!layers.flags.empty()) flags_.emplace(layers.flags);
  if (!layers.colours.empty()) colours_.emplace(layers.colours);
  auto start = std::make_unique<Channel>();
  for (std::size_t i = 0; i < 3; ++i) start->position[i] = little<std::int32_t>(first + 4 * i);
  start->return_number = little<std::uint8_t>(first + 14) & 15;
  start->return_count = little<std::uint8_t>(first + 14) >> 4;
  const std::uint32_t flags = little<std::uint8_t>(first + 15);
  start->flags = (flags & 15U) | (flags >> 6 << 4);  // without the scanner's number
  start->classification = little<std::uint8_t>(first + 16);
  start->heights.fill(start->position[2]);
  channels_[channel_] = std::move(start);
  if (!colour) return;
  for (std::size_t c = 0; c < 3; ++c) colour_[c] = little<std::uint16_t>(colour + 2 * c);
  colour_channel_ = channel_;
  colour_channels_[channel_] = std::make_unique<ColourChannel>(ColourChannel{colour_, {}});
}

// Decodes which values differ from those of the previous point, and switches to the point's scanner.
std::uint32_t LayeredPoint::decode_changes() {
  Channel& last = *channels_[channel_];
  const std::size_t context = (last.return_number == 1 ? 1U : 0U) +
                              (last.return_number >= last.return_count ? 2U : 0U) +
                              (last.has_new_time ? 4U : 0U);
  const std::uint32_t changes = xy_.symbol(last.changes[context]);
  if ((changes & changes_scanner_bit) == 0) return changes;
  channel_ = (channel_ + xy_.symbol(last.channel_step) + 1) % 4;
  if (channels_[channel_]) return changes;
  auto made = std::make_unique<Channel>();
  made->position = last.position;
  made->return_number = last.return_number;
  made->return_count = last.return_count;
  made->classification = last.classification;
  made->flags = last.flags;
  made->heights.fill(last.position[2]);
  channels_[channel_] = std::move(made);
  return changes;
}

void LayeredPoint::decode_returns(Channel& channel, std::uint32_t changes) {
  channel.has_new_time = (changes & 16) != 0;
  const std::uint32_t last = channel.return_number;
  if ((changes & 4) != 0) channel.return_count = symbol_of(channel.return_counts[channel.return_count], xy_);
  if ((changes & 3) == 1) channel.return_number = (last + 1) % 16;
  if ((changes & 3) == 2) channel.return_number = (last + 15) % 16;
  if ((changes & 3) != 3) return;
  channel.return_number = channel.has_new_time ? symbol_of(channel.return_numbers[last], xy_)
                                               : (last + xy_.symbol(channel.return_step) + 2) % 16;
}

void LayeredPoint::decode_position(Channel& channel) {
  const std::uint32_t number = channel.return_number, count = channel.return_count;
  const auto returns = static_cast<std::size_t>(layered_return_contexts[count][number] - '0');
  const std::size_t context = 2 * returns + (channel.has_new_time ? 1 : 0);
  const std::size_t level = std::min(7U, number > count ? number - count : count - number);
  const std::uint32_t is_single = count == 1 ? 1 : 0;
  std::array<std::int32_t, 3>& p = channel.position;

  const std::int32_t dx = channel.x.next(xy_, channel.median_x[context].get(), is_single);
  p[0] = wrapping_sum(p[0], dx);
  channel.median_x[context].add(dx);

  const std::int32_t dy = channel.y.next(xy_, channel.median_y[context].get(),
                                         is_single + size_context(channel.x.last_bits(), 20));
  p[1] = wrapping_sum(p[1], dy);
  channel.median_y[context].add(dy);

  if (!z_) return;
  const std::uint32_t bits = (channel.x.last_bits() + channel.y.last_bits()) / 2;
  p[2] = channel.z.next(*z_, channel.heights[level], is_single + size_context(bits, 18));
  channel.heights[level] = p[2];
}

void LayeredPoint::decode_class(Channel& channel) {
  const bool is_single = channel.return_number == 1 && channel.return_number >= channel.return_count;
  const std::size_t context = 2 * (channel.classification & 31U) + (is_single ? 1 : 0);
  if (classes_) channel.classification = symbol_of(channel.classes[context], *classes_, 256);
  if (flags_) channel.flags = symbol_of(channel.flag_sets[channel.flags], *flags_, 64);
}

// In version 3, a point's colour belongs to scanner 0, unless the scanner changes at this point. If the
// previous colour belongs to another scanner, and the new scanner already has colours, the stored difference
// is from the previous scanner's last colour, which the decoded colour then replaces.
void LayeredPoint::decode_colour(bool changes_scanner) {
  const std::size_t scanner = are_colours_mixed_ && !changes_scanner ? 0 : channel_;
  LazColour* last = &colour_channels_[colour_channel_]->last;
  if (colour_channel_ != scanner) {
    auto& channel = colour_channels_[scanner];
    const bool is_new = !channel;
    if (is_new) channel = std::make_unique<ColourChannel>(ColourChannel{*last, {}});
    if (is_new || !are_colours_mixed_) last = &channel->last;
    colour_channel_ = scanner;
  }
  if (colours_) colour_channels_[scanner]->models.next(*colours_, *last);
  colour_ = *last;
}

void LayeredPoint::next() {
  const std::uint32_t changes = decode_changes();
  Channel& channel = *channels_[channel_];
  decode_returns(channel, changes);
  decode_position(channel);
  decode_class(channel);
  if (colour_channels_[colour_channel_]) decode_colour((changes & changes_scanner_bit) != 0);
}

}  // namespace relievo::io
