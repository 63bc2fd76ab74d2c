// Reads the model of a 3MF file: the XML document in its archive, and the documents beside it that it refers
// to. Meshes are placed according to the build.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "io/formats.h"
#include "io/polygon.h"
#include "io/text.h"
#include "io/xml.h"
#include "relievo/core/text.h"
#include "relievo/core/types.h"

namespace relievo::io {
namespace {

// Reads "#RRGGBB" or "#RRGGBBAA"; the opacity AA is ignored.
std::optional<Colour> parse_colour(std::string_view text) {
  if (!text.starts_with('#') || (text.size() != 7 && text.size() != 9)) return std::nullopt;
  Colour colour = {};
  for (std::size_t c = 0; c < 3; ++c) {
    const char* const first = text.data() + 1 + 2 * c;
    const auto [end, failed] = std::from_chars(first, first + 2, colour[c], 16);
    if (failed != std::errc{} || end != first + 2) return std::nullopt;
  }
  return colour;
}

// The colours of a document: base materials, and colour groups of the materials extension.
class ThreeMfColours {
 public:
  // Adds the colours of a resource, if it is a group of base materials or colours. The document must outlive
  // this object.
  void take(const XmlElements& elements, std::size_t resource) {
    const std::string_view kind = local_name(elements[resource].name);
    const bool are_materials = kind == "basematerials";
    if (!are_materials && kind != "colorgroup") return;
    std::vector<Colour>& group = groups_[elements[resource].attribute("id")];
    for (std::size_t i = resource + 1; i < elements[resource].end; i = elements[i].end)
      if (local_name(elements[i].name) == (are_materials ? "base" : "color"))
        group.push_back(parse_colour(elements[i].attribute(are_materials ? "displaycolor" : "color"))
                            .value_or(Colour{255, 255, 255}));
  }

  bool is_empty() const { return groups_.empty(); }

  // Returns the colour of corner `corner` (0 to 2) of a triangle; nothing if the colour is missing or
  // unknown. The triangle is a part of `object`.
  std::optional<Colour> of_corner(const XmlElement& object, const XmlElement& triangle,
                                  std::size_t corner) const {
    // A triangle without colour has the colour of its object. A corner without colour has the colour of the
    // first corner.
    constexpr std::array names = {"p1", "p2", "p3"};
    std::string_view index = triangle.attribute(names[corner]), id = triangle.attribute("pid");
    if (index.empty()) index = triangle.attribute("p1");
    if (index.empty()) index = object.attribute("pindex"), id = object.attribute("pid");
    if (id.empty()) id = object.attribute("pid");
    const auto group = groups_.find(id);
    const auto number = parse_integer(index);
    if (group == groups_.end() || !number || *number < 0 ||
        static_cast<std::uint64_t>(*number) >= group->second.size())
      return std::nullopt;
    return group->second[static_cast<std::size_t>(*number)];
  }

 private:
  std::map<std::string_view, std::vector<Colour>> groups_;  // by resource id
};

constexpr std::size_t most_levels = 8, most_mesh_corners = 100'000'000;

// A document. Its texts are views of its bytes.
struct ModelPart {
  std::vector<std::byte> bytes;
  XmlElements elements;
  std::map<std::string_view, std::size_t> objects;  // by id: index of the object's element
  ThreeMfColours colours;
};

std::string_view text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class ThreeMfReader {
 public:
  explicit ThreeMfReader(const Source& source) : source_(source) {}

  Result<RawCloud> read() {
    RELIEVO_TRY(const ModelPart* const part, parsed("", source_.bytes));
    const std::size_t build = find_child(part->elements, 0, "build");
    if (build == 0) return source_.error("element model", "expected an element build, found none");
    RELIEVO_CHECK(place_children(*part, build, {Transform::Identity(), 0}));
    while (!open_.empty()) {
      const Placed placed = open_.back();
      open_.pop_back();
      RELIEVO_CHECK(add_object(placed));
    }
    if (!colours_.empty()) colours_.resize(points_.size(), white);
    RawCloud raw{Cloud{std::move(points_), {}, std::move(colours_)}, "3MF"};
    raw.mesh = mesh_over(raw.cloud, std::move(triangles_));
    if (supports_ > 0)
      raw.remarks.push_back(cat("left out ", supports_, " objects that only support others while printing"));
    return raw;
  }

 private:
  using Transform = Eigen::Affine3d;
  struct Place {
    Transform transform;
    std::size_t level = 0;  // number of enclosing objects
  };
  struct Placed {
    const ModelPart* part;
    std::size_t object;  // index of its element
    Place place;
  };

  std::unexpected<Error> fail(const XmlElement& element, std::string expected) const {
    return source_.error(cat("element ", printable(element.name)), std::move(expected));
  }

  Result<const ModelPart*> parsed(const std::string& name, std::string_view text) {
    ModelPart& part = *parts_.try_emplace(name, std::make_unique<ModelPart>()).first->second;
    RELIEVO_TRY(part.elements, parse_xml(text, source_));
    const std::size_t resources = find_child(part.elements, 0, "resources");
    for (std::size_t i = resources + 1; resources != 0 && i < part.elements[resources].end;
         i = part.elements[i].end) {
      part.colours.take(part.elements, i);
      if (part.elements[i].name == "object") part.objects[part.elements[i].attribute("id")] = i;
    }
    return &part;
  }

  // Returns the document with that path in the archive, such as "/3D/Objects/a.model". The main document is
  // in the folder "3D".
  Result<const ModelPart*> part_at(std::string_view path, const XmlElement& element) {
    constexpr std::string_view folder = "/3D/";
    const std::string name(path.starts_with(folder) ? path.substr(folder.size()) : "");
    if (const auto known = parts_.find(name); known != parts_.end() && !name.empty())
      return known->second.get();
    const bool may_be_read = !name.empty() && !name.contains("..") && source_.beside;
    auto bytes = may_be_read ? (*source_.beside)(name) : fail(element, "");
    if (!bytes) return fail(element, cat("expected a part of the archive, found ", in_quotes(path)));
    parts_[name] = std::make_unique<ModelPart>();
    parts_[name]->bytes = std::move(*bytes);
    return parsed(name, text_of(parts_[name]->bytes));
  }

  // Opens the objects to which the children of an element (items or components) refer.
  Result<void> place_children(const ModelPart& part, std::size_t parent, const Place& at) {
    if (at.level > most_levels)
      return fail(part.elements[parent],
                  cat("expected objects at most ", most_levels, " levels deep, found more"));
    for (std::size_t i = parent + 1; i < part.elements[parent].end; i = part.elements[i].end) {
      const XmlElement& child = part.elements[i];
      if (child.name != "item" && child.name != "component") continue;
      const ModelPart* of = &part;
      if (const std::string_view path = child.attribute("p:path"); !path.empty()) {
        RELIEVO_TRY(of, part_at(path, child));
      }
      const auto object = of->objects.find(child.attribute("objectid"));
      if (object == of->objects.end())
        return fail(child,
                    cat("expected the id of an object, found ", in_quotes(child.attribute("objectid"))));
      RELIEVO_TRY(const Transform transform, transform_of(child));
      open_.push_back({of, object->second, {at.transform * transform, at.level + 1}});
      if (++placed_ > most_placed) return fail(child, "expected at most 100000 objects, found more");
    }
    return {};
  }

  // The twelve numbers are the rows of a matrix; points are row vectors on its left.
  Result<Transform> transform_of(const XmlElement& element) const {
    Transform transform = Transform::Identity();
    const std::string_view text = element.attribute("transform");
    if (text.empty()) return transform;
    Words words(text);
    for (Eigen::Index i = 0; i < 12; ++i) {
      const auto number = parse_number(words.next());
      if (!number) return fail(element, cat("expected 12 numbers as transform, found ", in_quotes(text)));
      transform(i % 3, i / 3) = *number;
    }
    return transform;
  }

  Result<void> add_object(const Placed& placed) {
    const XmlElements& elements = placed.part->elements;
    if (elements[placed.object].attribute("type").ends_with("support")) {
      ++supports_;
      return {};
    }
    if (const std::size_t components = find_child(elements, placed.object, "components"))
      return place_children(*placed.part, components, placed.place);
    const std::size_t mesh = find_child(elements, placed.object, "mesh");
    if (mesh == 0) return {};
    const std::size_t vertices = find_child(elements, mesh, "vertices"),
                      triangles = find_child(elements, mesh, "triangles"), first = points_.size();
    if (vertices == 0 || triangles == 0)
      return fail(elements[mesh], "expected vertices and triangles, found only one of them");
    for (std::size_t i = vertices + 1; i < elements[vertices].end; i = elements[i].end)
      RELIEVO_CHECK(add_vertex(elements[i], placed.place.transform));
    const bool is_mirrored = placed.place.transform.linear().determinant() < 0;
    for (std::size_t i = triangles + 1; i < elements[triangles].end; i = elements[i].end)
      if (elements[i].name == "triangle") {
        RELIEVO_CHECK(add_triangle(elements[i], first, is_mirrored));
        if (!placed.part->colours.is_empty())
          colour_corners(placed.part->colours, elements[placed.object], elements[i], first);
      }
    if (points_.size() <= most_mesh_corners && triangles_.size() <= most_mesh_corners) return {};
    return fail(elements[mesh], "expected at most 100000000 vertices and triangles, found more");
  }

  Result<void> add_vertex(const XmlElement& vertex, const Transform& transform) {
    const auto x = parse_number(vertex.attribute("x")), y = parse_number(vertex.attribute("y")),
               z = parse_number(vertex.attribute("z"));
    if (!x || !y || !z)
      return fail(vertex, "expected numbers x, y and z, found " + in_quotes(vertex.attributes));
    points_.push_back(transform * Vec3(*x, *y, *z));
    return {};
  }

  Result<void> add_triangle(const XmlElement& triangle, std::size_t first, bool is_mirrored) {
    std::array<std::int64_t, 3> corners = {};
    const std::array names = {"v1", is_mirrored ? "v3" : "v2", is_mirrored ? "v2" : "v3"};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto corner = parse_integer(triangle.attribute(names[i]));
      if (!corner || *corner < 0 || static_cast<std::uint64_t>(*corner) >= points_.size() - first)
        return fail(triangle, cat("expected numbers of vertices below ", points_.size() - first, ", found ",
                                  in_quotes(triangle.attribute(names[i]))));
      corners[i] = *corner + static_cast<std::int64_t>(first);
    }
    add_face(corners, FaceKind::polygon, points_, triangles_);
    return {};
  }

  // Gives the corners of a triangle their colours. The vertex indices must have been checked. A vertex gets
  // the colour of its first corner that has one.
  void colour_corners(const ThreeMfColours& known, const XmlElement& object, const XmlElement& triangle,
                      std::size_t first) {
    constexpr std::array names = {"v1", "v2", "v3"};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::optional<Colour> colour = known.of_corner(object, triangle, i);
      if (!colour) continue;
      colours_.resize(points_.size(), white);
      is_coloured_.resize(points_.size(), 0);
      const auto vertex =
          first + static_cast<std::size_t>(parse_integer(triangle.attribute(names[i])).value_or(0));
      if (is_coloured_[vertex] == 0) colours_[vertex] = *colour;
      is_coloured_[vertex] = 1;
    }
  }

  static constexpr std::size_t most_placed = 100'000;
  static constexpr Colour white = {255, 255, 255};

  const Source& source_;
  // The documents by name; the name of the main document is empty.
  std::map<std::string, std::unique_ptr<ModelPart>> parts_;
  std::vector<Placed> open_;
  std::size_t placed_ = 0, supports_ = 0;
  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<Colour> colours_;            // colours of the first points; empty if no point has a colour
  std::vector<std::uint8_t> is_coloured_;  // per vertex: whether it has a colour
};

}  // namespace

bool is_3mf(const Source& source) {
  if (has_control_bytes(source.bytes)) return false;
  return has_ending(source.name, ".model") ||
         source.bytes.substr(0, 4096).contains("schemas.microsoft.com/3dmanufacturing/core");
}

Result<RawCloud> read_3mf(const Source& source) {
  return ThreeMfReader(source).read();
}

}  // namespace relievo::io
