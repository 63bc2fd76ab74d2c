// glTF 2.0: the triangles of the scene's meshes, transformed by their nodes.
#include "io/gltf.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "io/faces.h"
#include "io/formats.h"
#include "io/text.h"

namespace relievo::io {
namespace {

using Transform = Eigen::Affine3d;

constexpr std::size_t most_vertices = 100'000'000;  // a small file can ask for more: nodes may repeat a mesh

constexpr std::size_t triangles_mode = 4, strip_mode = 5, fan_mode = 6;

// Returns a member that is an array of `n` numbers; `otherwise` if it is missing; nothing if it is anything
// else.
std::optional<std::vector<double>> numbers_in(const Json& object, const char* name,
                                              std::vector<double> otherwise) {
  const auto found = object.find(name);
  if (found == object.end()) return otherwise;
  if (!found->is_array() || found->size() != otherwise.size()) return std::nullopt;
  for (std::size_t i = 0; i < otherwise.size(); ++i) {
    if (!(*found)[i].is_number()) return std::nullopt;
    otherwise[i] = (*found)[i].get<double>();
  }
  return otherwise;
}

std::optional<Transform> transform_of(const Json& node) {
  const auto matrix = numbers_in(node, "matrix", std::vector<double>(16));
  const auto t = numbers_in(node, "translation", {0, 0, 0}), s = numbers_in(node, "scale", {1, 1, 1}),
             q = numbers_in(node, "rotation", {0, 0, 0, 1});
  if (!matrix || !t || !s || !q) return std::nullopt;
  Transform transform = Transform::Identity();
  if (node.contains("matrix")) {
    transform.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix4d>(matrix->data()).topRows<3>();
    return transform;
  }
  const Eigen::Quaterniond turn((*q)[3], (*q)[0], (*q)[1], (*q)[2]);
  transform.translate(Vec3((*t)[0], (*t)[1], (*t)[2])).rotate(turn.normalized());
  return transform.scale(Vec3((*s)[0], (*s)[1], (*s)[2]));
}

class GltfReader {
 public:
  GltfReader(const Source& source, const GltfFile& file) : source_(source), file_(file) {}

  Result<RawCloud> read() {
    if (const auto refused = refuse_compression(); !refused) return std::unexpected(refused.error());
    if (const auto walked = walk_nodes(); !walked) return std::unexpected(walked.error());
    if (triangles_.empty()) return source_.error("meshes", "expected triangles, found none");
    if (normals_.size() != points_.size()) normals_.clear();
    if (colours_.size() != points_.size()) colours_.clear();
    RawCloud raw{Cloud{std::move(points_), std::move(normals_), std::move(colours_)},
                 source_.bytes.starts_with("glTF") ? "glTF binary" : "glTF"};
    raw.mesh = mesh_over(raw.cloud, std::move(triangles_));
    return raw;
  }

 private:
  struct Visit {
    std::size_t node;
    Transform parent;
  };

  Result<void> refuse_compression() const {
    const auto required = file_.json().find("extensionsRequired");
    if (required == file_.json().end() || !required->is_array()) return {};
    for (const Json& name : *required)
      if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression")
        return source_.error("extensionsRequired", "expected meshes that are not compressed, found " +
                                                       in_quotes(name.get_ref<const std::string&>()));
    return {};
  }

  // Returns the root nodes of the scene; without a scene, all nodes that are nobody's child.
  std::vector<std::size_t> roots() const {
    std::vector<std::size_t> found;
    const auto collect = [&](const Json& list) {
      if (list.is_array())
        for (const Json& i : list)
          if (i.is_number_unsigned()) found.push_back(i.get<std::size_t>());
    };
    const Json* scene = file_.element("scenes", number_in(file_.json(), "scene", 0).value_or(0));
    if (scene && scene->contains("nodes")) {
      collect((*scene)["nodes"]);
      return found;
    }
    for (std::size_t i = 0; const Json* node = file_.element("nodes", i); ++i)
      if (node->contains("children")) collect((*node)["children"]);
    const std::vector<std::size_t> children = std::move(found);
    found.clear();
    for (std::size_t i = 0; file_.element("nodes", i); ++i)
      if (std::ranges::find(children, i) == children.end()) found.push_back(i);
    return found;
  }

  // Visits each node once. In a valid file no node has two parents; in others this keeps cycles from being
  // endless.
  Result<void> walk_nodes() {
    std::vector<Visit> open;
    for (const std::size_t i : roots()) open.push_back({i, Transform::Identity()});
    std::vector<bool> is_seen;
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const std::string place = "node " + std::to_string(visit.node);
      const Json* node = file_.element("nodes", visit.node);
      if (!node) return source_.error(place, "expected a node, found none of that number");
      if (visit.node >= is_seen.size()) is_seen.resize(visit.node + 1);
      if (is_seen[visit.node]) return source_.error(place, "expected one parent, found two or a ring");
      is_seen[visit.node] = true;
      const auto own = transform_of(*node);
      if (!own) return source_.error(place, "expected numbers in its transformation, found others");
      const Transform transform = visit.parent * *own;
      const auto mesh = number_in(*node, "mesh", no_index);
      if (!mesh) return source_.error(place, "expected the number of a mesh, found another value");
      if (*mesh != no_index)
        if (const auto added = add_mesh(*mesh, transform); !added) return added;
      if (node->contains("children") && (*node)["children"].is_array())
        for (const Json& child : (*node)["children"])
          if (child.is_number_unsigned()) open.push_back({child.get<std::size_t>(), transform});
    }
    return {};
  }

  Result<void> add_mesh(std::size_t i, const Transform& transform) {
    const std::string place = "mesh " + std::to_string(i);
    const Json* mesh = file_.element("meshes", i);
    if (!mesh) return source_.error(place, "expected a mesh, found none of that number");
    const auto primitives = mesh->find("primitives");
    if (primitives == mesh->end() || !primitives->is_array())
      return source_.error(place, "expected primitives, found none");
    for (const Json& primitive : *primitives)
      if (const auto added = add_primitive(primitive, transform, place); !added) return added;
    return {};
  }

  Result<void> add_primitive(const Json& primitive, const Transform& transform, const std::string& place) {
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object())
      return source_.error(place, "expected attributes, found none");
    const auto mode = number_in(primitive, "mode", triangles_mode);
    if (!mode || *mode < triangles_mode || *mode > fan_mode) return {};  // points and lines
    const auto first = static_cast<Index>(points_.size());
    const auto added = add_vertices(*attributes, transform, place);
    if (!added) return std::unexpected(added.error());
    std::vector<double> order;
    if (primitive.contains("indices")) {
      const auto number = number_in(primitive, "indices", no_index);
      const auto indices = file_.accessor(source_, number.value_or(no_index), place);
      if (!indices) return std::unexpected(indices.error());
      indices->decode(order);
    } else {
      order.resize(*added);
      for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<double>(i);
    }
    for (const double i : order)
      if (!(i >= 0 && i < static_cast<double>(*added)))
        return source_.error(
            place, "expected numbers of vertices below " + std::to_string(*added) + ", found others");
    add_triangles(order, *mode, first);
    return {};
  }

  // Returns the number of vertices.
  Result<std::size_t> add_vertices(const Json& attributes, const Transform& transform,
                                   const std::string& place) {
    const auto vectors = [&](const char* name, std::vector<double>& to) -> Result<std::size_t> {
      const auto number = number_in(attributes, name, no_index);
      const auto accessor = file_.accessor(source_, number.value_or(no_index), place);
      if (!accessor) return std::unexpected(accessor.error());
      if (accessor->components < 3)
        return source_.error(place, "expected vectors of three numbers, found fewer");
      accessor->decode(to);
      return accessor->components;
    };
    std::vector<double> values;
    const auto width = vectors("POSITION", values);
    if (!width) return width;
    const std::size_t count = values.size() / *width;
    if (points_.size() + count > most_vertices)
      return source_.error(place, "expected at most 100000000 vertices, found more");
    for (std::size_t i = 0; i < count; ++i)
      points_.push_back(transform * Vec3(values[i * *width], values[i * *width + 1], values[i * *width + 2]));
    if (attributes.contains("NORMAL")) {
      values.clear();
      const auto wide = vectors("NORMAL", values);
      if (!wide) return wide;
      if (values.size() != count * *wide) return source_.error(place, "expected a normal for each vertex");
      const Mat3 turn =
          transform.linear().inverse().transpose() * (transform.linear().determinant() < 0 ? -1 : 1);
      for (std::size_t i = 0; i < count; ++i)
        normals_.push_back(
            unit_normal(turn * Vec3(values[i * *wide], values[i * *wide + 1], values[i * *wide + 2])));
    }
    if (!attributes.contains("COLOR_0")) return count;
    values.clear();
    const auto wide = vectors("COLOR_0", values);
    if (!wide) return wide;
    if (values.size() != count * *wide) return source_.error(place, "expected a colour for each vertex");
    const auto byte = [](double v) {
      return v > 0 ? static_cast<std::uint8_t>(std::min(255.0, 255 * v + .5)) : std::uint8_t{0};
    };
    for (std::size_t i = 0; i < count; ++i)
      colours_.push_back({byte(values[i * *wide]), byte(values[i * *wide + 1]), byte(values[i * *wide + 2])});
    return count;
  }

  void add_triangles(const std::vector<double>& order, std::size_t mode, Index first) {
    std::vector<std::int64_t> corners;
    for (const double i : order) corners.push_back(static_cast<std::int64_t>(i) + first);
    if (mode != triangles_mode) {
      add_face(corners, mode == strip_mode ? FaceKind::strip : FaceKind::polygon, points_.size(), triangles_);
      return;
    }
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      add_face(std::span(corners).subspan(i, 3), FaceKind::polygon, points_.size(), triangles_);
  }

  const Source& source_;
  const GltfFile& file_;
  std::vector<Vec3> points_;
  std::vector<Vec3f> normals_;
  std::vector<Colour> colours_;
  std::vector<Triangle> triangles_;
};

}  // namespace

bool is_gltf(const Source& source) {
  return source.bytes.starts_with("glTF") || has_ending(source.name, ".gltf") ||
         has_ending(source.name, ".glb");
}

Result<RawCloud> read_gltf(const Source& source) {
  const auto file = GltfFile::open(source);
  if (!file) return std::unexpected(file.error());
  return GltfReader(source, *file).read();
}

}  // namespace relievo::io
