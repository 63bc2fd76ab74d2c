#include <algorithm>
#include <cmath>
#include <limits>

#include "quality/model_picture.h"
#include "relief/baselines/scaled.h"
#include "relievo/core/parallel.h"
#include "relievo/relief/baselines.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

// The depths as an image: the histogram bin and the weight of each pixel. Background pixels have weight 0.
struct DepthPicture {
  Image<int> bin;
  Image<float> weight;
};

struct Depths {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  int bins;

  Depths(const Surface& surface, int bins_) : bins(bins_) {
    for (const Vec3& p : surface.points) lowest = std::min(lowest, p.z()), highest = std::max(highest, p.z());
  }
  // Returns a depth in units of bins, from 0 to less than the number of bins.
  double place(double z) const {
    const double span = std::max(highest - lowest, 1e-300);
    return std::clamp((z - lowest) / span * bins, 0.0, std::nextafter(static_cast<double>(bins), 0.0));
  }
};

DepthPicture draw(const Surface& surface, const BarycentricMap& grid, const Depths& depths,
                  const EqualiseOptions& options) {
  DepthPicture picture{filled_image(grid.width(), grid.height(), 0),
                       filled_image(grid.width(), grid.height(), 0.F)};
  const double a = options.gradient_gain;
  parallel_for(grid.pixels(), [&](std::size_t i) {
    const Index t = grid.triangle(i);
    if (t == no_index || !surface.boundary.is_inside[t]) return;
    const auto z = grid.at(
        i, [&](Index p) { return static_cast<float>(surface.points[p].z()); }, 0);
    const auto g = grid.at(
        i, [&](Index p) { return static_cast<float>(slope_of(surface.normals[p]).norm()); }, 0);
    picture.bin[i] = static_cast<int>(depths.place(static_cast<double>(z)));
    picture.weight[i] = static_cast<float>(std::log1p(a * static_cast<double>(g)) / a);
  });
  return picture;
}

using Histogram = std::vector<double>;

Histogram histogram_around(const DepthPicture& picture, int column, int row, int window, int bins) {
  Histogram counts(static_cast<std::size_t>(bins));
  const int half = window / 2;
  for (int y = std::max(0, row - half); y < std::min(picture.bin.height, row + half); ++y)
    for (int x = std::max(0, column - half); x < std::min(picture.bin.width, column + half); ++x)
      counts[static_cast<std::size_t>(picture.bin.at(x, y))] += static_cast<double>(picture.weight.at(x, y));
  return counts;
}

// Turns counts into the equalising curve. It clips the bins at the limit, distributes the excess evenly over
// all bins, and integrates. The curve has the values at the upper ends of the bins, in [0, 1]. If all counts
// are 0, the curve is the identity.
void equalise(Histogram& counts, double clip) {
  const auto bins = static_cast<double>(counts.size());
  double total = 0, cut = 0;
  for (const double c : counts) total += c;
  const double limit = clip * total / bins;
  for (double& c : counts) cut += std::max(0.0, c - limit), c = std::min(c, limit);
  double sum = 0;
  for (double& c : counts) c = sum += total > 0 ? (c + cut / bins) / total : 1 / bins;
}

// Equalising curves for the windows around the nodes of a lattice, interpolated between nodes.
class CurveLattice {
 public:
  CurveLattice(const DepthPicture& picture, int window, const EqualiseOptions& options)
      : step_(std::max(1, window / 4)),
        curves_(filled_image(picture.bin.width / step_ + 2, picture.bin.height / step_ + 2, Histogram())) {
    parallel_for(
        curves_.size(),
        [&](std::size_t node) {
          const int column = static_cast<int>(node) % curves_.width,
                    row = static_cast<int>(node) / curves_.width;
          curves_[node] = histogram_around(picture, column * step_, row * step_, window, options.bins);
          equalise(curves_[node], options.clip);
        },
        1);
  }

  // Returns the equalised value of a depth, given in bins, at a position in the picture.
  double at(const Vec2& pixel, double depth) const {
    const double x = pixel.x() / step_, y = pixel.y() / step_;
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const double u = x - column, v = y - row;
    return (1 - v) * ((1 - u) * value(column, row, depth) + u * value(column + 1, row, depth)) +
           v * ((1 - u) * value(column, row + 1, depth) + u * value(column + 1, row + 1, depth));
  }

 private:
  double value(int column, int row, double depth) const {
    const Histogram& curve = curves_.at(column, row);
    const auto bin = static_cast<std::size_t>(depth);
    const double from = bin > 0 ? curve[bin - 1] : 0;
    return from + (depth - static_cast<double>(bin)) * (curve[bin] - from);
  }

  int step_;
  Image<Histogram> curves_;
};

}  // namespace

std::vector<double> equalised_heights(const Surface& surface, const EqualiseOptions& options) {
  std::vector<double> z(surface.points.size(), 0.0);
  const BarycentricMap grid(surface.points, surface.triangulation, options.picture_px, 0);
  if (grid.pixels() == 0) return z;
  const Depths depths(surface, options.bins);
  const DepthPicture picture = draw(surface, grid, depths, options);
  for (int level = 0; level < options.windows; ++level) {
    const CurveLattice lattice(picture, std::max(4, options.largest_window_px >> level), options);
    parallel_for(z.size(), [&](std::size_t i) {
      z[i] += lattice.at(grid.to_pixels(surface.points[i]), depths.place(surface.points[i].z()));
    });
  }
  return z;
}

Relief equalised_relief(const Surface& surface, double height, const EqualiseOptions& options) {
  return scaled_relief(equalised_heights(surface, options), surface, height);
}

Relief equalised_relief(const ReliefModel& model, double height) {
  return equalised_relief(model.surface(), height);
}

}  // namespace relievo
