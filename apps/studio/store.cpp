#include "studio/store.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "relievo/core/text.h"

namespace relievo::app::studio {

using Json = nlohmann::json;

std::string document_of(const ScanSource& input) {
  const bool is_sample = !input.sample.empty();
  const std::string hash = hash_of(is_sample ? cat("sample:", input.sample) : cat("path:", input.path));
  return hash.substr(hash.find(':') + 1);
}

bool is_document(std::string_view id) {
  return id.size() == 16 && id.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::optional<ScanSource> input_of(const std::string& state) {
  const Json json = Json::parse(state, nullptr, false);
  if (!json.is_object() || !json.value("steps", Json()).is_array() ||
      !json.value("at", Json()).is_number_unsigned())
    return std::nullopt;
  const Json& steps = json["steps"];
  const auto at = json["at"].get<std::size_t>();
  if (at >= steps.size() || !steps[at].is_object()) return std::nullopt;
  const Result<ScanSource> input = input_from_json(steps[at].value("input", Json()), "document");
  return input ? std::optional(*input) : std::nullopt;
}

std::string plain_name(const std::string& name) {
  std::string plain = std::filesystem::path(name).filename().string();
  std::erase_if(plain, [](unsigned char c) { return c < 32 || c == '/' || c == '\\'; });
  if (plain.size() > 120) plain = plain.substr(plain.size() - 120);
  return plain.empty() || plain == "." || plain == ".." ? "scan" : plain;
}

}  // namespace relievo::app::studio
