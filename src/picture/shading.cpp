#include "picture/shading.h"

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

// Strengths of lamp and sky. Together they are 1, so that a place that faces both is as bright as its material
// and nothing is clipped; with less sky the shadows' form is lost, with more the relief looks flat.
constexpr float lamp_strength = .77F, sky_strength = .23F;

// The brightest sky is above, and a little on the side away from the lamp: slopes that are turned away from it
// keep their form.
constexpr float sky_away_x = .35F, sky_away_y = .2F, sky_up = .9F;

// A raking lamp is turned up, as a photographer would do it. At this cosine of the angle between lamp and normal,
// that of a lamp as far to the left and above as in front, the exposure is 1.
constexpr float usual_lamp_z = .577F;
constexpr float least_exposure = .9F, most_exposure = 1.5F;

// Between sRGB's 2.2 and linear: most of a relief lies in the middle tones, which 2.2 makes flat and pale.
constexpr float display_gamma = 1.45F;

// Highlights above this lose their contrast little by little instead of being clipped.
constexpr float knee = .85F;

const Vec3f plaster_colour(.93F, .91F, .87F);

// Light that passes through thin porcelain and thick: exp(-1.45) is about a quarter, as in lithophanes.
const Vec3f thin_porcelain(1, .965F, .89F), thick_porcelain(.62F, .33F, .16F);
constexpr float porcelain_absorption = 1.45F;

const Vec3f early_wood(.46F, .29F, .18F), late_wood(.27F, .155F, .09F), varnish(1, .93F, .82F);

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

// Metal mirrors the lamp in small glints, the (2^doublings)th power of a cosine, and a window beside the lamp in
// broad, soft-edged patches that open at this cosine. The shine is a mixture of the metal's colour and white.
constexpr int glint_doublings = 4;
constexpr float window_right = -.25F, window_up = .1F, window_front = .55F;
constexpr float window_edge = .55F;
constexpr float whiteness_of_shine = .35F;
constexpr float sky_on_metal = .10F;

// The properties by which metals differ.
struct Metal {
  Vec3f colour, tarnish;         // where it is open, and in hollows
  float diffuse, window, glint;  // strengths
};

const Metal& metal_of(Material material) {
  static const Metal silver{{.93F, .93F, .92F}, {.20F, .20F, .22F}, .62F, .42F, .50F};
  static const Metal bronze{{.80F, .52F, .26F}, {.13F, .10F, .06F}, .66F, .36F, .42F};
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

Vec3f direction_of(const Vec3f& light) {
  return light.stableNormalized();
}

Shader::Shader(Material material, const Vec3f& to_lamp, const Vec3f& to_viewer)
    : material_(material),
      to_lamp_(to_lamp),
      to_sky_(Vec3f(-sky_away_x * to_lamp.x(), -sky_away_y * to_lamp.y(), sky_up).normalized()),
      halfway_((to_lamp + to_viewer).stableNormalized()),
      exposure_(
          std::clamp(std::sqrt(usual_lamp_z / std::max(.05F, to_lamp.z())), least_exposure, most_exposure)),
      to_window_(Vec3f(to_lamp.x() + window_right, to_lamp.y() + window_up, window_front).normalized()) {}

// The light that a place gets, by where it faces and by what hides lamp and sky from it.
Light Shader::facing(const Lit& lit) const {
  return {std::max(0.F, lit.normal.dot(to_lamp_)) * lit.light.lamp,
          (.5F + .5F * lit.normal.dot(to_sky_)) * lit.light.sky};
}

Vec3f Shader::colour(const Lit& lit) const {
  switch (material_) {
    case Material::plaster: {
      const Light light = facing(lit);
      return plaster_colour * (lamp_strength * exposure_ * light.lamp + sky_strength * light.sky);
    }
    case Material::porcelain:
      return mix(thin_porcelain, thick_porcelain, lit.height) * std::exp(-porcelain_absorption * lit.height) *
             (.96F + .04F * facing(lit).lamp);
    case Material::walnut:
      return wood(lit);
    default:
      return metal(lit);
  }
}

Vec3f Shader::metal(const Lit& lit) const {
  const Metal& m = metal_of(material_);
  const Light light = facing(lit);
  const float glint = sharpen(std::max(0.F, lit.normal.dot(halfway_)), glint_doublings) * lit.light.lamp;
  const float window = smooth_step(window_edge, 1.F, lit.normal.dot(to_window_)) * lit.light.sky;
  const Vec3f body = mix(m.tarnish, m.colour, lit.light.sky * lit.light.sky);
  const Vec3f shine = mix(m.colour, Vec3f::Ones(), whiteness_of_shine);
  return body * (m.diffuse * exposure_ * light.lamp + sky_on_metal * light.sky +
                 m.window * window * light.lamp) +
         shine * (m.glint * glint * glint);
}

// The grain runs upright and bends a little; as growth rings lie slantwise in the board, carving deeper moves
// them aside. Lengths are in millimetres: rings are 3.3 mm apart, bend over some 30 and 80 mm, and the noise of
// fibres and pores is ten to twenty times as long as wide. All were chosen by eye.
Vec3f Shader::wood(const Lit& lit) const {
  const float x = lit.place.x() + 1.6F * lit.place.z(), y = lit.place.y();
  const float bend = 4 * smooth_noise(x * .03F + 7, y * .012F) + .5F * smooth_noise(x * .11F, y * .03F);
  const float ring = x * .3F + bend, phase = ring - std::floor(ring);
  const float late = phase * phase * (1 - smooth_step(.88F, 1, phase));
  const float fibre = smooth_noise(x * 6.F, y * .35F), pore = smooth_noise(x * 11.F, y * .9F + 40);
  const Vec3f grain = mix(early_wood, late_wood, .6F * late + .4F * fibre) * (pore > .86F ? .85F : 1.F);
  const Light light = facing(lit);
  const float glint = sharpen(std::max(0.F, lit.normal.dot(halfway_)), glint_doublings) * lit.light.lamp;
  return grain * (exposure_ * light.lamp + .28F * light.sky) + varnish * (.05F * glint);
}

DisplayTable::DisplayTable() : levels_(static_cast<std::size_t>(brightest * steps) + 2) {
  const float rest = 1 - knee;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    float linear = static_cast<float>(i) / steps;
    if (linear > knee) linear = knee + rest * (1 - std::exp((knee - linear) / rest));
    levels_[i] = static_cast<std::uint8_t>(std::pow(linear, 1 / display_gamma) * 255 + .5F);
  }
}

const DisplayTable& display_table() {
  static const DisplayTable table;
  return table;
}

}  // namespace relievo
