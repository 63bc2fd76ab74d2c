#include "lettering/ornament_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/angle.h"
#include "geometry/plane.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

constexpr double curve_tolerance_mm = .003;
// Default sizes of ornaments. The size of a text is a fraction of that part of the margin that has no
// borders. The width of a border, and its distance from the rim, are fractions of the whole margin.
constexpr double text_share = .6, border_share = .12, line_share = .06, border_inset = .04;
constexpr double usual_height = .2;  // as a fraction of the text's size
constexpr double below_rim = .8;     // largest default height, as a fraction of the rim's height
constexpr double least_mm = .01, most_mm = 1e4;

// Returns the height of an ornament. If no height is given, it is `usual`, but lower than the rim.
double height_of(const Ornament& ornament, double usual, const OrnamentFrame& frame) {
  if (frame.rim_mm) usual = std::min(usual, below_rim * *frame.rim_mm);
  const double height = ornament.height_mm.value_or(ornament.is_engraved ? -usual : usual);
  return frame.is_die ? -height : height;
}

double slope_of(const Ornament& ornament, const OrnamentFrame& frame) {
  return ornament.is_engraved ? std::min(1.0, frame.slope) : frame.slope;
}

Vec2 middle_of(const OrnamentFrame& frame) {
  return Box::of(frame.inner).centre().head<2>();
}

// Returns the radius of the largest circle around the centre that is inside the rim.
double radius_within(const OrnamentFrame& frame) {
  const Vec2 middle = middle_of(frame);
  double radius = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < frame.inner.size(); ++i) {
    const Vec2 &a = frame.inner[i], side = frame.inner[(i + 1) % frame.inner.size()] - a;
    radius =
        std::min(radius, std::abs(side.x() * (middle - a).y() - side.y() * (middle - a).x()) / side.norm());
  }
  return radius;
}

// The circle on which a text stands. Angles increase in the reading direction.
struct BaseCircle {
  Vec2 middle;
  double radius, angle, sign;  // sign: 1 if the text is read counter-clockwise, -1 if clockwise

  // Returns the position on the plate of a point of the text. On the straight line of text, the point is
  // `along` after the text's centre and `up` above the baseline. The centre of its letter is `letter` after
  // the text's centre.
  Vec2 place(double along, double letter, double up, double read_radius) const {
    const double turn = angle + sign * letter / read_radius;
    const Vec2 outwards(std::cos(turn), std::sin(turn)),
        rightwards(-sign * outwards.y(), sign * outwards.x());
    const Vec2 above = -sign * outwards;
    return middle + radius * outwards + (along - letter) * rightwards + up * above;
  }
};

// Returns the outline divided into edges of at most `step`, so that it can be bent.
std::vector<Vec2> finely_divided(const std::vector<Vec2>& outline, double step) {
  std::vector<Vec2> fine;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const int parts = std::max(1, static_cast<int>(std::ceil((b - a).norm() / step)));
    for (int k = 0; k < parts; ++k) fine.emplace_back(a + static_cast<double>(k) / parts * (b - a));
  }
  return fine;
}

class TextPlacer {
 public:
  TextPlacer(const Ornament& ornament, const OrnamentFrame& frame, ShapedLine line, double size)
      : ornament_(ornament),
        frame_(frame),
        line_(std::move(line)),
        size_(size),
        tracking_(ornament.tracking_mm) {}

  Result<Outlines> place() {
    const double inset = ornament_.inset_mm.value_or(usual_inset());
    length_ = size_ * line_.advance + tracking_ * static_cast<double>(line_.clusters.size() - 1);
    if (ornament_.arc == TextArc::straight) return straight(inset);
    const bool is_bottom = ornament_.arc == TextArc::bottom;
    circle_ = {middle_of(frame_), radius_within(frame_) - inset - (is_bottom ? 0 : size_),
               to_radians(ornament_.angle_deg.value_or(is_bottom ? 270 : 90)), is_bottom ? 1. : -1.};
    // At half the height of lower-case letters, the distances between letters are the same as on a straight
    // line.
    read_radius_ = circle_.radius + (is_bottom ? -.5 : .5) * line_.x_height * size_;
    const double way = 2 * std::numbers::pi * read_radius_;
    if (!(circle_.radius > size_) || length_ > way)
      return option_error(
          "text", cat("expected a text of at most ", std::max(0.0, way), " mm, all around its circle, found ",
                      length_, " mm: '", ornament_.text, "'"));
    if (ornament_.arc == TextArc::around) spread(way);
    return placed(
        [&](const Vec2& p, double letter) { return circle_.place(p.x(), letter, p.y(), read_radius_); });
  }

 private:
  // Returns the distance between capitals and rim that centres the text in the margin without its borders.
  // Parts of letters above the capitals and below the baseline count as text.
  double usual_inset() const {
    constexpr double usual_overshoot = .1;
    Box box;
    for (const GlyphCluster& cluster : line_.clusters)
      for (const std::vector<Vec2>& outline : cluster.outlines)
        box.extend(Box::of(outline).min), box.extend(Box::of(outline).max);
    const double above = box.max.y() > 1 + usual_overshoot ? box.max.y() - 1 : 0,
                 below = box.min.y() < -usual_overshoot ? -box.min.y() : 0;
    const double space = (frame_.margin_mm - frame_.border_mm - size_ * (1 + above + below)) / 2;
    return frame_.border_mm + space +
           size_ * (ornament_.arc == TextArc::straight || ornament_.arc == TextArc::bottom ? below : above);
  }

  // Widens the spaces between letters until the text fills the whole circle.
  void spread(double way) {
    const auto n = static_cast<double>(line_.clusters.size());
    tracking_ += (way - length_ - tracking_) / n;
    length_ = size_ * line_.advance + tracking_ * (n - 1);
  }

  Outlines straight(double inset) const {
    const double low = Box::of(frame_.inner).min.y() + inset;
    const Vec2 middle = middle_of(frame_);
    const Vec2 start =
        ornament_.at_mm ? Vec2(middle + *ornament_.at_mm - Vec2(0, size_ / 2)) : Vec2(middle.x(), low);
    return placed([&](const Vec2& p, double) { return Vec2(start + p); });
  }

  template <typename Place>
  Outlines placed(Place&& place) const {
    Outlines outlines;
    double shift = -length_ / 2;
    for (const GlyphCluster& cluster : line_.clusters) {
      const double letter = size_ * (cluster.begin + cluster.advance / 2) + shift;
      const double step = std::sqrt(8 * curve_tolerance_mm * std::max(read_radius_, 1.0)) / size_;
      for (const std::vector<Vec2>& outline : cluster.outlines) {
        std::vector<Vec2>& made = outlines.emplace_back();
        for (const Vec2& p : cluster.is_joined ? finely_divided(outline, step) : outline) {
          const Vec2 at = size_ * p + Vec2(shift, 0);
          made.push_back(place(at, cluster.is_joined ? at.x() : letter));
        }
      }
      shift += tracking_;
    }
    return outlines;
  }

  const Ornament& ornament_;
  const OrnamentFrame& frame_;
  ShapedLine line_;
  double size_, tracking_, length_ = 0, read_radius_ = 1;
  BaseCircle circle_ = {};
};

Result<RaisedShape> text_shape(const Ornament& ornament, const OrnamentFrame& frame) {
  const double size = ornament.size_mm.value_or(text_share * (frame.margin_mm - frame.border_mm));
  RELIEVO_TRY(ShapedLine line, shape_line(ornament, curve_tolerance_mm / size));
  RELIEVO_TRY(Outlines outlines, TextPlacer(ornament, frame, std::move(line), size).place());
  const double height = height_of(ornament, usual_height * size, frame);
  return RaisedShape{cat("the text '", ornament.text, "'"), std::move(outlines),
                     leaning_wall(height, slope_of(ornament, frame)), size / 15};
}

Result<RaisedShape> drawing_shape(const Ornament& ornament, const OrnamentFrame& frame) {
  Box box;
  for (const std::vector<Vec2>& outline : ornament.outlines)
    for (const Vec2& p : outline) box.extend({p.x(), p.y(), 0});
  if (!(box.size().x() > 0) || !(box.size().y() > 0))
    return option_error("ornaments", "expected a drawing with an area, found none");
  if (!ornament.size_mm) return option_error("ornaments", "expected a drawing with its size, found none");
  const double scale = *ornament.size_mm / box.size().x(), high = scale * box.size().y();
  const double room = Box::of(frame.inner).diagonal();
  if (std::max(*ornament.size_mm, high) > room)
    return option_error(
        "ornaments", cat("expected a drawing of at most ", room, " mm, the diagonal within the rim, found ",
                         *ornament.size_mm, " x ", high, " mm"));
  const Vec2 middle = middle_of(frame) + ornament.at_mm.value_or(Vec2::Zero());
  Outlines outlines = ornament.outlines;
  for (std::vector<Vec2>& outline : outlines)
    for (Vec2& p : outline) p = middle + scale * (p - box.centre().head<2>());
  const double height = height_of(ornament, usual_height * text_share * frame.margin_mm, frame);
  return RaisedShape{"the drawing", std::move(outlines), leaning_wall(height, slope_of(ornament, frame)),
                     std::min(.25, *ornament.size_mm / 20)};
}

// The distance of a border from the rim, and its width.
struct BorderSpan {
  double before_mm, width_mm;
};

BorderSpan span_of_border(const Ornament& ornament, double margin_mm) {
  const double share = ornament.kind == OrnamentKind::line ? line_share : border_share;
  return {ornament.inset_mm.value_or(border_inset * margin_mm), ornament.size_mm.value_or(share * margin_mm)};
}

Result<RaisedShape> border_shape(const Ornament& ornament, const OrnamentFrame& frame) {
  const bool is_line = ornament.kind == OrnamentKind::line;
  const auto [before, width] = span_of_border(ornament, frame.margin_mm);
  const double room = radius_within(frame);
  if (before + width >= room)
    return option_error("ornaments", cat("expected a border within ", room, " mm of the rim, found one of ",
                                         before + width, " mm"));
  const double slope = slope_of(ornament, frame);
  if (is_line) {
    const double height = height_of(ornament, width / 2, frame);
    return RaisedShape{"the line", line_outlines(frame.inner, before, width), leaning_wall(height, slope),
                       std::max(.25, width)};
  }
  const BorderRow row{inset(frame.inner, before + width / 2), width, ornament.count.value_or(0)};
  const double height = height_of(ornament, width, frame);
  if (ornament.kind == OrnamentKind::beads)
    return RaisedShape{"the beads", bead_outlines(row), round_wall(height, bead_radius(row), slope), width};
  return RaisedShape{"the rope", rope_outlines(row), round_wall(height, strand_radius(row), slope), width};
}

Result<void> check_lengths(const Ornament& ornament) {
  const std::string option = ornament.kind == OrnamentKind::text ? "text" : "ornaments";
  const auto is_bad = [](const std::optional<double>& mm, double least) {
    return mm && !(std::abs(*mm) >= least && std::abs(*mm) <= most_mm);
  };
  if (is_bad(ornament.size_mm, least_mm) || is_bad(ornament.height_mm, least_mm) ||
      is_bad(ornament.inset_mm, 0))
    return option_error(option, cat("expected lengths of ", least_mm, " to ", most_mm, " mm, found others"));
  if (ornament.size_mm.value_or(1) < 0)
    return option_error(option, cat("expected a positive size, found ", *ornament.size_mm, " mm"));
  if (!(std::abs(ornament.tracking_mm) <= most_mm))
    return option_error(option,
                        cat("expected tracking of at most ", most_mm, " mm, found ", ornament.tracking_mm));
  if (ornament.at_mm && !ornament.at_mm->allFinite())
    return option_error(option, "expected a finite place, found another");
  constexpr double most_beads = 2000;
  if (ornament.count && !(*ornament.count >= 3 && *ornament.count <= most_beads))
    return option_error(option, cat("expected 3 to ", most_beads, " beads, found ", *ornament.count));
  return {};
}

Result<RaisedShape> shape_of_ornament(const Ornament& ornament, const OrnamentFrame& frame) {
  RELIEVO_CHECK(check_lengths(ornament));
  if (ornament.kind == OrnamentKind::text) return text_shape(ornament, frame);
  if (ornament.kind == OrnamentKind::drawing) return drawing_shape(ornament, frame);
  return border_shape(ornament, frame);
}

}  // namespace

double margin_of_borders(std::span<const Ornament> ornaments, double margin_mm) {
  double taken = 0;
  for (const Ornament& ornament : ornaments) {
    if (ornament.kind == OrnamentKind::text || ornament.kind == OrnamentKind::drawing) continue;
    const auto [before, width] = span_of_border(ornament, margin_mm);
    if (before + width <= margin_mm / 2) taken = std::max(taken, before + width);
  }
  return taken;
}

Result<std::vector<RaisedShape>> ornament_shapes(std::span<const Ornament> ornaments,
                                                 const OrnamentFrame& frame) {
  std::vector<RaisedShape> shapes;
  const double twice_middle = 2 * middle_of(frame).x();
  for (const Ornament& ornament : ornaments) {
    RELIEVO_TRY(RaisedShape shape, shape_of_ornament(ornament, frame));
    if (frame.is_mirrored)
      for (std::vector<Vec2>& outline : shape.outlines)
        for (Vec2& p : outline) p.x() = twice_middle - p.x();
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

}  // namespace relievo
