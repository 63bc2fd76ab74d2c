// Reads the part of SVG 1.1 (W3C, second edition, chapter 8) that filled paths need.
#include "relievo/io/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/number.h"
#include "geometry/curve_polygon.h"
#include "geometry/plane.h"
#include "io/text.h"
#include "io/xml.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

using io::Source;
using io::XmlElement;

constexpr std::size_t most_drawn_corners = 50000;
constexpr double tolerance_share = 2e-4;  // tolerance of curves, as a share of the drawing's longer side
constexpr double most_coordinate = 1e9;

// Interprets the commands of one path.
class PathPen {
 public:
  PathPen(std::string_view data, CurvePolygons& out) : data_(data), out_(out) {}

  // Returns an empty text, or a message that says what was expected and what was found.
  std::string draw() {
    while (skip_space(), at_ < data_.size()) {
      if (std::isalpha(static_cast<unsigned char>(data_[at_])) != 0)
        command_ = data_[at_++];
      else if (command_ == 0 || command_ == 'z' || command_ == 'Z')
        return cat("expected a command, found '", data_.substr(at_, 12), "'");
      if (!step())
        return cat("expected numbers of the command ", command_, ", found '", data_.substr(at_, 12), "'");
    }
    return {};
  }

 private:
  void skip_space() {
    while (at_ < data_.size() && std::string_view(" \t\r\n,").find(data_[at_]) != std::string_view::npos)
      ++at_;
  }

  bool number(double& to) {
    skip_space();
    std::size_t begin = at_ < data_.size() && data_[at_] == '+' ? at_ + 1 : at_;
    const auto [value, end, error] = parse_double(data_.substr(begin));
    if (error != std::errc{} || !(std::abs(value) <= most_coordinate)) return false;
    at_ = static_cast<std::size_t>(end - data_.data());
    to = value;
    return true;
  }

  // Reads a flag, which may be followed by the next number without a space.
  bool flag(bool& to) {
    skip_space();
    if (at_ == data_.size() || (data_[at_] != '0' && data_[at_] != '1')) return false;
    to = data_[at_++] == '1';
    return true;
  }

  bool is_relative() const { return std::islower(static_cast<unsigned char>(command_)) != 0; }

  bool point(Vec2& to) {
    if (!number(to.x()) || !number(to.y())) return false;
    if (is_relative()) to += pen_;
    return true;
  }

  template <std::size_t n>
  bool points(std::array<Vec2, n>& to) {
    return std::ranges::all_of(to, [&](Vec2& p) { return point(p); });
  }

  // Interprets the next arguments of the command. Further arguments after those of a move are lines.
  bool step() {
    const char upper = static_cast<char>(std::toupper(static_cast<unsigned char>(command_)));
    const char before = std::exchange(last_, upper);
    switch (upper) {
      case 'M': {
        Vec2 p;
        if (!point(p)) return false;
        out_.move_to(start_ = pen_ = p);
        command_ = is_relative() ? 'l' : 'L';
        return true;
      }
      case 'Z':
        out_.close();
        pen_ = start_;
        return true;
      case 'L':
      case 'H':
      case 'V':
        return line(upper);
      case 'C':
      case 'S':
        return cubic(upper == 'S', before == 'C' || before == 'S');
      case 'Q':
      case 'T':
        return quadratic(upper == 'T', before == 'Q' || before == 'T');
      case 'A':
        return arc();
      default:
        return false;
    }
  }

  // A line after a closed outline, without a move, begins a new outline at the same starting point.
  void begin() {
    if (last_ != 'M') out_.continue_at(pen_);
  }

  bool line(char upper) {
    Vec2 p = pen_;
    double value = 0;
    if (upper == 'L') {
      if (!point(p)) return false;
    } else {
      if (!number(value)) return false;
      double& to = upper == 'H' ? p.x() : p.y();
      to = is_relative() ? to + value : value;
    }
    begin();
    out_.line_to(pen_ = p);
    return true;
  }

  bool cubic(bool is_smooth, bool is_continued) {
    std::array<Vec2, 2> to;
    Vec2 first = is_continued ? Vec2(2 * pen_ - control_) : pen_;
    if ((!is_smooth && !point(first)) || !points(to)) return false;
    begin();
    out_.cubic_to(first, to[0], to[1]);
    control_ = to[0];
    pen_ = to[1];
    return true;
  }

  bool quadratic(bool is_smooth, bool is_continued) {
    Vec2 control = is_continued ? Vec2(2 * pen_ - control_) : pen_, p;
    if ((!is_smooth && !point(control)) || !point(p)) return false;
    begin();
    out_.quadratic_to(control, p);
    control_ = control;
    pen_ = p;
    return true;
  }

  // Approximates an elliptical arc by cubic curves. Appendix F.6 of SVG 1.1 has the formula of its centre.
  bool arc() {
    Vec2 radii, p;
    double turn_deg = 0;
    bool is_large = false, is_sweeping = false;
    if (!number(radii.x()) || !number(radii.y()) || !number(turn_deg) || !flag(is_large) ||
        !flag(is_sweeping) || !point(p))
      return false;
    begin();
    radii = radii.cwiseAbs();
    if (radii.minCoeff() > 0 && p != pen_) draw_arc(radii, turn_deg, is_large != is_sweeping, is_sweeping, p);
    out_.line_to(pen_ = p);
    return true;
  }

  void draw_arc(Vec2 radii, double turn_deg, bool is_left, bool is_sweeping, const Vec2& to) {
    const double turn = turn_deg * std::numbers::pi / 180, c = std::cos(turn), s = std::sin(turn);
    const Vec2 half = (pen_ - to) / 2;
    Vec2 unit = Vec2(c * half.x() + s * half.y(), c * half.y() - s * half.x()).cwiseQuotient(radii);
    if (unit.norm() > 1) radii *= unit.norm(), unit.normalize();
    const double away = std::sqrt(std::max(0.0, 1 / unit.squaredNorm() - 1)) * (is_left ? 1 : -1);
    const Vec2 centre(away * unit.y(), -away * unit.x());
    const double begin = std::atan2((unit - centre).y(), (unit - centre).x());
    double sweep = std::atan2((-unit - centre).y(), (-unit - centre).x()) - begin;
    if (is_sweeping && sweep < 0) sweep += 2 * std::numbers::pi;
    if (!is_sweeping && sweep > 0) sweep -= 2 * std::numbers::pi;
    const Vec2 middle = (pen_ + to) / 2;
    const auto place = [&](const Vec2& p) {
      const Vec2 q = radii.cwiseProduct(p);
      return Vec2(middle + Vec2(c * q.x() - s * q.y(), s * q.x() + c * q.y()));
    };
    const int parts = static_cast<int>(std::ceil(std::abs(sweep) / (std::numbers::pi / 4)));
    const double step = sweep / parts, handle = 4. / 3 * std::tan(step / 4);
    for (int k = 0; k < parts; ++k) {
      const double from = begin + k * step, end = from + step;
      const Vec2 a(std::cos(from), std::sin(from)), b(std::cos(end), std::sin(end));
      out_.cubic_to(place(centre + a + handle * Vec2(-a.y(), a.x())),
                    place(centre + b - handle * Vec2(-b.y(), b.x())), place(centre + b));
    }
  }

  std::string_view data_;
  CurvePolygons& out_;
  std::size_t at_ = 0;
  char command_ = 0, last_ = 0;
  Vec2 pen_ = Vec2::Zero(), start_ = Vec2::Zero(), control_ = Vec2::Zero();
};

// Returns the value of a property of an element. The property is in the element's style or in an attribute
// with the property's name.
std::string_view property(const XmlElement& element, std::string_view name) {
  const std::string_view style = element.attribute("style");
  for (std::size_t at = 0; at < style.size();) {
    const std::size_t end = std::min(style.find(';', at), style.size());
    const std::string_view entry = style.substr(at, end - at);
    const std::size_t colon = entry.find(':'), first = entry.find_first_not_of(" \t\r\n");
    if (colon != std::string_view::npos && first < colon && entry.substr(first, colon - first) == name) {
      const std::string_view value = entry.substr(colon + 1);
      return value.substr(std::min(value.find_first_not_of(' '), value.size()));
    }
    at = end + 1;
  }
  return element.attribute(name);
}

double area_of(const std::vector<Vec2>& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    twice += cross(outline[i], outline[(i + 1) % outline.size()]);
  return twice / 2;
}

// Reverses outlines so that the winding number is 0 where the even-odd rule leaves holes. The outlines must
// not intersect.
void wind_by_depth(Outlines& outlines) {
  std::vector<std::uint8_t> is_hole;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    int depth = 0;
    for (std::size_t j = 0; j < outlines.size(); ++j)
      if (j != i && winding_number({outlines[j]}, outlines[i][0]) != 0) ++depth;
    is_hole.push_back(depth % 2 == 1);
  }
  for (std::size_t i = 0; i < outlines.size(); ++i)
    if ((area_of(outlines[i]) < 0) != (is_hole[i] != 0)) std::ranges::reverse(outlines[i]);
}

class DrawingReader {
 public:
  DrawingReader(const Source& source, const io::XmlElements& elements)
      : source_(source), elements_(elements) {}

  Result<Outlines> read(double tolerance) {
    if (elements_[0].name != "svg")
      return source_.error("the root", cat("expected svg, found ", elements_[0].name));
    Outlines all;
    std::vector<Inherited> open;
    for (std::size_t i = 0; i < elements_.size();) {
      const XmlElement& element = elements_[i];
      while (!open.empty() && open.back().end <= i) open.pop_back();
      Inherited own = open.empty() ? Inherited{0, "black", "nonzero"} : open.back();
      own.end = element.end;
      if (const auto fill = property(element, "fill"); !fill.empty()) own.fill = fill;
      if (const auto rule = property(element, "fill-rule"); !rule.empty()) own.rule = rule;
      if (is_one_of(element.name, {"defs", "clipPath", "mask", "symbol", "marker", "pattern", "metadata"})) {
        i = element.end;
        continue;
      }
      RELIEVO_CHECK(check_element(element));
      if (element.name == "path" && own.fill != "none") RELIEVO_CHECK(draw(element, own, tolerance, all));
      open.push_back(own);
      ++i;
    }
    return all;
  }

 private:
  struct Inherited {
    std::size_t end;
    std::string_view fill, rule;
  };

  static bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
  }

  Result<void> check_element(const XmlElement& element) const {
    if (is_one_of(element.name, {"rect", "circle", "ellipse", "polygon", "polyline", "text", "image", "use"}))
      return source_.error({},
                           cat("expected paths alone, found ", element.name, ": turn objects into paths"));
    if (!element.attribute("transform").empty())
      return source_.error({}, cat("expected paths without transform, found one on ", element.name));
    return {};
  }

  Result<void> draw(const XmlElement& element, const Inherited& own, double tolerance, Outlines& all) const {
    CurvePolygons polygons(tolerance);
    if (const std::string wrong = PathPen(element.attribute("d"), polygons).draw(); !wrong.empty())
      return source_.error("the data of a path", wrong);
    Outlines outlines = polygons.take();
    std::size_t corners = 0;
    for (const std::vector<Vec2>& outline : all) corners += outline.size();
    for (const std::vector<Vec2>& outline : outlines) corners += outline.size();
    if (corners > most_drawn_corners)
      return source_.error({}, cat("expected at most ", most_drawn_corners, " corners, found more"));
    if (own.rule == "evenodd" && outlines.size() <= 1000) wind_by_depth(outlines);
    all.insert(all.end(), outlines.begin(), outlines.end());
    return {};
  }

  const Source& source_;
  const io::XmlElements& elements_;
};

}  // namespace

Result<std::vector<std::vector<Vec2>>> read_svg(std::string_view text, std::string_view name) {
  const Source source{text, name};
  RELIEVO_TRY(const io::XmlElements elements, io::parse_xml(text, source));
  DrawingReader reader(source, elements);
  RELIEVO_TRY(const Outlines coarse, reader.read(most_coordinate));
  Box box;
  for (const std::vector<Vec2>& outline : coarse)
    for (const Vec2& p : outline) box.extend({p.x(), p.y(), 0});
  RELIEVO_TRY(Outlines outlines, reader.read(tolerance_share * std::max(box.longer_side(), 1e-6)));
  if (outlines.empty()) return source.error({}, "expected a filled path, found none");
  for (std::vector<Vec2>& outline : outlines)
    for (Vec2& p : outline) p.y() = -p.y();
  return outlines;
}

}  // namespace relievo
