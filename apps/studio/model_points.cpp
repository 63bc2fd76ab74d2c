#include "studio/model_points.h"

#include <algorithm>
#include <limits>

#include "relievo/core/parallel.h"

namespace relievo::app::studio {
namespace {

// The largest distance of a position from the nearest point of the model, in sampling distances. A position
// that is further away is beside the model.
constexpr double most_distance = 3;

Vec3 nearest_point(const Surface& surface, const Vec2& place) {
  double least = std::numeric_limits<double>::infinity();
  Index nearest = 0;
  for (Index i = 0; i < surface.points.size(); ++i) {
    const double distance_sq = (surface.points[i].head<2>() - place).squaredNorm();
    if (distance_sq >= least) continue;
    least = distance_sq;
    nearest = i;
  }
  return surface.points[nearest];
}

}  // namespace

std::vector<std::optional<Vec3>> points_under(const Surface& surface, std::span<const Vec2> places) {
  const Box box = Box::of(surface.points);
  std::vector<std::optional<Vec3>> points(places.size());
  const auto find = [&](std::size_t i) {
    const Vec2 place = box.min.head<2>() + places[i].cwiseProduct(box.size().head<2>());
    const Vec3 near = nearest_point(surface, place);
    if ((near.head<2>() - place).norm() > most_distance * surface.rho) return;
    const Vec3 seen(place.x(), place.y(), near.z());
    points[i] = surface.view.R_view_model.transpose() * seen + surface.centre;
  };
  parallel_for(places.size(), find, 1);
  return points;
}

}  // namespace relievo::app::studio
