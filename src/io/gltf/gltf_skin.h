// Places the vertices of a glTF mesh as its skeleton is posed.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "io/gltf/gltf.h"

namespace relievo::io {

// Returns the transform that a node states, relative to its parent; nothing if its numbers are wrong.
std::optional<Eigen::Affine3d> transform_of(const Json& node);

// Returns the transform of each of `count` vertices with those attributes: the sum of its joints' transforms
// by its weights. Without joints or weights the result is empty. Errors: kind input, at `place`.
Result<std::vector<Eigen::Affine3d>> skinned_transforms(const Source& source, GltfFile& file,
                                                        std::size_t skin, const Json& attributes,
                                                        std::size_t count, const std::string& place);

}  // namespace relievo::io
