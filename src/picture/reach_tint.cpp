#include "picture/shading.h"

#include <cmath>

namespace relievo {
namespace {

const Vec3f little_left(1, .4F, .05F), much_left(.6F, .01F, .01F);  // linear colours
constexpr float tint_strength = .85F;                               // the rest is the material's colour

float luminance(const Vec3f& colour) {
  return .21F * colour.x() + .72F * colour.y() + .07F * colour.z();
}

}  // namespace

ReachTint::ReachTint(std::shared_ptr<const ToolReach> reach, const Box& front) : reach_(std::move(reach)) {
  if (reach_ && reach_->residual_mm.empty()) reach_.reset();
  if (!reach_) return;
  const Image<float>& samples = reach_->residual_mm;
  const Vec2 half = reach_->mm_per_sample * Vec2(samples.width, samples.height) / 2;
  const Vec2 middle = front.centre().head<2>();
  corner_ = Vec2(middle.x() - half.x(), middle.y() + half.y()).cast<float>();
}

Vec3f ReachTint::operator()(const Vec3f& colour, const Vec3f& place) const {
  if (!reach_) return colour;
  const auto step = static_cast<float>(reach_->mm_per_sample);
  const int x = static_cast<int>(std::floor((place.x() - corner_.x()) / step));
  const int y = static_cast<int>(std::floor((corner_.y() - place.y()) / step));
  const Image<float>& samples = reach_->residual_mm;
  if (x < 0 || y < 0 || x >= samples.width || y >= samples.height) return colour;
  const float left = samples.at(x, y);
  if (!(static_cast<double>(left) > reach_->tolerance_mm)) return colour;
  const float share = std::sqrt(left / static_cast<float>(reach_->largest_residual_mm));
  const Vec3f tint = (.4F + luminance(colour)) * (little_left + share * (much_left - little_left));
  return colour + tint_strength * (tint - colour);
}

}  // namespace relievo
