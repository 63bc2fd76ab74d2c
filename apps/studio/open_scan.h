// What is known of the scan that is open.
#pragma once

#include <memory>

#include "project.h"
#include "relievo/make_relief.h"

namespace relievo::studio {

// Shared by copies; nothing of it changes.
class OpenScan {
 public:
  OpenScan() = default;  // none
  OpenScan(Input input, CloudFile file);

  const Input& input() const { return input_; }

  // To look at: without far points; of a mesh its corners. Null if no scan is open.
  const std::shared_ptr<const Cloud>& cloud() const { return cloud_; }

  // Number of the cloud's points that lie far from all others.
  std::size_t left_out() const { return left_out_; }

  // Returns what the relief is made of in that view. Errors: those of seen_points().
  Result<std::shared_ptr<const Cloud>> seen_from(const View& view) const;

 private:
  Input input_;
  std::shared_ptr<const CloudFile> file_;
  std::shared_ptr<const Cloud> cloud_;
  std::size_t left_out_ = 0;
};

}  // namespace relievo::studio
