#include "io/text.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "core/number.h"

namespace relievo::io {
namespace {

// Returns whether a number outside the range of double is too small instead of too large. from_chars does not
// distinguish these.
bool is_tiny(std::string_view word) {
  const std::size_t exponent = word.find_first_of("eE");
  if (exponent != std::string_view::npos) return word.substr(exponent + 1).starts_with('-');
  return word.substr(0, word.find('.')).find_first_of("123456789") == std::string_view::npos;
}

// Returns the word without a plus sign at its beginning. Some programs write this sign, but from_chars
// refuses it.
std::string_view without_plus(std::string_view word) {
  const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return word.substr(has_plus ? 1 : 0);
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

std::optional<std::string_view> Lines::next() {
  if (at_ >= text_.size()) return std::nullopt;
  ++number_;
  if (lf_ < at_) lf_ = text_.find('\n', at_);
  if (cr_ < at_) cr_ = text_.find('\r', at_);
  const std::size_t end = std::min({lf_, cr_, text_.size()});
  const std::string_view line = text_.substr(at_, end - at_);
  const bool is_crlf = end == cr_ && end + 1 == lf_;
  at_ = std::min(text_.size(), end + (is_crlf ? 2 : 1));
  return line;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view before_comment(std::string_view line) {
  std::size_t mark = line.find('#');
  while (mark != std::string_view::npos && mark > 0 && line[mark - 1] == '.') mark = line.find('#', mark + 1);
  return line.substr(0, mark);
}

std::optional<double> parse_number(std::string_view word) {
  word = without_plus(word);
  const char* last = word.data() + word.size();
  auto [value, end, code] = parse_double(word);
  if (code == std::errc::invalid_argument) return std::nullopt;
  if (code == std::errc::result_out_of_range)
    value = is_tiny(word) ? 0 : std::numeric_limits<double>::infinity();
  if (end == last) return value;
  if (*end == 'D' || *end == 'd') {  // Fortran writes 1.0D+02
    std::string with_e(word);
    with_e[static_cast<std::size_t>(end - word.data())] = 'e';
    return parse_number(with_e);
  }
  const bool is_old_runtimes_nan = *end == '#';  // texts of old runtimes: 1.#QNAN, -1.#IND, 1.#INF
  return is_old_runtimes_nan ? std::optional(std::numeric_limits<double>::quiet_NaN()) : std::nullopt;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  word = without_plus(word);
  const char* last = word.data() + word.size();
  std::int64_t value = 0;
  const auto [end, code] = std::from_chars(word.data(), last, value);
  if (code != std::errc() || end != last) return std::nullopt;
  return value;
}

std::string printable(std::string_view text, std::size_t most) {
  std::string shown(text.substr(0, most));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  if (text.size() > most) shown += "...";
  return shown;
}

std::string in_quotes(std::string_view text) {
  if (text.empty()) return "nothing";
  std::string shown(1, '\'');
  shown += printable(text);
  shown += '\'';
  return shown;
}

bool equals_ignoring_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

std::size_t byte_order_mark_size(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
}

}  // namespace relievo::io
