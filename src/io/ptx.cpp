// Reads PTX: a sequence of scans, each with a header of ten lines and one line per point. The header has the
// numbers of columns and rows, the scanner's axes (four lines), and the matrix that transforms the points to
// common axes (four lines).
#include <Eigen/Geometry>
#include <limits>

#include "io/formats.h"
#include "io/numbers.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// Returns the numbers of a line; no numbers if a word is not a number or there are more than eight words.
std::vector<double> numbers_of(std::string_view line) {
  std::vector<double> numbers;
  Words words(line);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    const auto number = parse_number(word);
    if (!number || numbers.size() == 8) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

class PtxReader {
 public:
  explicit PtxReader(const Source& source) : lines_(source) {}

  Result<RawCloud> read() {
    std::size_t scans = 0;
    while (const auto line = next_line()) {
      RELIEVO_CHECK(take_header(*line));
      RELIEVO_CHECK(take_points());
      ++scans;
    }
    if (raw_.cloud.colours.size() != raw_.cloud.size()) raw_.cloud.colours.clear();
    raw_.format = cat("PTX, ", scans, scans == 1 ? " scan" : " scans");
    raw_.leave_out(unmeasured_, "at 0, 0, 0 of their scanner, as scanners write what they have not measured");
    return std::move(raw_);
  }

 private:
  std::optional<std::string_view> next_line() {
    auto line = lines_.next();
    while (line && trim(*line).empty()) line = lines_.next();
    return line;
  }

  // Reads the header of a scan; `line` is its first line.
  Result<void> take_header(std::string_view line) {
    std::int64_t columns = 0, rows = 0;
    RELIEVO_CHECK(take_count(line, columns));
    RELIEVO_CHECK(take_count(next_line().value_or(""), rows));
    if (rows > 0 && columns >= std::int64_t{no_index} / rows)
      return lines_.fail(cat("expected fewer than 4294967295 points, found ", columns, " x ", rows));
    points_ = columns * rows;
    for (int i = 0; i < 4; ++i) RELIEVO_CHECK(take_numbers(3));
    for (Eigen::Index i = 0; i < 4; ++i) {
      RELIEVO_TRY(const std::vector<double> row, take_numbers(4));
      for (Eigen::Index k = 0; k < 3; ++k) to_common_(k, i) = row[static_cast<std::size_t>(k)];
    }
    return {};
  }

  Result<void> take_count(std::string_view line, std::int64_t& count) const {
    count = parse_integer(trim(line)).value_or(-1);
    if (count >= 0 && count < std::int64_t{no_index}) return {};
    return lines_.fail("expected the number of columns or rows of a scan, found " + in_quotes(trim(line)));
  }

  Result<std::vector<double>> take_numbers(std::size_t count) {
    const auto line = next_line();
    if (!line) return lines_.fail_at_end(cat(count, " numbers"));
    std::vector<double> numbers = numbers_of(*line);
    if (numbers.size() == count) return numbers;
    return lines_.fail(cat("expected ", count, " numbers, found ", in_quotes(trim(*line))));
  }

  Result<void> take_points() {
    for (std::int64_t i = 0; i < points_; ++i) {
      const auto line = next_line();
      if (!line) return lines_.fail_at_end(cat(points_, " points"), cat(" after ", i));
      const std::vector<double> numbers = numbers_of(*line);
      if (numbers.size() < 3)
        return lines_.fail("expected x, y, z and further numbers, found " + in_quotes(trim(*line)));
      add(numbers);
    }
    return {};
  }

  void add(const std::vector<double>& numbers) {
    const Vec3 point(numbers[0], numbers[1], numbers[2]);
    const bool is_measured = !point.isZero(0);
    if (!is_measured) ++unmeasured_;
    raw_.cloud.points.push_back(is_measured ? Vec3(to_common_ * point)
                                            : Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    if (numbers.size() >= 7)
      raw_.cloud.colours.push_back({as_byte(numbers[4]), as_byte(numbers[5]), as_byte(numbers[6])});
  }

  SourceLines lines_;
  RawCloud raw_;
  std::int64_t points_ = 0;  // number of points of the scan
  std::size_t unmeasured_ = 0;
  Eigen::AffineCompact3d to_common_ = Eigen::AffineCompact3d::Identity();
};

}  // namespace

// A PTX begins with two lines of one integer each; the third line has the scanner's position.
bool is_ptx(const Source& source) {
  if (has_control_bytes(source.bytes)) return false;
  if (has_ending(source.name, ".ptx")) return true;
  Lines lines(source.bytes, byte_order_mark_size(source.bytes));
  const auto first = lines.next(), second = lines.next(), third = lines.next();
  return third && parse_integer(trim(*first)) && parse_integer(trim(*second)) &&
         numbers_of(*third).size() == 3;
}

Result<RawCloud> read_ptx(const Source& source) {
  return PtxReader(source).read();
}

}  // namespace relievo::io
