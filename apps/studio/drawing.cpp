#include "studio/drawing.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/read_inputs.h"
#include "common/wording.h"
#include "relievo/relief/attention.h"
#include "relievo/relief/weights.h"
#include "relievo/scan/surface.h"
#include "studio/piece.h"

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

ModelFacts facts_of(const ReliefModel& model, std::size_t outliers, std::vector<std::string> remarks) {
  const Surface& surface = model.surface();
  const Box box = Box::of(surface.points);
  ModelFacts facts{.scan = ScanReport::of(surface),
                   .points = surface.points.size(),
                   .triangles = surface.triangulation.triangles.size(),
                   .hull = surface.triangulation.hull.size(),
                   .size = box.size().head<2>(),
                   .corner = box.min.head<2>(),
                   .origin = (surface.view.R_view_model * surface.centre + box.min).head<2>(),
                   .delta = surface.curvature.delta,
                   .rotation = surface.view.R_view_model,
                   .has_colours = !surface.colours.empty(),
                   .can_be_lit = !model.paper() && !model.subspace(),
                   .remarks = {},
                   .histogram = histogram_of(surface.curvature.k)};
  for (std::string& line : remarks) facts.remarks.push_back({std::move(line)});
  for (Remark& remark : remarks_on(facts.scan, outliers)) facts.remarks.push_back(std::move(remark));
  for (Remark& remark : facts.remarks) remark.text = as_sentence(std::move(remark.text));
  return facts;
}

CurveSamples sample_curve(const Shape& shape, double delta) {
  const bool is_layered = shape.style == Style::layered;
  const Compression saturation = saturation_alone(shape.compression);
  // In the layered style, the saturation or the tone curve keeps a share of each slope. This share is `scale`
  // times the weight for `saturation`, but at most 1.
  const double scale = is_layered ? saturation_scale(shape.compression) : 1;
  CurveSamples samples;
  for (std::size_t i = 0; i < CurveSamples::size; ++i) {
    const double root = static_cast<double>(i) / (CurveSamples::size - 1), k = root * root;
    samples.share.push_back(std::min(1.0, scale * curvature_weight(k, delta, saturation)));
    samples.kept.push_back(is_layered ? samples.share.back() : curvature_weight(k, delta, shape.compression));
  }
  return samples;
}

// Rounds a height down to as many decimals as the page shows for the heights of files. A height that is
// rounded up could exceed the largest possible height.
double rounded_down(double height_mm, double steps_per_mm) {
  return std::floor(height_mm * steps_per_mm) / steps_per_mm;
}

bool is_flat(const ReliefOptions& options) {
  return options.base.kind == BaseKind::plane && options.wrap.kind == WrapKind::none;
}

// Returns whether FrameRenderer can draw the piece while only its heights change. FrameRenderer draws the
// piece without ornaments, and without what takes long to compute: the draft angle, the simplification, and
// the reach of a tool.
bool is_frame_on_plate(const ReliefOptions& options) {
  return (is_flat(options) || options.outline != Outline::none) && options.form != Form::lithophane &&
         !options.mm_per_value;
}

// Returns whether the options ask only for a relief on a rectangular plate.
bool is_plain(const ReliefOptions& options) {
  const bool is_plate = options.outline == Outline::rectangle && !options.rim_mm && !options.plate_mm;
  const bool frame_shows_all =
      !options.draft_deg && !options.tolerance_mm && !options.triangles && !options.tool;
  return is_frame_on_plate(options) && is_plate && frame_shows_all && options.form == Form::relief &&
         is_flat(options);
}

ReliefOptions coarse(ReliefOptions options) {
  constexpr double samples = 180;  // along the longer side; so few are enough while a slider moves
  options.resolution_mm = std::max(options.effective_width_mm() / samples, options.resolution_mm.value_or(0));
  options.tolerance_mm = options.draft_deg = options.triangles = std::nullopt;
  options.finish = Finish::full;
  options.tool = std::nullopt;
  return options;
}

// Returns whether the thickness of the piece, coarse or finished, is exactly that of the plate plus the height of the
// relief.
bool is_level(const ReliefOptions& options) {
  return is_flat(options) && options.form != Form::die && !options.rim_mm &&
         options.outline != Outline::none && options.finish == Finish::full;
}

ReliefOptions without_ornaments(ReliefOptions options) {
  options.text.clear();
  options.font_name.clear();
  options.font = nullptr;
  options.text_arc = TextArc::straight;
  options.text_mm = options.text_height_mm = options.text_inset_mm = std::nullopt;
  options.ornament_source.clear();
  options.ornaments.clear();
  return options;
}

}  // namespace

bool leave_out_ornaments(PictureRequest& request, const Error& error) {
  const bool is_theirs = error.kind == ErrorKind::option &&
                         (error.input == "text" || error.input == "ornaments" || error.input == "font");
  if (!is_theirs || request.options.all_ornaments().empty()) return false;
  request.options = without_ornaments(request.options);
  request.ornament_error = error;
  return true;
}

void read_ornaments_of(PictureRequest& request) {
  const Result<void> read = read_ornaments(request.options);
  if (read) return;
  request.options = without_ornaments(request.options);
  request.ornament_error = read.error();
}

Drawing::Drawing(ShownModel shown, std::size_t outliers, std::vector<std::string> remarks)
    : facts_(facts_of(*shown.model, outliers, std::move(remarks))),
      model_(shown.model),
      live_(std::move(shown)) {}

LiveFrame Drawing::frame(const PictureRequest& request, bool is_exact) {
  if (is_frozen_ && live_.last_frame().frame) return live_.last_frame();
  const LiveFrame made = live_.make_frame(request.options, {request.u, !is_exact});
  frames_made_ += made.is_new;
  return made;
}

// Returns the lower left and upper right corner of the relief's bounding box, relative to the centre of the piece.
std::optional<std::array<Vec2, 2>> Drawing::relief_in(const Solid& solid,
                                                      const ReliefOptions& options) const {
  if (options.wrap.kind != WrapKind::none) return std::nullopt;
  const double scale = live_.mm_per_unit(options);
  Vec2 corner = facts_.corner * scale;
  const Vec2 size = facts_.size * scale;
  if (options.form == Form::mirror || options.form == Form::die) corner.x() = -corner.x() - size.x();
  const Box box = Box::of(solid.points);
  const Vec2 low = corner + (solid.shift - (box.min + box.max) / 2).head<2>();
  return {{low, low + size}};
}

// Returns the height of the relief in exported files: the requested height if the frame's relief and the
// draft angle allow it, otherwise the largest height that they allow. A lithophane can have any height. With
// the option mm-per-value the height is known only after the piece is made.
PieceHeight Drawing::height_of(const PictureRequest& request, const LiveFrame& made) const {
  const Frame& frame = *made.frame;
  const double height = frame.height * made.stretch * live_.mm_per_unit(request.options);
  const double highest = std::min(height, request.draft_limit_mm.value_or(height));
  const double asked = request.options.height_mm.value_or(height);
  if (request.options.form == Form::lithophane || request.options.mm_per_value) return {asked, true};
  if (height > highest || !frame.is_height_met)
    return {rounded_down(highest, highest < .1 ? 1e4 : 1e3), false};
  return {request.u ? rounded_down(height, 1e4) : asked, true};
}

// Returns the options for making the piece: those of the request, with the height of height_of().
ReliefOptions Drawing::piece_options(const PictureRequest& request, const LiveFrame& made) const {
  ReliefOptions options = request.options;
  if (options.mm_per_value) return options;
  const PieceHeight height = height_of(request, made);
  if (request.u || !height.is_met) options.height_mm = height.mm;
  return options;
}

Result<std::optional<ReliefOptions>> Drawing::missing_piece(PictureRequest request) {
  RELIEVO_TRY(request.options, live_.with_width(request.options));
  ReliefOptions wanted = piece_options(request, frame(request, true));
  if (is_finished(wanted)) return std::nullopt;
  return wanted;
}

void Drawing::take(std::shared_ptr<const MadeRelief> made, const ReliefOptions& options) {
  const std::shared_ptr<const Solid> solid(made, &made->solid);
  std::shared_ptr<const ToolReach> reach;
  if (made->report.reach) reach = {made, &*made->report.reach};
  finished_.reset();
  const bool is_flat = options.wrap.kind == WrapKind::none;  // the reach was measured before bending
  finished_.emplace(options, solid, reach, SolidRenderer(solid, is_flat ? reach : nullptr),
                    relief_height_mm(*made, options));
}

Result<DrawnPiece*> Drawing::piece(const ReliefOptions& options) {
  if (is_finished(options)) return &*finished_;
  const ReliefOptions bare =
      without_ornaments(options);  // making ornaments takes too long while a user drags a slider
  if (coarse_ && coarse_->options == bare) return &*coarse_;
  RELIEVO_TRY(MadeRelief made, make_relief(*model_, coarse(bare)));
  const auto solid = std::make_shared<const Solid>(std::move(made.solid));
  const auto height = options.mm_per_value ? std::optional(made.report.height_mm) : std::nullopt;
  coarse_.reset();
  coarse_.emplace(bare, solid, nullptr, SolidRenderer(solid), height);
  return &*coarse_;
}

Result<void> Drawing::draw_frame(const PictureRequest& request, const RenderOptions& render,
                                 const LiveFrame& made, PictureAnswer& answer) {
  const Vec2 half = facts_.size * render.mm_per_unit / 2;
  if (!is_plain(request.options)) {
    // The piece may be lower than the frame, because the draft angle may limit its height, and because a
    // height that is out of reach is rounded down. So the frame is scaled to the height of the piece.
    LiveFrame limited = made;
    const double unstretched = made.frame->height * made.mm_per_unit;
    if (unstretched > 0) limited.stretch = answer.height_mm / unstretched;
    RELIEVO_TRY(const PlacedRelief placed,
                live_.draw_on_plate(limited, without_ornaments(request.options), render, answer.picture,
                                    request.progress.get()));
    answer.size_mm = placed.size_mm;
    if (request.options.wrap.kind == WrapKind::none)
      answer.relief_mm = {placed.middle_mm - half, placed.middle_mm + half};
    return {};
  }
  if (request.is_drawn_apart)
    answer.undrawn = {model_, frames_made_, live_.shown(made), render};
  else
    live_.renderer().render(live_.shown(made), render, answer.picture, request.progress.get());
  const Vec2 plate = 2 * half + Vec2::Constant(2 * render.margin_mm);
  answer.size_mm.head<2>() = plate;
  answer.relief_mm = {-half, half};
  return {};
}

Result<void> Drawing::draw(const PictureRequest& request, const RenderOptions& render, const LiveFrame& made,
                           PictureAnswer& answer) {
  const auto start = std::chrono::steady_clock::now();
  const ReliefOptions wanted = piece_options(request, made);
  const bool is_frame = is_frame_on_plate(request.options), has_ornaments = !wanted.all_ornaments().empty();
  answer.is_plain = is_plain(request.options) && !has_ornaments;
  answer.is_finished = (!answer.is_plain || request.is_finished) && is_finished(wanted);
  answer.has_ornaments = answer.is_finished && has_ornaments;
  answer.ornament_error = request.ornament_error;
  const bool is_limit_known = !request.options.draft_deg || request.draft_limit_mm.has_value();
  answer.is_size_exact = answer.is_finished || (is_level(request.options) && is_limit_known);
  answer.relief_height_mm = answer.height_mm;
  if (is_frame && !answer.is_finished) {
    RELIEVO_CHECK(draw_frame(request, render, made, answer));
  } else {
    RELIEVO_TRY(DrawnPiece* const piece, this->piece(wanted));
    piece->renderer.render(render, answer.picture, request.progress.get());
    if (request.options.mm_per_value) answer.height_mm = piece->height_mm.value_or(answer.height_mm);
    answer.size_mm = Box::of(piece->solid->points).size();
    answer.relief_height_mm = piece->height_mm.value_or(answer.height_mm);
    answer.relief_mm = relief_in(*piece->solid, request.options);
    if (piece->reach) answer.reach = {piece->reach->reached_share, piece->reach->largest_residual_mm};
  }
  if (is_level(request.options)) answer.size_mm.z() = render.thickness_mm + answer.height_mm;
  RELIEVO_CHECK(check_cancelled(request.progress.get()));
  answer.drawing_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {};
}

std::span<const float> Drawing::attention() {
  if (attention_.empty()) attention_ = relievo::attention(model_->surface());
  return attention_;
}

Result<PictureAnswer> Drawing::picture(PictureRequest request) {
  RELIEVO_TRY(request.options, live_.with_width(request.options));
  RenderOptions options = live_.with_lengths(request.render, request.options);
  PictureAnswer answer;
  answer.width_mm = request.options.effective_width_mm();
  answer.most_width_mm = live_.most_width_mm();
  if (request.is_original) {
    options.has_shadows = false;           // at the model's full depth, shadows would cover the ground
    options.material = Material::plaster;  // the chosen material is only for reliefs
    Shown model = live_.renderer().original();
    if (request.has_attention) model.tint = attention();
    live_.renderer().render(model, options, answer.picture, request.progress.get());
    RELIEVO_CHECK(check_cancelled(request.progress.get()));
    answer.is_finished = true;
    return answer;
  }
  // A piece gets its height from the frame. So if a piece is drawn, the frame's height must be exact.
  const LiveFrame made = this->frame(request, request.is_at_rest || !is_frame_on_plate(request.options));
  const Frame& frame = *made.frame;
  answer.compression = frame.options.shape.compression;
  const PieceHeight height = height_of(request, made);
  answer.height_mm = height.mm;
  answer.is_height_met = height.is_met;
  answer.curve = sample_curve(frame.options.shape, facts_.delta);
  if (made.is_new) answer.times = frame.times;
  RELIEVO_CHECK(draw(request, options, made, answer));
  return answer;
}

Result<std::vector<OrnamentPlace>> Drawing::ornament_places(const ReliefOptions& options) const {
  return relievo::ornament_places(model_->surface(), options);
}

Result<double> Drawing::reachable_height(const ReliefOptions& asked) {
  RELIEVO_TRY(const ReliefOptions options, live_.with_width(asked));
  return live_.highest_mm(options);
}

Result<std::vector<float>> Drawing::profile(PictureRequest request, const SectionLine& line) {
  RELIEVO_TRY(request.options, live_.with_width(request.options));
  const RenderOptions options = live_.with_lengths(request.render, request.options);
  const auto along = [&](const Shown& shown) {
    return live_.renderer().profile(shown, options, line.from, line.to, line.samples);
  };
  if (request.is_original) return along(live_.renderer().original());
  const LiveFrame made = frame(request, true);
  if (is_plain(request.options)) return along(live_.shown(made));
  const ReliefOptions wanted = piece_options(request, made);
  RELIEVO_TRY(const DrawnPiece* const shown, piece(wanted));
  // Making a coarse piece does not check the rim, so the rim is checked here.
  RELIEVO_CHECK(check_rim(wanted, shown->height_mm.value_or(height_of(request, made).mm)));
  return section_of(*shown->solid, line);
}

}  // namespace relievo::app::studio
