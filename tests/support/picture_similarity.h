// Computes the similarity of two pictures: the structural similarity of their luminance, by Wang, Bovik,
// Sheikh and Simoncelli (2004), with its usual constants. It is the mean over those windows in which at
// least one of the pictures has details.
#pragma once

#include <array>
#include <cmath>

#include "relievo/core/image.h"

namespace relievo::test {

namespace similarity {

constexpr int reach = 5;
constexpr double sigma = 1.5, c1 = 6.5025, c2 = 58.5225;  // c1 = (.01 * 255)^2, c2 = (.03 * 255)^2

inline Image<double> luminance(const Image8& picture) {
  Image<double> grey;
  grey.resize(picture.width, picture.height);
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const std::uint8_t* rgba = &picture.pixels[4 * i];
    const double opacity = rgba[3] / 255.0;
    grey[i] = opacity * (.2126 * rgba[0] + .7152 * rgba[1] + .0722 * rgba[2]) + (1 - opacity) * 255;
  }
  return grey;
}

// Returns Gaussian means of the image a. If b is given, returns Gaussian means of the products of
// the values of a and b.
inline Image<double> means(const Image<double>& a, const Image<double>* b) {
  std::array<double, 2 * reach + 1> kernel;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i)
    sum += kernel[static_cast<std::size_t>(i + reach)] = std::exp(-i * i / (2 * sigma * sigma));
  Image<double> product = a, along = a, mean = a;
  if (b)
    for (std::size_t i = 0; i < product.size(); ++i) product[i] *= (*b)[i];
  const auto blur = [&](const Image<double>& from, Image<double>& to, int dx, int dy) {
    for (int y = reach; y < from.height - reach; ++y)
      for (int x = reach; x < from.width - reach; ++x) {
        double value = 0;
        for (int i = -reach; i <= reach; ++i)
          value += kernel[static_cast<std::size_t>(i + reach)] * from.at(x + i * dx, y + i * dy);
        to.at(x, y) = value / sum;
      }
  };
  blur(product, along, 1, 0);
  blur(along, mean, 0, 1);
  return mean;
}

}  // namespace similarity

// Returns the similarity of two pictures, which must have the same size and four channels.
inline double structural_similarity(const Image8& one, const Image8& other) {
  using namespace similarity;
  const Image<double> a = luminance(one), b = luminance(other);
  const Image<double> ma = means(a, nullptr), mb = means(b, nullptr), aa = means(a, &a), bb = means(b, &b),
                      ab = means(a, &b);
  double sum = 0, count = 0;
  for (int y = 2 * reach; y < a.height - 2 * reach; ++y)
    for (int x = 2 * reach; x < a.width - 2 * reach; ++x) {
      const double ua = ma.at(x, y), ub = mb.at(x, y), va = aa.at(x, y) - ua * ua, vb = bb.at(x, y) - ub * ub;
      constexpr double level = .25;  // below this variance, a window has no details
      if (va < level && vb < level) continue;
      sum += (2 * ua * ub + c1) * (2 * (ab.at(x, y) - ua * ub) + c2) /
             ((ua * ua + ub * ub + c1) * (va + vb + c2));
      ++count;
    }
  return count > 0 ? sum / count : 1;
}

}  // namespace relievo::test
