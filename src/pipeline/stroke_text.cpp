#include <algorithm>
#include <nlohmann/json.hpp>

#include "relievo/core/json_place.h"
#include "relievo/core/text.h"
#include "relievo/relief/stroke.h"

namespace relievo {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_of_a_value = 40;  // largest number of characters that a message shows of a value

std::string found(const Json& value) {
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return cat(", found ", text.size() <= most_of_a_value ? text : text.substr(0, most_of_a_value) + "...");
}

bool is_point(const Json& json) {
  return json.is_array() && json.size() == 3 &&
         std::ranges::all_of(json, [](const Json& x) { return x.is_number(); });
}

Vec3 to_point(const Json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

// Reads one stroke. Errors state the stroke's number and the key.
class StrokeReader {
 public:
  StrokeReader(const Json& json, std::size_t number) : json_(json), number_(number) {}

  Result<Stroke> read() const {
    if (!json_.is_object()) return fail(cat("expected an object", found(json_)));
    for (const auto& [key, value] : json_.items())
      if (std::ranges::find(keys, key) == keys.end())
        return fail(cat("expected ", either({keys.begin(), keys.end()}), ", found '", key, "'"));
    Stroke stroke;
    RELIEVO_CHECK(read_words(stroke));
    const bool may_exceed = stroke.brush == Brush::strengthen || stroke.brush == Brush::sharpen;
    RELIEVO_CHECK(read_number("amount", {0, may_exceed ? 4.0 : 1.0}, stroke.amount));
    RELIEVO_CHECK(read_number("softness", {.05, 1}, stroke.softness));
    if (!json_.contains("radius")) return fail("expected a radius in the units of the scan");
    RELIEVO_CHECK(read_number("radius", {1e-9, 1e9}, stroke.radius));
    RELIEVO_CHECK(read_points(stroke.points));
    RELIEVO_CHECK(read_area(stroke));
    return stroke;
  }

 private:
  struct Range {
    double least, most;
  };
  static constexpr std::array<std::string_view, 10> keys{
      "brush", "amount", "radius", "softness", "points", "name", "muted", "area", "direction", "tolerance"};

  std::unexpected<Error> fail(std::string expected) const {
    return option_error("strokes", cat("stroke ", number_ + 1, ": ", expected));
  }

  Result<void> read_words(Stroke& stroke) const {
    const Json name = json_.value("name", Json("")), muted = json_.value("muted", Json(false));
    RELIEVO_CHECK(read_choice("brush", brushes, stroke.brush));
    if (!name.is_string()) return fail(cat("expected a text as name", found(name)));
    if (!muted.is_boolean()) return fail(cat("expected muted to be true or false", found(muted)));
    stroke.name = name.get<std::string>();
    stroke.is_muted = muted.get<bool>();
    return {};
  }

  template <std::size_t n, typename T>
  Result<void> read_choice(const char* key, const std::array<Choice<T>, n>& choices, T& to) const {
    const Json word = json_.value(key, Json());
    const Result<T> known = parse_choice({}, word.is_string() ? word.get<std::string>() : "", choices);
    if (!known) return fail(cat("expected ", either(names_of(choices)), " as ", key, found(word)));
    to = *known;
    return {};
  }

  Result<void> read_area(Stroke& stroke) const {
    if (json_.contains("area")) RELIEVO_CHECK(read_choice("area", stroke_areas, stroke.area));
    RELIEVO_CHECK(read_number("tolerance", {.1, 180}, stroke.tolerance));
    if (const auto direction = json_.find("direction"); direction != json_.end()) {
      if (!is_point(*direction)) return fail(cat("expected a direction [x, y, z]", found(*direction)));
      stroke.direction = to_point(*direction);
    }
    if (stroke.area == StrokeArea::region && stroke.points.size() > 1)
      return fail(cat("expected one point of a region, found ", stroke.points.size()));
    if (stroke.area != StrokeArea::lasso) return {};
    if (stroke.points.size() < 3)
      return fail(cat("expected at least three points of a lasso, found ", stroke.points.size()));
    if (!(stroke.direction.norm() > 0)) return fail("expected a direction of the lasso that is not 0");
    return {};
  }

  Result<void> read_number(const char* key, Range range, double& to) const {
    const auto value = json_.find(key);
    if (value == json_.end()) return {};
    if (value->is_number()) to = value->get<double>();
    if (value->is_number() && to >= range.least && to <= range.most) return {};
    return fail(cat("expected ", key, " from ", range.least, " to ", range.most, found(*value)));
  }

  Result<void> read_points(std::vector<Vec3>& to) const {
    const Json points = json_.value("points", Json());
    if (!points.is_array() || points.empty() || points.size() > most_stroke_points)
      return fail(cat("expected 1 to ", most_stroke_points, " points [x, y, z]", found(points)));
    for (const Json& point : points) {
      if (!is_point(point)) return fail(cat("expected a point [x, y, z]", found(point)));
      to.push_back(to_point(point));
    }
    return {};
  }

  const Json& json_;
  std::size_t number_;
};

}  // namespace

Result<Strokes> parse_strokes(std::string_view text) {
  if (text.empty()) return Strokes();
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded())
    return option_error(
        "strokes", cat("expected strokes in JSON or a file with them, found '",
                       text.substr(0, most_of_a_value), "', which is no JSON at ", json_error_place(text)));
  if (!json.is_array() || json.size() > most_strokes)
    return option_error("strokes",
                        cat("expected a JSON array of at most ", most_strokes, " strokes", found(json)));
  Strokes strokes;
  for (std::size_t i = 0; i < json.size(); ++i) {
    RELIEVO_TRY(Stroke stroke, StrokeReader(json[i], i).read());
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

}  // namespace relievo
