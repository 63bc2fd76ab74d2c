// Fuzz target of whole reliefs. A small cloud and a few options must give an error or a solid; a solid must be closed
// and have the requested height. The first bytes of an input are the options, the rest are the points.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "fuzz/fuzz_program.h"
#include "relievo/make_relief.h"
#include "relievo/plate/solid.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/cloud.h"
#include "relievo/scan/view.h"

namespace {

using namespace relievo;

// Makes a point from every three bytes. The points lie on the lines of a grid, so that most of them are visible.
Cloud cloud_of(std::span<const std::uint8_t> data) {
  Cloud cloud;
  for (std::size_t i = 0; i + 2 < data.size() && cloud.size() < 400; i += 3) {
    const std::size_t n = cloud.size();
    cloud.points.emplace_back(static_cast<double>(n % 20) + data[i] / 256.,
                              static_cast<double>(n / 20) + data[i + 1] / 256., data[i + 2] / 32.);
  }
  return cloud;
}

ReliefOptions options_of(std::span<const std::uint8_t> data) {
  constexpr Method methods[] = {Method::layered, Method::paper, Method::linear, Method::gradient};
  ReliefOptions options;
  options.method = methods[data[0] % 4];
  options.outline = outline_choices[data[1] % outline_choices.size()].value;
  options.height_mm = .1 + data[2] / 64.;
  options.resolution_mm = 2;
  return options;
}

[[noreturn]] void fail(const char* what, const std::string& why) {
  std::fprintf(stderr, "%s: %s\n", what, why.c_str());
  std::abort();
}

}  // namespace

void run_target(std::string_view input) {
  if (input.size() < 4) return;
  const std::span data(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  const Cloud cloud = cloud_of(data.subspan(3));
  const ReliefOptions options = options_of(data);
  const auto model = prepare(cloud, *parse_view("front"));
  if (!model) return;
  const auto made = make_relief(*model, options);
  if (!made) {
    if (made.error().expected.empty()) fail("an error without a message", made.error().input);
    return;
  }
  if (const std::string why = check_solid(made->solid); !why.empty()) fail("a solid that is not closed", why);
  if (std::abs(made->report.height_mm - *options.height_mm) > 1e-4)
    fail("another height", std::to_string(made->report.height_mm));
}
