// The raised style: forms need not rise from the base at the silhouette, the figure stands off it by a step.
//
// Heights that equation (9) finds are linear in the slopes, and a relief's slopes nearly so in the layers of
// the normals: the height fields of the layers are found once, with a free rim; what a relief adds to their
// sum is left to the ordinary system. So a change of height is a frame here, too.
#pragma once

#include "height_tails.h"
#include "relievo/surface.h"
#include "relievo/weights.h"

namespace relievo {

// A point's height for each of its layers kept in full, and for `depth` what the ranks of the depths give.
struct LayerHeights {
  float fine = 0, middle = 0, coarse = 0, depth = 0;
};

// All per point; 0 at boundary points.
struct RaisedLayers {
  std::vector<LayerHeights> heights;
  std::vector<float> fade;  // of the layers towards the silhouette, where slopes are steep and show little

  std::size_t memory() const { return heights.size() * (sizeof(LayerHeights) + sizeof(float)); }
};

// Returns the heights of every layer, for a relief of middling height: with the highest and lowest tenth of
// its coarse form held back, so that the others get more of a height. Flat if the surface has no area. Takes
// about as long as HeightSystem::build().
RaisedLayers raised_layers(const Surface& surface);

// What a raised relief has of the layers: `kept` in its slopes, of which the `linear` part comes from their
// heights.
struct RaisedWeights {
  LayerWeights kept, linear;

  // `mean` is mean_share().
  static RaisedWeights of(const Shape& shape, double mean);

  float height(const LayerHeights& z) const {
    return linear.fine * z.fine + linear.middle * z.middle + linear.coarse * z.coarse +
           linear.depth * z.depth;
  }

  // The slope that is left to the ordinary system. `share` is what saturation or tone curve leave, `fade`
  // that of RaisedLayers.
  template <typename Real>
  Eigen::Vector2<Real> rest(const PointLayers& layers, Real share, Real fade, Real max_slope) const {
    const Vec2f sum =
        linear.fine * layers.fine + linear.middle * layers.middle + linear.coarse * layers.coarse;
    return layered_slope(layers, kept, share * fade, max_slope) - fade * sum.cast<Real>();
  }
};

// What saturation or tone curve leave of a slope, by the formula; frames have a table.
class SaturationShare {
 public:
  SaturationShare(double delta, const Compression& compression)
      : delta_(delta), scale_(saturation_scale(compression)), alone_(saturation_alone(compression)) {}

  double operator()(float k) const {
    return scale_ * curvature_weight(static_cast<double>(k), delta_, alone_);
  }

 private:
  double delta_, scale_;
  Compression alone_;
};

// The mean of what saturation or tone curve leave of the slopes; `share_of` tells it for a curvature. 1 where
// they leave all.
template <typename Share>
double mean_share(const Compression& compression, std::span<const float> k, Share&& share_of) {
  if ((compression.beta == 0 && !compression.curve) || k.empty()) return 1;
  const double sum = parallel_reduce(
      k.size(), 0.0,
      [&](std::size_t begin, std::size_t end) {
        double part = 0;
        for (std::size_t i = begin; i < end; ++i) part += static_cast<double>(share_of(k[i]));
        return part;
      },
      [](double all, double part) { return all + part; });
  return sum / static_cast<double>(k.size());
}

// What a raised relief ends with: the ends of its heights rounded off, the lowest of them on the base, the
// step at the silhouette bevelled.
template <typename Real>
class Bevel {
 public:
  // Both spans must outlive it; boundary points, which come to 0, do not count.
  Bevel(std::span<const Real> heights, const Boundary& boundary, std::span<const float> boundary_weight)
      : is_boundary_(boundary.is_boundary),
        boundary_weight_(boundary_weight),
        tails_(heights, {.share = .005, .flattest = .3, .keeps_base = false, .left_out = is_boundary_}),
        lowest_(tails_(tails_.lowest())) {}

  // The height of point i, which was z.
  Real operator()(std::size_t i, Real z) const {
    return is_boundary_[i] ? 0 : static_cast<Real>(boundary_weight_[i]) * (tails_(z) - lowest_);
  }

 private:
  std::span<const std::uint8_t> is_boundary_;
  std::span<const float> boundary_weight_;
  HeightTails<Real> tails_;
  Real lowest_;
};

}  // namespace relievo
