// Defines rectangular grids of values: pictures, height maps and masks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relievo {

// Values are row-major, with the first row at the top. A pixel has `channels` values: 1 (grey, a height, a
// mask), 3 (red, green, blue) or 4 (red, green, blue and opacity; colours are not premultiplied).
template <typename T>
struct Image {
  int width = 0, height = 0, channels = 1;
  std::vector<T> pixels;

  bool empty() const { return pixels.empty(); }

  // The number of elements of `pixels`, and access to them in their order: row by row, with the channels of a
  // pixel next to each other.
  std::size_t size() const { return pixels.size(); }
  T& operator[](std::size_t i) { return pixels[i]; }
  const T& operator[](std::size_t i) const { return pixels[i]; }

  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }

  // Returns the index in `pixels` of the pixel's first value.
  std::size_t index(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels);
  }

  // Return the pixel's first value; x and y must be inside the image.
  T& at(int x, int y) { return pixels[index(x, y)]; }
  const T& at(int x, int y) const { return pixels[index(x, y)]; }

  // Sets the size; no side may be negative. The values are unspecified afterwards. Reuses allocated memory.
  void resize(int new_width, int new_height, int new_channels = 1) {
    width = new_width;
    height = new_height;
    channels = new_channels;
    pixels.resize(index(0, new_height));
  }
};
using Image8 = Image<std::uint8_t>;
using Image16 = Image<std::uint16_t>;

// Returns an image with all values equal.
template <typename T>
Image<T> filled_image(int width, int height, const T& value, int channels = 1) {
  Image<T> image{width, height, channels, {}};
  image.pixels.assign(image.index(0, height), value);
  return image;
}

}  // namespace relievo
