#include "plate/front/folds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "geometry/predicates.h"
#include "plate/front/fans.h"
#include "plate/plate_surface.h"

namespace relievo {
namespace {

constexpr int most_steps = 6;  // units in the last place by which a point is moved
constexpr int most_passes = 8;

// Returns the places of points as files store them. The floats are stored first, because g++ 12 drops the
// rounding of double(float(x)) when it vectorises.
std::vector<Vec2> stored_places(const Solid& solid) {
  std::vector<Vec2f> stored;
  stored.reserve(solid.points.size());
  for (const Vec3& p : solid.points) stored.push_back(p.head<2>().cast<float>());
  std::vector<Vec2> places;
  places.reserve(stored.size());
  for (const Vec2f& p : stored) places.push_back(p.cast<double>());
  return places;
}

bool is_folded(std::span<const Vec2> places, const Triangle& t) {
  return orient2d(places[t[0]], places[t[1]], places[t[2]]) <= 0;
}

std::span<const Triangle> front_of(const Solid& solid) {
  return std::span(solid.triangles).first(solid.front_triangles);
}

std::vector<Index> folds_among(const Solid& solid, std::span<const Vec2> places) {
  std::vector<Index> folds;
  for (Index t = 0; t < front_of(solid).size(); ++t)
    if (is_folded(places, solid.triangles[t])) folds.push_back(t);
  return folds;
}

class Unfolder {
 public:
  Unfolder(Solid& solid, std::span<const Index> outline)
      : solid_(solid), places_(stored_places(solid)), is_fixed_(solid.points.size(), 0) {
    for (const Index i : outline) is_fixed_[i] = 1;
  }

  void run() {
    std::vector<Index> folds = folds_among(solid_, places_);
    if (folds.empty()) return;
    prepare();
    for (int pass = 0; pass < most_passes && !folds.empty(); ++pass) {
      for (const Index t : folds)
        if (is_folded(places_, solid_.triangles[t])) mend(solid_.triangles[t]);
      folds = folds_among(solid_, places_);
    }
  }

 private:
  void prepare() {
    fans_.emplace(solid_.points.size(), front_of(solid_));
    const Box box = used_box(solid_.points, solid_.triangles);
    for (std::size_t i = 0; i < is_fixed_.size(); ++i) {
      const Vec3& p = solid_.points[i];
      is_fixed_[i] |= ((p - box.min).head<2>().minCoeff() <= 0 || (box.max - p).head<2>().minCoeff() <= 0);
    }
    const auto largest = static_cast<float>(
        std::max(box.max.head<2>().cwiseAbs().maxCoeff(), box.min.head<2>().cwiseAbs().maxCoeff()));
    step_ = static_cast<double>(std::nextafter(largest, 2 * largest) - largest);
    const bool has_walls = solid_.front_triangles < solid_.triangles.size();
    for (Index i = 0; has_walls && i < solid_.points.size(); ++i)
      at_place_.emplace(std::pair(solid_.points[i].x(), solid_.points[i].y()), i);
  }

  std::size_t folds_around(Index point) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        fans_->around(point), [&](Index t) { return is_folded(places_, solid_.triangles[t]); }));
  }

  // Moves a corner of a folded triangle so that fewer triangles around the corner are folded, if that is
  // possible.
  void mend(const Triangle& t) {
    for (int steps = 1; steps <= most_steps; ++steps)
      for (const Index corner : t)
        for (const Vec2& direction : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1), Vec2(1, 1),
                                      Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)})
          if (!is_fixed_[corner] && improves(corner, steps * step_ * direction)) return;
  }

  bool improves(Index corner, const Vec2& move) {
    const std::size_t before = folds_around(corner);
    const Vec2f place = (places_[corner] + move).cast<float>();
    const Vec2 old = std::exchange(places_[corner], place.cast<double>());
    if (folds_around(corner) < before) {
      move_all_at(corner, places_[corner]);
      return true;
    }
    places_[corner] = old;
    return false;
  }

  // Moves the point and the points below it, which have the same x and y.
  void move_all_at(Index corner, const Vec2& place) {
    std::vector<Index> together{corner};
    const auto [first, last] =
        at_place_.equal_range(std::pair(solid_.points[corner].x(), solid_.points[corner].y()));
    for (auto each = first; each != last; ++each) together.push_back(each->second);
    at_place_.erase(first, last);
    for (const Index i : together) {
      solid_.points[i].head<2>() = places_[i] = place;
      at_place_.emplace(std::pair(place.x(), place.y()), i);
    }
  }

  Solid& solid_;
  std::vector<Vec2> places_;
  std::vector<std::uint8_t> is_fixed_;
  std::optional<Fans> fans_;
  std::multimap<std::pair<double, double>, Index> at_place_;  // empty before walls are added
  double step_ = 0;
};

}  // namespace

std::vector<Index> find_folds(const Solid& solid) {
  return folds_among(solid, stored_places(solid));
}

void unfold(Solid& solid, std::span<const Index> outline) {
  Unfolder(solid, outline).run();
}

}  // namespace relievo
