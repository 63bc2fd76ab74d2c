// Reads textures of meshes, and samples them to colour the vertices.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "io/readers.h"
#include "relievo/scan/depth_image.h"

namespace relievo::io {

class Texture {
 public:
  // Reads a picture in any format that is read as depths. Returns nothing for other files.
  static std::optional<Texture> read(std::string_view bytes, std::string_view name);

  // Returns the colour at a position in the picture, which repeats periodically. (0, 0) is the upper left
  // corner, (1, 1) the lower right one.
  Colour at(double u, double v) const;

 private:
  std::array<Image<float>, 3> channels_;  // values from 0 to 255
};

}  // namespace relievo::io
