#include "engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "live_frames.h"
#include "loaded_scan.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

namespace relievo::studio {
namespace {

std::unexpected<Error> nothing_open() {
  return std::unexpected(Error{ErrorKind::geometry, {}, {}, "expected a scan to be open"});
}

struct Opening {
  Input input;
  View view;
};

struct Shared {
  std::optional<Opening> opening;
  Input wanted;
  std::string view, up;
  bool is_reading = false;
  bool is_cancelled = false;
  std::optional<Error> error;
  OpenScan scan;   // the newest that was read
  OpenScan shown;  // of the model that is shown
  std::uint64_t models = 0;
  std::shared_ptr<const ReliefModel> model;
};

std::vector<std::size_t> histogram_of(const std::vector<float>& k) {
  std::vector<std::size_t> counts(64);
  for (const float value : k) {
    const auto bin = static_cast<std::size_t>(std::sqrt(std::abs(value)) * 64);
    ++counts[std::min<std::size_t>(bin, counts.size() - 1)];
  }
  return counts;
}

}  // namespace

struct Engine::State {
  Session session;
  Guarded<Shared> shared;

  std::mutex drawing;  // guards what follows
  std::uint64_t drawn_model = 0;
  std::optional<FrameRenderer> renderer;
  LiveFrames frames{session};
  std::shared_ptr<const Cloud> drawn_cloud;
  std::optional<CloudRenderer> cloud_renderer;

  BackgroundLoop loop{[this] { return read(); }};  // last: it starts when all else is there

  bool read() {
    auto opening = shared.with([](Shared& s) {
      if (s.opening) s.is_reading = true;
      return std::exchange(s.opening, std::nullopt);
    });
    if (!opening) return false;
    Result<Scene> scene = load_input(opening->input, {});
    Result<void> done;
    if (!scene)
      done = std::unexpected(scene.error());
    else
      done = hand_over(OpenScan(opening->input, std::move(*scene)), opening->view);
    shared.with([&](Shared& s) {
      s.is_reading = false;
      if (!done) s.error = done.error();
    });
    return true;
  }

  Result<void> hand_over(OpenScan scan, const View& view) {
    const auto seen = scan.seen_from(view);
    if (!seen) return std::unexpected(seen.error());
    const bool is_wanted = shared.with([&](Shared& s) {
      if (s.is_cancelled || s.opening) return false;
      s.scan = scan;
      return true;
    });
    if (is_wanted) session.open(*seen, view);
    return {};
  }

  // Notices a model that has become ready since the last call.
  std::shared_ptr<const ReliefModel> model() {
    const std::shared_ptr<const ReliefModel> newest = session.model();
    shared.with([&](Shared& s) {
      if (newest == s.model) return;
      s.model = newest;
      s.shown = s.scan;
      ++s.models;
    });
    return newest;
  }

  // The scan that was read last, or the one that is shown if that came to nothing.
  OpenScan scan_in_use() {
    model();
    const SessionStatus status = session.status();
    return shared.with([&](const Shared& s) {
      const bool has_failed = !status.is_preparing && (status.error || s.error);
      return has_failed && s.shown.cloud() ? s.shown : s.scan;
    });
  }

  // With `drawing` held: the model, ready to be drawn; null before the first.
  std::shared_ptr<const ReliefModel> model_to_draw() {
    std::shared_ptr<const ReliefModel> ready = model();
    const std::uint64_t number = shared.with([](const Shared& s) { return s.models; });
    if (!ready || (renderer && drawn_model == number)) return ready;
    renderer.emplace(ready);
    frames.forget();
    drawn_model = number;
    return ready;
  }
};

Engine::Engine() : state_(std::make_unique<State>()) {}
Engine::~Engine() = default;

void Engine::open(const Input& input, const std::string& view, const std::string& up) {
  const Result<View> parsed = parse_view(view, up);
  state_->session.cancel();
  state_->shared.with([&](Shared& s) {
    s.error = std::nullopt;
    s.is_cancelled = false;
    s.opening = Opening{input, parsed.value_or(View{})};
    s.wanted = input;
    s.view = view;
    s.up = up;
  });
  state_->loop.wake();
}

Result<void> Engine::choose_view(const std::string& view, const std::string& up) {
  const Result<View> parsed = parse_view(view, up);
  if (!parsed) return std::unexpected(parsed.error());
  const OpenScan scan = state_->scan_in_use();
  state_->shared.with([&](Shared& s) {
    s.error = std::nullopt;
    s.is_cancelled = false;
    s.view = view;
    s.up = up;
    s.scan = scan;
  });
  if (!scan.cloud()) return nothing_open();
  const auto seen = scan.seen_from(*parsed);
  if (!seen) return std::unexpected(seen.error());
  state_->session.open(*seen, *parsed);
  return {};
}

void Engine::cancel() {
  state_->shared.with([](Shared& s) {
    s.is_cancelled = true;
    s.opening = std::nullopt;
  });
  state_->session.cancel();
}

EngineStatus Engine::status() const {
  state_->model();
  const SessionStatus session = state_->session.status();
  return state_->shared.with([&](const Shared& s) {
    EngineStatus status{session.is_preparing,
                        session.stage,
                        session.fraction,
                        session.error,
                        s.shown.input(),
                        s.wanted,
                        s.view,
                        s.up,
                        s.models};
    if (s.is_reading || s.opening) {
      status.is_busy = true;
      status.stage = "read";
      status.fraction = 0;
    }
    if (s.error) status.error = s.error;
    if (s.is_cancelled) status.error = Error{ErrorKind::cancelled, {}, {}, "cancelled"};
    if (status.is_busy) status.error = std::nullopt;  // that of an older attempt
    return status;
  });
}

Result<ModelFacts> Engine::facts() const {
  const std::shared_ptr<const ReliefModel> model = state_->model();
  if (!model) return nothing_open();
  const Surface& surface = model->surface();
  ModelFacts facts;
  facts.input_points = surface.input_points;
  facts.visible_points = surface.visible_points;
  facts.points = surface.points.size();
  facts.triangles = surface.triangulation.triangles.size();
  facts.hull = surface.triangulation.hull.size();
  Box box;
  for (const Vec3& p : surface.points) box.extend(p);
  facts.size = box.size().head<2>();
  facts.rho = surface.rho;
  facts.delta = surface.curvature.delta;
  facts.rotation = surface.view.rotation;
  facts.histogram = histogram_of(surface.curvature.k);
  if (surface.has_estimated_normals) facts.remarks.push_back("The scan has no normals: they were estimated.");
  if (surface.has_flipped_normals)
    facts.remarks.push_back("The scan's normals point inwards: they were turned.");
  const std::size_t left_out = state_->shared.with([](const Shared& s) { return s.shown.left_out(); });
  if (left_out > 0) facts.remarks.push_back(cat("Left out ", left_out, " points far from all others."));
  return facts;
}

namespace {

Result<FrameOptions> frame_options(const PictureRequest& request, double scale) {
  const Result<Shape> shape = shape_of(request.options);
  if (!shape) return std::unexpected(shape.error());
  FrameOptions options;
  options.shape = *shape;
  if (request.u)
    options.shape.compression.u = *request.u;
  else if (request.options.height_mm)
    options.height = *request.options.height_mm / scale;
  return options;
}

RenderOptions render_options(const PictureRequest& request, double scale) {
  RenderOptions render = request.render;
  render.mm_per_unit = scale;
  render.margin_mm = request.options.margin_mm;
  render.thickness_mm = request.options.thickness_mm;
  return render;
}

}  // namespace

Result<PictureAnswer> Engine::picture(const PictureRequest& request) {
  const std::lock_guard turn(state_->drawing);
  const std::shared_ptr<const ReliefModel> model = state_->model_to_draw();
  if (!model) return nothing_open();
  const double scale = mm_per_unit(model->surface(), request.options);
  const Result<FrameOptions> wanted = frame_options(request, scale);
  if (!wanted) return std::unexpected(wanted.error());
  const std::size_t points = model->surface().points.size();
  const auto [frame, stretch, is_new] =
      request.render.is_fine ? state_->frames.exact(*wanted, points) : state_->frames.quick(*wanted, points);
  if (!frame) return nothing_open();

  const auto start = std::chrono::steady_clock::now();
  FrameRenderer& renderer = *state_->renderer;
  const Shown shown = request.is_original
                          ? renderer.original()
                          : Shown{frame->heights, frame->normals, static_cast<float>(stretch)};
  PictureAnswer answer;
  RenderOptions render = render_options(request, scale);
  render.has_shadows = !request.is_original;  // the model's own depth would bury the ground in them
  renderer.render(shown, render, answer.picture);
  answer.drawing_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  answer.compression = frame->options.shape.compression;
  answer.height_mm = frame->height * stretch * scale;
  answer.is_height_met = frame->is_height_met;
  if (is_new) answer.times = frame->times;
  return answer;
}

Result<std::vector<float>> Engine::profile(const PictureRequest& request, const Vec2& from, const Vec2& to,
                                           std::size_t samples) {
  const std::lock_guard turn(state_->drawing);
  const std::shared_ptr<const ReliefModel> model = state_->model_to_draw();
  if (!model) return nothing_open();
  const double scale = mm_per_unit(model->surface(), request.options);
  const Result<FrameOptions> wanted = frame_options(request, scale);
  if (!wanted) return std::unexpected(wanted.error());
  const auto frame = state_->frames.exact(*wanted, model->surface().points.size()).frame;
  if (!frame) return nothing_open();
  FrameRenderer& renderer = *state_->renderer;
  const Shown shown = request.is_original ? renderer.original() : Shown{frame->heights, frame->normals};
  return renderer.profile(shown, render_options(request, scale), from, to, samples);
}

Result<Picture> Engine::scan_picture(const View& view, int width, int height) {
  const std::lock_guard turn(state_->drawing);
  const auto cloud = state_->scan_in_use().cloud();
  if (!cloud) return nothing_open();
  if (cloud != state_->drawn_cloud) state_->cloud_renderer.emplace(*cloud);
  state_->drawn_cloud = cloud;
  Picture picture;
  state_->cloud_renderer->render(view, width, height, picture);
  return picture;
}

Result<std::vector<std::string>> Engine::suggest_views() {
  const auto cloud = state_->scan_in_use().cloud();
  if (!cloud) return nothing_open();
  std::vector<std::string> names;
  for (const ViewGuess& guess : rank_views(*cloud)) names.emplace_back(guess.name);
  return names;
}

Result<ExportedFile> Engine::make_file(const ReliefOptions& options, const std::string& format,
                                       int heightmap_px) {
  if (!is_format(format))
    return std::unexpected(
        Error{ErrorKind::option,
              "format",
              {},
              cat("expected stl, 3mf, ply, obj, heightmap, tiff or preview, found '", format, "'")});
  const std::shared_ptr<const ReliefModel> model = state_->model();
  if (!model) return nothing_open();
  const Result<View> view = parse_view(options.view, options.up);
  if (!view) return std::unexpected(view.error());
  if (view->rotation != model->surface().view.rotation)
    return std::unexpected(
        Error{ErrorKind::option, "view", {}, "expected the view that is shown; it is still being prepared"});
  const Result<Mode> mode = parse_mode(options.mode);
  if (!mode) return std::unexpected(mode.error());
  if ((settle(*mode, model->surface()) == Mode::subspace) != (model->subspace() != nullptr))
    return std::unexpected(Error{ErrorKind::option, "mode", {}, "expected auto, as the model was prepared"});
  const Result<MadeRelief> made = make_relief(*model, options);
  if (!made) return std::unexpected(made.error());
  return export_file(*made, format, heightmap_px);
}

}  // namespace relievo::studio
