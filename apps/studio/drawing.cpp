#include "studio/drawing.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/wording.h"
#include "relievo/make_relief.h"
#include "relievo/scan/surface.h"

namespace relievo::app::studio {
namespace {

std::vector<std::size_t> histogram_of(const std::vector<float>& k) {
  std::vector<std::size_t> counts(64);
  for (const float value : k) {
    const auto bin = static_cast<std::size_t>(std::sqrt(std::abs(value)) * 64);
    ++counts[std::min<std::size_t>(bin, counts.size() - 1)];
  }
  return counts;
}

std::vector<std::string> sentences_on(const Surface& surface, std::size_t left_out) {
  std::vector<std::string> sentences;
  const ScanFacts facts{surface.has_estimated_normals, surface.has_flipped_normals, left_out,
                        surface.visible_points,        surface.removed_points,      surface.crumbs,
                        surface.measured_noise,        surface.removed_noise};
  for (const std::string& line : remarks_on(facts)) sentences.push_back(as_sentence(line));
  return sentences;
}

double area_of(const Surface& surface) {
  double sum = 0;
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    const auto& [a, b, c] = surface.triangulation.triangles[t];
    const Vec3 u = surface.points[b] - surface.points[a], v = surface.points[c] - surface.points[a];
    sum += (u.x() * v.y() - u.y() * v.x()) / 2;
  }
  return sum;
}

ModelFacts facts_of(const Surface& surface, std::size_t left_out) {
  const Box box = Box::of(surface.points);
  return {.input_points = surface.input_points,
          .visible_points = surface.visible_points,
          .points = surface.points.size(),
          .triangles = surface.triangulation.triangles.size(),
          .hull = surface.triangulation.hull.size(),
          .size = box.size().head<2>(),
          .area = area_of(surface),
          .noise = surface.removed_noise,
          .rho = surface.rho,
          .delta = surface.curvature.delta,
          .rotation = surface.view.R_view_model,
          .remarks = sentences_on(surface, left_out),
          .histogram = histogram_of(surface.curvature.k)};
}

Shown shown(const CachedFrame& cached) {
  const Frame& frame = *cached.frame;
  return {frame.heights, frame.normals, static_cast<float>(cached.stretch), {{frame.lowest, frame.highest}}};
}

}  // namespace

Shape SharedToneCurve::shape_of(const ReliefOptions& options) {
  Shape shape = relievo::shape_of(options);
  if (!options.tone) return shape;
  if (!curve_ || curve_->points() != options.tone->points()) curve_ = shape.compression.curve;
  shape.compression.curve = curve_;
  return shape;
}

Drawing::Drawing(std::shared_ptr<const ReliefModel> model, std::size_t left_out)
    : model_(std::move(model)),
      facts_(facts_of(model_->surface(), left_out)),
      renderer_(model_),
      frames_(*model_) {}

// The same as relievo::mm_per_unit(), without its walk over all points.
double Drawing::mm_per_unit(const ReliefOptions& options) const {
  return options.width_mm / facts_.size.maxCoeff();
}

RenderOptions Drawing::render_options(const PictureRequest& request) const {
  RenderOptions render = request.render;
  render.mm_per_unit = mm_per_unit(request.options);
  render.margin_mm = request.options.margin_mm;
  render.thickness_mm = request.options.thickness_mm;
  return render;
}

FrameOptions Drawing::frame_options(const PictureRequest& request) {
  FrameOptions options;
  options.shape = tone_curve_.shape_of(request.options);
  if (request.u)
    options.shape.compression.u = *request.u;
  else if (request.options.height_mm)
    options.height = *request.options.height_mm / mm_per_unit(request.options);
  return options;
}

CachedFrame Drawing::frame(const PictureRequest& request, bool is_exact) {
  const FrameOptions wanted = frame_options(request);
  if (is_frozen_ && frames_.last().frame) return frames_.last();
  return is_exact ? frames_.exact(wanted) : frames_.quick(wanted);
}

std::uint64_t Drawing::number_of_scene(const RenderOptions& render) {
  if (scene_ > 0 && render == scene_options_) return scene_;
  scene_options_ = render;
  return ++scene_;
}

void Drawing::render(const Shown& shown, const RenderOptions& render, PictureAnswer& answer) {
  const auto start = std::chrono::steady_clock::now();
  renderer_.render(shown, render, answer.picture);
  answer.drawing_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

PictureAnswer Drawing::picture(const PictureRequest& request) {
  RenderOptions options = render_options(request);
  PictureAnswer answer;
  answer.scene = number_of_scene(options);
  if (request.is_original) {
    options.has_shadows = false;  // the model's own depth would bury the ground in them
    render(renderer_.original(), options, answer);
    return answer;
  }
  const CachedFrame cached = this->frame(request, options.is_fine);
  render(shown(cached), options, answer);
  const Frame& frame = *cached.frame;
  answer.compression = frame.options.shape.compression;
  answer.height_mm = frame.height * cached.stretch * options.mm_per_unit;
  answer.is_height_met = frame.is_height_met;
  answer.curve = sample_curve(frame.options.shape, facts_.delta);
  if (cached.is_new) answer.times = frame.times;
  return answer;
}

std::vector<float> Drawing::profile(const PictureRequest& request, const SectionLine& line) {
  const RenderOptions options = render_options(request);
  const auto along = [&](const Shown& shown) {
    return renderer_.profile(shown, options, line.from, line.to, line.samples);
  };
  if (request.is_original) return along(renderer_.original());
  return along(shown(frame(request, true)));
}

}  // namespace relievo::app::studio
