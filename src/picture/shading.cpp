#include "picture/shading.h"

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

float smooth_step(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.F, 1.F);
  return t * t * (3 - 2 * t);
}

Vec3f mix(const Vec3f& a, const Vec3f& b, float t) {
  return a + t * (b - a);
}

// x^(2^doublings)
float sharpen(float x, int doublings) {
  for (; doublings > 0; --doublings) x *= x;
  return x;
}

// What tells one metal from another.
struct Metal {
  Vec3f colour, tarnish;  // where it is open, and in hollows
  float diffuse, window;  // strengths
  float glint;
  int glint_doublings;  // more is a smaller glint
};

const Metal& metal_of(Material material) {
  static const Metal silver{{.93F, .93F, .92F}, {.20F, .20F, .22F}, .62F, .42F, .50F, 4};
  static const Metal bronze{{.80F, .52F, .26F}, {.13F, .10F, .06F}, .66F, .36F, .42F, 4};
  return material == Material::silver ? silver : bronze;
}

// Values in [0, 1] at the corners of a square grid that repeats, smooth in between.
float smooth_noise(float x, float y) {
  const auto corner = [](int i, int j) {
    auto h = static_cast<std::uint32_t>(i) * 0x9E3779B1U ^ static_cast<std::uint32_t>(j) * 0x85EBCA77U;
    h = (h ^ h >> 15) * 0x2C1B3C6DU;
    return static_cast<float>((h ^ h >> 13) & 0xFFFFU) / 65535.F;
  };
  const float fx = std::floor(x), fy = std::floor(y);
  const int i = static_cast<int>(fx), j = static_cast<int>(fy);
  const float s = smooth_step(0, 1, x - fx), t = smooth_step(0, 1, y - fy);
  const float low = corner(i, j) + s * (corner(i + 1, j) - corner(i, j));
  const float high = corner(i, j + 1) + s * (corner(i + 1, j + 1) - corner(i, j + 1));
  return low + t * (high - low);
}

}  // namespace

Shader::Shader(Material material, const Vec3f& to_lamp, const Vec3f& to_viewer)
    : material_(material),
      to_lamp_(to_lamp),
      to_sky_(Vec3f(-.35F * to_lamp.x(), -.2F * to_lamp.y(), .9F).normalized()),
      halfway_((to_lamp + to_viewer).normalized()),
      exposure_(std::clamp(std::sqrt(.577F / std::max(.05F, to_lamp.z())), .9F, 1.5F)),
      to_window_(Vec3f(to_lamp.x() - .25F, to_lamp.y() + .1F, .55F).normalized()) {}

Vec3f Shader::colour(const Lit& lit) const {
  const float lamp = std::max(0.F, lit.normal.dot(to_lamp_)) * lit.light.lamp;
  const float sky = (.5F + .5F * lit.normal.dot(to_sky_)) * lit.light.sky;
  switch (material_) {
    case Material::plaster:
      return Vec3f(.93F, .91F, .87F) * (.77F * exposure_ * lamp + .23F * sky);
    case Material::porcelain:
      return mix(Vec3f(1, .965F, .89F), Vec3f(.62F, .33F, .16F), lit.height) * std::exp(-1.45F * lit.height) *
             (.96F + .04F * lamp);
    case Material::walnut:
      return wood(lit);
    default:
      return metal(lit);
  }
}

Vec3f Shader::metal(const Lit& lit) const {
  const Metal& m = metal_of(material_);
  const float lamp = std::max(0.F, lit.normal.dot(to_lamp_)) * lit.light.lamp;
  const float sky = (.5F + .5F * lit.normal.dot(to_sky_)) * lit.light.sky;
  const float glint = sharpen(std::max(0.F, lit.normal.dot(halfway_)), m.glint_doublings) * lit.light.lamp;
  const float window = smooth_step(.55F, 1.F, lit.normal.dot(to_window_)) * lit.light.sky;
  const Vec3f body = mix(m.tarnish, m.colour, lit.light.sky * lit.light.sky);
  const Vec3f shine = mix(m.colour, Vec3f::Ones(), .35F);
  return body * (m.diffuse * exposure_ * lamp + .10F * sky + m.window * window * lamp) +
         shine * (m.glint * glint * glint);
}

// Grain runs upright and bends a little; as growth rings lie slantwise in the board, carving deeper moves
// them aside.
Vec3f Shader::wood(const Lit& lit) const {
  const float x = lit.place.x() + 1.6F * lit.place.z(), y = lit.place.y();
  const float bend = 4 * smooth_noise(x * .03F + 7, y * .012F) + .5F * smooth_noise(x * .11F, y * .03F);
  const float ring = x * .3F + bend, phase = ring - std::floor(ring);
  const float late = phase * phase * (1 - smooth_step(.88F, 1, phase));
  const float fibre = smooth_noise(x * 6.F, y * .35F), pore = smooth_noise(x * 11.F, y * .9F + 40);
  const Vec3f grain = mix(Vec3f(.46F, .29F, .18F), Vec3f(.27F, .155F, .09F), .6F * late + .4F * fibre) *
                      (pore > .86F ? .85F : 1.F);
  const float lamp = std::max(0.F, lit.normal.dot(to_lamp_)) * lit.light.lamp;
  const float sky = (.5F + .5F * lit.normal.dot(to_sky_)) * lit.light.sky;
  const float glint = sharpen(std::max(0.F, lit.normal.dot(halfway_)), 4) * lit.light.lamp;
  return grain * (exposure_ * lamp + .28F * sky) + Vec3f(1, .93F, .82F) * (.05F * glint);
}

DisplayTable::DisplayTable() : levels_(static_cast<std::size_t>(brightest * steps) + 2) {
  const float display_gamma = 1.45F, knee = .85F, rest = 1 - knee;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    float linear = static_cast<float>(i) / steps;
    // Highlights lose their contrast little by little.
    if (linear > knee) linear = knee + rest * (1 - std::exp((knee - linear) / rest));
    levels_[i] = static_cast<std::uint8_t>(std::pow(linear, 1 / display_gamma) * 255 + .5F);
  }
}

const DisplayTable& display_table() {
  static const DisplayTable table;
  return table;
}

}  // namespace relievo
