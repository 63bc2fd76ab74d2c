// Generates scans for trying the program, because the licences of real scans forbid shipping them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "relievo/core/error.h"
#include "relievo/scan/cloud.h"

namespace relievo {

struct SampleOptions {
  std::size_t points = 300000;  // number of points in the cloud, [1000, 100000000]
  double noise = 0.15;          // standard deviation along the normal, in sampling distances, [0, 5]
};

struct SampleInfo {
  std::string_view name;
  std::string_view description;
};

// Returns the names for make_sample(), with descriptions.
std::span<const SampleInfo> samples();

// Returns the sample `name`, similar to a cloud from a scanner: scattered points with noise and outward
// normals, +Y up, with the front towards +Z. The same name and options give the same bits. Errors: kind
// option for an unknown name, with a list of the known ones, or an option out of range.
Result<Cloud> make_sample(std::string_view name, const SampleOptions& options = {});

}  // namespace relievo
