// Determines the base colours of a glTF file's materials: textures, sampled at vertices, or plain colours.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/gltf/gltf.h"
#include "io/texture.h"

namespace relievo::io {

class GltfTextures {
 public:
  // Reads the base colour textures of all materials. `file` must outlive the object.
  explicit GltfTextures(GltfFile& file);

  // Returns whether any texture can be read. If not, materials have no effect on colours.
  bool has_any() const { return !textures_.empty(); }

  // Returns the colours of the `count` vertices of a primitive with these attributes.
  std::vector<Colour> colours(const Json& primitive, const Json& attributes, std::size_t count) const;

  // Returns remarks on textures that could not be read.
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  void read_texture(std::size_t number);

  GltfFile& file_;
  std::map<std::size_t, Texture> textures_;  // by texture index
  std::vector<std::string> remarks_;
};

}  // namespace relievo::io
