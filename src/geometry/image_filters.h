// Filters images: dilates them by a shape, and blurs them.
#pragma once

#include <vector>

#include "relievo/core/image.h"

namespace relievo {

// The heights of a shape at integer offsets of samples. The shape is symmetric in x and y.
class Profile {
 public:
  // Calls height(x, y) for 0 <= x, y <= reach. The height must be infinite outside the shape, and must not
  // decrease with increasing x or y.
  template <typename F>
  Profile(int reach, F&& height) : reach_(reach) {
    for (int y = 0; y <= reach; ++y)
      for (int x = 0; x <= reach; ++x) heights_.push_back(height(x, y));
  }

  int reach() const { return reach_; }
  float at(int x, int y) const { return heights_[static_cast<std::size_t>(y * (reach_ + 1) + x)]; }

 private:
  int reach_;
  std::vector<float> heights_;
};

// Returns, for every sample p, the maximum over q of value(q) - profile(p - q); NaN counts as -infinity. The
// result has `border` more samples than the image on each side, or fewer if `border` is negative. It is
// exact, because only values that cannot be the maximum are skipped. It has the same bits for any number of
// threads.
Image<float> dilate(const Image<float>& image, const Profile& profile, int border);

// Replaces each value of a single-channel image by an average of its neighbourhood. Averages twice along the
// rows and twice along the columns, each time over a box of 2 * radius + 1 pixels. Outside the image the
// border's pixels are repeated. The time does not depend on the radius.
void blur(Image<float>& image, int radius);

}  // namespace relievo
