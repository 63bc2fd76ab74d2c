// The finished piece of a model as export makes it, for pictures of it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "relievo/make_relief.h"
#include "relievo/picture/solid_renderer.h"

namespace relievo::app::studio {

// Returns whether the options ask for nothing but the relief on a rectangular plate, which FrameRenderer draws.
bool is_plain(const ReliefOptions& options);

// Makes the piece anew when its options change. Not for concurrent use.
class Piece {
 public:
  explicit Piece(std::shared_ptr<const ReliefModel> model) : model_(std::move(model)) {}

  // Returns what draws the piece of these options, which `key` identifies; valid until the next call. A coarse piece is
  // made faster, of fewer samples and without a draft angle, unless the fine one is at hand. Errors: those of make_relief().
  Result<SolidRenderer*> renderer(const ReliefOptions& options, const std::string& key, bool is_fine);

  // Returns the piece that was made last; null before the first.
  const Solid* solid() const { return solid_.get(); }

 private:
  std::shared_ptr<const ReliefModel> model_;
  std::shared_ptr<const Solid> solid_;
  std::optional<SolidRenderer> renderer_;
  std::string key_;
  bool is_fine_ = false;
};

}  // namespace relievo::app::studio
