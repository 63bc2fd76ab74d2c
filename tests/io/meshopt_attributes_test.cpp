// Tests attributes in both versions of meshopt's compression. The encoders do not depend on the decoder.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>
#include <random>

#include "io/gltf/meshopt.h"
#include "support/meshopt_encoder.h"

namespace relievo {
namespace {

using namespace io;

// Returns the four bytes by which version 1 stores the difference of two numbers, in a channel of mode `mode`.
std::array<char, 4> channel_difference(unsigned mode, std::uint32_t before, std::uint32_t now) {
  std::uint32_t stored = std::rotr(before ^ now, static_cast<int>(mode >> 4));
  if (mode < 2) {
    stored = 0;
    const unsigned bits = mode == 0 ? 8 : 16;
    for (unsigned shift = 0; shift < 32; shift += bits) {
      const std::uint32_t all = (1U << bits) - 1, change = ((now >> shift) - (before >> shift)) & all;
      stored |= ((change >> (bits - 1) != 0 ? ~(change << 1) : change << 1) & all) << shift;
    }
  }
  std::array<char, 4> bytes;
  std::memcpy(bytes.data(), &stored, 4);
  return bytes;
}

// Returns the elements as version 1 compresses them. `modes` contains the mode of each channel of four
// bytes. The columns of bytes use all suitable encodings, one after the other.
std::string compressed_attributes_1(const std::string& elements, std::size_t stride,
                                    const std::string& modes) {
  const std::size_t count = elements.size() / stride, block = block_of(stride);
  const auto number_at = [&](std::size_t i, std::size_t byte) {
    std::uint32_t number = 0;
    std::memcpy(&number, elements.data() + i * stride + byte, 4);
    return number;
  };
  std::string out = "\xA1";
  for (std::size_t first = 0, turn = 0; first < count; first += block) {
    std::string controls(stride / 4, '\0'), columns;
    for (std::size_t channel = 0; channel < stride / 4; ++channel) {
      std::array<std::string, 4> differences;
      for (std::size_t i = first; i < std::min(first + block, count); ++i) {
        const auto bytes =
            channel_difference(static_cast<unsigned char>(modes[channel]),
                               number_at(i == 0 ? 0 : i - 1, 4 * channel), number_at(i, 4 * channel));
        for (std::size_t b = 0; b < 4; ++b) differences[b] += bytes[b];
      }
      for (std::size_t b = 0; b < 4; ++b, ++turn) {
        const bool is_zero = differences[b].find_first_not_of('\0') == std::string::npos;
        const unsigned control = is_zero && turn % 4 != 3 ? 2 : std::array{0U, 1U, 3U}[turn % 3];
        controls[channel] = static_cast<char>(static_cast<unsigned>(controls[channel]) | control << 2 * b);
        if (control == 3) columns += differences[b];
        if (control < 2) columns += packed_column(differences[b], control == 0 ? narrow_widths : wide_widths);
      }
    }
    out += controls + columns;
  }
  const std::size_t tail = stride + stride / 4;
  return out + std::string(std::max<std::size_t>(tail, 24) - tail, '\0') + elements.substr(0, stride) + modes;
}

TEST(MeshoptAttributes, DecodesTheExampleOfTheSpecification) {
  // The group has the differences of the first byte of sixteen four-byte elements, with 4 bits each. Two
  // differences do not fit into 4 bits; 0xf stands for them, and they follow as the last two bytes. The
  // other three bytes of the elements do not change.
  const std::string group = bytes_of({0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0x00, 0x34, 0xb5});
  const std::string stream =
      "\xA0" + bytes_of({2}) + group + bytes_of({0, 0, 0}) + std::string(28, '\0') + bytes_of({100, 1, 2, 3});
  std::string expected;
  int value = 100;
  for (const int difference : {-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0})
    expected += bytes_of({value += difference, 1, 2, 3});
  EXPECT_EQ(text_of(decode_meshopt(stream, {.count = 16, .stride = 4})), expected);
}

// Returns random elements. Each byte differs by less than `range` from the same byte of the previous element.
std::string random_elements(std::mt19937& random, std::size_t bytes, std::size_t stride, unsigned range) {
  std::string elements;
  for (std::size_t i = 0; i < bytes; ++i)
    elements +=
        static_cast<char>((i < stride ? 0 : elements[i - stride]) + static_cast<int>(random() % range));
  return elements;
}

TEST(MeshoptAttributes, DecodesAttributesOfAllSizes) {
  std::mt19937 random(1);
  for (const std::size_t stride : {4U, 8U, 12U, 16U, 64U, 256U})
    for (const std::size_t count : {1U, 15U, 16U, 17U, 64U, 200U, 255U, 256U, 257U, 1000U})
      for (const unsigned range : {1, 2, 5, 256}) {  // differences of bytes are less than `range`
        const std::string elements = random_elements(random, count * stride, stride, range);
        const std::string stream = compressed_attributes(elements, stride);
        const MeshoptLayout layout{.count = count, .stride = stride};
        ASSERT_EQ(text_of(decode_meshopt(stream, layout)), elements)
            << stride << " " << count << " " << range;
        EXPECT_FALSE(decode_meshopt(stream + '\0', layout));
        EXPECT_FALSE(decode_meshopt(stream.substr(0, stream.size() - 1), layout));
      }
}

TEST(MeshoptAttributes, DecodesVersion1InAllItsWays) {
  std::mt19937 random(3);
  for (const std::size_t stride : {4U, 12U, 16U, 256U})
    for (const std::size_t count : {1U, 16U, 17U, 255U, 257U, 1000U})
      for (const unsigned range : {1, 3, 256}) {
        const std::string elements = random_elements(random, count * stride, stride, range);
        std::string modes;
        for (std::size_t i = 0; i < stride / 4; ++i)
          modes += std::array{'\x00', '\x01', '\x02', '\x52', '\xF2'}[random() % 5];
        const std::string stream = compressed_attributes_1(elements, stride, modes);
        const MeshoptLayout layout{.count = count, .stride = stride};
        ASSERT_EQ(text_of(decode_meshopt(stream, layout)), elements)
            << stride << " " << count << " " << range;
        EXPECT_FALSE(decode_meshopt(stream.substr(0, stream.size() - 1), layout));
      }
}

TEST(MeshoptAttributes, RefusesModesThatAreNone) {
  const MeshoptLayout layout{.count = 16, .stride = 4};
  const std::string stream = compressed_attributes_1(std::string(64, '\1'), 4, std::string(1, '\0'));
  EXPECT_TRUE(decode_meshopt(stream, layout));
  for (const char mode : {'\x03', '\x10', '\x21', '\x0F'})
    EXPECT_FALSE(decode_meshopt(stream.substr(0, stream.size() - 1) + mode, layout));
}

// In version 1, a block of four-byte elements takes only one byte if all its differences are 0. A block has
// at most 256 elements.
TEST(MeshoptAttributes, TakesNoMoreMemoryThanItsBytesStandFor) {
  const std::string stream = "\xA1" + std::string(1000, '\xAA') + std::string(24, '\0');
  EXPECT_EQ(text_of(decode_meshopt(stream, {.count = 256'000, .stride = 4})), std::string(1'024'000, '\0'));
  EXPECT_FALSE(decode_meshopt(stream, {.count = 256'001, .stride = 4}));
  EXPECT_FALSE(decode_meshopt(stream, {.count = std::numeric_limits<std::size_t>::max() / 8, .stride = 4}))
      << "takes no memory";
}

}  // namespace
}  // namespace relievo
