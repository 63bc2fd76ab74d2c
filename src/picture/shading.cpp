#include "picture/shading.h"

#include <cmath>

namespace relievo {
namespace {

// Strengths of lamp and sky. Their sum is 1, so a surface that faces both has the brightness of its material, and no
// value is clipped. With less sky light, shadows would lose their detail; with more, the relief would look flat.
constexpr float lamp_strength = .77F, sky_strength = .23F;

// The direction of the brightest sky. It is above, and slightly away from the lamp, so that slopes that face
// away from the lamp get some shading, too.
constexpr float sky_away_x = .35F, sky_away_y = .2F, sky_up = .9F;

// For a raking lamp the exposure is raised, as in photography. It is 1 if the cosine of the angle between the
// lamp's direction and the plate's normal is `usual_lamp_z`. A lamp with this cosine is equally far to the
// left of the plate, above it and in front of it.
constexpr float usual_lamp_z = .577F;
constexpr float least_exposure = .9F, most_exposure = 1.5F;

// The exponent for the conversion to display values is between 1 (linear) and 2.2 (sRGB). Most of a relief
// has middle tones, which an exponent of 2.2 would make flat and pale.
constexpr float display_gamma = 1.45F;

// Brightness above this value is compressed gradually, because clipping would be visible.
constexpr float knee = .85F;

const Vec3f plaster_colour(.93F, .91F, .87F);

// Colours of light that has passed thin and thick porcelain. Thick porcelain transmits exp(-1.45),
// about a quarter of the light, as in lithophanes.
const Vec3f thin_porcelain(1, .965F, .89F), thick_porcelain(.62F, .33F, .16F);
constexpr float porcelain_absorption = 1.45F;

const Vec3f early_wood(.46F, .29F, .18F), late_wood(.27F, .155F, .09F), varnish(1, .93F, .82F),
    deep_stain(.42F, .36F, .32F);

float smooth_step(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.F, 1.F);
  return t * t * (3 - 2 * t);
}

Vec3f mix(const Vec3f& a, const Vec3f& b, float t) {
  return a + t * (b - a);
}

// The environment that metal and varnish reflect. It has a soft box around the lamp, and a lower and dimmer reflector
// on the other side. Its walls are bright above and dark below, and the room beside the plate is dark. The brightness
// of box and reflector rises from 0 at the cosine `edge` to its full value at the cosine `full`. All values were chosen
// by eye; silver was compared with a photograph of coins.
constexpr float box_edge = .42F, box_full = .97F, box_light = 1.F;
constexpr float reflector_edge = .72F, reflector_full = .99F, reflector_light = .42F;
constexpr float dark_wall = .05F, bright_wall = .36F, darkest_side = .35F;

// The viewer's distance, in units of half the body's longer side. Because the distance is finite, different
// parts of level ground reflect different parts of the room, so the ground does not have a uniform tone.
constexpr float viewer_distance = 3.6F;

struct Metal {
  Vec3f bare, worn;       // colours of the bare metal and of polished edges
  Vec3f patina;           // colour in hollows
  float diffuse, mirror;  // strengths of diffuse and of mirror reflection
  float mottle;           // variation of the patina
};

const Metal& metal_of(Material material) {
  static const Metal silver{{.90F, .90F, .89F}, {1, .99F, .96F}, {.105F, .105F, .12F}, .34F, .70F, .06F};
  static const Metal bronze{{.60F, .36F, .17F}, {1, .72F, .42F}, {.075F, .070F, .045F}, .46F, .74F, .16F};
  return material == Material::silver ? silver : bronze;
}

// Returns value noise: random values in [0, 1] at the corners of a square grid, interpolated smoothly. If
// `period` is positive, the values repeat after `period` cells.
float smooth_noise(float x, float y, int period = 0) {
  const auto corner = [period](int i, int j) {
    if (period > 0) i %= period, j %= period;
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

// Tabulates patches of patina, in [-0.75, 0.75]. They are noise with scales of 3 mm and half a millimetre.
// The noise repeats after 64 mm. Its grids are rotated, because the eye notices horizontal and vertical
// grids. The table is used because computing the noise would take half of a picture's time.
class Patches {
 public:
  Patches() : values_(static_cast<std::size_t>(side) * side) {
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const float u = static_cast<float>(x) / side, v = static_cast<float>(y) / side;
        values_[static_cast<std::size_t>(y * side + x)] =
            slanted_noise(u, v, {4, 2, 5}) + .5F * slanted_noise(u, v, {4, 3, 24}) - .75F;
      }
  }

  float at(float x_mm, float y_mm) const {
    constexpr float before = 1 << 16;  // keeps values positive, so that casts round down
    const float x = x_mm * per_mm + before, y = y_mm * per_mm + before;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const float s = x - static_cast<float>(i), t = y - static_cast<float>(j);
    const float low = value(i, j) + s * (value(i + 1, j) - value(i, j));
    const float high = value(i, j + 1) + s * (value(i + 1, j + 1) - value(i, j + 1));
    return low + t * (high - low);
  }

 private:
  // A rotated grid of noise. One side of the table is the vector `period` * (right, up), in cells of the grid.
  struct Slant {
    float right, up;
    int period;
  };

  static float slanted_noise(float u, float v, const Slant& slant) {
    const auto period = static_cast<float>(slant.period);
    return smooth_noise(period * (slant.right * u + slant.up * v),
                        period * (slant.right * v + slant.up * (1 - u)), slant.period);
  }

  float value(int i, int j) const {
    return values_[static_cast<std::size_t>(j & (side - 1)) * side +
                   static_cast<std::size_t>(i & (side - 1))];
  }

  static constexpr int side = 512;  // a power of 2
  static constexpr float per_mm = 8;
  std::vector<float> values_;
};

const Patches& patches() {
  static const Patches table;
  return table;
}

// Returns the light from a direction of the room. Both directions are unit vectors.
float light_from(const Vec3f& direction, const Vec3f& to_lamp) {
  const Vec3f to_reflector = Vec3f(-.8F * to_lamp.x(), -.45F * to_lamp.y() - .1F, .55F).normalized();
  const float up = smooth_step(-.8F, 1.F, direction.y() - .35F * direction.x());
  const float walls = dark_wall + (bright_wall - dark_wall) * up;
  const float side = darkest_side + (1 - darkest_side) * smooth_step(-.1F, .75F, direction.z());
  return side * walls + box_light * smooth_step(box_edge, box_full, direction.dot(to_lamp)) +
         reflector_light * smooth_step(reflector_edge, reflector_full, direction.dot(to_reflector));
}

}  // namespace

Vec3f direction_of(const Vec3f& light) {
  return light.stableNormalized();
}

EnvironmentLight::EnvironmentLight(const Vec3f& to_lamp) {
  light_.reserve((cells + 1) * (cells + 1));
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) {
      Vec2f flat(static_cast<float>(column), static_cast<float>(row));
      flat = 2 * flat / cells - Vec2f::Ones();
      const float length = flat.norm();
      if (length > 1) flat /= length;
      const Vec3f direction(flat.x(), flat.y(), std::sqrt(std::max(0.F, 1 - flat.squaredNorm())));
      light_.push_back(light_from(direction, to_lamp));
    }
}

float EnvironmentLight::operator()(const Vec2f& direction) const {
  if (light_.empty()) return 0;
  const auto place = [](float x) { return std::clamp((x + 1) * (cells / 2.F), 0.F, cells - 1e-3F); };
  const float x = place(direction.x()), y = place(direction.y());
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const float s = x - static_cast<float>(column), t = y - static_cast<float>(row);
  const float* const at = &light_[static_cast<std::size_t>(row * (cells + 1) + column)];
  const float low = at[0] + s * (at[1] - at[0]);
  const float high = at[cells + 1] + s * (at[cells + 2] - at[cells + 1]);
  return low + t * (high - low);
}

Shader::Shader(Material material, const Vec3f& to_lamp, const Vec3f& to_viewer)
    : material_(material),
      to_lamp_(to_lamp),
      to_viewer_(to_viewer),
      to_sky_(Vec3f(-sky_away_x * to_lamp.x(), -sky_away_y * to_lamp.y(), sky_up).normalized()),
      exposure_(
          std::clamp(std::sqrt(usual_lamp_z / std::max(.05F, to_lamp.z())), least_exposure, most_exposure)),
      environment_(material == Material::plaster ? EnvironmentLight() : EnvironmentLight(to_lamp)) {}

// Returns the light of lamp and sky that falls on the point `lit`, reduced according to the point's normal
// and shadows.
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
      return porcelain(lit);
    case Material::walnut:
      return wood(lit);
    default:
      return metal(lit);
  }
}

// Returns the room's light that the point `lit` reflects towards the viewer.
float Shader::mirrored_light(const Lit& lit) const {
  const Vec2f to_viewer = to_viewer_.head<2>() - lit.from_middle / viewer_distance;
  const float cosine = lit.normal.head<2>().dot(to_viewer) + lit.normal.z() * to_viewer_.z();
  return environment_(2 * cosine * lit.normal.head<2>() - to_viewer);
}

// Patina covers hollows and low ground in patches; the raised parts have been polished by hands.
Vec3f Shader::metal(const Lit& lit) const {
  const Metal& m = metal_of(material_);
  const Light light = facing(lit);
  const float patch = patches().at(lit.place.x(), lit.place.y());
  const float open = lit.light.sky * lit.light.sky * (1 + m.mottle * patch);
  const float polished = smooth_step(.45F, 1, lit.height) * lit.light.sky;
  const float clean = std::min(1.F, open);
  const Vec3f colour = mix(m.patina, mix(m.bare, m.worn, polished), clean);
  const float mirror =
      m.mirror * clean * (.75F + .25F * polished) * mirrored_light(lit) * (.35F + .65F * lit.light.lamp);
  return colour * (exposure_ * (m.diffuse * light.lamp + mirror) + .12F * light.sky);
}

// The grain runs vertically and bends slightly. Growth rings are slanted in the board, so that they shift
// sideways with the depth of the carving. Rings are 3.3 mm apart, and bend over lengths of about 30 and 80
// mm. The noise of fibres and pores is ten to twenty times as long as wide. All values were chosen by eye.
Vec3f Shader::wood(const Lit& lit) const {
  const float x = lit.place.x() + 1.6F * lit.place.z(), y = lit.place.y();
  const float bend = 4 * smooth_noise(x * .03F + 7, y * .012F) + .5F * smooth_noise(x * .11F, y * .03F);
  const float ring = x * .3F + bend, phase = ring - std::floor(ring);
  const float late = phase * phase * (1 - smooth_step(.88F, 1, phase));
  const float fibre = smooth_noise(x * 6.F, y * .35F), pore = smooth_noise(x * 11.F, y * .9F + 40);
  const Vec3f grain = mix(early_wood, late_wood, .6F * late + .4F * fibre) * (pore > .86F ? .85F : 1.F);
  const Light light = facing(lit);
  const float stain = lit.light.sky * lit.light.sky;
  const float oil = .085F * stain * mirrored_light(lit) * lit.light.lamp;
  const Vec3f tone = mix(grain.cwiseProduct(deep_stain), grain * (1 + .12F * lit.height), stain);
  return exposure_ * (tone * (1.02F * light.lamp + .30F * light.sky) + varnish * oil);
}

// The lamp is behind the middle, and its light falls off towards the edge. The glaze reflects some of the
// environment.
Vec3f Shader::porcelain(const Lit& lit) const {
  const float behind = 1 - .22F * lit.from_middle.squaredNorm();
  const float glaze = .035F * mirrored_light(lit);
  return mix(thin_porcelain, thick_porcelain, lit.height) *
             (behind * std::exp(-porcelain_absorption * lit.height) * (.96F + .04F * facing(lit).lamp)) +
         Vec3f::Constant(glaze);
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
