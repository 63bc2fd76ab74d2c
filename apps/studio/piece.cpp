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
         !options.tolerance_mm && !options.triangles && options.finish == Finish::full && !options.plate_mm;
}

Result<SolidRenderer*> Piece::renderer(const ReliefOptions& options, const std::string& key, bool is_fine) {
  if (renderer_ && key == key_ && (is_fine_ || !is_fine)) return &*renderer_;
  RELIEVO_TRY(MadeRelief made, make_relief(*model_, is_fine ? options : coarse(options)));
  solid_ = std::make_shared<const Solid>(std::move(made.solid));
  renderer_.emplace(solid_);
  key_ = key;
  is_fine_ = is_fine;
  return &*renderer_;
}

}  // namespace relievo::app::studio
