#include "io/gltf/gltf.h"

#include "relievo/core/text.h"

namespace relievo::io {
namespace {

using Transform = Eigen::Affine3d;

// Returns the named member if it is an array of `n` numbers; `otherwise` if it is missing; nothing for any
// other value.
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

// Returns the parent of each node; no_index for roots.
std::vector<std::size_t> parents_in(const GltfFile& file) {
  std::vector<std::size_t> parents;
  for (std::size_t i = 0; const Json* node = file.element("nodes", i); ++i) {
    parents.resize(std::max(parents.size(), i + 1), no_index);
    if (!node->contains("children") || !(*node)["children"].is_array()) continue;
    for (const Json& child : (*node)["children"]) {
      const auto number = whole_number(child);
      if (!number || *number >= no_index || !file.element("nodes", *number)) continue;
      parents.resize(std::max(parents.size(), *number + 1), no_index);
      parents[*number] = i;
    }
  }
  return parents;
}

// Returns the transform of a node in the scene; nothing if the node is missing, invalid or its own ancestor.
std::optional<Transform> global_transform(const GltfFile& file, const std::vector<std::size_t>& parents,
                                          std::size_t node) {
  Transform global = Transform::Identity();
  for (std::size_t steps = 0; node != no_index; ++steps) {
    const Json* json = file.element("nodes", node);
    const auto own = json ? transform_of(*json) : std::nullopt;
    if (!own || steps > parents.size()) return std::nullopt;
    global = *own * global;
    node = parents[node];
  }
  return global;
}

// Returns the transform of each joint, from the mesh's original pose to the scene.
Result<std::vector<Transform>> joint_transforms(const Source& source, GltfFile& file, std::size_t skin,
                                                const std::string& place) {
  const Json* json = file.element("skins", skin);
  if (!json || !json->contains("joints") || !(*json)["joints"].is_array())
    return source.error(place, "expected a skin with joints, found none");
  AccessorValues inverse;
  if (json->contains("inverseBindMatrices")) {
    RELIEVO_TRY(inverse, file.accessor(number_in(*json, "inverseBindMatrices", 0).value_or(no_index), place));
    if (inverse.components != 16 || inverse.count() < (*json)["joints"].size())
      return source.error(place, "expected a matrix for each joint of its skin, found fewer");
  }
  const std::vector<std::size_t> parents = parents_in(file);
  std::vector<Transform> joints;
  for (const Json& joint : (*json)["joints"]) {
    const auto global = global_transform(file, parents, whole_number(joint).value_or(no_index - 1));
    if (!global) return source.error(place, "expected nodes as joints, found " + printable(joint.dump()));
    Transform to_joint = Transform::Identity();
    if (!inverse.numbers.empty())
      to_joint.matrix().topRows<3>() =
          Eigen::Map<const Eigen::Matrix4d>(inverse.numbers.data() + 16 * joints.size()).topRows<3>();
    joints.push_back(*global * to_joint);
  }
  return joints;
}

}  // namespace

std::optional<Eigen::Affine3d> transform_of(const Json& node) {
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

Result<std::vector<Eigen::Affine3d>> skinned_transforms(const Source& source, GltfFile& file,
                                                        std::size_t skin, const Json& attributes,
                                                        std::size_t count, const std::string& place) {
  RELIEVO_TRY(const std::vector<Transform> of_joints, joint_transforms(source, file, skin, place));
  std::vector<Transform> transforms;
  for (int set = 0; attributes.contains(cat("JOINTS_", set)) && attributes.contains(cat("WEIGHTS_", set));
       ++set) {
    const auto values = [&](const std::string& name) {
      return file.accessor(number_in(attributes, name.c_str(), 0).value_or(no_index), place);
    };
    RELIEVO_TRY(const AccessorValues joints, values(cat("JOINTS_", set)));
    RELIEVO_TRY(const AccessorValues weights, values(cat("WEIGHTS_", set)));
    if (joints.numbers.size() != 4 * count || weights.numbers.size() != 4 * count)
      return source.error(place,
                          cat("expected four joints and weights for each of ", count, " vertices, found ",
                              joints.numbers.size(), " and ", weights.numbers.size(), " numbers"));
    if (set == 0) transforms.assign(count, Transform(Eigen::Matrix4d::Zero()));
    for (std::size_t i = 0; i < 4 * count; ++i) {
      if (weights.numbers[i] == 0) continue;
      if (!(joints.numbers[i] >= 0 && joints.numbers[i] < static_cast<double>(of_joints.size())))
        return source.error(
            place, cat("expected numbers of joints below ", of_joints.size(), ", found ", joints.numbers[i]));
      transforms[i / 4].matrix() +=
          weights.numbers[i] * of_joints[static_cast<std::size_t>(joints.numbers[i])].matrix();
    }
  }
  return transforms;
}

}  // namespace relievo::io
