#include "io/obj_textures.h"

#include <algorithm>
#include <map>
#include <optional>

#include "io/texture.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// Returns a file in the folder of the OBJ; nothing if the file cannot be read or is not in that folder.
std::optional<std::string> file_beside(const Source& source, std::string name) {
  std::ranges::replace(name, '\\', '/');
  if (!source.beside || name.empty() || name.starts_with('/') || name.contains("..") || name.contains(':'))
    return std::nullopt;
  const auto bytes = (*source.beside)(name);
  if (!bytes) return std::nullopt;
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

// Returns the file name in a map_Kd line. Options with their numbers may precede the name.
std::string picture_name(std::string_view line) {
  if (!line.starts_with('-')) return std::string(line);
  return std::string(line.substr(line.find_last_of(" \t") + 1));
}

// Returns the names of the textures by material.
std::map<std::string, std::string> pictures_in(std::string_view library) {
  std::map<std::string, std::string> pictures;
  std::string material;
  Lines lines(library);
  while (const auto line = lines.next()) {
    const std::string_view text = trim(before_comment(*line));
    const std::string_view keyword = Words(text).next(), rest = trim(text.substr(keyword.size()));
    if (keyword == "newmtl") material = rest;
    if (keyword == "map_Kd") pictures[material] = picture_name(rest);
  }
  return pictures;
}

std::optional<Texture> read_texture(const Source& source, const std::string& name, RawCloud& raw) {
  const auto bytes = file_beside(source, name);
  auto texture = bytes ? Texture::read(*bytes, name) : std::nullopt;
  if (!texture)
    raw.remarks.push_back(
        cat("left out the texture ", in_quotes(name),
            bytes ? ", whose format is not read; save it as PNG" : ", which is not beside it"));
  return texture;
}

}  // namespace

std::optional<Index> resolve_obj_index(std::string_view word, std::size_t defined) {
  std::int64_t index = parse_integer(word).value_or(0);
  if (index < 0) index += static_cast<std::int64_t>(defined) + 1;
  if (index <= 0 || index >= no_index) return std::nullopt;
  return static_cast<Index>(index - 1);
}

void ObjTextures::take_coordinates(Words& words) {
  const double u = parse_number(words.next()).value_or(0), v = parse_number(words.next()).value_or(0);
  coordinates_.push_back({static_cast<float>(u), static_cast<float>(v)});
}

void ObjTextures::take_libraries(std::string_view names) {
  if (std::ranges::find(libraries_, names) == libraries_.end()) libraries_.emplace_back(names);
}

void ObjTextures::take_material(std::string_view name) {
  const auto found = std::ranges::find(materials_, name);
  material_ = static_cast<std::size_t>(found - materials_.begin());
  if (found == materials_.end()) materials_.emplace_back(name);
}

void ObjTextures::take_corner(Index vertex, std::string_view word) {
  if (material_ == no_index || libraries_.empty() || word.size() < 2) return;
  const std::string_view number = word.substr(1, word.find('/', 1) - 1);
  const std::optional<Index> index = resolve_obj_index(number, coordinates_.size());
  if (!index) return;
  if (uses_.size() <= vertex) uses_.resize(vertex + std::size_t{1});
  if (uses_[vertex].coordinates == no_index) uses_[vertex] = {*index, material_};
}

void ObjTextures::add_colours(const Source& source, RawCloud& raw) const {
  if (uses_.empty()) return;
  std::map<std::string, std::string> pictures;
  for (const std::string& name : libraries_) {
    const auto library = file_beside(source, name);
    if (library)
      pictures.merge(pictures_in(*library));
    else
      raw.remarks.push_back(cat("left out its textures, as the file ", in_quotes(name), " is not beside it"));
  }
  std::map<std::string, std::optional<Texture>> textures;
  std::vector<const Texture*> of_materials(materials_.size(), nullptr);
  for (std::size_t i = 0; i < materials_.size(); ++i) {
    const auto name = pictures.find(materials_[i]);
    if (name == pictures.end()) continue;
    const auto [texture, is_new] = textures.try_emplace(name->second);
    if (is_new) texture->second = read_texture(source, name->second, raw);
    if (texture->second) of_materials[i] = &*texture->second;
  }
  if (std::ranges::none_of(textures, [](const auto& texture) { return texture.second.has_value(); })) return;
  raw.cloud.colours.resize(raw.cloud.size(), {255, 255, 255});
  for (std::size_t i = 0; i < std::min(uses_.size(), raw.cloud.size()); ++i) {
    const Use& use = uses_[i];
    if (use.coordinates >= coordinates_.size() || !of_materials[use.material]) continue;
    const auto [u, v] = coordinates_[use.coordinates];
    raw.cloud.colours[i] =
        of_materials[use.material]->at(double{u}, 1 - double{v});  // v = 0 is the picture's lower edge
  }
}

}  // namespace relievo::io
