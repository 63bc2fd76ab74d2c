#include <algorithm>
#include <string>
#include <utility>

#include "io/xyz.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

bool is_comment(std::string_view trimmed) {
  return trimmed.starts_with('#') || trimmed.starts_with("//");
}

// Returns a name without quotation marks and without a unit in brackets, as in "X (m)" or "x[mm]".
std::string_view plain_name(std::string_view field) {
  field = field.substr(0, field.find_first_of("(["));
  const std::string_view around = " \t\v\f\"'";
  const std::size_t first = std::min(field.find_first_not_of(around), field.size());
  return field.substr(first, field.find_last_not_of(around) + 1 - first);
}

// Returns the names of columns in a line. The separator of names may differ from the separator of the data.
ColumnNames split_names(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of("#/ \t\v\f"), line.size()));
  const std::size_t separator = line.find_first_of(line.contains(';')   ? ";"
                                                   : line.contains(',') ? ","
                                                                        : "\t");
  Fields fields(line, separator == std::string_view::npos ? ' ' : line[separator]);
  ColumnNames names;
  while (const auto field = fields.next()) {
    const std::string_view name = plain_name(*field);
    const bool is_unit = name.empty() && !field->empty();
    if (!is_unit) names.push_back(name);
  }
  return names;
}

// Returns the words between separators of any kind.
ColumnNames split_words(std::string_view line) {
  const std::string_view separators = " \t\v\f,;\"'";
  ColumnNames words;
  for (std::size_t at = line.find_first_not_of(separators); at < line.size();) {
    const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(separators, end);
  }
  return words;
}

std::size_t count_fields(std::string_view line, char separator) {
  Fields fields(line, separator);
  std::size_t count = 0;
  while (fields.next()) ++count;
  return count;
}

bool are_numbers(std::string_view text) {
  Words words(text);
  for (std::string_view word = words.next(); !word.empty(); word = words.next())
    if (!parse_number(word)) return false;
  return true;
}

// Returns the end of the quoted text at the beginning of a line; 0 if there is none. In a quoted text, two
// quotation marks represent one.
std::size_t end_of_quoted(std::string_view line) {
  std::size_t at = 0;
  while (at < line.size() && is_blank(line[at])) ++at;
  if (at == line.size() || line[at] != '"') return 0;
  for (at = line.find('"', at + 1); at < line.size(); at = line.find('"', at + 2))
    if (line.substr(at + 1, 1) != "\"") return at + 1;
  return 0;
}

// Returns the line without quoted fields, because separators inside quotation marks do not count.
std::string without_quoted(std::string_view line) {
  std::string plain;
  bool begins_field = true;
  for (std::size_t at = 0; at < line.size();) {
    const bool may_open = begins_field && line[at] == '"';
    const std::size_t quoted = may_open ? end_of_quoted(line.substr(at)) : 0;
    if (std::string_view(",;\t").contains(line[at]))
      begins_field = true;
    else if (!is_blank(line[at]))
      begins_field = false;
    if (quoted == 0) plain += line[at];
    at += std::max<std::size_t>(quoted, 1);
  }
  return plain;
}

// Returns whether the line has decimal commas. Not all commas can be separators in "1,5 2,5". In "1, 2,5" the
// second comma is a decimal comma, but only if no number of the line has a decimal point.
bool has_decimal_commas(std::string_view line) {
  std::size_t commas = 0, spaced_commas = 0;
  Fields fields(line, ',');
  while (const auto field = fields.next())
    if (std::any_of(field->begin(), field->end(), is_blank) && are_numbers(*field)) return true;
  const std::string plain = without_quoted(line);
  for (std::size_t i = plain.find(','); i < plain.size(); i = plain.find(',', i + 1)) {
    ++commas;
    if (i + 1 < plain.size() && is_blank(plain[i + 1])) ++spaced_commas;
  }
  return spaced_commas > 0 && spaced_commas < commas && !line.contains('.');
}

// Returns whether all fields between tabs are numbers with a decimal point or comma; the first field may be a
// name.
bool is_between_tabs(std::string_view line) {
  if (!line.contains('\t')) return false;
  XyzLayout commas;
  commas.has_decimal_commas = true;
  Fields fields(line, '\t');
  bool is_first = true;
  while (const auto field = fields.next()) {
    const bool is_name = std::exchange(is_first, false) && !field->contains(',');
    if (!is_name && (field->ends_with(',') || !parse_field(*field, commas))) return false;
  }
  return true;
}

char likely_separator(std::string_view line) {
  const std::string plain = without_quoted(line);
  if (plain.contains(';')) return ';';
  return plain.contains(',') && !is_between_tabs(line) ? ',' : ' ';
}

// Returns whether the first column is a name, which begins with a letter, and three numbers follow. If blanks
// separate the fields, there must be three, six or nine numbers; otherwise the 1 of "Point 1 10 20 30" would
// be read as x.
bool begins_with_name(std::string_view line) {
  XyzLayout layout;
  layout.separator = likely_separator(line);
  layout.has_decimal_commas = layout.separator != ',';
  Fields fields(line, layout.separator);
  const auto name = fields.next();
  const auto is_letter = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80;
  };
  if (!name || name->empty() || !is_letter(name->front()) || parse_number(*name)) return false;
  std::size_t count = 0;
  for (; const auto field = fields.next(); ++count)
    if (count < 3 && !parse_field(*field, layout)) return false;
  return count >= 3 && (layout.separator != ' ' || count % 3 == 0);
}

// Reads the lines before the first line of data.
class Preamble {
 public:
  Preamble(const Source& source, XyzLayout& layout) : layout_(layout), lines_(source) {}

  // Returns the first line of data.
  Result<std::string_view> read() {
    layout_.data_offset = lines_.offset();
    while (const auto raw = lines_.next()) {
      const std::string_view line = trim(*raw);
      if (is_comment(line)) commented_names_ = split_names(line);
      RELIEVO_TRY(const auto is_data, take(without_comment(line)));
      if (is_data) return without_comment(line);
      layout_.data_offset = lines_.offset();
    }
    return lines_.fail_at_end("a line of numbers");
  }

  std::size_t line() const { return lines_.number(); }

  // A line of names must have as many names as there are columns. Only then does a comment count as a line of
  // names.
  Result<void> name_columns() {
    if (names_.empty() && commented_names_.size() == layout_.columns && has_coordinates(commented_names_))
      names_ = commented_names_;
    if (!names_.empty() && names_.size() != layout_.columns)
      return lines_.fail(cat("expected ", names_.size(), " columns as named in line ", names_line_,
                             ", found ", layout_.columns));
    return {};
  }

  const ColumnNames& names() const { return names_; }

 private:
  Result<bool> take(std::string_view line) {
    const ColumnNames words = split_words(line);
    if (line.empty()) return false;
    if (words.size() == 1 && !layout_.promised_points && parse_integer(words[0]).value_or(-1) >= 0) {
      layout_.promised_points = parse_integer(words[0]);
      layout_.promising_line = lines_.number();
      return false;
    }
    // After a line of names, the first column may contain text.
    const bool has_number =
        std::ranges::any_of(words, [](auto word) { return parse_number(word).has_value(); });
    if (!words.empty() && (parse_number(words[0]) || (!names_.empty() && has_number))) return true;
    if (names_.empty() && begins_with_name(line)) return true;
    const ColumnNames names = split_names(line);
    if (names_.empty() && has_degrees(names))
      return lines_.fail(
          "expected coordinates that are lengths, found degrees of longitude and "
          "latitude; a program for maps, such as QGIS, projects them to metres");
    if (!names_.empty() || !has_coordinates(names))
      return lines_.fail("expected numbers, or names of columns with x, y and z, found " + in_quotes(line));
    names_ = names;
    names_line_ = lines_.number();
    return false;
  }

  XyzLayout& layout_;
  SourceLines lines_;
  ColumnNames names_, commented_names_;
  std::size_t names_line_ = 0;
};

Result<char> find_separator(const Source& source, std::string_view line, std::size_t number) {
  const char separator = likely_separator(line);
  if (separator != ',' || !has_decimal_commas(line)) return separator;
  return source.error_in_line(
      number, "expected numbers with a decimal point, separated in one way, found " + in_quotes(line));
}

}  // namespace

std::optional<std::string_view> Fields::next() {
  if (separator_ == ' ') {
    const std::string_view word = words_.next();
    return word.empty() ? std::nullopt : std::optional(word);
  }
  if (trim(line_).empty()) return std::nullopt;
  const std::size_t end = std::min(line_.find(separator_, end_of_quoted(line_)), line_.size());
  std::string_view field = trim(line_.substr(0, end));
  line_.remove_prefix(std::min(end + 1, line_.size()));
  const bool is_quoted = field.size() >= 2 && field.starts_with('"') && field.ends_with('"');
  return is_quoted ? trim(field.substr(1, field.size() - 2)) : field;
}

std::optional<double> parse_field(std::string_view field, const XyzLayout& layout) {
  if (!layout.has_decimal_commas || !field.contains(',')) return parse_number(field);
  std::string word(field);
  std::ranges::replace(word, ',', '.');
  return parse_number(word);
}

std::string_view without_comment(std::string_view line) {
  for (const char mark : {'#', '/'}) {
    for (std::size_t i = line.find(mark); i < line.size(); i = line.find(mark, i + 1)) {
      const bool begins_word = i == 0 || is_blank(line[i - 1]);  // false for the # in 1.#QNAN
      if (begins_word && is_comment(line.substr(i))) line = line.substr(0, i);
    }
  }
  return trim(line);
}

Result<void> take_separators(const Source& source, std::string_view line, XyzLayout& layout) {
  RELIEVO_TRY(layout.separator, find_separator(source, line, layout.first_line));
  // Between semicolons or tabs a comma is not a separator. It is then a decimal comma, which may first occur
  // in a later line.
  const bool has_other_separators =
      layout.separator == ';' || (layout.separator == ' ' && line.contains('\t'));
  layout.has_decimal_commas = has_other_separators && !line.contains('.');
  layout.columns = count_fields(line, layout.separator);
  return {};
}

Result<XyzLayout> find_layout(const Source& source) {
  XyzLayout layout;
  Preamble preamble(source, layout);
  RELIEVO_TRY(const auto line, preamble.read());
  layout.first_line = preamble.line();
  RELIEVO_CHECK(take_separators(source, line, layout));
  if (layout.columns < 3)
    return source.error_in_line(layout.first_line, "expected at least 3 numbers, found " + in_quotes(line));
  RELIEVO_CHECK(preamble.name_columns());
  layout.has_names = !preamble.names().empty();
  if (!layout.has_names)
    find_columns(source, begins_with_name(line), layout);
  else
    take_columns(preamble.names(), layout);
  return layout;
}

}  // namespace relievo::io
