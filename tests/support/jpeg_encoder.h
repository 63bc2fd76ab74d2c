// Writes JPEG files of squares of 8 x 8 pixels with one colour each, without a library. All pixels are known
// without computing the transform.
#pragma once

#include <string>
#include <vector>

namespace relievo {

struct JpegSquares {
  int columns = 1, rows = 1;  // numbers of squares
  int channels = 1;           // 1: grey; 3: luminance, blue and red difference
  std::vector<std::vector<int>>
      squares;  // per square: its channels, from -128 to 127; grey is the level minus 128
  bool is_progressive = false;
  std::string segments = {};  // inserted after the first two bytes
};

namespace jpeg {

inline std::string big_endian_16(std::size_t number) {
  return {static_cast<char>(number >> 8), static_cast<char>(number)};
}

inline std::string segment(unsigned char marker, const std::string& data) {
  return std::string{'\xFF', static_cast<char>(marker)} + big_endian_16(data.size() + 2) + data;
}

// Collects bits, the highest first, and inserts a 0 after each byte 255.
class Bits {
 public:
  void put(unsigned value, int count) {
    while (count-- > 0) {
      byte_ = byte_ << 1 | (value >> count & 1);
      if (++size_ % 8 == 0) end_byte();
    }
  }
  std::string finished() {
    while (size_ % 8 != 0) put(1, 1);
    return bytes_;
  }

 private:
  void end_byte() {
    bytes_ += static_cast<char>(byte_);
    if ((byte_ & 255) == 255) bytes_ += '\0';
  }
  std::string bytes_;
  unsigned byte_ = 0;
  int size_ = 0;
};

// Returns the quantisation and Huffman tables. The Huffman tables have 4-bit codes for the numbers of
// bits from 0 to 9, and a 1-bit code for the end of a square.
inline std::string tables() {
  const std::string eights(64, '\x08');  // divides by 8, as the coefficient is 8 times the mean
  std::string dc("\0\0\0\0\x0A", 5), ac("\x10\1", 2);
  dc += std::string(12, '\0');
  for (char bits = 0; bits < 10; ++bits) dc += bits;
  ac += std::string(15, '\0') + '\0';
  return segment(0xDB, '\0' + eights) + segment(0xC4, dc) + segment(0xC4, ac);
}

// Writes the difference from the last square. First comes the number of its bits, then the bits themselves.
inline void put_difference(Bits& bits, int difference) {
  int count = 0;
  for (int left = difference < 0 ? -difference : difference; left > 0; left /= 2) ++count;
  bits.put(static_cast<unsigned>(count), 4);
  bits.put(static_cast<unsigned>(difference < 0 ? difference + (1 << count) - 1 : difference), count);
}

}  // namespace jpeg

inline std::string jpeg_of(const JpegSquares& picture) {
  using namespace jpeg;
  std::string frame = '\x08' + big_endian_16(8 * static_cast<std::size_t>(picture.rows)) +
                      big_endian_16(8 * static_cast<std::size_t>(picture.columns)) +
                      static_cast<char>(picture.channels);
  std::string scan(1, static_cast<char>(picture.channels));
  for (int c = 1; c <= picture.channels; ++c) {
    frame += {static_cast<char>(c), '\x11', '\0'};
    scan += {static_cast<char>(c), '\0'};
  }
  scan += {'\0', picture.is_progressive ? '\0' : '\x3F', '\0'};
  Bits bits;
  std::vector<int> last(static_cast<std::size_t>(picture.channels));
  for (const std::vector<int>& square : picture.squares)
    for (std::size_t c = 0; c < last.size(); ++c) {
      put_difference(bits, square[c] - last[c]);
      if (!picture.is_progressive) bits.put(0, 1);
      last[c] = square[c];
    }
  return "\xFF\xD8" + picture.segments + tables() + segment(picture.is_progressive ? 0xC2 : 0xC0, frame) +
         segment(0xDA, scan) + bits.finished() + "\xFF\xD9";
}

}  // namespace relievo
