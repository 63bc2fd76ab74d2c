#include "relievo/samples/sample.h"

#include <array>
#include <string>

#include "relievo/core/text.h"
#include "samples/sample_shapes.h"

namespace relievo {
namespace {

struct Entry {
  SampleInfo info;
  field::Solid (*solid)();
};

constexpr std::array<Entry, 3> entries{{
    {{"shell", "an ammonite: ribs that fork, knobs, a roped keel and growth lines"}, field::shell},
    {{"still_life",
      "a scene on a plinth: urn, ammonite, dodecahedron, rope, pine cone and leaves that hide each other"},
     field::still_life},
    {{"green_man", "a face among oak leaves"}, field::green_man},
}};

constexpr std::array<SampleInfo, entries.size()> infos = [] {
  std::array<SampleInfo, entries.size()> all;
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = entries[i].info;
  return all;
}();

Error unknown(std::string_view name) {
  std::string names;
  for (const SampleInfo& info : infos) names += (names.empty() ? "" : ", ") + std::string(info.name);
  return {ErrorKind::option, "sample", "",
          "expected one of " + names + ", found '" + std::string(name) + "'"};
}

template <typename T>
Result<void> check_range(const char* option, T value, T least, T most) {
  if (value >= least && value <= most) return {};
  return option_error(option, cat("expected ", least, " to ", most, ", found ", value));
}

}  // namespace

std::span<const SampleInfo> samples() {
  return infos;
}

Result<Cloud> make_sample(std::string_view name, const SampleOptions& options) {
  const auto known = std::ranges::find(entries, name, [](const Entry& entry) { return entry.info.name; });
  if (known == entries.end()) return std::unexpected(unknown(name));
  const std::size_t fewest = 1000, most = 100000000;
  RELIEVO_CHECK(check_range("points", options.points, fewest, most));
  RELIEVO_CHECK(check_range("noise", options.noise, 0.0, 5.0));
  const auto seed = static_cast<std::uint64_t>(known - entries.begin());
  return field::scatter(known->solid(), {options.points, options.noise, seed});
}

}  // namespace relievo
