// The points from which a view's relief is made, and notes on how the scans were sampled.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace relievo {

struct Cloud;

// A step that changed a model's points.
struct SampleNote {
  enum class Kind {
    outliers,           // `points` far from the middle were left out
    repeated,           // `points` that repeat others were left out
    estimated_normals,  // normals were estimated, because the model has none
    turned_normals,     // normals were reversed, because they point inwards
    mesh,               // `points` were taken from a mesh of `of` triangles
    coarse,             // the cloud is coarser than the scene: points were added between its own
    fine                // the cloud is finer than the scene: `points` of its `of` points were kept
  };

  Kind kind = Kind::outliers;
  std::string model = {};  // name of the model in a scene; empty if there is only one
  std::size_t points = 0, of = 0;

  bool operator==(const SampleNote&) const = default;
};

struct ViewSample {
  std::shared_ptr<const Cloud> cloud;  // points in the scene's frame; the file's own if no point was changed
  std::size_t left_out = 0;            // number of outliers of all models together
  std::vector<SampleNote> notes;
};

}  // namespace relievo
