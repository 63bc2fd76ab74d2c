// Reads the textures of an OBJ file. Its materials are in files beside it, and refer to pictures.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/readers.h"
#include "io/text.h"
#include "relievo/core/types.h"

namespace relievo::io {

// Converts an index in an OBJ file to one that counts from 0. Positive indices count from 1; negative ones
// count backwards from the last of the `defined` entries so far, which has the index -1.
std::optional<Index> resolve_obj_index(std::string_view word, std::size_t defined);

// Processes the lines of an OBJ that concern textures, and determines a colour per vertex.
class ObjTextures {
 public:
  void take_coordinates(Words& words);          // reads a vt line
  void take_libraries(std::string_view names);  // reads an mtllib line
  void take_material(std::string_view name);    // reads a usemtl line, for the following faces
  // Processes a corner of a face. `vertex` is the corner's vertex; `word` is the rest of the corner, such as
  // "/2/3". A vertex gets the colour of its first corner that has a texture.
  void take_corner(Index vertex, std::string_view word);

  // Adds the colours of the textures to the cloud, which has points but no colours. If that is impossible,
  // adds a remark with the reason.
  void add_colours(const Source& source, RawCloud& raw) const;

 private:
  struct Use {
    Index coordinates = no_index;
    std::size_t material = 0;
  };

  std::vector<std::array<float, 2>> coordinates_;
  std::vector<std::string> libraries_, materials_;  // materials_ in the order of first use
  std::size_t material_ = no_index;                 // material of the following faces
  std::vector<Use> uses_;                           // per vertex, up to the last one with a texture
};

}  // namespace relievo::io
