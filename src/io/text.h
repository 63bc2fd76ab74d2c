// Splits text into lines, words and numbers, and counts lines for messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace relievo::io {

// Iterates over the lines of a text, without their ends. LF, CRLF and CR may be mixed. Takes linear time.
class Lines {
 public:
  explicit Lines(std::string_view text, std::size_t offset = 0, std::size_t lines_before = 0)
      : text_(text),
        at_(offset),
        number_(lines_before),
        lf_(text.find('\n', offset)),
        cr_(text.find('\r', offset)) {}

  // Returns the next line; nothing at the end. A line end at the end of the text is not followed by an empty
  // line.
  std::optional<std::string_view> next();

  // Returns the number of the last returned line, counted from 1; 0 before the first line.
  std::size_t number() const { return number_; }

  // Returns the byte offset after the last returned line and its end.
  std::size_t offset() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_, number_;
  // The next LF and CR. They are cached, because searching for a missing one in each line would take
  // quadratic time.
  std::size_t lf_, cr_;
};

// Returns whether a character separates words within a line.
constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

// Iterates over the words of a line, which are separated by blanks. Returns an empty view at the end.
class Words {
 public:
  explicit Words(std::string_view line = {}) : at_(line.data()), end_(line.data() + line.size()) {}

  std::string_view next() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    const char* first = at_;
    while (at_ != end_ && !is_blank(*at_)) ++at_;
    return {first, static_cast<std::size_t>(at_ - first)};
  }

 private:
  const char* at_;
  const char* end_;
};

std::string_view trim(std::string_view text);

// Returns the text before a comment, which begins with '#'. The '#' in 1.#QNAN does not begin one.
std::string_view before_comment(std::string_view line);

// Returns the number that the whole word represents: a decimal with optional sign and exponent (after e, or d
// as in Fortran), or a spelling of nan or inf. The result is infinite if the number is too large for a
// double, and zero if it is too small. Returns nothing if the word is not a number.
std::optional<double> parse_number(std::string_view word);

// Returns the integer that the whole word represents; nothing for other words and beyond 64 bits.
std::optional<std::int64_t> parse_integer(std::string_view word);

// Return the text for messages, shortened to `most` bytes, with '?' for unprintable bytes. in_quotes() adds
// quotation marks, and returns "nothing" for an empty text.
std::string printable(std::string_view text, std::size_t most = 32);
std::string in_quotes(std::string_view text);

// Returns whether the texts are equal, ignoring the case of ASCII letters.
bool equals_ignoring_case(std::string_view a, std::string_view b);

// Returns 3 if the text begins with a UTF-8 byte order mark, else 0.
std::size_t byte_order_mark_size(std::string_view text);

}  // namespace relievo::io
