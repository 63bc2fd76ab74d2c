#include "io/las/point_layers.h"

#include "io/numbers.h"

namespace relievo::io {
namespace {

// The context of a point's models, by the number of returns of its pulse (row) and the return's number
// (column). Similar returns share a context.
constexpr std::array<std::string_view, 16> layered_return_contexts = {
    "0123453445555555", "1013333333333333", "2124444444433333", "3345444444444444",
    "4344544444444444", "5344454444444444", "3344445444444444", "4344444544444444",
    "4344444454444444", "5344444445444444", "5344444444544444", "5334444444455444",
    "5334444444455544", "5334444444445554", "5334444444444555", "5334444444444455"};

constexpr std::uint32_t changes_scanner_bit = 64;  // set in `changes` if the scanner differs

std::uint32_t symbol_of(std::optional<SymbolModel>& model, ArithmeticDecoder& decoder) {
  if (!model) model.emplace(16);
  return decoder.symbol(*model);
}

}  // namespace

LayeredPoint::LayeredPoint(const PointLayers& layers, const char* first, const char* colour)
    : xy_(layers.xy),
      are_colours_mixed_(layers.are_colours_mixed),
      channel_(little<std::uint8_t>(first + 15) >> 4 & 3) {
  if (!layers.z.empty()) z_.emplace(layers.z);
  if (!layers.colours.empty()) colours_.emplace(layers.colours);
  auto start = std::make_unique<Channel>();
  for (std::size_t i = 0; i < 3; ++i) start->position[i] = little<std::int32_t>(first + 4 * i);
  start->return_number = little<std::uint8_t>(first + 14) & 15;
  start->return_count = little<std::uint8_t>(first + 14) >> 4;
  start->heights.fill(start->position[2]);
  channels_[channel_] = std::move(start);
  if (!colour) return;
  for (std::size_t c = 0; c < 3; ++c) colour_[c] = little<std::uint16_t>(colour + 2 * c);
  colour_channel_ = channel_;
  colour_channels_[channel_] = std::make_unique<ColourChannel>(ColourChannel{colour_, {}});
}

// Decodes the changes relative to the previous point, and switches to the point's scanner.
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

// Writers of version 3 store a point's colour under scanner 0 unless the scanner changes with this point.
// When they switch back to a scanner that already had colours, they store the difference to the previous
// scanner's last colour, which is then replaced.
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
  if (colour_channels_[colour_channel_]) decode_colour((changes & changes_scanner_bit) != 0);
}

}  // namespace relievo::io
