#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>

#include "io/gltf/meshopt.h"

namespace relievo::io {
namespace {

constexpr std::size_t group_size = 16;  // number of elements whose differences have the same width
constexpr std::size_t channel_size = 4, most_stride = 256, most_in_block = 256;
constexpr unsigned char version_0 = 0xA0, version_1 = 0xA1;
constexpr std::size_t least_tail_0 = 32, least_tail_1 = 24;

// The number of bits per difference, for each of the four codes that a group may have.
using Widths = std::array<unsigned, 4>;
constexpr Widths widths_0 = {0, 2, 4, 8}, narrow_widths = {0, 1, 2, 4}, wide_widths = {1, 2, 4, 8};

// A two-bit code of version 1. It says how the differences at one byte position of a block are stored.
enum class Control : std::uint8_t { narrow, wide, all_zero, literal };

using Group = std::array<std::uint8_t, group_size>;

// Reads the differences of a group. If all bits of a stored difference are set, the actual difference follows
// in a separate byte.
Group next_differences(MeshoptBytes& from, unsigned bits) {
  Group differences{};
  if (bits == 0) return differences;
  const unsigned in_byte = 8 / bits, escape = (1U << bits) - 1;
  for (std::size_t i = 0; i < group_size; i += in_byte) {
    const unsigned packed = from.next();
    for (unsigned j = 0; j < in_byte; ++j) {
      const unsigned shift = bits == 1 ? j : 8 - bits * (j + 1);
      differences[i + j] = static_cast<std::uint8_t>(packed >> shift & escape);
    }
  }
  if (bits == 8) return differences;
  for (std::uint8_t& difference : differences)
    if (difference == escape) difference = from.next();
  return differences;
}

// The differences at one byte position, for all elements of a block.
using Column = std::array<std::uint8_t, most_in_block>;

void read_groups(MeshoptBytes& from, std::size_t elements, const Widths& widths, Column& to) {
  const std::size_t groups = (elements + group_size - 1) / group_size;
  std::array<std::uint8_t, 4> codes{};  // codes for up to 16 groups, two bits each
  for (std::size_t i = 0; i < (groups + 3) / 4; ++i) codes[i] = from.next();
  for (std::size_t group = 0; group < groups; ++group) {
    const Group differences = next_differences(from, widths[codes[group / 4] >> 2 * (group % 4) & 3U]);
    std::ranges::copy(differences, to.begin() + static_cast<std::ptrdiff_t>(group * group_size));
  }
}

void read_column(MeshoptBytes& from, std::size_t elements, Control control, Column& to) {
  if (control == Control::narrow) return read_groups(from, elements, narrow_widths, to);
  if (control == Control::wide) return read_groups(from, elements, wide_widths, to);
  to.fill(0);
  if (control == Control::all_zero) return;
  for (std::size_t i = 0; i < elements; ++i) to[i] = from.next();
}

// Four bytes of an element as a little-endian number.
using ChannelBytes = std::array<std::uint8_t, channel_size>;

std::uint32_t number_of(const ChannelBytes& bytes) {
  return bytes[0] | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 |
         std::uint32_t{bytes[3]} << 24;
}

// Computes a channel of the next element from the same channel of the previous element. In mode 0,
// `differences` are four differences of bytes. In mode 1 they are two differences of 16-bit words. In other
// modes they are bits to flip, after a rotation to the left by the mode's upper four bits.
void step(std::uint8_t mode, const ChannelBytes& differences, ChannelBytes& last) {
  if (mode == 0) {
    for (std::size_t i = 0; i < channel_size; ++i)
      last[i] = static_cast<std::uint8_t>(last[i] + without_zigzag(differences[i]));
    return;
  }
  const std::uint32_t difference = number_of(differences), before = number_of(last);
  std::uint32_t now = before ^ std::rotl(difference, mode >> 4);
  if (mode == 1) {
    const auto word = [&](unsigned shift) {
      const auto change = without_zigzag(static_cast<std::uint16_t>(difference >> shift));
      return std::uint32_t{static_cast<std::uint16_t>((before >> shift) + change)} << shift;
    };
    now = word(0) | word(16);
  }
  for (std::size_t i = 0; i < channel_size; ++i) last[i] = static_cast<std::uint8_t>(now >> 8 * i);
}

// A stream of attributes: a header, blocks of elements, and a tail. The tail contains the element from which
// the differences of the first one are counted and, in version 1, the mode of each channel.
class Attributes {
 public:
  // Returns nothing if the header or a mode is not in the specification, or if the tail is truncated.
  static std::optional<Attributes> open(std::string_view stream, std::size_t stride) {
    if (stream.empty() || stride == 0 || stride % channel_size != 0 || stride > most_stride)
      return std::nullopt;
    const auto header = static_cast<unsigned char>(stream[0]);
    const bool has_modes = header == version_1;
    const std::size_t own_tail = stride + (has_modes ? stride / channel_size : 0);
    const std::size_t tail = std::max(own_tail, has_modes ? least_tail_1 : least_tail_0);
    if ((!has_modes && header != version_0) || stream.size() < 1 + tail) return std::nullopt;
    Attributes it(stream.substr(1, stream.size() - 1 - tail), stride, has_modes);
    const char* const last = stream.data() + stream.size() - own_tail;
    std::memcpy(it.last_.data(), last, stride);
    std::memcpy(it.modes_.data(), last + stride, own_tail - stride);
    const bool are_known =
        std::ranges::all_of(it.modes_, [](unsigned mode) { return mode < 2 || mode % 16 == 2; });
    return are_known ? std::optional(it) : std::nullopt;
  }

  std::optional<std::vector<std::byte>> decode(std::size_t count) {
    const std::size_t block = std::min(8192 / stride_ / group_size * group_size, most_in_block);
    const std::size_t least_size = has_modes_ ? stride_ / channel_size : stride_;  // least size of a block
    // Checks the sizes before allocating memory. On 32-bit systems the product could overflow.
    if (count / block > body_size_ / least_size || count > std::numeric_limits<std::size_t>::max() / stride_)
      return std::nullopt;
    std::vector<std::byte> decoded(count * stride_);
    for (std::size_t first = 0; first < count && !from_.is_beyond(); first += block)
      decode_block(std::min(block, count - first), decoded.data() + first * stride_);
    return from_.is_at_end() ? std::optional(std::move(decoded)) : std::nullopt;
  }

 private:
  Attributes(std::string_view body, std::size_t stride, bool has_modes)
      : from_(body), body_size_(body.size()), stride_(stride), has_modes_(has_modes) {}

  void decode_block(std::size_t elements, std::byte* to) {
    std::array<std::uint8_t, most_stride / channel_size> controls{};
    for (std::size_t i = 0; has_modes_ && i < stride_ / channel_size; ++i) controls[i] = from_.next();
    std::array<Column, channel_size> columns;
    for (std::size_t channel = 0; channel < stride_ / channel_size; ++channel) {
      for (std::size_t i = 0; i < channel_size; ++i) {
        const auto control = static_cast<Control>(controls[channel] >> 2 * i & 3U);
        has_modes_ ? read_column(from_, elements, control, columns[i])
                   : read_groups(from_, elements, widths_0, columns[i]);
      }
      add_up(columns, elements, channel, to);
    }
  }

  void add_up(const std::array<Column, channel_size>& columns, std::size_t elements, std::size_t channel,
              std::byte* to) {
    ChannelBytes last;
    std::uint8_t* const kept = last_.data() + channel * channel_size;
    std::copy_n(kept, channel_size, last.begin());
    for (std::size_t i = 0; i < elements; ++i) {
      step(modes_[channel], {columns[0][i], columns[1][i], columns[2][i], columns[3][i]}, last);
      std::memcpy(to + i * stride_ + channel * channel_size, last.data(), channel_size);
    }
    std::ranges::copy(last, kept);
  }

  MeshoptBytes from_;
  std::size_t body_size_, stride_;
  bool has_modes_;                                // true in version 1 of the stream
  std::array<std::uint8_t, most_stride> last_{};  // the previous element
  std::array<std::uint8_t, most_stride / channel_size> modes_{};
};

}  // namespace

std::optional<std::vector<std::byte>> decode_meshopt_attributes(std::string_view stream, std::size_t count,
                                                                std::size_t stride) {
  auto attributes = Attributes::open(stream, stride);
  return attributes ? attributes->decode(count) : std::nullopt;
}

}  // namespace relievo::io
