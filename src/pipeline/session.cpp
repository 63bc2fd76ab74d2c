#include "relievo/session.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "core/lists.h"
#include "relievo/core/parallel.h"
#include "relievo/core/within_memory.h"
#include "relievo/relief/layers.h"
#include "relievo/relief/relief.h"
#include "scan/measured_cloud.h"
#include "scan/turning/turned_surface.h"

namespace relievo {
namespace {

// The largest number of points, approximately, from which the first coarse relief of a large cloud is made.
constexpr std::size_t early_points = 150'000;

// Returns about `most` points of the cloud, distributed evenly over the order of its points.
Cloud thinned(const Cloud& cloud, std::size_t most) {
  const double share = static_cast<double>(most) / static_cast<double>(cloud.size());
  const std::vector<Index> erased = indices_where(cloud.size(), [&](Index i) {
    double whole = 0;
    // The multiples of phi, modulo 1, are distributed evenly over [0, 1].
    return std::modf(std::numbers::phi * i, &whole) >= share;
  });
  return erase_points(cloud, erased);
}

// Returns the view for measuring the points of a turntable, which applies the crop itself.
View without_crop(View view) {
  view.crop = {};
  return view;
}

// The last points that were measured, and their measurements.
struct Measured {
  std::shared_ptr<const Cloud> of;
  std::shared_ptr<const MeasuredCloud> cloud;
};

struct Waiting {
  Preparation wanted;
  std::shared_ptr<Progress> progress;
};

// The state that callers share with the session's thread.
struct Shared {
  std::optional<Waiting> waiting;
  std::shared_ptr<Progress> progress;  // progress of the preparation that is running
  std::shared_ptr<const ReliefModel> model;
  std::weak_ptr<const Cloud> of_model;  // points of the model
  SessionStatus status;
  Measured measured;  // the last measurement
  std::function<Preparation::Points(Progress&)> all_sides;
  std::shared_ptr<const Turntable> turntable;  // turntable of the measured points; null before the first turn
  std::shared_ptr<Progress> turning;           // progress of the newest turn() while that is running
  std::optional<ShownModel> first;             // coarse relief in first_view, until there is a model
  View first_view;
  // Not null while `first` is being made; status() then reports that turn() is not possible.
  std::shared_ptr<Progress> making_first;

  void cancel_turning() {
    if (turning) turning->cancel();
  }

  void cancel_first() {
    if (making_first) making_first->cancel();
  }

  // Frees the points if there is no model. If there is one, its next view may need them.
  void forget_unused() {
    if (!model) forget_points();
  }

  // Frees the measured points when another scan is opened, unless the model is made of these points.
  void forget_other_scan() {
    if (!model || measured.of != of_model.lock()) forget_points();
  }

  void forget_points() {
    measured = {};
    all_sides = nullptr;
    turntable = nullptr;
    first.reset();
  }
};

SurfaceDetail detail_of(const TurnedSurface& turned) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const FrontCells& front = turned.front;
  SurfaceDetail detail{front.corner, front.cell, {}, {}};
  detail.xy.resize(front.normal.width, front.normal.height);
  parallel_for(detail.xy.size(), [&](std::size_t i) {
    const bool is_smooth = front.normal[i].z() > 0 && !front.is_edge[i];
    detail.xy[i] = is_smooth ? faded_xy(front.normal[i]) : Vec2f::Constant(none);
  });
  const std::vector<Vec3f>& normals = turned.surface.normals;
  detail.own.resize(normals.size());
  parallel_for(normals.size(), [&](std::size_t i) { detail.own[i] = faded_xy(normals[i]); });
  return detail;
}

}  // namespace

struct Session::State {
  Guarded<Shared> shared;
  BackgroundLoop loop{[this] { return step(); }};  // the last member, because the thread starts at once

  // Prepares the waiting model, if any. Returns whether there was one.
  bool step() {
    const std::optional<Waiting> next = shared.with([&](Shared& s) {
      std::optional<Waiting> first = std::exchange(s.waiting, std::nullopt);
      if (first) s.progress = first->progress;
      return first;
    });
    if (!next) return false;
    const auto& [wanted, progress] = *next;
    finish(wanted, *progress, within_memory([&] { return prepare(wanted, *progress); }));
    if (wanted.changed) wanted.changed();
    return true;
  }

  void finish(const Preparation& wanted, const Progress& progress, Result<Preparation::Model> made) {
    shared.with([&](Shared& s) {
      s.progress = nullptr;
      if (s.waiting) return;  // a newer open() has replaced this preparation
      if (progress.is_cancelled()) return s.forget_unused();
      s.status.is_preparing = false;
      if (made && wanted.ready) made = within_memory([&] { return wanted.ready(*made), made; });
      if (!made) {
        const bool is_short_of_memory = made.error().kind == ErrorKind::memory;
        if (!s.measured.cloud || (is_short_of_memory && s.measured.of != s.of_model.lock()))
          s.forget_points();
        s.status.error = std::move(made).error();
        return;
      }
      s.status.fraction = 1;
      s.model = *std::move(made);
      s.of_model = s.measured.of;
      s.first.reset();
    });
  }

  Result<Preparation::Model> prepare(const Preparation& wanted, Progress& progress) {
    RELIEVO_TRY(const std::shared_ptr<const Cloud> cloud, wanted.points(progress));
    return within_memory({.points = cloud->size()}, [&] { return prepare(cloud, wanted, progress); });
  }

  Result<Preparation::Model> prepare(const std::shared_ptr<const Cloud>& cloud, const Preparation& wanted,
                                     Progress& progress) {
    const View view = wanted.chosen_view ? wanted.chosen_view() : wanted.view;
    const bool is_early = make_early(*cloud, view, wanted.makes_first_relief);
    RELIEVO_TRY(const auto measured, measure(cloud, view, progress));
    auto all_sides = wanted.all_sides;
    shared.with([&](Shared& s) {
      if (progress.is_cancelled()) return;
      if (s.measured.cloud != measured) {
        s.measured = {cloud, measured};
        s.all_sides = std::move(all_sides);
        s.turntable = nullptr;
        if (!is_early) s.first.reset();
      }
      const bool has_first = s.first && s.first_view == view;
      if (wanted.makes_first_relief && !s.model && !has_first) s.making_first = std::make_shared<Progress>();
    });
    make_first(view);
    RELIEVO_CHECK(check_cancelled(&progress));
    RELIEVO_TRY(ReliefModel model, ReliefModel::of_view(*measured, view, wanted.model, &progress));
    return std::make_shared<const ReliefModel>(std::move(model));
  }

  // Makes the first coarse relief if it is wanted. The model is made afterwards, because making both at the
  // same time would take longer.
  void make_first(const View& view) {
    const auto progress = shared.with([](const Shared& s) { return s.making_first; });
    if (!progress) return;
    keep_first(turned(view, nullptr, progress), view, *progress);
  }

  // Makes the first coarse relief of a large cloud, if wanted, before all its points are measured. Returns
  // whether it was made.
  bool make_early(const Cloud& cloud, const View& view, bool is_wanted) {
    if (!is_wanted || cloud.size() < 2 * early_points) return false;
    const auto progress = shared.with([](Shared& s) -> std::shared_ptr<Progress> {
      if (s.model || s.measured.cloud || s.progress->is_cancelled()) return nullptr;
      return s.making_first = std::make_shared<Progress>();
    });
    if (!progress) return false;
    return keep_first(within_memory([&]() -> Result<ShownModel> {
                        const Cloud part = thinned(cloud, early_points);
                        RELIEVO_TRY(const auto measured,
                                    MeasuredCloud::measure(part, without_crop(view), progress.get()));
                        return Turntable(*measured).turn(view, nullptr, progress.get());
                      }),
                      view, *progress);
  }

  // Keeps the first coarse relief, unless a newer open() has cancelled it. Returns whether it was kept.
  bool keep_first(Result<ShownModel> made, const View& view, const Progress& progress) {
    return shared.with([&](Shared& s) {
      s.making_first = nullptr;
      if (!made || progress.is_cancelled()) return false;
      s.first = std::move(*made), s.first_view = view;
      return true;
    });
  }

  Result<ShownModel> turned(const View& view, const ReliefModel* like,
                            const std::shared_ptr<Progress>& progress) {
    Result<ShownModel> made = within_memory([&]() -> Result<ShownModel> {
      RELIEVO_TRY(const auto table, turntable(view, *progress));
      return table->turn(view, like, progress.get());
    });
    shared.with([&](Shared& s) {
      if (s.turning == progress) s.turning = nullptr;
    });
    if (progress->is_cancelled()) return cancelled_error();
    return made;
  }

  // Measures the points, unless the last measurement is of the same points and can be used for this view.
  Result<std::shared_ptr<const MeasuredCloud>> measure(const std::shared_ptr<const Cloud>& points,
                                                       const View& view, Progress& progress) {
    const Measured last = shared.with([](const Shared& s) { return s.measured; });
    if (last.of == points && last.cloud->serves(view)) return last.cloud;
    return MeasuredCloud::measure(*points, view, &progress);
  }

  // Returns the turntable of the points that were measured last. If these were sampled or cropped for a
  // single view, first measures the points of all sides.
  Result<std::shared_ptr<const Turntable>> turntable(const View& view, Progress& progress) {
    const auto [known, last, all_sides, has_first] = shared.with([](const Shared& s) {
      return std::tuple(s.turntable, s.measured, s.all_sides, s.first.has_value());
    });
    if (!last.cloud && has_first) return cancelled_error();  // the caller tries again later
    if (!last.cloud)
      return std::unexpected(Error{ErrorKind::geometry, {}, {}, "expected points that were prepared"});
    if (known) return known;
    View whole = without_crop(last.cloud->view());
    whole.R_view_model = view.R_view_model;
    RELIEVO_TRY(const auto points, all_sides ? all_sides(progress) : Preparation::Points(last.of));
    RELIEVO_CHECK(check_cancelled(&progress));
    std::shared_ptr<const MeasuredCloud> measured = last.cloud;
    if (points != last.of || !measured->serves(whole)) {
      RELIEVO_TRY(measured, MeasuredCloud::measure(*points, whole, &progress));
    }
    auto made = std::make_shared<const Turntable>(*measured);
    shared.with([&](Shared& s) {
      if (s.measured.cloud == last.cloud) s.turntable = made;
    });
    return made;
  }

  Result<Waiting> waiting(Preparation wanted) {
    const auto watch = [this, changed = wanted.changed](std::string_view stage, double fraction) {
      shared.with([&](Shared& s) {
        if (s.waiting || s.progress->is_cancelled()) return;
        s.status.stage = stage;
        s.status.fraction = fraction;
      });
      if (changed) changed();
    };
    return Waiting{std::move(wanted), std::make_shared<Progress>(watch)};
  }
};

Session::Session() : state_(std::make_unique<State>()) {}

Session::~Session() {
  cancel();
}

void Session::open(Preparation preparation) {
  const bool is_of_other_scan = preparation.is_of_other_scan;
  Result<Waiting> next = within_memory([&] { return state_->waiting(std::move(preparation)); });
  state_->shared.with([&](Shared& s) {
    if (s.progress) s.progress->cancel();
    s.cancel_first();
    if (is_of_other_scan) s.forget_other_scan();
    s.waiting.reset();
    s.status = {next.has_value(), "waiting", 0, std::nullopt};
    if (next)
      s.waiting = *std::move(next);
    else
      s.status.error = std::move(next).error();
  });
  state_->loop.wake();
}

void Session::cancel() {
  state_->shared.with([](Shared& s) {
    s.cancel_turning();
    s.cancel_first();
    if (s.status.is_preparing) s.status.error = cancelled_error().error();
    if (s.progress)
      s.progress->cancel();
    else
      s.forget_unused();
    s.waiting = std::nullopt;
    s.status.is_preparing = false;
  });
}

Result<ShownModel> Session::turn(const View& view) {
  return within_memory([&]() -> Result<ShownModel> {
    const auto progress = std::make_shared<Progress>();
    const auto [like, first] = state_->shared.with([&](Shared& s) {
      s.cancel_turning();
      const auto made = s.first_view == view ? s.first : std::nullopt;
      s.turning = made ? nullptr : progress;
      return std::pair(s.model, made);
    });
    if (first) return *first;
    return state_->turned(view, like.get(), progress);
  });
}

SessionStatus Session::status() const {
  return state_->shared.with([](const Shared& s) {
    SessionStatus status = s.status;
    status.can_turn = (s.measured.cloud || s.first) && !s.making_first;
    return status;
  });
}

std::shared_ptr<const ReliefModel> Session::model() const {
  return state_->shared.with([](const Shared& s) { return s.model; });
}

bool Session::wait_until_idle(std::chrono::milliseconds timeout) {
  return state_->loop.wait_until_idle(timeout);
}

struct Turntable::State {
  explicit State(const MeasuredCloud& measured) : scan(measured) {}

  // Returns the scan without the surface's support plane. The last result is cached, because a turning model
  // needs it many times a second.
  std::shared_ptr<const TurningScan> without_plane(const Surface& surface) const {
    const WithoutPlane last = last_.with([](const WithoutPlane& w) { return w; });
    if (last.scan && last.plane == *surface.plane && last.R_view_model == surface.view.R_view_model)
      return last.scan;
    const WithoutPlane made{*surface.plane, surface.view.R_view_model,
                            std::make_shared<const TurningScan>(scan.without_plane(surface))};
    last_.with([&](WithoutPlane& w) { w = made; });
    return made.scan;
  }

  const TurningScan scan;

 private:
  struct WithoutPlane {
    SupportPlane plane;
    Mat3 R_view_model = Mat3::Identity();
    std::shared_ptr<const TurningScan> scan;
  };
  mutable Guarded<WithoutPlane> last_;
};

Turntable::Turntable(const MeasuredCloud& measured) : state_(std::make_unique<const State>(measured)) {}
Turntable::~Turntable() = default;

Result<ShownModel> Turntable::turn(const View& view, const ReliefModel* like, Progress* progress) const {
  const bool leaves_plane_out = like && like->surface().plane && !view.has_plane;
  const auto without_plane = leaves_plane_out ? state_->without_plane(like->surface()) : nullptr;
  RELIEVO_TRY(TurnedSurface turned,
              turned_surface(without_plane ? *without_plane : state_->scan, view, points, progress));
  ShownModel relief;
  relief.detail = std::make_shared<const SurfaceDetail>(detail_of(turned));
  relief.spacing_ratio = state_->scan.rho / turned.surface.rho;
  RELIEVO_TRY(ReliefModel model, ReliefModel::prepare(std::move(turned.surface), progress));
  relief.model = std::make_shared<const ReliefModel>(std::move(model));
  return relief;
}

}  // namespace relievo
