// Lets Python call single stages of the library with arrays.
#include <header_docs.h>

#include <cmath>
#include <cstdint>
#include <numeric>

#include "native/arrays.h"
#include "native/call.h"
#include "native/errors.h"
#include "native/relief.h"
#include "relievo/core/text.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/boundary.h"
#include "relievo/scan/curvature.h"
#include "relievo/scan/normals.h"
#include "relievo/scan/spacing.h"
#include "relievo/scan/view.h"
#include "relievo/scan/visible.h"

namespace relievo::python {
namespace {

using OptionalArray = std::optional<py::array>;

Cloud cloud_of(const py::array& points, const OptionalArray& normals) {
  Cloud cloud{points_of({"points", points}), {}};
  if (normals) cloud.normals = normals_of({"normals", *normals}, cloud.size());
  return cloud;
}

Result<Spacing> spacing_of(const Cloud& cloud) {
  Spacing spacing = measure_spacing(cloud);
  if (spacing.rho > 0) return spacing;
  return geometry_error("expected points at a distance from each other, found most of them equal");
}

py::array index_array(const std::vector<Index>& numbers) {
  return array_of(numbers, {std::ssize(numbers)});
}

py::array triangle_array(std::vector<Triangle> triangles) {
  const auto owner = std::make_shared<const std::vector<Triangle>>(std::move(triangles));
  return view_of(*owner, owner);
}

py::array find_visible_points(const py::array& points, const OptionalArray& normals, const std::string& view,
                              const std::string& up) {
  const Cloud cloud = cloud_of(points, normals);
  const View seen = value_or_raise(parse_view(view, up));
  return index_array(value_or_raise(unlocked([&]() -> Result<std::vector<Index>> {
    Cloud viewed = in_view(cloud, seen);
    RELIEVO_TRY(const Spacing spacing, spacing_of(viewed));
    if (!viewed.has_normals()) {
      estimate_normals(viewed);
      turn_to_viewer(viewed);
      spread_normal_signs(viewed, spacing, visible_points(viewed, spacing));
    }
    return visible_points(viewed, spacing);
  })));
}

py::array find_mean_curvature(const py::array& points, const py::array& normals, const OptionalArray& queries,
                              double scale) {
  const Cloud cloud = cloud_of(points, normals);
  if (!(scale > 0) || !std::isfinite(scale))
    raise({ErrorKind::option, "scale", {}, "expected a number above 0"});
  std::vector<Index> at(cloud.size());
  std::iota(at.begin(), at.end(), Index{0});
  if (queries) at = indices_of({"queries", *queries}, cloud.size());
  std::vector<double> k = value_or_raise(unlocked([&]() -> Result<std::vector<double>> {
    RELIEVO_TRY(const Spacing spacing, spacing_of(cloud));
    return mean_curvature(cloud, spacing, at, {scale});
  }));
  const py::ssize_t n = std::ssize(k);
  return array_of(std::move(k), {n});
}

py::array find_normals(const py::array& points, std::size_t neighbours) {
  Cloud cloud = cloud_of(points, std::nullopt);
  if (cloud.size() < 3) raise_input("points", "shape", "expected at least 3 points");
  if (neighbours < 3 || neighbours > 64)
    raise({ErrorKind::option, "neighbours", {}, cat("expected 3 to 64, found ", neighbours)});
  unlocked([&] { estimate_normals(cloud, neighbours); });
  const auto owner = std::make_shared<const std::vector<Vec3f>>(std::move(cloud.normals));
  return view_of(*owner, owner);
}

Result<Triangulation> triangulated(std::span<const Vec2> points) {
  Triangulation triangulation = delaunay(points);
  if (!triangulation.triangles.empty()) return triangulation;
  return geometry_error("expected points that enclose an area, found none or coordinates that are not exact");
}

py::array triangulate(const py::array& points) {
  const std::vector<Vec2> at = plane_points_of({"points", points});
  return triangle_array(value_or_raise(unlocked([&] { return triangulated(at); })).triangles);
}

// The system of equation (9) for points in the plane.
struct PlaneSystem {
  Triangulation triangulation;
  Boundary boundary;
  HeightSystem system;
};
using SharedSystem = std::shared_ptr<PlaneSystem>;

Result<SharedSystem> build_system(std::span<const Vec2> points, std::optional<double> rho,
                                  std::span<const float> weights) {
  RELIEVO_TRY(Triangulation triangulation, triangulated(points));
  if (!rho) {
    Cloud flat;
    for (const Vec2& p : points) flat.points.emplace_back(p.x(), p.y(), 0);
    RELIEVO_TRY(const Spacing spacing, spacing_of(flat));
    rho = spacing.rho;
  }
  Boundary boundary = find_boundary(points, triangulation, *rho);
  RELIEVO_TRY(HeightSystem system, HeightSystem::build(points, triangulation, boundary, weights));
  return std::make_shared<PlaneSystem>(std::move(triangulation), std::move(boundary), std::move(system));
}

SharedSystem height_system(const py::array& points, std::optional<double> rho, const OptionalArray& weights) {
  const std::vector<Vec2> at = plane_points_of({"points", points});
  if (rho && (!(*rho > 0) || !std::isfinite(*rho)))
    raise({ErrorKind::option, "rho", {}, "expected a number above 0"});
  const std::vector<float> weight =
      weights ? weights_of({"weights", *weights}, at.size()) : std::vector<float>();
  return value_or_raise(unlocked([&] { return build_system(at, rho, weight); }));
}

// Returns the slopes without a copy if their layout is that of the library. It does no harm if other threads
// write to the array while the library reads it, because the library uses the slopes only as numbers and
// never as indices.
std::optional<std::span<const Vec2>> slopes_in_place(const py::array& slopes) {
  const bool is_plain = slopes.dtype().is(py::dtype::of<double>()) && slopes.ndim() == 2 &&
                        slopes.shape(1) == 2 && (slopes.flags() & py::array::c_style) != 0;
  if (!is_plain || reinterpret_cast<std::uintptr_t>(slopes.data()) % alignof(Vec2) != 0) return std::nullopt;
  return std::span(static_cast<const Vec2*>(slopes.data()), static_cast<std::size_t>(slopes.shape(0)));
}

py::array solve(const SharedSystem& system, const py::array& slopes) {
  std::vector<Vec2> copied;
  std::optional<std::span<const Vec2>> given = slopes_in_place(slopes);
  if (!given) given = copied = plane_points_of({"slopes", slopes});
  if (given->size() != system->system.size())
    raise_input("slopes", "shape",
                cat("expected a row for each of ", system->system.size(), " points, found ", given->size()));
  std::vector<double> heights(given->size());
  unlocked([&] { system->system.solve(*given, heights); });
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (!std::isfinite(heights[i])) raise_input("slopes", "", "expected finite numbers, found others");
  const py::ssize_t n = std::ssize(heights);
  return array_of(std::move(heights), {n});
}

py::array boundary_flags(const SharedSystem& system) {
  const auto& flags = system->boundary.is_boundary;
  return view_of(reinterpret_cast<const bool*>(flags.data()), {std::ssize(flags)}, system);
}

}  // namespace

void add_stages(py::module_& module) {
  module.def("visible_points", &find_visible_points);
  module.def("mean_curvature", &find_mean_curvature);
  module.def("estimate_normals", &find_normals);
  module.def("triangulate", &triangulate);
  py::class_<PlaneSystem, SharedSystem>(module, "HeightSystem")
      .def("solve", &solve)
      .def("is_boundary", &boundary_flags)
      .def("triangles", [](const SharedSystem& s) { return view_of(s->triangulation.triangles, s); });
  module.def("height_system", &height_system);
  py::dict docs;
  for (const HeaderDoc& doc : header_docs) docs[doc.name] = doc.text;
  module.attr("header_docs") = docs;
}

}  // namespace relievo::python
