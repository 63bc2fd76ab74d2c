#include "studio/piece.h"

#include <algorithm>
#include <utility>

#include "relievo/core/text.h"
#include "relievo/core/within_memory.h"
#include "relievo/scan/surface.h"

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

constexpr std::size_t most_limits = 16;  // that are kept: one is wanted again when its options come back

std::string whole_key(const NumberedModel& shown, const std::string& key) {
  return cat(shown.number, " ", key);
}

}  // namespace

bool is_plain(const ReliefOptions& options) {
  return options.outline == Outline::rectangle && !options.rim_mm && options.base.kind == BaseKind::plane &&
         options.wrap.kind == WrapKind::none && options.form == Form::relief && !options.draft_deg &&
         !options.tolerance_mm && !options.triangles && !options.tool && !options.plate_mm;
}

double relief_height_mm(const MadeRelief& made, const ReliefOptions& options) {
  const double made_mm = made.report.height_mm;
  return options.finish == Finish::reachable ? made_mm : options.height_mm.value_or(made_mm);
}

void Piece::take(std::shared_ptr<const MadeRelief> made, const PieceOrder& order) {
  const std::shared_ptr<const Solid> solid(made, &made->solid);
  std::shared_ptr<const ToolReach> reach;
  if (made->report.reach) reach = {made, &*made->report.reach};
  finished_.reset();
  finished_key_ = order.key;
  const bool is_flat = order.options.wrap.kind == WrapKind::none;  // as is the front whose reach was measured
  finished_.emplace(solid, reach, SolidRenderer(solid, is_flat ? reach : nullptr),
                    relief_height_mm(*made, order.options));
}

Result<DrawnPiece*> Piece::drawn(const PieceOrder& order) {
  if (is_finished(order.key)) return &*finished_;
  if (coarse_ && coarse_key_ == order.key) return &*coarse_;
  RELIEVO_TRY(MadeRelief made, make_relief(*model_, coarse(order.options)));
  const auto solid = std::make_shared<const Solid>(std::move(made.solid));
  coarse_.reset();
  coarse_key_ = order.key;
  coarse_.emplace(solid, nullptr, SolidRenderer(solid), std::nullopt);
  return &*coarse_;
}

PieceMaker::Stage PieceMaker::stage() const {
  return making_.with([](const Making& m) { return m.stage; });
}

template <typename Make>
auto PieceMaker::watched(const NumberedModel& shown, PieceUse use, const Make& make) {
  Progress progress([this](std::string_view stage, double fraction) {
    making_.with([&](Making& m) { m.stage = {std::string(stage), fraction}; });
    if (changed_) changed_();
  });
  making_.with([&](Making& m) { m = {{"waiting", 0}, &progress, use}; });
  auto made =
      within_memory({.points = shown.model->surface().points.size()}, [&] { return make(&progress); });
  making_.with([](Making& m) { m = {}; });
  return made;
}

Result<std::shared_ptr<const MadeRelief>> PieceMaker::piece(const NumberedModel& shown,
                                                            const ReliefOptions& options,
                                                            const std::string& key, PieceUse use) {
  const Lock lock(mutex_);
  std::string whole = whole_key(shown, key);
  if (made_ && made_key_ == whole) return made_;
  RELIEVO_TRY(MadeRelief made, watched(shown, use, [&](Progress* progress) {
                return make_relief(*shown.model, options, progress);
              }));
  made_ = std::make_shared<const MadeRelief>(std::move(made));
  made_key_ = std::move(whole);
  return made_;
}

Result<double> PieceMaker::draft_limit(PieceUse use, const NumberedModel& shown, const ReliefOptions& options,
                                       const std::string& key) {
  const Lock lock(mutex_);
  if (const auto known = known_draft_limit(shown, key)) return *known;
  RELIEVO_TRY(const double height_mm, watched(shown, use, [&](Progress* progress) {
                return highest_with_draft(*shown.model, options, progress);
              }));
  draft_limits_.with([&](auto& limits) {
    if (limits.size() >= most_limits) limits.clear();
    limits[whole_key(shown, key)] = height_mm;
  });
  return height_mm;
}

std::optional<double> PieceMaker::known_draft_limit(const NumberedModel& shown,
                                                    const std::string& key) const {
  return draft_limits_.with([&](const auto& limits) -> std::optional<double> {
    const auto found = limits.find(whole_key(shown, key));
    return found == limits.end() ? std::nullopt : std::optional(found->second);
  });
}

void PieceMaker::cancel() {
  making_.with([](Making& m) {
    if (m.progress) m.progress->cancel();
  });
}

void PieceMaker::cancel_for_picture() {
  making_.with([](Making& m) {
    if (m.progress && m.use == PieceUse::picture) m.progress->cancel();
  });
}

}  // namespace relievo::app::studio
