// What is known of the scan, or the scene of several, that is open.
#pragma once

#include <memory>

#include "project.h"
#include "relievo/scene.h"

namespace relievo::studio {

// Shared by copies; nothing of it changes.
class OpenScan {
 public:
  OpenScan() = default;                // none
  OpenScan(Input input, Scene scene);  // of at least one model

  const Input& input() const { return input_; }

  // To look at, all models as they stand seen from the front: without far points; of meshes their corners.
  // Null if no scan is open.
  const std::shared_ptr<const Cloud>& cloud() const { return cloud_; }

  // Number of the points of clouds that lie far from all others.
  std::size_t left_out() const { return left_out_; }

  // Returns what the relief is made of in that view. Errors: those of seen_points().
  Result<std::shared_ptr<const Cloud>> seen_from(const View& view) const;

 private:
  bool is_one_file() const;
  void add(const CloudFile& file, const PlacedModel& place, double share, Cloud& all);

  Input input_;
  Scene scene_;
  std::shared_ptr<const Cloud> cloud_;
  std::size_t left_out_ = 0;
};

}  // namespace relievo::studio
