#include "io/texture.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "io/numbers.h"
#include "relievo/io/read.h"

namespace relievo::io {

std::optional<Texture> Texture::read(std::string_view bytes, std::string_view name) {
  Texture texture;
  float highest = 0;
  for (int c = 0; c < 3; ++c) {
    auto image = read_depth_image(std::as_bytes(std::span(bytes)), name, {.channel = c + 1});
    if (!image && c == 0) return std::nullopt;
    Image<float>& channel = texture.channels_[static_cast<std::size_t>(c)];
    channel = image ? std::move(image->values) : texture.channels_[0];  // a grey picture has one channel
    for (const float value : channel.pixels) highest = std::max(highest, value);
  }
  if (highest <= 255) return texture;
  for (Image<float>& channel : texture.channels_)
    for (float& value : channel.pixels) value /= 257;  // from 16 bits to 8 bits
  return texture;
}

Colour Texture::at(double u, double v) const {
  const int width = channels_[0].width, height = channels_[0].height;
  if (!std::isfinite(u) || !std::isfinite(v)) return {};
  const double x = (u - std::floor(u)) * width - .5, y = (v - std::floor(v)) * height - .5;
  const double left = std::floor(x), top = std::floor(y);
  const auto wrapped = [](double at, int size) { return (static_cast<int>(at) + size) % size; };
  Colour colour = {};
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0;
    for (const double i : {0., 1.})
      for (const double k : {0., 1.}) {
        const double weight = (i == 0 ? left + 1 - x : x - left) * (k == 0 ? top + 1 - y : y - top);
        const Image<float>& image = channels_[c];
        sum += weight * image.pixels[image.index(wrapped(left + i, width), wrapped(top + k, height))];
      }
    colour[c] = as_byte(sum);
  }
  return colour;
}

}  // namespace relievo::io
