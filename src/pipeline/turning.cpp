#include "relievo/turning.h"

#include <limits>

#include "relievo/core/parallel.h"
#include "relievo/relief/layers.h"
#include "scan/turning/turned_surface.h"

namespace relievo {
namespace {

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

struct Turntable::State {
  explicit State(const MeasuredCloud& measured) : scan(measured) {}

  // Returns the scan without the plane of a surface that has one. The last result is cached, because it is
  // needed many times a second while a model is turned.
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

Result<TurnedRelief> Turntable::turn(const View& view, const ReliefModel* like, Progress* progress) const {
  const bool leaves_plane_out = like && like->surface().plane && !view.has_plane;
  const auto without_plane = leaves_plane_out ? state_->without_plane(like->surface()) : nullptr;
  RELIEVO_TRY(TurnedSurface turned,
              turned_surface(without_plane ? *without_plane : state_->scan, view, points, progress));
  TurnedRelief relief;
  relief.detail = std::make_shared<const SurfaceDetail>(detail_of(turned));
  relief.spacing_ratio = state_->scan.rho / turned.surface.rho;
  RELIEVO_TRY(ReliefModel model, ReliefModel::prepare_like(like, std::move(turned.surface), progress));
  relief.model = std::make_shared<const ReliefModel>(std::move(model));
  return relief;
}

}  // namespace relievo
