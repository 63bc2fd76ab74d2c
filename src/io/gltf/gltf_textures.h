// The base colours of the materials of a glTF file: textures, sampled at the vertices, and plain colours.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/gltf/gltf.h"
#include "io/texture.h"

namespace relievo::io {

class GltfTextures {
 public:
  // Reads the base colour textures of all materials. Both arguments must outlive the object.
  explicit GltfTextures(GltfFile& file);

  // Returns whether any texture can be read. If not, materials give no colours.
  bool has_any() const { return !textures_.empty(); }

  // Returns the colour of each of the `count` vertices of a primitive with those attributes.
  std::vector<Colour> colours(const Json& primitive, const Json& attributes, std::size_t count) const;

  // Returns remarks on textures that cannot be read.
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  void read_texture(std::size_t number);

  GltfFile& file_;
  std::map<std::size_t, Texture> textures_;  // by their numbers
  std::vector<std::string> remarks_;
};

}  // namespace relievo::io
