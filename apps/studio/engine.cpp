#include "studio/engine.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <utility>

#include "relievo/core/parallel.h"
#include "relievo/core/within_memory.h"
#include "relievo/scan/surface.h"
#include "relievo/session.h"
#include "studio/loaded_scan.h"
#include "studio/model_points.h"

namespace relievo::app::studio {
namespace {

std::unexpected<Error> nothing_open() {
  return std::unexpected(Error{ErrorKind::geometry, {}, {}, "expected a scan to be open"});
}

// Ignores the error of a cancelled piece, so that the picture is drawn without that piece.
Result<void> unless_cancelled(const Error& error) {
  return error.kind == ErrorKind::cancelled ? Result<void>{} : std::unexpected(error);
}

// Returns a number that no other model has, in this run or another: the time in milliseconds, or a larger
// number.
std::uint64_t new_model_number() {
  using std::chrono::duration_cast, std::chrono::milliseconds, std::chrono::system_clock;
  static std::atomic<std::uint64_t> next =
      static_cast<std::uint64_t>(duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count());
  return next++;
}

struct PreparedScan : NumberedModel {
  LoadedScan scan;
};

struct Shared {
  ScanSource wanted;           // the scan that was requested last
  std::uint64_t openings = 0;  // number of scans that were opened
  OptionValues view;
  std::optional<ViewGuess> best;            // the side that was chosen, if the view is "auto"
  std::shared_ptr<const ScanOrder> unread;  // the scan that was requested but is not read yet
  LoadedScan scan;                          // the scan that was read last
  PreparedScan shown;
};

}  // namespace

struct Engine::State {
  explicit State(const std::function<void()>& report_change) : changed(report_change), maker(report_change) {}

  std::function<void()> changed;
  // Lock order: the session calls Preparation::ready while its own mutex is locked, and ready() locks `shared`. So a
  // thread that has locked `shared` must not call the session.
  Guarded<Shared> shared;

  Guarded<std::shared_ptr<Progress>>
      at_rest;  // progress of pictures with is_at_rest or is_finished; null after other pictures

  PieceMaker maker;

  Mutex drawing_mutex;  // guards the members up to the next mutex
  std::optional<Drawing> drawing;
  std::uint64_t drawn_model = 0;
  // The view for which `turned` was made, and Shared::openings at that time.
  std::optional<std::pair<View, std::uint64_t>> turned_of;
  std::optional<Drawing> turned;  // the turned relief that is drawn while the user turns the model
  Mutex scan_mutex;               // guards the members up to the session
  std::shared_ptr<const Cloud> drawn_cloud;
  std::optional<CloudRenderer> cloud_renderer;

  Session session;  // declared last, because its thread uses the members above

  // Returns the description of the next preparation: the scan that was requested last, in the view of the options.
  Preparation preparation_of(const ReliefOptions& options) {
    Preparation preparation;
    const auto chosen = std::make_shared<View>(options.effective_view());
    preparation.points = [this, chosen, number = options.points](Progress& progress) {
      return points(*chosen, number, progress);
    };
    preparation.chosen_view = [chosen] { return *chosen; };
    preparation.all_sides = [this, chosen](Progress&) -> Preparation::Points {
      return shared.with([](const Shared& s) { return s.scan; }).all_sides(*chosen);
    };
    preparation.makes_first_relief = !changed;  // without threads no picture of it could be requested
    preparation.model = options.effective_model();
    preparation.ready = [this](const Preparation::Model& model) {
      shared.with([&](Shared& s) { s.shown = {{model, new_model_number()}, s.scan}; });
    };
    preparation.changed = changed;
    return preparation;
  }

  // Runs in the session's thread. Reads the scan if necessary, and returns the points that the view shows. If
  // the side is still to be chosen, sets `view` to the best side.
  Preparation::Points points(View& view, std::optional<double> number, Progress& progress) {
    if (auto done = read(progress); !done) return std::unexpected(done.error());
    const LoadedScan scan = shared.with([](const Shared& s) { return s.scan; });
    if (auto go = progress.stage("view", 0); !go) return std::unexpected(go.error());
    if (view.is_best) {
      const ViewGuess best = best_side(scan.scene());
      view = on_side(view, best);
      shared.with([&](Shared& s) { s.best = best; });
    }
    return scan.seen_from(view, number, &progress);
  }

  Result<void> read(Progress& progress) {
    const auto unread = shared.with([](const Shared& s) { return s.unread; });
    if (!unread) return {};
    if (auto go = progress.stage("read", 0); !go) return go;
    // If the user chooses another view, the preparation is cancelled, but the reading continues.
    const auto is_unwanted = [&] { return shared.with([&](const Shared& s) { return s.unread != unread; }); };
    Result<LoadedScan> scan = read_scan(*unread, is_unwanted);
    const bool is_wanted = shared.with([&](Shared& s) {
      if (s.unread != unread) return false;  // another scan was opened meanwhile, or this one was cancelled
      s.unread = nullptr;
      if (scan) s.scan = std::move(*scan);
      return true;
    });
    if (!is_wanted) return cancelled_error();
    return scan ? Result<void>{} : std::unexpected(std::move(scan).error());
  }

  NumberedModel shown_model() const {
    return shared.with([](const Shared& s) { return NumberedModel(s.shown); });
  }

  // Returns the scan that was read last or, if no relief could be made of it, the scan that the page shows.
  LoadedScan scan_in_use() {
    const SessionStatus status = session.status();
    const bool has_failed = !status.is_preparing && status.error;
    return shared.with([&](Shared& s) {
      if (has_failed && s.shown.scan.cloud()) s.scan = LoadedScan(s.shown.scan);
      return s.scan;
    });
  }

  // Draws the model in a view that is not prepared yet. The turned relief is made once per view, and is then
  // used until the view is prepared, even if options change. While the turned relief is made, other pictures
  // can be drawn, and a request for another view cancels the making.
  Result<PictureAnswer> turned_picture(const PictureRequest& request) {
    // The values of `drawn_model` and Shared::openings when the making of `relief` began.
    std::uint64_t model = 0, opening = 0;
    for (std::optional<ShownModel> relief;;) {
      {
        const Lock lock(drawing_mutex);
        RELIEVO_CHECK(check_cancelled(request.progress.get()));
        const auto [newest, scan] =
            shared.with([](const Shared& s) { return std::pair(s.openings, s.scan); });
        if (relief && model == drawn_model && opening == newest) {
          turned.emplace(*std::move(relief), scan.left_out(), scan.remarks());
          turned_of.emplace(*request.turned, opening);
        }
        model = drawn_model;
        opening = newest;
        if (turned && turned_of == std::pair(*request.turned, newest)) return turned->picture(request);
      }
      RELIEVO_TRY(relief, session.turn(*request.turned));
    }
  }

  // Returns the drawing of the shown model; null before the first model. While another view is being
  // prepared, the drawing is frozen, so that the preparation gets the processor. The caller has locked
  // `drawing_mutex`.
  Drawing* current_drawing() {
    const bool is_preparing = session.status().is_preparing;
    const PreparedScan shown = shared.with([](const Shared& s) { return s.shown; });
    if (!shown.model) return nullptr;
    if (drawn_model != shown.number) {
      drawing.emplace(ShownModel{shown.model}, shown.scan.left_out(), shown.scan.remarks());
      turned.reset();
    }
    drawn_model = shown.number;
    drawing->freeze(is_preparing);
    return &*drawing;
  }

  // Calls f with the current drawing, and returns its result. Errors: kind geometry before the first model;
  // kind memory.
  template <typename F>
  std::invoke_result_t<F, Drawing&> with_drawing(F&& f) {
    return within_memory([&]() -> std::invoke_result_t<F, Drawing&> {
      const Lock lock(drawing_mutex);
      Drawing* const now = current_drawing();
      if (!now) return nothing_open();
      return f(*now);
    });
  }
};

Engine::Engine(const std::function<void()>& changed) : state_(std::make_unique<State>(changed)) {}
Engine::~Engine() = default;

void Engine::open(const ScanSource& input, const OptionValues& view) {
  // If the view's options are wrong, the next picture reports the error.
  Preparation preparation = state_->preparation_of(parse_options(view).value_or(ReliefOptions{}));
  preparation.is_of_other_scan = true;
  const auto unread = std::make_shared<const ScanOrder>(input, reading_of(view));
  state_->shared.with([&, wanted = input, values = view](Shared& s) mutable {
    s.unread = unread;
    s.wanted = std::move(wanted);
    s.view = std::move(values);
    s.best.reset();
  });
  state_->session.open(std::move(preparation));
  // The session has stopped showing the previous scan: a turned relief with this number is of the new scan.
  state_->shared.with([](Shared& s) { ++s.openings; });
}

void Engine::show(const ScanSource& input, const OptionValues& view) {
  const SessionStatus session = state_->session.status();
  const auto [is_open, has_view] = state_->shared.with([&](const Shared& s) {
    return std::pair(is_same(s.wanted, input), s.view == view || with_side(s.view, s.best) == view);
  });
  if (!is_open || session.error)
    open(input, view);
  else if (!has_view)
    (void)choose_view(view);  // if the view's options are wrong, the next picture reports the error
}

Result<void> Engine::choose_view(const OptionValues& view) {
  RELIEVO_TRY(const ReliefOptions options, parse_options(view));
  RELIEVO_CHECK(parse_depth(view));
  const InputArguments how = reading_of(view);
  const LoadedScan scan = state_->scan_in_use();
  Preparation preparation = state_->preparation_of(options);
  const bool is_open = state_->shared.with([&, values = view](Shared& s) mutable {
    s.view = std::move(values);
    s.best.reset();
    if (s.unread ? s.unread->how != how : scan.depends_on(how))
      s.unread = std::make_shared<const ScanOrder>(s.unread ? s.unread->input : scan.input(), how);
    return scan.cloud() || s.unread;
  });
  if (!is_open) return nothing_open();
  state_->session.open(std::move(preparation));
  return {};
}

// Cancels the session, and frees a scan of which no relief was made. The session is cancelled first, so that
// its thread does not go on without the scan.
void Engine::cancel() {
  state_->session.cancel();
  state_->shared.with([](Shared& s) {
    s.unread = nullptr;
    s.scan = LoadedScan(s.shown.scan);
  });
}

bool Engine::is_idle() {
  return state_->session.wait_until_idle(std::chrono::milliseconds(0));
}

void Engine::work() {
  while (!state_->session.wait_until_idle(std::chrono::hours(1))) {
  }
}

EngineStatus Engine::status() const {
  const SessionStatus session = state_->session.status();
  const PieceMaker::Stage making = state_->maker.stage();
  return state_->shared.with([&](const Shared& s) {
    return EngineStatus{
        session.is_preparing,      session.stage, session.fraction, session.error,  s.shown.scan.input(),
        with_side(s.view, s.best), making.name,   making.fraction,  s.shown.number, session.can_turn};
  });
}

Result<ModelFacts> Engine::facts() {
  return state_->with_drawing([](Drawing& drawing) -> Result<ModelFacts> { return drawing.facts(); });
}

// Computes the largest height that the draft angle allows, if the options have one. Meanwhile other pictures
// can be drawn.
Result<void> Engine::find_draft_limit(PictureRequest& request, PieceUse use) {
  if (!request.options.draft_deg) return {};
  const NumberedModel shown = state_->shown_model();
  if (!shown.model) return nothing_open();
  RELIEVO_TRY(request.draft_limit_mm, state_->maker.draft_limit(use, shown, request.options));
  return {};
}

// Makes the finished piece that a picture is to show. Meanwhile other pictures can be drawn.
Result<void> Engine::finish(PictureRequest& request) {
  // While another model is being prepared, no piece is made, because the page will request the piece of the
  // new model.
  if (request.turned || state_->session.status().is_preparing) return {};
  if (auto known = find_draft_limit(request, PieceUse::picture); !known)
    return unless_cancelled(known.error());
  RELIEVO_CHECK(check_cancelled(request.progress.get()));  // the picture may be cancelled by now
  std::uint64_t model = 0;
  RELIEVO_TRY(const std::optional<ReliefOptions> missing, state_->with_drawing([&](Drawing& drawing) {
    model = state_->drawn_model;
    return drawing.missing_piece(request);
  }));
  if (!missing) return {};
  auto made = piece(*missing, PieceUse::picture);
  if (!made && leave_out_ornaments(request, made.error())) return finish(request);
  if (!made) return unless_cancelled(made.error());
  return state_->with_drawing([&](Drawing& drawing) -> Result<void> {
    if (state_->drawn_model == model) drawing.take(std::move(*made), *missing);
    return {};
  });
}

Result<PictureAnswer> Engine::picture(PictureRequest request) {
  const bool is_at_rest = request.is_finished || request.is_at_rest;
  state_->at_rest.with([&](std::shared_ptr<Progress>& progress) {
    if (!is_at_rest && progress) std::exchange(progress, nullptr)->cancel();
    if (is_at_rest && !progress) progress = std::make_shared<Progress>();
    request.progress = progress;
  });
  if (request.is_finished) {
    RELIEVO_CHECK(finish(request));
  } else {
    state_->maker.cancel(PieceUse::picture);
    if (request.options.draft_deg)
      request.draft_limit_mm = state_->maker.known_draft_limit(state_->shown_model(), request.options);
  }
  if (request.turned) return state_->turned_picture(request);
  return state_->with_drawing([&](Drawing& drawing) -> Result<PictureAnswer> {
    RELIEVO_CHECK(check_cancelled(request.progress.get()));
    return drawing.picture(std::move(request));
  });
}

Result<std::vector<float>> Engine::profile(PictureRequest request, const SectionLine& line) {
  if (request.options.rim_mm)  // the check of the rim's bevel needs the height that the draft angle allows
    if (auto known = find_draft_limit(request, PieceUse::entry); !known)
      RELIEVO_CHECK(unless_cancelled(known.error()));
  return state_->with_drawing([&](Drawing& drawing) { return drawing.profile(std::move(request), line); });
}

Result<double> Engine::reachable_height(PictureRequest request) {
  RELIEVO_TRY(const double height_mm, state_->with_drawing([&](Drawing& drawing) {
    return drawing.reachable_height(request.options);
  }));
  RELIEVO_CHECK(find_draft_limit(request, PieceUse::picture));
  return std::min(height_mm, request.draft_limit_mm.value_or(height_mm));
}

Result<std::vector<OrnamentPlace>> Engine::ornament_places(const ReliefOptions& options) {
  return state_->with_drawing([&](Drawing& drawing) { return drawing.ornament_places(options); });
}

Result<Picture> Engine::scan_picture(const View& view, int width, int height) {
  const Lock lock(state_->scan_mutex);
  const LoadedScan scan = state_->scan_in_use();
  if (!scan.cloud()) return nothing_open();
  if (scan.cloud() != state_->drawn_cloud) {
    state_->drawn_cloud.reset();
    RELIEVO_TRY(const auto points, scan.all_sides({}));
    state_->cloud_renderer.emplace(*points);
    state_->drawn_cloud = scan.cloud();
  }
  Picture picture;
  state_->cloud_renderer->render(view, width, height, picture);
  return picture;
}

std::shared_ptr<const SceneModel> Engine::depth_image() const {
  return state_->shared.with([](const Shared& s) -> std::shared_ptr<const SceneModel> {
    const SceneModel* const image = s.shown.scan.depth_image();
    return image ? std::make_shared<const SceneModel>(*image) : nullptr;
  });
}

Result<std::vector<std::optional<Vec3>>> Engine::points_under(std::span<const Vec2> places) const {
  const auto model = state_->shown_model().model;
  if (!model) return nothing_open();
  return studio::points_under(model->surface(), places);
}

Result<std::vector<ViewGuess>> Engine::suggest_views() {
  return state_->scan_in_use().ranked_sides();
}

Result<std::shared_ptr<const MadeRelief>> Engine::piece(const ReliefOptions& options, PieceUse use) {
  const NumberedModel shown = state_->shown_model();
  const auto& model = shown.model;
  if (!model) return nothing_open();
  if (options.effective_view() != model->surface().view)
    return option_error("view", "expected the view that is shown; it is still being prepared");
  if ((resolve_mode(options.mode, model->surface()) == Mode::subspace) != (model->control_points() > 0))
    return option_error("mode", "expected the mode of the model that is shown; it is still being prepared");
  // The options of a picture have the width that fits the plate, but the options of an export may have no
  // width. with_width() makes both equal, so the piece is made only once.
  RELIEVO_TRY(const ReliefOptions sized, with_width(model->surface(), options));
  return state_->maker.piece(use, shown, sized);
}

void Engine::cancel_making() {
  state_->maker.cancel();
}

}  // namespace relievo::app::studio
