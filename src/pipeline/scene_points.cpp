#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/lists.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scene.h"
#include "scan/coarse_visibility.h"
#include "scan/front_mesh.h"
#include "scan/merging/repeated_points.h"

namespace relievo {
namespace {

// A cloud keeps all its points if its sampling distance, divided by that of the scene, is between these
// limits.
constexpr double much_closer = 1 / 1.3, much_wider = 1.5;
constexpr Colour white{255, 255, 255};

// A cloud placed in the scene, with outward normals, and the same cloud in view coordinates.
struct PlacedCloud {
  std::string name;
  Cloud cloud, viewed;
  Spacing spacing;
};

struct Parts {
  std::vector<PlacedCloud> clouds;
  Mesh mesh;  // all meshes of the scene, merged
  std::size_t left_out = 0;
  std::vector<SampleNote> notes;
};

// Appends the values of a member of `from` to those of the same member of `to`. The member has one value per
// point, such as a colour or an own height. If the member of only one of the two objects has values, the
// points of the other object get the value `usual`.
template <typename T, typename Value>
void append_member(T& to, const T& from, std::vector<Value> T::*member, const Value& usual) {
  if ((to.*member).empty() && (from.*member).empty()) return;
  (to.*member).resize(to.points.size(), usual);
  append(to.*member, from.*member);
  (to.*member).resize(to.points.size() + from.points.size(), usual);
}

using relievo::append;

void append(Cloud& to, const Cloud& from) {
  append_member(to, from, &Cloud::own_heights, 0.F);
  append_member(to, from, &Cloud::colours, white);
  append(to.points, from.points);
  append(to.normals, from.normals);
  append(to.outlines, from.outlines);
}

void append(Mesh& to, const Mesh& from) {
  append_member(to, from, &Mesh::own_heights, 0.F);
  append_member(to, from, &Mesh::colours, white);
  const auto first = static_cast<Index>(to.points.size());
  for (const auto& [a, b, c] : from.triangles) to.triangles.push_back({a + first, b + first, c + first});
  append(to.points, from.points);
  append(to.corner_normals, from.corner_normals);
}

std::vector<float> own_heights_of(const SceneModel& model, std::size_t points) {
  if (!model.pose.height) return {};
  return std::vector<float>(points, static_cast<float>(*model.pose.height));
}

Mesh placed_mesh(const SceneModel& model, const PlacedModel& place) {
  const Mesh& mesh = model.file->mesh;
  Mesh placed{mesh.points, mesh.triangles, normals_to_show(mesh), mesh.colours,
              own_heights_of(model, mesh.points.size())};
  const Eigen::Matrix3f turn = place.turn.cast<float>();
  parallel_for(placed.points.size(), [&](std::size_t i) { placed.points[i] = place(mesh.points[i]); });
  parallel_for(placed.triangles.size(), [&](std::size_t t) {
    for (Vec3f& n : placed.corner_normals[t]) n = turn * n;
    if (!model.pose.is_mirrored) return;
    std::swap(placed.triangles[t][1], placed.triangles[t][2]);
    std::swap(placed.corner_normals[t][1], placed.corner_normals[t][2]);
  });
  return placed;
}

PlacedCloud placed_cloud(const SceneModel& model, const PlacedModel& place, const View& view, Parts& parts) {
  PlacedCloud placed{model.name, model.file->cloud, {}, {}};
  if (const std::vector<Index> outlying = outliers(placed.cloud); !outlying.empty()) {
    placed.cloud = erase_points(placed.cloud, outlying);
    parts.left_out += outlying.size();
    parts.notes.push_back({SampleNote::Kind::outliers, model.name, outlying.size()});
  }
  const std::size_t given = placed.cloud.size();
  placed.cloud = without_repeated_points(std::move(placed.cloud));
  if (placed.cloud.size() < given)
    parts.notes.push_back({SampleNote::Kind::repeated, model.name, given - placed.cloud.size()});
  placed.cloud.is_height_field = false;  // other models may be in front of it
  placed.cloud.own_heights = own_heights_of(model, placed.cloud.size());
  const Eigen::Matrix3f turn = place.turn.cast<float>();
  for (Vec3& p : placed.cloud.points) p = place(p);
  for (Vec3f& n : placed.cloud.normals) n = turn * n;
  for (Vec3f& axis : placed.cloud.axes) axis = turn * axis;
  placed.viewed = in_view(placed.cloud, view);
  placed.spacing = measure_spacing(placed.viewed);
  const OriginalNormals were = orient_normals(placed.viewed, placed.spacing, placed.cloud);
  if (were == OriginalNormals::usable) return placed;
  parts.notes.push_back({were == OriginalNormals::missing ? SampleNote::Kind::estimated_normals
                                                          : SampleNote::Kind::turned_normals,
                         model.name});
  const Eigen::Matrix3f back = view.R_view_model.transpose().cast<float>();
  placed.cloud.normals.resize(placed.cloud.size());
  parallel_for(placed.cloud.size(),
               [&](std::size_t i) { placed.cloud.normals[i] = back * placed.viewed.normals[i]; });
  return placed;
}

Result<Parts> place_all(const Scene& scene, const std::vector<PlacedModel>& places, const View& view,
                        Progress* progress) {
  Parts parts;
  for (std::size_t i = 0; i < places.size(); ++i) {
    RELIEVO_CHECK(begin_stage(progress, "models", 0));
    const SceneModel& model = scene.models[i];
    if (!model.file->mesh.empty()) {
      append(parts.mesh, placed_mesh(model, places[i]));
      continue;
    }
    if (model.file->cloud.size() < 4)
      return geometry_error(model.name, cat("expected at least 4 points, found ", model.file->cloud.size()));
    parts.clouds.push_back(placed_cloud(model, places[i], view, parts));
    if (!(parts.clouds.back().spacing.rho > 0))
      return geometry_error(model.name,
                            "expected points at a distance from each other, found most of them equal");
  }
  return parts;
}

// Returns the area, in the view plane, of those points that face the viewer. Hidden points count, too.
double shown_area(const PlacedCloud& cloud) {
  double sum = 0;
  for (std::size_t i = 0; i < cloud.viewed.size(); ++i) {
    const auto side = static_cast<double>(cloud.spacing.local[i]);
    sum += side * side * std::max(0.0, static_cast<double>(cloud.viewed.normals[i].z()));
  }
  return sum;
}

// Returns the area, in the view plane, of those triangles of a closed mesh that face the viewer. Hidden
// triangles count, too. The orientation of triangles is ignored.
double shown_area(const Mesh& mesh, const View& view) {
  const Vec3 to_viewer = view.R_view_model.row(2);
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.points[b] - mesh.points[a], q = mesh.points[c] - mesh.points[a];
    // The cross product gives twice the area of a triangle, and only half of a closed mesh faces the viewer.
    sum += std::abs(p.cross(q).dot(to_viewer)) / 4;
  }
  return sum;
}

// Returns the common sampling distance of all points.
double common_spacing(const Parts& parts, const View& view, double points) {
  double area = shown_area(parts.mesh, view), finest = std::numeric_limits<double>::infinity();
  for (const PlacedCloud& cloud : parts.clouds) {
    area += shown_area(cloud);
    finest = std::min(finest, cloud.spacing.rho);
  }
  const double wanted = std::sqrt(area / points);
  return parts.mesh.empty() ? std::max(wanted, finest) : wanted;
}

// Returns the visible side of a coarse cloud as a mesh in the scene's axes.
Mesh front_in_scene(const PlacedCloud& placed, const View& view) {
  Mesh mesh = front_mesh(placed.viewed, placed.spacing);
  const Mat3 back = view.R_view_model.transpose();
  const Vec3 centre = bounds(placed.cloud).centre();
  for (Vec3& p : mesh.points) p = back * p + centre;
  for (auto& normals : mesh.corner_normals)
    for (Vec3f& n : normals) n = back.cast<float>() * n;
  return mesh;
}

// Brings clouds to the common spacing. Returns the points of all clouds except coarse clouds. Adds coarse
// clouds to parts.mesh as triangles.
Cloud even_clouds(Parts& parts, double spacing, const View& view) {
  Cloud all;
  for (PlacedCloud& placed : parts.clouds) {
    // Each model has a scale factor of its own, so depths are not proportional to the values of a file any
    // more.
    if (placed.cloud.units_per_value) all.units_per_value = 0;
    const double own = placed.spacing.rho;
    if (own > much_wider * spacing) {
      append(parts.mesh, front_in_scene(placed, view));
      parts.notes.push_back({SampleNote::Kind::coarse, placed.name});
    } else if (own < much_closer * spacing) {
      const Cloud thin = subsample(placed.cloud, placed.spacing, spacing);
      if (thin.size() < placed.cloud.size())
        parts.notes.push_back({SampleNote::Kind::fine, placed.name, thin.size(), placed.cloud.size()});
      append(all, thin);
    } else {
      append(all, placed.cloud);
    }
    placed = {};
  }
  return all;
}

// Returns the cloud without its outliers. If there are none, the cloud is not copied.
ViewSample without_outliers(std::shared_ptr<const Cloud> cloud) {
  const std::vector<Index> far = outliers(*cloud);
  if (far.empty()) return {std::move(cloud), 0, {}};
  return {std::make_shared<const Cloud>(erase_points(*cloud, far)),
          far.size(),
          {{SampleNote::Kind::outliers, {}, far.size()}}};
}

Result<ViewSample> sample_file(const std::shared_ptr<const CloudFile>& file, const View& view, double points,
                               Progress* progress) {
  if (file->mesh.empty()) return without_outliers({file, &file->cloud});
  RELIEVO_TRY(Cloud sampled, sample_mesh(file->mesh, view, {points}, progress));
  const std::size_t taken = sampled.size();
  ViewSample sample = without_outliers(std::make_shared<const Cloud>(std::move(sampled)));
  sample.notes.push_back({SampleNote::Kind::mesh, {}, taken, file->mesh.triangles.size()});
  return sample;
}

}  // namespace

double usual_points(const Scene& scene) {
  constexpr double for_each_triangle = 15, fewest = 1e5, most = MeshSampling{}.points;
  double triangles = 0;
  for (const SceneModel& model : scene.models) {
    if (model.file->mesh.empty()) return most;
    triangles += static_cast<double>(model.file->mesh.triangles.size());
  }
  return std::clamp(for_each_triangle * triangles, fewest, most);
}

Result<ViewSample> sample_for_view(const Scene& scene, const View& view, std::optional<double> wanted,
                                   Progress* progress) {
  const double points = wanted.value_or(usual_points(scene));
  RELIEVO_TRY(const std::vector<PlacedModel> places, place_models(scene, view));
  if (scene.models.size() == 1 && scene.models[0].pose == Pose{})
    return sample_file(scene.models[0].file, view, points, progress);
  RELIEVO_CHECK(check_points(points));
  RELIEVO_TRY(Parts parts, place_all(scene, places, view, progress));
  MeshSampling sampling{points};
  if (!parts.clouds.empty()) sampling.spacing = common_spacing(parts, view, points);
  Cloud all = even_clouds(parts, sampling.spacing, view);
  if (!parts.mesh.empty()) {
    RELIEVO_TRY(const Cloud sampled, sample_mesh(parts.mesh, view, sampling, progress));
    append(all, sampled);
  }
  return ViewSample{std::make_shared<const Cloud>(std::move(all)), parts.left_out, std::move(parts.notes)};
}

}  // namespace relievo
