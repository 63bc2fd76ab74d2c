// Reads OFF, as text or binary: a keyword, three counts, vertices and faces. Prefixes of the keyword list the
// properties of a vertex. The keyword may be missing.
#include <algorithm>
#include <utility>

#include "io/formats.h"
#include "io/numbers.h"
#include "io/polygon.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// The properties after the position of a vertex, according to the keyword [ST][C][N]OFF.
struct Kind {
  bool has_colours = false, has_normals = false, has_texture = false;
};

std::optional<Kind> parse_keyword(std::string_view word) {
  Kind kind;
  const auto take = [&](std::string_view prefix) {
    const bool is_there = word.starts_with(prefix);
    if (is_there) word.remove_prefix(prefix.size());
    return is_there;
  };
  kind.has_texture = take("ST");
  kind.has_colours = take("C");
  kind.has_normals = take("N");
  return word == "OFF" ? std::optional(kind) : std::nullopt;
}

class OffReader {
 public:
  explicit OffReader(const Source& source) : lines_(source) {}

  Result<RawCloud> read() {
    Words words = next_row();
    const std::string_view keyword = Words(words).next();
    const auto kind = parse_keyword(keyword);
    if (!kind && !parse_integer(keyword))
      return lines_.fail("expected OFF, COFF or NOFF, found " + in_quotes(keyword));
    kind_ = kind.value_or(Kind{});
    if (kind) words.next();
    RELIEVO_CHECK(take_counts(words));
    for (std::int64_t i = 0; i < vertices_; ++i) RELIEVO_CHECK(take_vertex(i));
    std::vector<Triangle> triangles;
    for (std::int64_t i = 0; i < faces_; ++i) RELIEVO_CHECK(take_face(i, triangles));
    RawCloud raw{std::move(cloud_), "OFF"};
    raw.mesh = mesh_over(raw.cloud, std::move(triangles));
    return raw;
  }

 private:
  // Returns the words of the next non-empty line; no words at the end of the file.
  Words next_row() {
    while (const auto line = lines_.next()) {
      const std::string_view text = trim(before_comment(*line));
      if (!text.empty()) return Words(text);
    }
    is_at_end_ = true;
    return Words();
  }

  // Returns the next word of `words` or, because the format is free-form, of a later line. If the word is in
  // a later line, sets is_wrapped_.
  std::string_view next_word(Words& words) {
    std::string_view word = words.next();
    while (word.empty() && !is_at_end_) {
      words = next_row();
      is_wrapped_ = true;
      word = words.next();
    }
    return word;
  }

  // Further words in a line belong to properties that are not read. They are ignored, unless the row began in
  // an earlier line; then they are an error.
  Result<void> end_row(Words words) {
    const std::string_view word = words.next();
    const bool is_bad = std::exchange(is_wrapped_, false) && !word.empty();
    return is_bad ? lines_.fail("expected the end of a row that began in a line before, found " +
                                in_quotes(word))
                  : Result<void>{};
  }

  static std::string shown(std::string_view word) {
    return word.empty() ? "the end of the file" : in_quotes(word);
  }

  Result<void> take_counts(Words words) {
    std::string_view word = words.next();
    if (word.empty()) words = next_row(), word = words.next();
    for (std::int64_t* count : {&vertices_, &faces_}) {
      const auto number = parse_integer(word);
      if (!number || *number < 0 || *number >= std::int64_t{no_index})
        return lines_.fail("expected the numbers of vertices and faces, found " + in_quotes(word));
      *count = *number;
      word = words.next();
    }
    return {};
  }

  Result<void> take_numbers(Words& words, Vec3& to) {
    for (double& value : to) {
      const std::string_view word = next_word(words);
      const auto number = parse_number(word);
      if (!number) return lines_.fail("expected a number, found " + shown(word));
      value = *number;
    }
    return {};
  }

  Result<void> take_vertex(std::int64_t i) {
    Words words = next_row();
    if (is_at_end_) return fail_at_end("vertices", vertices_, i);
    Vec3 point, normal;
    RELIEVO_CHECK(take_numbers(words, point));
    cloud_.points.push_back(point);
    if (kind_.has_normals) {
      RELIEVO_CHECK(take_numbers(words, normal));
      cloud_.normals.push_back(unit_normal(normal));
    }
    if (kind_.has_colours) RELIEVO_CHECK(take_colour(words));
    return end_row(words);
  }

  // Colour components are integers up to 255, or fractions from 0 to 1 with a decimal point.
  Result<void> take_colour(Words& words) {
    Colour colour;
    for (std::uint8_t& value : colour) {
      const std::string_view word = next_word(words);
      const auto number = parse_number(word);
      if (!number) return lines_.fail("expected three numbers for the colour, found " + in_quotes(word));
      const double scale = word.find('.') == std::string_view::npos ? 1 : 255;
      value = as_byte(scale * *number);
    }
    cloud_.colours.push_back(colour);
    return {};
  }

  Result<void> take_face(std::int64_t i, std::vector<Triangle>& triangles) {
    Words words = next_row();
    if (is_at_end_) return fail_at_end("faces", faces_, i);
    const std::string_view first = words.next();
    const auto length = parse_integer(first);
    if (!length || *length < 0)
      return lines_.fail("expected the number of corners, found " + in_quotes(first));
    corners_.clear();
    for (std::int64_t c = 0; c < *length; ++c) {
      const std::string_view word = next_word(words);
      const auto corner = parse_integer(word);
      if (!corner) return lines_.fail(cat("expected ", *length, " numbers of vertices, found ", shown(word)));
      corners_.push_back(*corner);
    }
    RELIEVO_CHECK(end_row(words));
    has_two_in_line_ = has_two_in_line_ || is_face(words);
    if (add_face(corners_, FaceKind::polygon, cloud_.points, triangles)) return {};
    return lines_.fail(expected_corners(corners_, cloud_.points));
  }

  // Returns whether the words after a face look like another face. The numbers of a face's colour usually do
  // not look like a face.
  static bool is_face(Words words) {
    const auto length = parse_integer(words.next());
    std::int64_t corners = 0;
    while (!words.next().empty()) ++corners;
    return length && *length >= 3 && corners >= *length;
  }

  Result<void> fail_at_end(std::string_view what, std::int64_t promised, std::int64_t found) const {
    return lines_.fail_at_end(
        cat(promised, " ", what),
        cat(" after ", found, has_two_in_line_ ? "; each has to begin on a line of its own" : ""));
  }

  SourceLines lines_;
  Kind kind_;
  bool is_at_end_ = false, is_wrapped_ = false, has_two_in_line_ = false;
  std::int64_t vertices_ = 0, faces_ = 0;
  std::vector<std::int64_t> corners_;
  Cloud cloud_;
};

// Returns the kind of a binary file, which has the word BINARY after its keyword.
std::optional<Kind> binary_kind(std::string_view bytes) {
  Words words(bytes.substr(0, std::min(bytes.find_first_of("\r\n"), std::size_t{80})));
  const auto kind = parse_keyword(words.next());
  return words.next() == "BINARY" ? kind : std::nullopt;
}

// Reads the numbers after the first line of a binary file: big-endian 32-bit integers and floats.
class BinaryOffReader {
 public:
  BinaryOffReader(const Source& source, const Kind& kind) : source_(source), kind_(kind) {
    at_ = source.bytes.find('\n') + 1;  // 0 for a file of a single line, which is too short anyway
  }

  Result<RawCloud> read() {
    RELIEVO_TRY(const std::size_t vertices, take_count("vertices"));
    RELIEVO_TRY(const std::size_t faces, take_count("faces"));
    RELIEVO_TRY(const std::size_t edges, take_count("edges"));
    (void)edges;  // not needed, because the faces determine the edges
    const Records records = rows_of(vertices);
    if (vertices > left() / records.stride)
      return fail(
          cat("expected ", vertices, " vertices of ", records.stride, " bytes, found ", left(), " bytes"));
    RawCloud raw{decode_all(records, source_.bytes.data() + at_), "OFF binary"};
    at_ += vertices * records.stride;
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < faces; ++i) RELIEVO_CHECK(take_face(raw.cloud.points, triangles));
    raw.mesh = mesh_over(raw.cloud, std::move(triangles));
    return raw;
  }

 private:
  std::size_t left() const { return source_.bytes.size() - at_; }
  std::unexpected<Error> fail(std::string expected) const {
    return source_.error_at_byte(at_, std::move(expected));
  }

  Records rows_of(std::size_t vertices) const {
    Records records;
    records.count = vertices;
    records.is_big_endian = true;
    const auto take = [&](std::size_t numbers, double scale) {
      std::array<RecordColumn, 3> columns;
      for (std::size_t i = 0; i < 3; ++i) columns[i] = {NumberType::float32, records.stride + 4 * i, scale};
      records.stride += 4 * numbers;
      return columns;
    };
    records.position = take(3, 1);
    if (kind_.has_normals) records.normal = take(3, 1);
    if (kind_.has_colours) records.colour = take(4, 255);
    if (kind_.has_texture) records.stride += 8;
    return records;
  }

  Result<std::size_t> take_count(std::string_view what) {
    if (left() < 4) return fail(cat("expected the number of ", what, ", found the end of the file"));
    const auto count =
        number_at<std::int32_t, std::endian::native == std::endian::little>(source_.bytes.data() + at_);
    if (count < 0) return fail(cat("expected the number of ", what, ", found ", count));
    at_ += 4;
    return static_cast<std::size_t>(count);
  }

  // A face is stored as: number of corners, corners, number of colour components, colour components.
  Result<void> take_face(const std::vector<Vec3>& points, std::vector<Triangle>& triangles) {
    RELIEVO_TRY(const std::size_t length, take_count("corners"));
    if (length > left() / 4) return fail(cat("expected ", length, " corners, found ", left(), " bytes"));
    corners_.clear();
    for (std::size_t i = 0; i < length; ++i) {
      RELIEVO_TRY(const std::size_t corner, take_count("a vertex"));
      corners_.push_back(static_cast<std::int64_t>(corner));
    }
    RELIEVO_TRY(const std::size_t components, take_count("a colour's components"));
    if (components > left() / 4)
      return fail(cat("expected a colour of ", components, " numbers, found ", left(), " bytes"));
    at_ += 4 * components;
    if (add_face(corners_, FaceKind::polygon, points, triangles)) return {};
    return fail(expected_corners(corners_, points));
  }

  const Source& source_;
  Kind kind_;
  std::size_t at_ = 0;
  std::vector<std::int64_t> corners_;
};

}  // namespace

bool is_off(const Source& source) {
  if (binary_kind(source.bytes)) return true;
  if (has_control_bytes(source.bytes)) return has_ending(source.name, ".off");
  Lines lines(source.bytes, byte_order_mark_size(source.bytes));
  while (const auto line = lines.next()) {
    const std::string_view word = Words(before_comment(*line)).next();
    if (!word.empty()) return parse_keyword(word).has_value() || has_ending(source.name, ".off");
  }
  return false;
}

Result<RawCloud> read_off(const Source& source) {
  if (const auto kind = binary_kind(source.bytes)) return BinaryOffReader(source, *kind).read();
  return OffReader(source).read();
}

}  // namespace relievo::io
