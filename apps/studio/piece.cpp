#include "studio/piece.h"

#include <algorithm>

namespace relievo::app::studio {
namespace {

constexpr double coarse_samples = 180;  // along the longer side: enough to follow a hand

ReliefOptions coarse(ReliefOptions options) {
  options.resolution_mm =
      std::max(options.effective_width_mm() / coarse_samples, options.resolution_mm.value_or(0));
  options.tolerance_mm = options.draft_deg = options.triangles = std::nullopt;
  options.finish = Finish::full;
  options.tool = std::nullopt;
  return options;
}

}  // namespace

bool is_plain(const ReliefOptions& options) {
  return options.outline == Outline::rectangle && !options.rim_mm && options.base.kind == BaseKind::plane &&
         options.wrap.kind == WrapKind::none && options.form == Form::relief && !options.draft_deg &&
         !options.tolerance_mm && !options.triangles && !options.tool && !options.plate_mm;
}

void Piece::take(std::shared_ptr<const MadeRelief> made, const PieceOrder& order) {
  const std::shared_ptr<const Solid> solid(made, &made->solid);
  std::shared_ptr<const ToolReach> reach;
  if (made->report.reach) reach = {made, &*made->report.reach};
  const bool is_flat = order.options.wrap.kind == WrapKind::none;  // as is the front whose reach was measured
  finished_.emplace(solid, reach, SolidRenderer(solid, is_flat ? reach : nullptr));
  finished_key_ = order.key;
}

Result<DrawnPiece*> Piece::drawn(const PieceOrder& order) {
  if (is_finished(order.key)) return &*finished_;
  if (coarse_ && coarse_key_ == order.key) return &*coarse_;
  RELIEVO_TRY(MadeRelief made, make_relief(*model_, coarse(order.options)));
  const auto solid = std::make_shared<const Solid>(std::move(made.solid));
  coarse_.emplace(solid, nullptr, SolidRenderer(solid));
  coarse_key_ = order.key;
  return &*coarse_;
}

}  // namespace relievo::app::studio
