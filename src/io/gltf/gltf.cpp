// Reads glTF 2.0: the triangles and points of the scene's meshes, transformed by their nodes.
#include "io/gltf/gltf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "io/formats.h"
#include "io/polygon.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

using Transform = Eigen::Affine3d;

constexpr std::size_t most_vertices = 100'000'000;  // limit, because small files can repeat a mesh many times

constexpr std::array placements = {"TRANSLATION", "ROTATION", "SCALE"};  // in the order of their application

constexpr const char* draco = "KHR_draco_mesh_compression";

constexpr std::size_t points_mode = 0, triangles_mode = 4, strip_mode = 5, fan_mode = 6;

// Returns whether a file that requires this extension can be read: the extension is supported, or affects
// only the look of surfaces.
bool is_readable_with(std::string_view extension) {
  for (const char* const known :
       {"KHR_mesh_quantization", "KHR_meshopt_compression", "EXT_meshopt_compression",
        "EXT_mesh_gpu_instancing", "EXT_mesh_features", "EXT_structural_metadata", "KHR_techniques_webgl",
        "MSFT_packing_occlusionRoughnessMetallic", "MSFT_packing_normalRoughnessMetallic"})
    if (extension == known) return true;
  for (const char* const look : {"material", "texture", "light", "animation", "xmp", "audio"})
    if (extension.contains(look)) return true;
  return false;
}

// The vertices of a primitive, one per position.
struct Vertices {
  AccessorValues positions, normals, colours;
  // Colours from the material, used if `colours` is empty; empty if the file has no textures.
  std::vector<Colour> material_colours = {};

  std::size_t count() const { return positions.count(); }
};

Vec3 vector_at(const AccessorValues& values, std::size_t i) {
  return Eigen::Map<const Vec3>(values.numbers.data() + i * values.components);
}

class GltfReader {
 public:
  GltfReader(const Source& source, GltfFile& file) : source_(source), file_(file), textures_(file) {}

  Result<RawCloud> read() {
    RELIEVO_CHECK(check_extensions());
    const std::vector<std::size_t> first = roots();
    RELIEVO_CHECK(first.empty() ? add_all_meshes() : walk_nodes(first));
    if (points_.empty())
      return source_.error("meshes", has_lines_ ? "expected triangles or points, found lines"
                                                : "expected triangles or points, found none");
    if (normals_.size() != points_.size()) normals_.clear();
    if (colours_.size() != points_.size()) colours_.clear();
    RawCloud raw{Cloud{std::move(points_), std::move(normals_), std::move(colours_)},
                 source_.bytes.starts_with("glTF") ? "glTF binary" : "glTF"};
    raw.mesh = mesh_over(raw.cloud, std::move(triangles_));
    add_remarks(raw);
    return raw;
  }

 private:
  void add_remarks(RawCloud& raw) const {
    if (!raw.mesh.empty() && single_points_ > 0)
      raw.remarks.push_back(cat("left out ", single_points_, " single points, as there are triangles, too"));
    raw.remarks.insert(raw.remarks.end(), textures_.remarks().begin(), textures_.remarks().end());
    if (has_lines_) raw.remarks.emplace_back("left out the lines");
  }

  // The placement of a mesh in the scene: the transforms of its copies, or the number of its skin. A mesh
  // with a skin needs no transform, because the skin alone determines the positions.
  struct Placement {
    std::vector<Transform> copies;
    std::size_t skin = no_index;
  };

  struct Visit {
    std::size_t node;
    Transform parent;
  };

  Result<void> check_extensions() const {
    const auto required = file_.json().find("extensionsRequired");
    if (required == file_.json().end() || !required->is_array()) return {};
    for (const Json& name : *required) {
      if (name == draco) return compressed("extensionsRequired");
      const std::string text = name.is_string() ? name.get<std::string>() : name.dump();
      if (!is_readable_with(text))
        return source_.error("extensionsRequired",
                             cat("expected no extension but those that are read here, found ",
                                 in_quotes(text), "; export the model without it, or as PLY, STL or OBJ"));
    }
    return {};
  }

  std::unexpected<Error> compressed(std::string place) const {
    return source_.error(std::move(place),
                         "expected meshes that are not compressed, found 'KHR_draco_mesh_compression'; "
                         "Blender opens the file, and exports it without compression");
  }

  // Returns whether the vertices exist only in compressed form. A file may also contain an uncompressed copy.
  bool is_compressed(const Json& primitive, const Json& attributes) const {
    const Json* extensions = object_in(primitive, "extensions");
    if (!extensions || !object_in(*extensions, draco)) return false;
    const Json* positions = file_.element("accessors", number_in(attributes, "POSITION", 0).value_or(0));
    return !positions || (!positions->contains("bufferView") && !positions->contains("sparse"));
  }

  // Returns the root nodes of the scene; without a scene, all nodes without a parent.
  std::vector<std::size_t> roots() const {
    std::vector<std::size_t> found;
    const auto collect = [&](const Json& list) {
      if (list.is_array())
        for (const Json& i : list)
          if (const auto number = whole_number(i)) found.push_back(*number);
    };
    const Json* scene = file_.element("scenes", number_in(file_.json(), "scene", 0).value_or(0));
    if (scene && scene->contains("nodes")) {
      collect((*scene)["nodes"]);
      return found;
    }
    std::size_t nodes = 0;
    for (; const Json* node = file_.element("nodes", nodes); ++nodes)
      if (node->contains("children")) collect((*node)["children"]);
    std::vector<bool> is_child(nodes);
    for (const std::size_t i : found)
      if (i < nodes) is_child[i] = true;
    found.clear();
    for (std::size_t i = 0; i < nodes; ++i)
      if (!is_child[i]) found.push_back(i);
    return found;
  }

  // A file without nodes is a library of meshes. All meshes are shown, without a transform.
  Result<void> add_all_meshes() {
    for (std::size_t i = 0; file_.element("meshes", i); ++i)
      RELIEVO_CHECK(add_mesh(i, {{Transform::Identity()}}));
    return {};
  }

  // Visits each node only once, which prevents endless loops in invalid files. In a valid file each node has
  // at most one parent.
  Result<void> walk_nodes(const std::vector<std::size_t>& first) {
    std::vector<Visit> open;
    for (const std::size_t i : first) open.push_back({i, Transform::Identity()});
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
      if (!own)
        return source_.error(
            place, "expected 16 numbers as matrix, 4 as rotation, 3 as translation and scale, found " +
                       shown_members(*node, {"matrix", "rotation", "translation", "scale"}));
      const Transform transform = visit.parent * *own;
      const auto mesh = number_in(*node, "mesh", no_index);
      if (!mesh)
        return source_.error(place,
                             cat("expected the number of a mesh, found ", in_quotes((*node)["mesh"].dump())));
      if (*mesh != no_index) {
        RELIEVO_TRY(const std::vector<Transform> copies, copies_of(*node, transform, place));
        RELIEVO_CHECK(add_mesh(*mesh, {copies, number_in(*node, "skin", no_index).value_or(no_index)}));
      }
      if (node->contains("children") && (*node)["children"].is_array())
        for (const Json& child : (*node)["children"])
          if (const auto number = whole_number(child)) open.push_back({*number, transform});
    }
    return {};
  }

  // Returns the transforms of the node's mesh: the transform of the node or, with EXT_mesh_gpu_instancing,
  // the transforms of its copies.
  Result<std::vector<Transform>> copies_of(const Json& node, const Transform& transform,
                                           const std::string& place) {
    const Json* attributes = &node;
    for (const char* const name : {"extensions", "EXT_mesh_gpu_instancing", "attributes"})
      if (attributes) attributes = object_in(*attributes, name);
    const auto is_placed = [&](const char* name) { return attributes->contains(name); };
    if (!attributes || std::ranges::none_of(placements, is_placed)) return std::vector{transform};
    std::vector<Transform> copies;
    for (const char* const name : placements) {
      if (!attributes->contains(name)) continue;
      const std::size_t needed = name == std::string_view("ROTATION") ? 4 : 3;
      RELIEVO_TRY(const AccessorValues values, attribute(*attributes, name, needed, place));
      if (copies.empty()) copies.assign(values.count(), transform);
      if (values.count() != copies.size())
        return source_.error(place, cat("expected as many values of ", name, " as copies, ", copies.size(),
                                        ", found ", values.count()));
      for (std::size_t i = 0; i < copies.size(); ++i) {
        const double* v = values.numbers.data() + i * values.components;
        if (needed == 4)
          copies[i].rotate(Eigen::Quaterniond(v[3], v[0], v[1], v[2]).normalized());
        else if (name == std::string_view("SCALE"))
          copies[i].scale(Vec3(v[0], v[1], v[2]));
        else
          copies[i].translate(Vec3(v[0], v[1], v[2]));
      }
    }
    return copies;
  }

  Result<void> add_mesh(std::size_t i, const Placement& placement) {
    const std::string place = "mesh " + std::to_string(i);
    const Json* mesh = file_.element("meshes", i);
    if (!mesh) return source_.error(place, "expected a mesh, found none of that number");
    const auto primitives = mesh->find("primitives");
    if (primitives == mesh->end() || !primitives->is_array())
      return source_.error(place, "expected primitives, found none");
    for (const Json& primitive : *primitives) RELIEVO_CHECK(add_primitive(primitive, placement, place));
    return {};
  }

  Result<void> add_primitive(const Json& primitive, const Placement& placement, const std::string& place) {
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object())
      return source_.error(place, "expected attributes, found none");
    // The format requires readers to skip primitives without positions.
    if (!attributes->contains("POSITION")) return {};
    const auto mode = number_in(primitive, "mode", triangles_mode);
    const bool is_read = mode && (*mode == points_mode || (*mode >= triangles_mode && *mode <= fan_mode));
    has_lines_ = has_lines_ || !is_read;
    if (!is_read) return {};
    if (is_compressed(primitive, *attributes)) return compressed(place);
    RELIEVO_TRY(Vertices vertices, vertices_of(*attributes, place));
    if (textures_.has_any() && vertices.colours.count() == 0)
      vertices.material_colours = textures_.colours(primitive, *attributes, vertices.count());
    std::vector<std::int64_t> order;
    if (*mode != points_mode) {
      RELIEVO_TRY(order, order_of(primitive, vertices.count(), place));
    }
    if (vertices.count() == 0) return {};
    std::vector<Transform> posed;
    if (placement.skin != no_index) {
      RELIEVO_TRY(posed,
                  skinned_transforms(source_, file_, placement.skin, *attributes, vertices.count(), place));
    }
    for (const Transform& copy : posed.empty() ? placement.copies : std::vector{posed[0]}) {
      if (points_.size() + vertices.count() > most_vertices || triangles_.size() > most_vertices)
        return source_.error(place, cat("expected at most 100000000 vertices and as many triangles, found ",
                                        points_.size() + vertices.count(), " and ", triangles_.size()));
      const std::size_t first = points_.size();
      if (*mode == points_mode) single_points_ += vertices.count();
      add_vertices(vertices, copy, posed);
      add_triangles(order, *mode, first, copy.linear().determinant() < 0);
    }
    return {};
  }

  // Returns the vertex indices of the triangles' corners in sequence.
  Result<std::vector<std::int64_t>> order_of(const Json& primitive, std::size_t vertices,
                                             const std::string& place) {
    std::vector<std::int64_t> order;
    if (!primitive.contains("indices")) {
      for (std::size_t i = 0; i < vertices; ++i) order.push_back(static_cast<std::int64_t>(i));
      return order;
    }
    const auto number = number_in(primitive, "indices", no_index);
    RELIEVO_TRY(const AccessorValues indices, file_.accessor(number.value_or(no_index), place));
    if (indices.components != 1 || indices.type == NumberType::float32)
      return source_.error(place, cat("expected whole numbers as indices, found ",
                                      indices.type == NumberType::float32 ? "fractions" : "vectors"));
    for (const double i : indices.numbers) {
      if (!(i >= 0 && i < static_cast<double>(vertices)))
        return source_.error(place, cat("expected numbers of vertices below ", vertices, ", found ", i));
      order.push_back(static_cast<std::int64_t>(i));
    }
    return order;
  }

  // Returns an attribute's vectors of `wanted` numbers. Colours may have one more number for opacity.
  Result<AccessorValues> attribute(const Json& attributes, const char* name, std::size_t wanted,
                                   const std::string& place) {
    const auto number = number_in(attributes, name, no_index);
    RELIEVO_TRY(AccessorValues values, file_.accessor(number.value_or(no_index), place));
    const bool has_alpha = name == std::string_view("COLOR_0") && values.components == 4;
    if (values.components != wanted && !has_alpha)
      return source_.error(place, cat("expected vectors of ", wanted, " numbers as ", name,
                                      ", found vectors of ", values.components));
    return values;
  }

  Result<Vertices> vertices_of(const Json& attributes, const std::string& place) {
    Vertices all;
    RELIEVO_TRY(all.positions, attribute(attributes, "POSITION", 3, place));
    if (attributes.contains("NORMAL")) {
      RELIEVO_TRY(all.normals, attribute(attributes, "NORMAL", 3, place));
      if (all.normals.count() != all.count())
        return source_.error(place, cat("expected a normal for each of ", all.count(), " vertices, found ",
                                        all.normals.count()));
    }
    if (attributes.contains("COLOR_0")) {
      RELIEVO_TRY(all.colours, attribute(attributes, "COLOR_0", 3, place));
      if (all.colours.count() != all.count())
        return source_.error(place, cat("expected a colour for each of ", all.count(), " vertices, found ",
                                        all.colours.count()));
    }
    return all;
  }

  // Adds the vertices. Each is transformed by its own transform in `posed` or, if that is empty, by
  // `transform`.
  void add_vertices(const Vertices& all, const Transform& transform, const std::vector<Transform>& posed) {
    const auto turn_of = [](const Transform& by) -> Mat3 { return by.linear().inverse().transpose(); };
    const Mat3 turn = turn_of(transform);
    for (std::size_t i = 0; i < all.count(); ++i)
      points_.push_back((posed.empty() ? transform : posed[i]) * vector_at(all.positions, i));
    for (std::size_t i = 0; i < all.normals.count(); ++i)
      normals_.push_back(unit_normal((posed.empty() ? turn : turn_of(posed[i])) * vector_at(all.normals, i)));
    colours_.insert(colours_.end(), all.material_colours.begin(), all.material_colours.end());
    for (std::size_t i = 0; i < all.colours.count(); ++i) {
      const Vec3 colour = 255 * vector_at(all.colours, i);
      colours_.push_back({as_byte(colour.x()), as_byte(colour.y()), as_byte(colour.z())});
    }
  }

  // Adds triangles; `first` is added to the indices of their vertices. If the transform mirrors, the order of
  // their corners is reversed, because otherwise the triangles would face inwards.
  void add_triangles(std::vector<std::int64_t> corners, std::size_t mode, std::size_t first,
                     bool is_mirrored) {
    const auto before = static_cast<std::ptrdiff_t>(triangles_.size());
    for (std::int64_t& corner : corners) corner += static_cast<std::int64_t>(first);
    if (mode != triangles_mode)
      add_face(corners, mode == strip_mode ? FaceKind::strip : FaceKind::fan, points_, triangles_);
    for (std::size_t i = 0; mode == triangles_mode && i + 2 < corners.size(); i += 3)
      add_face(std::span(corners).subspan(i, 3), FaceKind::polygon, points_, triangles_);
    for (auto t = triangles_.begin() + before; is_mirrored && t != triangles_.end(); ++t)
      std::swap((*t)[1], (*t)[2]);
  }

  const Source& source_;
  GltfFile& file_;
  GltfTextures textures_;
  bool has_lines_ = false;
  std::size_t single_points_ = 0;
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
  RELIEVO_TRY(GltfFile file, GltfFile::open(source));
  return GltfReader(source, file).read();
}

}  // namespace relievo::io
