// Transforms the vertices of a glTF mesh according to the pose of its skeleton.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "io/gltf/gltf.h"

namespace relievo::io {

// Returns the transform of a node relative to its parent; nothing if the node's numbers are invalid.
std::optional<Eigen::Affine3d> transform_of(const Json& node);

// Returns the transform of each of `count` vertices with these attributes: the weighted sum of its joints'
// transforms. Returns no transforms if there are no joints or weights. Errors: kind input, at `place`.
Result<std::vector<Eigen::Affine3d>> skinned_transforms(const Source& source, GltfFile& file,
                                                        std::size_t skin, const Json& attributes,
                                                        std::size_t count, const std::string& place);

}  // namespace relievo::io
