// Writes the page of `compare`: pictures of a model and of its reliefs, with the measures of each relief.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/image.h"
#include "relievo/quality/measures.h"

namespace relievo::app::cli {

struct ComparedRelief {
  std::string_view method;
  double height = 0;       // as a fraction of the width
  std::string parameters;  // the parameters of a baseline, see TunedRelief
  Measures measures;
  Image8 picture;  // empty, like Comparison::model, if no page is wanted
};

struct Comparison {
  std::string scan;  // name of the scan as the user typed it
  std::vector<std::string_view> methods;
  std::size_t visible_points = 0, measured_pixels = 0;
  Image8 model;
  std::vector<ComparedRelief> reliefs = {};  // sorted by height, then in the order of `methods`
  std::vector<std::string> remarks = {};
};

// Returns a page in one HTML file, with a row for each height and a column for each method. The page needs no
// other file.
std::string comparison_page(const Comparison& comparison);

}  // namespace relievo::app::cli
