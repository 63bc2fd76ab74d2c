// Sentences for people, made of the facts that the library returns: for the command line and the studio alike.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "relievo/make_relief.h"

namespace relievo::app {

// Returns sentences about scanned points that a user should know.
struct ScanFacts {
  bool has_estimated_normals = false, has_turned_normals = false;
  std::size_t left_out = 0;                                        // outliers
  std::size_t visible_points = 0, removed_points = 0, crumbs = 0;  // see Surface
  double measured_noise = 0, removed_noise = 0;
  std::optional<ReliefReport::FoundPlane> plane = {};
};

// Returns a line for each fact that a user should know, without capital and full stop.
std::vector<std::string> remarks_on(const ScanFacts& facts);
std::vector<std::string> remarks_on(const ReliefReport& report);

// Returns the line with a capital and a full stop.
std::string as_sentence(std::string line);

}  // namespace relievo::app
