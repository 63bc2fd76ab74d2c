#include "relievo/core/json_place.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace relievo {
namespace {

// Accepts all JSON. Stores the position of the first syntax error, counted from 1.
struct MistakeFinder : nlohmann::json_sax<nlohmann::json> {
  std::size_t at = 0;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t place, const std::string&, const nlohmann::detail::exception&) override {
    at = place;
    return false;
  }
};

}  // namespace

std::string json_error_place(std::string_view text) {
  MistakeFinder finder;
  if (nlohmann::json::sax_parse(text, &finder)) return {};
  const std::string_view before = text.substr(0, finder.at > 0 ? std::min(finder.at - 1, text.size()) : 0);
  const auto lines = std::ranges::count(before, '\n');
  // Without a line break, rfind() returns npos, and npos + 1 is 0.
  const std::size_t column = before.size() - (before.rfind('\n') + 1);
  return "line " + std::to_string(lines + 1) + ", column " + std::to_string(column + 1);
}

}  // namespace relievo
