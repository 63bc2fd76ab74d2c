#include "common/stage_names.h"

#include <algorithm>
#include <array>

namespace relievo::app {

std::span<const StageName> stage_names() {
  static constexpr std::array names{
      StageName{"waiting", "Getting ready"},
      StageName{"upload", "Taking in the file"},
      StageName{"read", "Reading the scan"},
      StageName{"first look", "Reading the scan: a first look"},
      StageName{"extent", "Reading the scan: its extent"},
      StageName{"front", "Reading the scan: the side that is seen"},
      StageName{"means", "Reading the scan: averaging its points"},
      StageName{"depths", "Turning depths into points"},
      StageName{"smooth depths", "Smoothing depths"},
      StageName{"models", "Placing the models"},
      StageName{"mesh", "Looking at the mesh"},
      StageName{"mesh samples", "Sampling the mesh"},
      StageName{"view", "Turning the model"},
      StageName{"spacing", "Measuring the spacing"},
      StageName{"normals", "Looking at normals"},
      StageName{"visible points", "Finding what is seen"},
      StageName{"curvature", "Measuring curvature"},
      StageName{"triangulation", "Connecting the points"},
      StageName{"boundary", "Finding the outline"},
      StageName{"layers", "Splitting the normals in layers"},
      StageName{"factorisation", "Preparing live work"},
      StageName{"tuning", "Tuning the relief"},
      StageName{"reference heights", "Computing reference reliefs"},
      StageName{"control points", "Placing control points"},
      StageName{"relief", "Computing the relief"},
      StageName{"solid", "Building the solid"},
      StageName{"simplify", "Simplifying the mesh"},
      StageName{"files", "Writing files"},
      StageName{"comparison", "Comparing methods"},
  };
  return names;
}

std::string_view name_of_stage(std::string_view stage) {
  const auto found = std::ranges::find(stage_names(), stage, &StageName::stage);
  return found != stage_names().end() ? found->text : stage;
}

}  // namespace relievo::app
