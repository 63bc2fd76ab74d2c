#include "io/gltf/gltf.h"

#include <array>
#include <cmath>
#include <optional>

#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// Returns number `i` of the array `name`; `otherwise` if it is missing.
double number_at_index(const Json& object, const char* name, std::size_t i, double otherwise) {
  const auto found = object.find(name);
  const bool is_there =
      found != object.end() && found->is_array() && i < found->size() && (*found)[i].is_number();
  return is_there ? (*found)[i].get<double>() : otherwise;
}

const Json* base_texture(const Json& material) {
  const Json* pbr = object_in(material, "pbrMetallicRoughness");
  return pbr ? object_in(*pbr, "baseColorTexture") : nullptr;
}

// Returns the position in the picture for texture coordinates, after applying KHR_texture_transform.
std::array<double, 2> transformed(const Json& use, double u, double v) {
  const Json* extensions = object_in(use, "extensions");
  const Json* by = extensions ? object_in(*extensions, "KHR_texture_transform") : nullptr;
  if (!by) return {u, v};
  const double turn = by->contains("rotation") && (*by)["rotation"].is_number()
                          ? (*by)["rotation"].get<double>()
                          : 0,
               scaled_u = u * number_at_index(*by, "scale", 0, 1),
               scaled_v = v * number_at_index(*by, "scale", 1, 1);
  return {std::cos(turn) * scaled_u + std::sin(turn) * scaled_v + number_at_index(*by, "offset", 0, 0),
          std::cos(turn) * scaled_v - std::sin(turn) * scaled_u + number_at_index(*by, "offset", 1, 0)};
}

}  // namespace

GltfTextures::GltfTextures(GltfFile& file) : file_(file) {
  for (std::size_t i = 0; const Json* material = file.element("materials", i); ++i)
    if (const Json* use = base_texture(*material))
      read_texture(number_in(*use, "index", no_index).value_or(no_index));
}

void GltfTextures::read_texture(std::size_t number) {
  const Json* json = file_.element("textures", number);
  if (!json || textures_.contains(number)) return;
  const std::size_t image = number_in(*json, "source", no_index).value_or(no_index);
  const auto bytes = file_.image(image);
  const auto texture = bytes ? Texture::read(*bytes, cat("image ", image)) : std::nullopt;
  if (texture)
    textures_.emplace(number, *texture);
  else
    remarks_.push_back(cat("left out texture ", number,
                           bytes ? ", whose format is not read; save it as PNG" : ", which cannot be read"));
}

std::vector<Colour> GltfTextures::colours(const Json& primitive, const Json& attributes,
                                          std::size_t count) const {
  const Json* material =
      file_.element("materials", number_in(primitive, "material", no_index).value_or(no_index));
  const Json* pbr = material ? object_in(*material, "pbrMetallicRoughness") : nullptr;
  const auto factor = [&](std::size_t c) { return pbr ? number_at_index(*pbr, "baseColorFactor", c, 1) : 1; };
  const auto scaled = [&](const Colour& colour) {
    return Colour{as_byte(factor(0) * colour[0]), as_byte(factor(1) * colour[1]),
                  as_byte(factor(2) * colour[2])};
  };
  std::vector<Colour> colours(count, scaled({255, 255, 255}));
  const Json* use = material ? base_texture(*material) : nullptr;
  const auto texture = textures_.find(use ? number_in(*use, "index", no_index).value_or(no_index) : no_index);
  if (texture == textures_.end()) return colours;
  const std::string name = cat("TEXCOORD_", number_in(*use, "texCoord", 0).value_or(0));
  const auto places = file_.accessor(number_in(attributes, name.c_str(), no_index).value_or(no_index), name);
  if (!places || places->components != 2 || places->count() != count) return colours;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [u, v] = transformed(*use, places->numbers[2 * i], places->numbers[2 * i + 1]);
    colours[i] = scaled(texture->second.at(u, v));
  }
  return colours;
}

}  // namespace relievo::io
