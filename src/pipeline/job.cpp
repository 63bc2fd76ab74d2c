#include <algorithm>
#include <utility>

#include "pipeline/body.h"
#include "relievo/core/text.h"
#include "relievo/core/within_memory.h"
#include "relievo/io/read.h"
#include "relievo/job.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

// If u, the coefficient in equation (6), has at least this value, all weights are exactly 1.
constexpr double uncompressed_u = 1e12;

// While the picture moves, viewers do not notice that heights are wrong by up to this share.
constexpr double moving_tolerance = .03;

// Returns the sizes that determine the largest width of a relief in a plate of a given size.
std::vector<double> plate_sizes(const ReliefOptions& options) {
  const Vec2 plate = options.plate_mm.value_or(Vec2::Constant(options.diameter_mm.value_or(0)));
  return {plate.x(),
          plate.y(),
          options.effective_margin_mm(),
          options.rim_mm.value_or(0),
          options.corner_mm,
          static_cast<double>(options.outline),
          options.shift_mm.x(),
          options.shift_mm.y()};
}

}  // namespace

struct LiveModel::State {
  State(ShownModel model, std::vector<SampleNote> sampled)
      : shown(std::move(model)),
        notes(std::move(sampled)),
        longer_side(Box::of(shown.model->surface().points).longer_side()) {}

  ShownModel shown;
  std::vector<SampleNote> notes;
  double longer_side;  // longer side of the surface, in its units

  std::optional<FrameMaker> maker;        // empty before the first frame
  std::optional<FrameRenderer> renderer;  // empty before the first picture
  std::vector<float> gains;               // gains of the last frame
  Frame frame, highest;
  std::optional<FrameOptions> made;  // options of `frame`; empty before the first one
  LiveFrame last;

  std::shared_ptr<const ToneCurve> curve;  // curve of the last frame that had one
  std::vector<double> sizes;               // plate_sizes() for which most_width_mm was computed
  std::optional<double> most_width_mm;

  FrameMaker& frames() {
    if (!maker) maker.emplace(*shown.model);
    return *maker;
  }

  // Returns the options of a frame. If the tone curve has the same points as that of the last frame, the
  // curve object of that frame is reused.
  FrameOptions frame_options(const ReliefOptions& options) {
    FrameOptions wanted{shape_of(options, options.effective_width_mm() / longer_side)};
    wanted.shape.boundary_width *= shown.spacing_ratio;
    if (!options.tone) return wanted;
    if (!curve || curve->points() != options.tone->points()) curve = wanted.shape.compression.curve;
    wanted.shape.compression.curve = curve;
    return wanted;
  }

  LiveFrame make(const FrameOptions& wanted, double mm_per_unit) {
    const bool is_known = made == wanted;
    if (!is_known) {
      made.reset();  // so that an unfinished frame is not reused after running out of memory
      last = {};
      frames().make(wanted, frame);
      if (shown.detail) frames().write_gains(gains);
      made = wanted;
    }
    return last = {&frame, gains, 1, mm_per_unit, !is_known};
  }
};

LiveModel::LiveModel(ShownModel shown, std::vector<SampleNote> notes)
    : state_(std::make_unique<State>(std::move(shown), std::move(notes))) {}
LiveModel::LiveModel(LiveModel&&) noexcept = default;
LiveModel::~LiveModel() = default;

const ReliefModel& LiveModel::model() const {
  return *state_->shown.model;
}

Result<MadeRelief> LiveModel::relief(const ReliefOptions& options, Progress* progress) const {
  RELIEVO_TRY(MadeRelief made, make_relief(model(), options, progress));
  made.report.sample = state_->notes;
  return made;
}

Result<LiveFrame> LiveModel::frame(const ReliefOptions& options) {
  return within_memory({.points = model().surface().points.size()}, [&]() -> Result<LiveFrame> {
    const Method method = options.effective_method();
    if (!has_shape(method))
      return option_error("method", cat("expected layered or paper for frames, found ", name_of(method)));
    // A model that is being turned has `detail`. Its coarse surface serves all methods, so it needs no check.
    if (!state_->shown.detail) RELIEVO_CHECK(check_model(model(), options));
    RELIEVO_TRY(ReliefOptions sized, with_width(options));
    sized.height_mm = sized.effective_height_mm();
    return make_frame(sized);
  });
}

Result<Picture> LiveModel::picture(const ReliefOptions& options, RenderOptions render) {
  return within_memory([&]() -> Result<Picture> {
    RELIEVO_CHECK(check(render));
    RELIEVO_TRY(const LiveFrame made, frame(options));
    RELIEVO_TRY(const ReliefOptions sized, with_width(options));
    Picture picture;
    renderer().render(shown(made), with_lengths(render, sized), picture);
    return picture;
  });
}

Result<ReliefOptions> LiveModel::with_width(const ReliefOptions& options) {
  std::optional<double>& most_mm = state_->most_width_mm;
  ReliefOptions sized = options;
  if (!options.diameter_mm && !options.plate_mm) {
    most_mm.reset();
    return with_height(model().surface(), std::move(sized));
  }
  std::vector<double> sizes = plate_sizes(options);
  if (sizes != state_->sizes || !most_mm) {
    sized.width_mm.reset();
    const auto largest = relievo::with_width(model().surface(), sized);
    if (!largest)
      return relievo::with_width(model().surface(),
                                 options);  // this call's error names the requested width
    state_->sizes = std::move(sizes);
    most_mm = largest->width_mm;
  }
  sized.width_mm = options.width_mm.value_or(*most_mm);
  if (*sized.width_mm > *most_mm)
    return relievo::with_width(model().surface(), sized);  // this call's error says why the width is refused
  return with_height(model().surface(), std::move(sized));
}

std::optional<double> LiveModel::most_width_mm() const {
  return state_->most_width_mm;
}

double LiveModel::mm_per_unit(const ReliefOptions& options) const {
  return options.effective_width_mm() / state_->longer_side;
}

LiveFrame LiveModel::make_frame(const ReliefOptions& options, const FrameWish& wish) {
  FrameOptions wanted = state_->frame_options(options);
  const double scale = mm_per_unit(options);
  if (wish.u)
    wanted.shape.compression.u = *wish.u;
  else if (options.height_mm)
    wanted.height = *options.height_mm / scale;
  if (!wish.is_quick || !wanted.height || state_->made == wanted) return state_->make(wanted, scale);
  wanted.height_tolerance = moving_tolerance;
  LiveFrame made = state_->make(wanted, scale);
  if (made.frame->is_height_met) made.stretch = *wanted.height / made.frame->height;
  return state_->last = made;
}

LiveFrame LiveModel::last_frame() const {
  return state_->last;
}

double LiveModel::highest_mm(const ReliefOptions& options) {
  FrameOptions wanted = state_->frame_options(options);
  wanted.shape.compression.u = uncompressed_u;
  state_->frames().make(wanted, state_->highest);
  return state_->highest.height * mm_per_unit(options);
}

Shown LiveModel::shown(const LiveFrame& made) const {
  const Frame& frame = *made.frame;
  return {frame.heights,
          frame.normals,
          static_cast<float>(made.stretch),
          {{frame.lowest, frame.highest}},
          state_->shown.detail.get(),
          made.gains};
}

Result<PlacedRelief> LiveModel::draw_on_plate(const LiveFrame& made, const ReliefOptions& options,
                                              const RenderOptions& render, Picture& picture,
                                              const Progress* progress) {
  RELIEVO_CHECK(relievo::check(options));
  if (!state_->shown.detail) RELIEVO_CHECK(check_model(model(), options));
  ReliefOptions quick = options;  // the draft angle stays, because the rim's bevel depends on it
  quick.tolerance_mm = quick.triangles = std::nullopt;
  quick.tool = std::nullopt;
  quick.finish = Finish::full;
  const double height_mm = made.frame->height * made.mm_per_unit * made.stretch;
  PlateOptions plate = plate_of(quick, height_mm);
  plate.ornaments.clear();
  return renderer().render_on(plate, shown(made), render, picture, progress);
}

RenderOptions LiveModel::with_lengths(RenderOptions render, const ReliefOptions& options) const {
  render.mm_per_unit = mm_per_unit(options);
  render.margin_mm = options.effective_margin_mm();
  render.thickness_mm = options.effective_thickness_mm();
  return render;
}

FrameRenderer& LiveModel::renderer() {
  if (!state_->renderer) state_->renderer.emplace(state_->shown.model);
  return *state_->renderer;
}

Result<void> check(const RenderOptions& options) {
  const Camera& camera = options.camera;
  const auto is_within = [](double x, double min, double max) { return x >= min && x <= max; };
  if (!is_within(options.width, 1, 8192)) return option_error("width", "expected 1 to 8192 pixels");
  if (!is_within(options.height, 1, 8192)) return option_error("height", "expected 1 to 8192 pixels");
  if (!is_within(camera.yaw_deg, -360, 360)) return option_error("yaw_deg", "expected -360 to 360");
  if (!is_within(camera.pitch_deg, -90, 90)) return option_error("pitch_deg", "expected -90 to 90");
  if (!is_within(camera.zoom, .05, 100)) return option_error("zoom", "expected 0.05 to 100");
  if (is_within(camera.pan.cwiseAbs().maxCoeff(), 0, 1e6)) return {};
  return option_error("x", "expected x and y within a million mm");
}

Result<Job> load(std::span<const std::byte> file, std::string_view name) {
  return within_memory([&]() -> Result<Job> {
    RELIEVO_TRY(CloudFile scan, read_cloud(file, name));
    SceneModel model{std::string(name), nullptr};
    for (const std::string& line : remarks_on(scan)) model.remarks.push_back(cat(name, ": ", line));
    model.file = std::make_shared<const CloudFile>(std::move(scan));
    return Job{{{std::move(model)}}};
  });
}

Result<SampledModel> prepare_sampled(Job job, Progress* progress) {
  return within_memory([&]() -> Result<SampledModel> {
    const View view = chosen_view(job.inputs, job.options.effective_view());
    RELIEVO_TRY(ViewSample sample, sample_for_view(job.inputs, view, job.options.points, progress));
    job.inputs = {};
    RELIEVO_TRY(ReliefModel model,
                prepare_owned(std::move(sample.cloud), view, job.options.effective_model(), progress));
    return SampledModel{std::move(model), std::move(sample.notes)};
  });
}

Result<LiveModel> prepare(const Job& job, Progress* progress) {
  RELIEVO_TRY(SampledModel made, prepare_sampled(job, progress));
  return LiveModel(ShownModel{std::make_shared<const ReliefModel>(std::move(made.model))},
                   std::move(made.notes));
}

}  // namespace relievo
