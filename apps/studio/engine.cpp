#include "engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "relievo/parallel.h"
#include "relievo/preview.h"
#include "relievo/text.h"

namespace relievo::studio {
namespace {

using namespace std::chrono_literals;

std::unexpected<Error> nothing_open() {
  return std::unexpected(Error{ErrorKind::geometry, {}, {}, "expected a scan to be open"});
}

struct Opening {
  Input input;
  View view;
};

// What is known of the scan that is open.
struct Scan {
  Input input;
  std::shared_ptr<const Cloud> cloud;
  std::size_t left_out = 0;
};

struct Shared {
  std::optional<Opening> opening;
  Input wanted;
  std::string view, up;
  bool is_reading = false;
  bool is_cancelled = false;
  std::optional<Error> error;
  Scan scan;    // the newest that was read
  Input shown;  // of the model that is shown
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

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Result<ExportedFile> file_of(const Solid& solid, const std::string& format, int heightmap_px) {
  if (format == "stl") return ExportedFile{text_of(write_stl(solid)), "model/stl"};
  if (format == "ply") return ExportedFile{text_of(write_ply(solid)), "application/octet-stream"};
  if (format == "obj") return ExportedFile{text_of(write_obj(solid)), "model/obj"};
  if (format == "preview") return ExportedFile{text_of(write_png(render_preview(solid, {}))), "image/png"};
  const HeightMap map = make_height_map(solid, heightmap_px);
  const std::pair<std::string, std::string> scale[] = {{"mm_per_pixel", cat(map.mm_per_pixel)},
                                                       {"mm_per_grey", cat(map.mm_per_grey)}};
  return ExportedFile{text_of(write_png(map.image, scale, map.mm_per_pixel)), "image/png"};
}

bool is_format(const std::string& format) {
  for (const char* known : {"stl", "ply", "obj", "heightmap", "preview"})
    if (format == known) return true;
  return false;
}

}  // namespace

struct Engine::State {
  Session session;
  Guarded<Shared> shared;

  std::mutex drawing;  // guards what follows
  std::uint64_t drawn_model = 0;
  std::optional<FrameRenderer> renderer;
  std::shared_ptr<const Cloud> drawn_cloud;
  std::optional<CloudRenderer> cloud_renderer;

  BackgroundLoop loop{[this] { return read(); }};  // last: it starts when all else is there

  bool read() {
    auto opening = shared.with([](Shared& s) {
      if (s.opening) s.is_reading = true;
      return std::exchange(s.opening, std::nullopt);
    });
    if (!opening) return false;
    Result<Cloud> cloud = load_input(opening->input, {});
    if (cloud && cloud->size() > 0) {
      const std::vector<Index> strays = far_points(*cloud);
      Scan scan{opening->input, nullptr, strays.size()};
      scan.cloud =
          std::make_shared<const Cloud>(strays.empty() ? std::move(*cloud) : without(*cloud, strays));
      hand_over(std::move(scan), opening->view);
    }
    shared.with([&](Shared& s) {
      s.is_reading = false;
      if (!cloud) s.error = cloud.error();
    });
    return true;
  }

  void hand_over(Scan scan, const View& view) {
    const bool is_wanted = shared.with([&](Shared& s) {
      if (s.is_cancelled || s.opening) return false;
      s.scan = scan;
      return true;
    });
    if (is_wanted) session.open(scan.cloud, view);
  }

  // Notices a model that has become ready since the last call.
  std::shared_ptr<const ReliefModel> model() {
    const std::shared_ptr<const ReliefModel> newest = session.model();
    shared.with([&](Shared& s) {
      if (newest == s.model) return;
      s.model = newest;
      s.shown = s.scan.input;
      ++s.models;
    });
    return newest;
  }

  // With `drawing` held.
  FrameRenderer& renderer_for(const std::shared_ptr<const ReliefModel>& ready) {
    const std::uint64_t number = shared.with([](const Shared& s) { return s.models; });
    if (!renderer || drawn_model != number) renderer.emplace(ready);
    drawn_model = number;
    return *renderer;
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
  const Scan scan = state_->shared.with([&](Shared& s) {
    s.error = std::nullopt;
    s.is_cancelled = false;
    s.view = view;
    s.up = up;
    return s.scan;
  });
  if (!scan.cloud) return nothing_open();
  state_->session.open(scan.cloud, *parsed);
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
                        s.shown,
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
  const std::size_t left_out = state_->shared.with([](const Shared& s) { return s.scan.left_out; });
  if (left_out > 0) facts.remarks.push_back(cat("Left out ", left_out, " points far from all others."));
  return facts;
}

namespace {

Result<FrameOptions> frame_options(const PictureRequest& request, double scale) {
  const Result<Shape> shape = shape_of(request.options);
  if (!shape) return std::unexpected(shape.error());
  FrameOptions options;
  options.shape = *shape;
  options.light = request.render.light;
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

// The frame asked for; while another view is prepared, the last one of the old.
std::shared_ptr<const Frame> frame_for(Session& session, const FrameOptions& options, std::size_t points) {
  const bool is_preparing = session.status().is_preparing;
  if (!is_preparing) {
    session.request(options);
    session.wait_until_idle(10s);
  }
  std::shared_ptr<const Frame> frame = session.frame();
  return frame && frame->heights.size() == points ? frame : nullptr;
}

}  // namespace

Result<PictureAnswer> Engine::picture(const PictureRequest& request) {
  const std::lock_guard turn(state_->drawing);
  const std::shared_ptr<const ReliefModel> model = state_->model();
  if (!model) return nothing_open();
  const double scale = mm_per_unit(model->surface(), request.options);
  const Result<FrameOptions> wanted = frame_options(request, scale);
  if (!wanted) return std::unexpected(wanted.error());
  const auto frame = frame_for(state_->session, *wanted, model->surface().points.size());
  if (!frame) return nothing_open();

  const auto start = std::chrono::steady_clock::now();
  FrameRenderer& renderer = state_->renderer_for(model);
  const Shown shown = request.is_original ? renderer.original() : Shown{frame->heights, frame->normals};
  PictureAnswer answer;
  RenderOptions render = render_options(request, scale);
  render.has_shadows = !request.is_original;  // the model's own depth would bury the ground in them
  renderer.render(shown, render, answer.picture);
  answer.drawing_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  answer.compression = frame->options.shape.compression;
  answer.height_mm = frame->height * scale;
  answer.is_height_met = frame->is_height_met;
  answer.times = frame->times;
  return answer;
}

Result<std::vector<float>> Engine::profile(const PictureRequest& request, const Vec2& from, const Vec2& to,
                                           std::size_t samples) {
  const std::lock_guard turn(state_->drawing);
  const std::shared_ptr<const ReliefModel> model = state_->model();
  if (!model) return nothing_open();
  const double scale = mm_per_unit(model->surface(), request.options);
  const Result<FrameOptions> wanted = frame_options(request, scale);
  if (!wanted) return std::unexpected(wanted.error());
  const auto frame = frame_for(state_->session, *wanted, model->surface().points.size());
  if (!frame) return nothing_open();
  FrameRenderer& renderer = state_->renderer_for(model);
  const Shown shown = request.is_original ? renderer.original() : Shown{frame->heights, frame->normals};
  return renderer.profile(shown, render_options(request, scale), from, to, samples);
}

Result<Picture> Engine::scan_picture(const View& view, int width, int height) {
  const std::lock_guard turn(state_->drawing);
  const auto cloud = state_->shared.with([](const Shared& s) { return s.scan.cloud; });
  if (!cloud) return nothing_open();
  if (cloud != state_->drawn_cloud) state_->cloud_renderer.emplace(*cloud);
  state_->drawn_cloud = cloud;
  Picture picture;
  state_->cloud_renderer->render(view, width, height, picture);
  return picture;
}

Result<std::vector<std::string>> Engine::suggest_views() {
  const auto cloud = state_->shared.with([](const Shared& s) { return s.scan.cloud; });
  if (!cloud) return nothing_open();
  std::vector<std::string> names;
  for (const ViewGuess& guess : rank_views(*cloud)) names.emplace_back(guess.name);
  return names;
}

Result<ExportedFile> Engine::make_file(const ReliefOptions& options, const std::string& format,
                                       int heightmap_px) {
  if (!is_format(format))
    return std::unexpected(Error{ErrorKind::option,
                                 "format",
                                 {},
                                 cat("expected stl, ply, obj, heightmap or preview, found '", format, "'")});
  const std::shared_ptr<const ReliefModel> model = state_->model();
  if (!model) return nothing_open();
  const Result<View> view = parse_view(options.view, options.up);
  if (!view) return std::unexpected(view.error());
  if (view->rotation != model->surface().view.rotation)
    return std::unexpected(
        Error{ErrorKind::option, "view", {}, "expected the view that is shown; it is still being prepared"});
  const Result<MadeRelief> made = make_relief(*model, options);
  if (!made) return std::unexpected(made.error());
  return file_of(made->solid, format, heightmap_px);
}

}  // namespace relievo::studio
