#include "scan/turning/turned_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/lists.h"
#include "geometry/hilbert.h"
#include "relievo/core/parallel.h"
#include "scan/measured_cloud.h"
#include "scan/scan_limits.h"

namespace relievo {
namespace {

// If a scan has more points, only every second, third, ... point is drawn. 600,000 points on all sides
// suffice for the detail of a relief that is as large as a screen.
constexpr std::size_t most_drawn = 600'000;
constexpr std::size_t cells_per_point = 12;
constexpr std::size_t least_cells = 16;  // fewer cells show no recognisable surface

// Chooses the cells whose centres are the points of a surface.
class CellChoice {
 public:
  CellChoice(const FrontCells& front, std::size_t points, float spacing)
      : front_(front),
        hole_reach_(
            static_cast<int>(std::ceil(float{ScanLimits::hole_fill_distance} * spacing / front.cell))) {
    const double cells = static_cast<double>(front.covered) / static_cast<double>(points);
    // Shifted rows give nearly equilateral triangles. If columns_ is 2 and rows_ is 1, cells are chosen like the black
    // fields of a chessboard.
    const int least = cells > std::numbers::sqrt2 ? 2 : 1;
    columns_ = std::max(least, static_cast<int>(std::lround(std::sqrt(cells / (std::numbers::sqrt3 / 2)))));
    rows_ = std::clamp(static_cast<int>(std::lround(cells / columns_)), 1, columns_);
  }

  // spacing() returns the mean distance between chosen cells. reach() returns a whole number close to it, which is at
  // least 2 unless all cells are chosen. Both are in cells.
  double spacing() const { return std::sqrt(columns_ * rows_); }
  int reach() const { return std::max(rows_, std::min(columns_, 2)); }

  // Returns the indices of the chosen cells, row by row.
  std::vector<Index> chosen() const {
    const int height = front_.normal.height;
    std::vector<std::vector<Index>> rows(static_cast<std::size_t>(height));
    parallel_for(
        rows.size(),
        [&](std::size_t r) {
          const int y = static_cast<int>(r);
          for (int x = 0; x < front_.normal.width; ++x)
            if (is_chosen(x, y)) rows[r].push_back(static_cast<Index>(front_.normal.index(x, y)));
        },
        16);
    std::vector<Index> all;
    for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
    return all;
  }

 private:
  // Every second row is shifted by half the distance between its points.
  bool is_regular(int x, int y) const {
    return y % rows_ == 0 && (x + y / rows_ % 2 * (columns_ / 2)) % columns_ == 0;
  }
  bool is_chosen(int x, int y) const {
    if (front_.is_covered(x, y)) return is_regular(x, y) || ((x + y) % 2 == 0 && front_.is_edge.at(x, y));
    return is_regular(x, y) && front_.is_behind.at(x, y) && is_far_from_front(x, y);
  }
  bool is_far_from_front(int x, int y) const {
    for (int j = y - hole_reach_; j <= y + hole_reach_; ++j)
      for (int i = x - hole_reach_; i <= x + hole_reach_; ++i)
        if (front_.is_covered(i, j)) return false;
    return true;
  }

  const FrontCells& front_;
  int columns_ = 1, rows_ = 1, hole_reach_;
};

// Measures normal and curvature of the front at a cell. `step` is about the distance between points of the surface,
// in cells. The normal is averaged over the cells within step / 2.
class CellMeasures {
 public:
  CellMeasures(const FrontCells& front, int step) : front_(front), step_(step), reach_(step / 2) {}

  // Returns the mean normal of the surrounding cells with similar depth.
  Vec3f normal(int x, int y) const {
    if (!front_.is_covered(x, y)) return Vec3f::UnitZ();
    const float depth = front_.depth.at(x, y), most = 6 * static_cast<float>(step_) * front_.cell;
    Vec3f sum = Vec3f::Zero();
    for (int j = y - reach_; j <= y + reach_; ++j)
      for (int i = x - reach_; i <= x + reach_; ++i)
        if (front_.is_covered(i, j) && std::abs(front_.depth.at(i, j) - depth) < most)
          sum += front_.normal.at(i, j);
    return sum.normalized();
  }

  // Returns the mean curvature: half the divergence of the normal's x and y in the view plane.
  double curvature(int x, int y) const {
    const int s = step_;
    if (!front_.is_covered(x, y) || !front_.is_covered(x + s, y) || !front_.is_covered(x - s, y) ||
        !front_.is_covered(x, y + s) || !front_.is_covered(x, y - s))
      return 0;
    const float sum =
        normal(x + s, y).x() - normal(x - s, y).x() + normal(x, y + s).y() - normal(x, y - s).y();
    return static_cast<double>(sum / (4 * static_cast<float>(s) * front_.cell));
  }

 private:
  const FrontCells& front_;
  int step_, reach_;
};

float lowest_depth(const FrontCells& front) {
  float lowest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < front.depth.size(); ++i)
    if (front.normal[i].z() > 0) lowest = std::min(lowest, front.depth[i]);
  return lowest;
}

// Returns a small offset from a cell's centre, in cells. Without offsets, points on the hull would be
// collinear and give triangles without area.
Vec2f offset_in(Index cell) {
  constexpr float most = .2F;
  const std::uint32_t x = cell * 2654435761U, y = (x ^ (x >> 15)) * 2246822519U;
  const auto share = [](std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-23F - 1; };
  return most * Vec2f(share(x ^ (x >> 16)), share(y ^ (y >> 13)));
}

// Sets the surface's points and normals, in the order of a space-filling curve. Returns the curvature at the
// points.
std::vector<double> put_points(const FrontCells& front, const CellChoice& choice, Surface& surface) {
  const int width = front.normal.width;
  const auto column = [&](Index cell) { return static_cast<int>(cell) % width; };
  const auto row = [&](Index cell) { return static_cast<int>(cell) / width; };
  std::vector<Index> cells = choice.chosen();
  std::vector<Vec2> places(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    places[i] =
        (front.centre(column(cells[i]), row(cells[i])) + front.cell * offset_in(cells[i])).cast<double>();
  const std::vector<Index> order = hilbert_order(places);
  cells = pick(cells, order);
  places = pick(places, order);
  const CellMeasures measures(front, choice.reach());
  const float lowest = lowest_depth(front);
  surface.points.resize(cells.size());
  surface.normals.resize(cells.size());
  std::vector<double> k(cells.size());
  parallel_for(
      cells.size(),
      [&](std::size_t i) {
        const int x = column(cells[i]), y = row(cells[i]);
        surface.points[i] << places[i],
            static_cast<double>(front.is_covered(x, y) ? front.depth.at(x, y) : lowest);
        surface.normals[i] = measures.normal(x, y);
        k[i] = measures.curvature(x, y);
      },
      1024);
  return k;
}

// Finds the points of a scan that are visible in cells. Only scans with colours or own heights need it.
class PointsInFront {
 public:
  PointsInFront(const TurningScan& scan, const View& view, const FrontCells& front, int step)
      : front_(front),
        nearest_(filled_image(front.depth.width, front.depth.height, no_index)),
        distance_(
            filled_image(front.depth.width, front.depth.height, 6 * static_cast<float>(step) * front.cell)) {
    const Eigen::Matrix3f R = view.R_view_model.cast<float>();
    for (Index i = 0; i < scan.points.size(); ++i) add(i, R * scan.points[i].place);
  }

  // Returns the points of the cells whose columns and rows differ from those of `cell` by at most `reach`. If there
  // are none, looks for points farther away.
  std::vector<Index> around(Index cell, int reach) const {
    constexpr int farthest = 8;
    const int x = static_cast<int>(cell) % nearest_.width, y = static_cast<int>(cell) / nearest_.width;
    std::vector<Index> found;
    for (int j = y - reach; j <= y + reach; ++j)
      for (int i = x - reach; i <= x + reach; ++i)
        if (nearest_.contains(i, j) && nearest_.at(i, j) != no_index) found.push_back(nearest_.at(i, j));
    return found.empty() && reach < farthest ? around(cell, 2 * reach + 1) : found;
  }

 private:
  // Notes the point for its cell if no other point is nearer to the depth at which the cell is drawn.
  void add(Index point, const Vec3f& place) {
    const Vec2f at = (place.head<2>() - front_.corner) / front_.cell;
    const Vec2f size(static_cast<float>(nearest_.width), static_cast<float>(nearest_.height));
    if (!((at.array() >= 0).all() && (at.array() < size.array()).all())) return;
    const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
    const float distance = front_.is_covered(x, y) ? std::abs(place.z() - front_.depth.at(x, y)) : 0;
    if (!(distance < distance_.at(x, y))) return;
    distance_.at(x, y) = distance;
    nearest_.at(x, y) = point;
  }

  const FrontCells& front_;
  Image<Index> nearest_;
  Image<float> distance_;
};

Colour mean_colour(std::span<const Colour> colours, std::span<const Index> points) {
  std::array<std::size_t, 3> sum{};
  for (const Index i : points)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += colours[i][k];
  Colour mean{255, 255, 255};
  for (std::size_t k = 0; k < 3 && !points.empty(); ++k)
    mean[k] = static_cast<std::uint8_t>(sum[k] / points.size());
  return mean;
}

// Gives the surface's points the colours and own heights of the scan's points that are visible there.
void put_values(const TurningScan& scan, const FrontCells& front, int step, Surface& surface) {
  if (scan.colours.empty() && scan.own_heights.empty()) return;
  const PointsInFront in_front(scan, surface.view, front, step);
  if (!scan.colours.empty()) surface.colours.resize(surface.points.size());
  if (!scan.own_heights.empty()) surface.own_heights.resize(surface.points.size());
  parallel_for(
      surface.points.size(),
      [&](std::size_t i) {
        const Vec2f at = (surface.points[i].head<2>().cast<float>() - front.corner) / front.cell;
        const auto cell =
            static_cast<Index>(front.normal.index(static_cast<int>(at.x()), static_cast<int>(at.y())));
        if (!scan.colours.empty())
          surface.colours[i] = mean_colour(scan.colours, in_front.around(cell, step / 2));
        if (scan.own_heights.empty()) return;
        // Heights of different models have no mean, so the nearest point decides.
        const std::vector<Index> nearest = in_front.around(cell, 0);
        surface.own_heights[i] = nearest.empty() ? 0 : scan.own_heights[nearest.front()];
      },
      1024);
}

// Returns the boundary. A triangle is inside if the front covers at least three of four positions: the
// centre of the triangle, and the midpoints of its sides.
Boundary boundary_of(const FrontCells& front, std::span<const Vec2> points, const Triangulation& mesh) {
  const auto is_covered = [&](const Vec2& p) {
    const Vec2f at = (p.cast<float>() - front.corner) / front.cell;
    return front.is_covered(static_cast<int>(at.x()), static_cast<int>(at.y()));
  };
  Boundary boundary;
  boundary.is_inside.resize(mesh.triangles.size());
  parallel_for(mesh.triangles.size(), [&](std::size_t t) {
    const Vec2 a = points[mesh.triangles[t][0]], b = points[mesh.triangles[t][1]],
               c = points[mesh.triangles[t][2]];
    boundary.is_inside[t] = is_covered((a + b + c) / 3) + is_covered((a + b) / 2) + is_covered((b + c) / 2) +
                                is_covered((c + a) / 2) >=
                            3;
  });
  boundary.is_boundary = boundary_points(points.size(), mesh, boundary.is_inside);
  boundary.distance = distances_to(points, boundary.is_boundary);
  return boundary;
}

}  // namespace

TurningScan::TurningScan(const MeasuredCloud& measured)
    : do_normals_face_viewer(measured.has_estimated_normals()),
      centre(measured.centre()),
      rho(measured.spacing().rho),
      diagonal(measured.diagonal()) {
  const auto clean = measured.without_noise(Vec3f::Zero());
  const Cloud& cloud = clean->cloud;
  const std::size_t stride = (cloud.size() + most_drawn - 1) / most_drawn;
  const float sign = measured.do_normals_point_inward() ? -1.F : 1.F;
  const double sparser = std::sqrt(static_cast<double>(stride));
  points.resize((cloud.size() + stride - 1) / stride);
  parallel_for(points.size(), [&](std::size_t i) {
    const std::size_t from = i * stride;
    const double local = std::clamp(static_cast<double>(measured.spacing().local[from]),
                                    ScanLimits::least_spacing * rho, ScanLimits::largest_spacing * rho);
    points[i] = {cloud.points[from].cast<float>(), sign * cloud.normals[from],
                 static_cast<float>(local * sparser)};
  });
  for (std::size_t from = 0; from < cloud.size(); from += stride) {
    if (measured.cloud().has_colours()) colours.push_back(measured.cloud().colours[from]);
    if (!measured.cloud().own_heights.empty()) own_heights.push_back(measured.cloud().own_heights[from]);
  }
}

TurningScan TurningScan::without_plane(const Surface& surface) const {
  TurningScan rest = *this;
  const SupportPlane& plane = *surface.plane;
  // Some noisy points are farther from the plane than its tolerance, and would be visible as separate discs.
  SupportPlane thicker = plane;
  thicker.tolerance *= 2;
  const Mat3& R = surface.view.R_view_model;
  const Vec3 shift = centre - surface.centre;
  const Eigen::Matrix3f rotation = R.cast<float>();
  const Vec3f normal = plane.normal.cast<float>();
  const std::vector<Index> kept = indices_where(points.size(), [&](Index i) {
    const FrontPoint& p = points[i];
    const Vec3f n = rotation * p.normal;
    const bool is_reversed = do_normals_face_viewer && n.dot(normal) < 0;
    const Vec3 place = R * (p.place.cast<double>() + shift);
    const Vec3f oriented = is_reversed ? Vec3f(-n) : n;
    return !plane.takes(place, oriented) && !thicker.takes(place, oriented);
  });
  rest.points = pick(points, kept);
  rest.colours = pick(colours, kept);
  rest.own_heights = pick(own_heights, kept);
  return rest;
}

Result<TurnedSurface> turned_surface(const TurningScan& scan, const View& view, std::size_t points,
                                     Progress* progress) {
  TurnedSurface made;
  const NormalSigns signs = scan.do_normals_face_viewer ? NormalSigns::unknown : NormalSigns::outward;
  made.front = draw_front(scan.points, view, points * cells_per_point, signs);
  RELIEVO_CHECK(check_cancelled(progress));
  const double crumb = ScanLimits::crumb_share * static_cast<double>(made.front.covered);
  clear_small_pieces(made.front, view.has_crumbs ? 0 : static_cast<std::size_t>(crumb),
                     static_cast<std::size_t>(view.most_pieces));
  const double hole_radius = ScanLimits::largest_hole * scan.rho / static_cast<double>(made.front.cell);
  fill_small_holes(made.front, static_cast<std::size_t>(std::numbers::pi * hole_radius * hole_radius));
  mark_edges(made.front);
  if (made.front.covered < least_cells)
    return geometry_error("expected points that face the viewer; try another view");
  Surface& surface = made.surface;
  const CellChoice choice(made.front, points, static_cast<float>(scan.rho));
  const std::vector<double> k = put_points(made.front, choice, surface);
  const std::vector<Vec2> xy = in_plane(surface.points);
  surface.triangulation = delaunay(xy);
  if (surface.triangulation.triangles.empty())
    return geometry_error("expected a view that shows an area; try another view");
  RELIEVO_CHECK(check_cancelled(progress));
  surface.boundary = boundary_of(made.front, xy, surface.triangulation);
  surface.triangulation.neighbours = {};
  surface.curvature = normalise(k);
  surface.view = view;
  put_values(scan, made.front, choice.reach(), surface);
  surface.centre = scan.centre;
  surface.rho = choice.spacing() * static_cast<double>(made.front.cell);
  surface.diagonal = view.crop == Crop{} ? scan.diagonal : static_cast<double>(made.front.diagonal);
  surface.input_points = scan.points.size();
  surface.visible_points = surface.points.size();
  return made;
}

}  // namespace relievo
