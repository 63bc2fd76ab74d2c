// Describes the points for the relief of a view, and how they were sampled.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace relievo {

struct Cloud;

// A step that changed the points of a model.
struct SampleNote {
  enum class Kind {
    outliers,           // `points` points far from the middle were left out
    repeated,           // `points` points were left out because they repeat other points
    estimated_normals,  // normals were estimated, because the model has none
    turned_normals,     // normals were reversed, because they point inwards
    mesh,               // `points` points were sampled from a mesh of `of` triangles
    coarse,             // the cloud is coarser than the scene, so points were added between its own
    fine                // the cloud is finer than the scene, so only `points` of its `of` points were kept
  };

  Kind kind = Kind::outliers;
  std::string model = {};  // name of the model in a scene; empty for a single model
  std::size_t points = 0, of = 0;

  bool operator==(const SampleNote&) const = default;
};

struct ViewSample {
  // Points in the scene's axes; the file's cloud itself if no point was changed.
  std::shared_ptr<const Cloud> cloud;
  std::size_t left_out = 0;  // number of outliers of all models together
  std::vector<SampleNote> notes;
};

}  // namespace relievo
