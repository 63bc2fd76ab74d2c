#include "quality/image_filters.h"

#include <algorithm>
#include <cmath>

namespace relievo {

GaussianFilter::GaussianFilter(double sigma, int radius) : weights_(static_cast<std::size_t>(radius) + 1) {
  double sum = 0;
  for (int d = -radius; d <= radius; ++d) sum += std::exp(-d * d / (2 * sigma * sigma));
  for (int d = 0; d <= radius; ++d)
    weights_[static_cast<std::size_t>(d)] = static_cast<float>(std::exp(-d * d / (2 * sigma * sigma)) / sum);
}

void GaussianFilter::apply(Image<float>& image) const {
  const int width = image.width, height = image.height, radius = static_cast<int>(weights_.size()) - 1;
  const auto row_of = [&](Image<float>& from, int row) {
    return &from.at(0, std::clamp(row, 0, height - 1));
  };
  Image<float> down = filled_image(width, height, 0.F);
  for (int row = 0; row < height; ++row) {
    float* const to = row_of(down, row);
    for (int x = 0; x < width; ++x) to[x] = weights_[0] * row_of(image, row)[x];
    for (int d = 1; d <= radius; ++d) {
      const float *const above = row_of(image, row - d), *const below = row_of(image, row + d);
      for (int x = 0; x < width; ++x) to[x] += weights_[static_cast<std::size_t>(d)] * (above[x] + below[x]);
    }
  }
  std::vector<float> line(static_cast<std::size_t>(width + 2 * radius));
  for (int row = 0; row < height; ++row) {
    const float* const from = row_of(down, row);
    for (int x = -radius; x < width + radius; ++x) line[x + radius] = from[std::clamp(x, 0, width - 1)];
    float* const to = row_of(image, row);
    const float* const middle = line.data() + radius;
    for (int x = 0; x < width; ++x) to[x] = weights_[0] * middle[x];
    for (int d = 1; d <= radius; ++d)
      for (int x = 0; x < width; ++x)
        to[x] += weights_[static_cast<std::size_t>(d)] * (middle[x - d] + middle[x + d]);
  }
}

Image8 dilated(const Image8& mask, int radius) {
  const int width = mask.width, height = mask.height;
  Image8 across = filled_image(width, height, std::uint8_t{0}), out = across;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int other = std::max(0, x - radius); other <= std::min(width - 1, x + radius); ++other)
        across.at(x, y) |= mask.at(other, y);
  for (int y = 0; y < height; ++y)
    for (int other = std::max(0, y - radius); other <= std::min(height - 1, y + radius); ++other)
      for (int x = 0; x < width; ++x) out.at(x, y) |= across.at(x, other);
  return out;
}

}  // namespace relievo
