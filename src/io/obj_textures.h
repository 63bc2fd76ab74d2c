// The textures of an OBJ: its materials are in files beside it, and name pictures.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "io/readers.h"
#include "io/text.h"
#include "relievo/core/types.h"

namespace relievo::io {

// Collects the lines of an OBJ that concern textures, and gives a colour to every vertex.
class ObjTextures {
 public:
  void take_coordinates(Words& words);          // vt
  void take_libraries(std::string_view names);  // mtllib
  void take_material(std::string_view name);    // usemtl: the material of the faces that follow
  // `vertex` has been read, and `word` is what follows it in a corner of a face, "/2/3". A vertex has the colour of its first
  // corner with a texture.
  void take_corner(Index vertex, std::string_view word);

  // Adds the colours of the textures to the cloud, which has points but no colours, or says why it has none.
  void add_colours(const Source& source, RawCloud& raw) const;

 private:
  struct Use {
    Index coordinates = no_index;
    std::size_t material = 0;
  };

  std::vector<std::array<float, 2>> coordinates_;
  std::vector<std::string> libraries_, materials_;  // materials by the order of their first use
  std::size_t material_ = no_index;                 // of the faces that follow
  std::vector<Use> uses_;                           // one for each vertex up to the last one with a texture
};

}  // namespace relievo::io
