// Generated scans to try the program with; the licences of real scans forbid shipping them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "relievo/core/error.h"
#include "relievo/scan/cloud.h"

namespace relievo {

struct SampleOptions {
  std::size_t points = 300000;  // in the cloud, [1000, 100000000]
  double noise = 0.15;  // standard deviation along the normal, in units of the sampling distance, [0, 5]
};

struct SampleInfo {
  std::string_view name;
  std::string_view description;
};

// The names that make_sample() knows.
std::span<const SampleInfo> samples();

// Returns the sample `name` as a scanner would deliver it: scattered points with noise and outward normals,
// +Y up, the front towards +Z. Same name and options, same bits. Errors: kind option for an unknown name
// (lists the known ones) or an option out of range.
Result<Cloud> make_sample(std::string_view name, const SampleOptions& options = {});

}  // namespace relievo
