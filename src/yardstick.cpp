#include "yardstick.h"

#include "relievo/core/parallel.h"
#include "relievo/detail.h"
#include "relievo/relief/gradient_slopes.h"
#include "slope_input.h"

namespace relievo {
namespace {

constexpr std::size_t least_pixels = 100;

}  // namespace

Yardstick::Yardstick(const Surface& surface, const Membrane& membrane, const HeightSystem& system)
    : surface_(surface),
      membrane_(membrane),
      system_(system),
      judge_(surface),
      boundary_weight_(
          boundary_weights(surface.boundary.distance, boundary_rho(surface, layered_shape().boundary_width))),
      compressed_(solved(gradient_slopes(surface))),
      compressed_span_(height_span(compressed_)) {}

bool Yardstick::is_of_use() const {
  return judge_.pixels() >= least_pixels && compressed_span_ > 0;
}

std::vector<double> Yardstick::solved(std::span<const Vec2> slopes) const {
  std::vector<Vec2f> single(slopes.size());
  parallel_for(slopes.size(), [&](std::size_t i) { single[i] = slopes[i].cast<float>(); });
  std::vector<float> heights(slopes.size());
  HeightSystem::Workspace workspace = system_.make_workspace();
  system_.solve(single, heights, workspace);
  return {heights.begin(), heights.end()};
}

std::vector<double> Yardstick::heights(double u, const Hold& hold) const {
  Shape shape = layered_shape();
  shape.compression.u = u;
  shape.hold = hold;
  std::vector<Vec2> slopes(surface_.points.size());
  layered_slopes(slope_input(surface_, boundary_weight_), shape, slopes);
  return solved(slopes);
}

Kept Yardstick::lacking(std::vector<double> relief, const Hold& hold) const {
  std::vector<double> compressed = compressed_;
  const double height = hold.share * height_span(relief);
  Membrane::Workspace workspace = membrane_.make_workspace();
  membrane_.hold<double>({relief, boundary_weight_, Membrane::Limits::of(height, hold)}, workspace);
  for (double& z : compressed) z *= height / compressed_span_;
  const Kept theirs = judge_.kept_by_whole(compressed), ours = judge_.kept_by_whole(relief);
  return {theirs.detail - ours.detail, theirs.order - ours.order};
}

}  // namespace relievo
