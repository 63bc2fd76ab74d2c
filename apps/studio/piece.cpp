#include "studio/piece.h"

#include <algorithm>
#include <utility>

#include "relievo/core/within_memory.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"

namespace relievo::app::studio {
namespace {

// The number of draft limits to keep. They are kept because users often return to earlier options.
constexpr std::size_t most_limits = 16;

ReliefOptions without_height(ReliefOptions options) {
  options.height_mm.reset();
  return options;
}

}  // namespace

double relief_height_mm(const MadeRelief& made, const ReliefOptions& options) {
  const double made_mm = made.report.height_mm;
  return options.finish == Finish::reachable ? made_mm : options.height_mm.value_or(made_mm);
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

Result<std::shared_ptr<const MadeRelief>> PieceMaker::piece(PieceUse use, const NumberedModel& shown,
                                                            const ReliefOptions& options) {
  const Lock lock(mutex_);
  if (made_ && made_model_ == shown.number && made_options_ == options) return made_;
  RELIEVO_TRY(MadeRelief made, watched(shown, use, [&](Progress* progress) {
                return make_relief(*shown.model, options, progress);
              }));
  made_.reset();  // if memory runs out below, the old piece must not stay with the new options
  made_model_ = shown.number;
  made_options_ = options;
  made_ = std::make_shared<const MadeRelief>(std::move(made));
  return made_;
}

Result<double> PieceMaker::draft_limit(PieceUse use, const NumberedModel& shown,
                                       const ReliefOptions& options) {
  const Lock lock(mutex_);
  if (const auto known = known_draft_limit(shown, options)) return *known;
  RELIEVO_TRY(const double height_mm, watched(shown, use, [&](Progress* progress) {
                return highest_with_draft(*shown.model, options, progress);
              }));
  draft_limits_.with([&](auto& limits) {
    if (limits.size() >= most_limits) limits.clear();
    limits.push_back({shown.number, without_height(options), height_mm});
  });
  return height_mm;
}

std::optional<double> PieceMaker::known_draft_limit(const NumberedModel& shown,
                                                    const ReliefOptions& options) const {
  return draft_limits_.with([&, wanted = without_height(options)](const auto& limits) {
    const auto is_wanted = [&](const DraftLimit& limit) {
      return limit.model == shown.number && limit.options == wanted;
    };
    const auto found = std::ranges::find_if(limits, is_wanted);
    return found == limits.end() ? std::nullopt : std::optional(found->height_mm);
  });
}

void PieceMaker::cancel(std::optional<PieceUse> use) {
  making_.with([&](Making& m) {
    if (m.progress && m.use == use.value_or(m.use)) m.progress->cancel();
  });
}

}  // namespace relievo::app::studio
