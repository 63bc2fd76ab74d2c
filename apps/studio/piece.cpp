#include "studio/piece.h"

#include <algorithm>
#include <array>
#include <cmath>
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

// A point where an edge of a triangle crosses the plane of the section.
struct Crossing {
  double along, z;  // `along` in multiples of the distance between samples, z in mm
};

// Raises each sample between two crossings to the height of the line through them, if the sample is lower.
void raise(std::vector<float>& heights, Crossing a, Crossing b) {
  if (a.along > b.along) std::swap(a, b);
  const double last = static_cast<double>(heights.size() - 1);
  if (b.along < 0 || a.along > last) return;
  const auto first = static_cast<std::size_t>(std::ceil(std::max(a.along, 0.)));
  for (std::size_t i = first; static_cast<double>(i) <= std::min(b.along, last); ++i) {
    const double length = b.along - a.along,
                 share = length > 0 ? (static_cast<double>(i) - a.along) / length : 1;
    heights[i] = std::max(heights[i], static_cast<float>(a.z + share * (b.z - a.z)));
  }
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

std::vector<float> section_of(const Solid& solid, const SectionLine& line) {
  const Box box = Box::of(solid.points);
  const Vec2 middle = ((box.min + box.max) / 2).head<2>(), way = line.to - line.from;
  const double length = std::max(way.norm(), 1e-9), steps = static_cast<double>(line.samples - 1);
  const Vec2 along = way.norm() > 0 ? Vec2(way / length) : Vec2(1, 0), across(-along.y(), along.x());
  std::vector<float> heights(line.samples, static_cast<float>(box.min.z() - solid.ground_mm));
  for (const Triangle& triangle : solid.triangles) {
    std::array<Vec2, 3> places;  // coordinates along and across the line
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 p = solid.points[triangle[i]].head<2>() - middle - line.from;
      places[i] = {p.dot(along) / length * steps, p.dot(across)};
    }
    std::array<Crossing, 3> crossings{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if ((places[i].y() < 0) == (places[j].y() < 0)) continue;
      const double share = places[i].y() / (places[i].y() - places[j].y());
      const double a = solid.points[triangle[i]].z(), b = solid.points[triangle[j]].z();
      crossings[count++] = {places[i].x() + share * (places[j].x() - places[i].x()),
                            a + share * (b - a) - solid.ground_mm};
    }
    if (count == 2) raise(heights, crossings[0], crossings[1]);
  }
  return heights;
}

}  // namespace relievo::app::studio
