#include "lettering/ornament_shapes.h"

#include <fribidi.h>
#include <hb-ot.h>
#include <hb.h>

#include <algorithm>
#include <memory>
#include <span>

#include "core/number.h"
#include "geometry/curve_polygon.h"
#include "relievo/core/text.h"

// Embeds the bytes of the font in the program. g++ 12 has no #embed, and WebAssembly has no .pushsection.
#ifdef __wasm__
#pragma clang diagnostic ignored "-Wc23-extensions"
static constexpr char relievo_font[] = {
#embed RELIEVO_FONT
};
static constexpr const char *relievo_font_begin = relievo_font, *relievo_font_end = std::end(relievo_font);
#else
asm(".pushsection .rodata\n"
    ".global relievo_font_begin\n.hidden relievo_font_begin\n"
    ".global relievo_font_end\n.hidden relievo_font_end\n"
    "relievo_font_begin:\n.incbin \"" RELIEVO_FONT
    "\"\nrelievo_font_end:\n.byte 0\n"
    ".popsection\n");
extern "C" __attribute__((visibility("hidden"))) const char relievo_font_begin[], relievo_font_end[];
#endif

namespace relievo {
namespace {

// Limits that protect against malicious fonts and texts.
constexpr std::size_t most_characters = 1000, most_font_bytes = 64 << 20, most_outline_points = 50000,
                      most_corners = 100000;
constexpr double farthest = 1e5;  // largest distance from the start of the line, in heights of capitals

// The least plausible height of capitals, and the height that replaces an implausible one, as fractions of
// the em. Both numbers also apply to the height of lower-case letters, as fractions of the height of
// capitals.
constexpr double least_capital = .1, usual_capital = .7;

template <auto destroy>
struct Destroyer {
  template <typename T>
  void operator()(T* object) const {
    destroy(object);
  }
};
using FontPointer = std::unique_ptr<hb_font_t, Destroyer<hb_font_destroy>>;
using BufferPointer = std::unique_ptr<hb_buffer_t, Destroyer<hb_buffer_destroy>>;
using DrawPointer = std::unique_ptr<hb_draw_funcs_t, Destroyer<hb_draw_funcs_destroy>>;

std::span<const char> bytes_of(const Ornament& ornament) {
  if (!ornament.font) return {relievo_font_begin, relievo_font_end};
  return {reinterpret_cast<const char*>(ornament.font->bytes.data()), ornament.font->bytes.size()};
}

Result<FontPointer> open_font(const Ornament& ornament) {
  const std::span<const char> bytes = bytes_of(ornament);
  hb_blob_t* const blob =
      hb_blob_create(bytes.data(), static_cast<unsigned>(std::min(bytes.size(), most_font_bytes + 1)),
                     HB_MEMORY_MODE_READONLY, nullptr, nullptr);
  hb_face_t* const face = hb_face_create(blob, 0);
  FontPointer font(hb_font_create(face));
  const bool is_font = bytes.size() <= most_font_bytes && hb_face_get_glyph_count(face) > 0;
  hb_face_destroy(face);
  hb_blob_destroy(blob);
  if (is_font) return font;
  return option_error("font", cat("expected a TrueType or OpenType font of at most 64 MiB, found '",
                                  ornament.font->name, "', which is none"));
}

// A part of the text with one direction and one script, which HarfBuzz shapes as a whole.
struct ScriptRun {
  std::size_t begin, end;
  hb_script_t script;
  bool is_rightwards;
  FriBidiLevel level;
};

bool is_script(hb_script_t script) {
  return script != HB_SCRIPT_COMMON && script != HB_SCRIPT_INHERITED && script != HB_SCRIPT_UNKNOWN;
}

std::vector<hb_script_t> scripts_of(const std::vector<FriBidiChar>& text) {
  hb_unicode_funcs_t* const unicode = hb_unicode_funcs_get_default();
  std::vector<hb_script_t> scripts;
  for (const FriBidiChar c : text) scripts.push_back(hb_unicode_script(unicode, c));
  for (std::size_t i = 1; i < scripts.size(); ++i)
    if (!is_script(scripts[i])) scripts[i] = scripts[i - 1];
  for (std::size_t i = scripts.size(); i-- > 1;)
    if (!is_script(scripts[i - 1])) scripts[i - 1] = scripts[i];
  return scripts;
}

std::vector<FriBidiLevel> levels_of(const std::vector<FriBidiChar>& text) {
  const auto n = static_cast<FriBidiStrIndex>(text.size());
  std::vector<FriBidiCharType> types(text.size());
  std::vector<FriBidiBracketType> brackets(text.size());
  std::vector<FriBidiLevel> levels(text.size(), 0);
  fribidi_get_bidi_types(text.data(), n, types.data());
  fribidi_get_bracket_types(text.data(), n, types.data(), brackets.data());
  FriBidiParType base = FRIBIDI_PAR_ON;
  if (fribidi_get_par_embedding_levels_ex(types.data(), brackets.data(), n, &base, levels.data()) == 0)
    std::ranges::fill(levels, FriBidiLevel{0});
  return levels;
}

// Returns the runs in visual order, from left to right. Applies rule L2 of the Unicode bidirectional
// algorithm to runs instead of characters.
std::vector<ScriptRun> runs_of(const std::vector<FriBidiChar>& text) {
  const std::vector<FriBidiLevel> levels = levels_of(text);
  const std::vector<hb_script_t> scripts = scripts_of(text);
  std::vector<ScriptRun> runs;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i > 0 && levels[i] == levels[i - 1] && scripts[i] == scripts[i - 1])
      runs.back().end = i + 1;
    else
      runs.push_back({i, i + 1, scripts[i], levels[i] % 2 == 0, levels[i]});
  }
  const FriBidiLevel highest = levels.empty() ? FriBidiLevel{0} : *std::ranges::max_element(levels);
  for (FriBidiLevel level = highest; level > 0; --level)
    for (auto begin = runs.begin(); begin != runs.end();) {
      const auto is_deep = [&](const ScriptRun& run) { return run.level >= level; };
      begin = std::find_if(begin, runs.end(), is_deep);
      const auto end = std::find_if_not(begin, runs.end(), is_deep);
      std::reverse(begin, end);
      begin = end;
    }
  return runs;
}

// Returns whether the letters of a script are connected along the line.
bool is_joining(hb_script_t script) {
  constexpr hb_script_t joining[] = {HB_SCRIPT_ARABIC,   HB_SCRIPT_SYRIAC,     HB_SCRIPT_NKO,
                                     HB_SCRIPT_MANDAIC,  HB_SCRIPT_DEVANAGARI, HB_SCRIPT_BENGALI,
                                     HB_SCRIPT_GURMUKHI, HB_SCRIPT_MONGOLIAN};
  return std::ranges::find(joining, script) != std::end(joining);
}

struct Pen {
  CurvePolygons polygons;
  Vec2 origin;
  double unit;
  std::size_t points = 0;

  Vec2 at(float x, float y) {
    ++points;
    return (origin + Vec2(static_cast<double>(x), static_cast<double>(y))) / unit;
  }
};

Pen& pen_of(void* data) {
  return *static_cast<Pen*>(data);
}

DrawPointer draw_functions() {
  DrawPointer draw(hb_draw_funcs_create());
  hb_draw_funcs_set_move_to_func(
      draw.get(),
      [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float x, float y, void*) {
        pen_of(data).polygons.move_to(pen_of(data).at(x, y));
      },
      nullptr, nullptr);
  hb_draw_funcs_set_line_to_func(
      draw.get(),
      [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float x, float y, void*) {
        pen_of(data).polygons.line_to(pen_of(data).at(x, y));
      },
      nullptr, nullptr);
  hb_draw_funcs_set_quadratic_to_func(
      draw.get(),
      [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float cx, float cy, float x, float y, void*) {
        pen_of(data).polygons.quadratic_to(pen_of(data).at(cx, cy), pen_of(data).at(x, y));
      },
      nullptr, nullptr);
  hb_draw_funcs_set_cubic_to_func(
      draw.get(),
      [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float cx, float cy, float dx, float dy, float x,
         float y, void*) {
        Pen& pen = pen_of(data);
        pen.polygons.cubic_to(pen.at(cx, cy), pen.at(dx, dy), pen.at(x, y));
      },
      nullptr, nullptr);
  hb_draw_funcs_set_close_path_func(
      draw.get(),
      [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, void*) { pen_of(data).polygons.close(); }, nullptr,
      nullptr);
  return draw;
}

void draw_glyph(hb_font_t* font, hb_codepoint_t glyph, hb_draw_funcs_t* draw, Pen& pen) {
#if HB_VERSION_ATLEAST(7, 0, 0)
  hb_font_draw_glyph(font, glyph, draw, &pen);
#else
  hb_font_get_glyph_shape(font, glyph, draw, &pen);
#endif
}

class LineShaper {
 public:
  LineShaper(const Ornament& ornament, FontPointer font, double tolerance)
      : ornament_(ornament), font_(std::move(font)), draw_(draw_functions()), tolerance_(tolerance) {
    const double em = hb_face_get_upem(hb_font_get_face(font_.get()));
    capital_ = metric(HB_OT_METRICS_TAG_CAP_HEIGHT);
    if (!(capital_ > least_capital * em && capital_ < em)) capital_ = usual_capital * em;
    line_.x_height = metric(HB_OT_METRICS_TAG_X_HEIGHT) / capital_;
    if (!(line_.x_height > least_capital && line_.x_height < 1)) line_.x_height = usual_capital;
  }

  Result<ShapedLine> shape() {
    RELIEVO_TRY(text_, characters());
    for (const ScriptRun& run : runs_of(text_)) add(run);
    line_.advance = x_ / capital_;
    if (!missing_.empty())
      return option_error("text", cat("expected characters of the font ", font_name(),
                                      ", found others: ", missing_, "; font names another font"));
    if (outline_points_ > most_outline_points || corners_ > most_corners || is_far_)
      return option_error("font", cat("expected glyphs near the line, of at most ", most_corners,
                                      " corners together, found others in ", font_name()));
    if (outline_points_ == 0) return option_error("text", "expected visible characters, found none");
    return std::move(line_);
  }

 private:
  std::string font_name() const { return ornament_.font ? ornament_.font->name : "inside, Noto Serif"; }

  double metric(hb_ot_metrics_tag_t tag) const {
    hb_position_t value = 0;
    hb_ot_metrics_get_position_with_fallback(font_.get(), tag, &value);
    return value;
  }

  // Returns the characters of the text. Invalid UTF-8 becomes a replacement character.
  Result<std::vector<FriBidiChar>> characters() const {
    const std::string& text = ornament_.text;
    if (text.size() > 4 * most_characters)
      return option_error("text", cat("expected at most ", most_characters, " characters, found more"));
    std::vector<FriBidiChar> all(text.size() + 1);
    const FriBidiStrIndex n = fribidi_charset_to_unicode(
        FRIBIDI_CHAR_SET_UTF8, text.data(), static_cast<FriBidiStrIndex>(text.size()), all.data());
    all.resize(static_cast<std::size_t>(n));
    const auto is_control = [](FriBidiChar c) { return c < 32; };
    if (std::ranges::any_of(all, is_control))
      return option_error("text", "expected one line of text, found a control character");
    return all;
  }

  void add(const ScriptRun& run) {
    const BufferPointer buffer(hb_buffer_create());
    hb_buffer_t* const b = buffer.get();
    hb_buffer_add_utf32(b, text_.data(), static_cast<int>(text_.size()), static_cast<unsigned>(run.begin),
                        static_cast<int>(run.end - run.begin));
    hb_buffer_set_direction(b, run.is_rightwards ? HB_DIRECTION_LTR : HB_DIRECTION_RTL);
    hb_buffer_set_script(b, run.script);
    hb_buffer_set_language(b, hb_language_from_string("und", -1));
    // Only some builds of HarfBuzz support Graphite, which would give other glyphs. So only OpenType is used.
    constexpr const char* shapers[] = {"ot", nullptr};
    hb_shape_full(font_.get(), b, nullptr, 0, shapers);
    unsigned count = 0;
    const hb_glyph_info_t* const infos = hb_buffer_get_glyph_infos(b, &count);
    const hb_glyph_position_t* const positions = hb_buffer_get_glyph_positions(b, &count);
    for (unsigned i = 0; i < count;) {
      const unsigned first = i;
      for (++i; i < count && infos[i].cluster == infos[first].cluster;) ++i;
      add_cluster({infos + first, i - first}, positions + first, is_joining(run.script));
    }
  }

  void add_cluster(std::span<const hb_glyph_info_t> infos, const hb_glyph_position_t* positions,
                   bool is_joined) {
    GlyphCluster cluster;
    cluster.begin = x_ / capital_;
    cluster.is_joined = is_joined;
    for (std::size_t i = 0; i < infos.size(); ++i) {
      if (infos[i].codepoint == 0) report_missing(infos[i].cluster);
      const Vec2 origin(x_ + positions[i].x_offset, positions[i].y_offset);
      Pen pen{CurvePolygons(tolerance_), origin, capital_};
      if (outline_points_ <= most_outline_points)
        draw_glyph(font_.get(), infos[i].codepoint, draw_.get(), pen);
      outline_points_ += pen.points;
      for (std::vector<Vec2>& outline : pen.polygons.take()) {
        const auto is_near = [](const Vec2& p) { return p.cwiseAbs().maxCoeff() <= farthest; };
        is_far_ |= !std::ranges::all_of(outline, is_near);
        corners_ += outline.size();
        if (!is_far_ && corners_ <= most_corners) cluster.outlines.push_back(std::move(outline));
      }
      x_ += positions[i].x_advance;
    }
    cluster.advance = x_ / capital_ - cluster.begin;
    line_.clusters.push_back(std::move(cluster));
  }

  void report_missing(unsigned at) {
    const FriBidiChar c = text_[at];
    char utf8[8] = {};
    fribidi_unicode_to_charset(FRIBIDI_CHAR_SET_UTF8, &c, 1, utf8);
    constexpr char digits[] = "0123456789ABCDEF";
    std::string code;
    for (int shift = c > 0xFFFF ? 20 : 12; shift >= 0; shift -= 4) code += digits[(c >> shift) & 15];
    const std::string name = cat("'", utf8, "' (U+", code, ")");
    if (missing_.find(name) == std::string::npos) missing_ += cat(missing_.empty() ? "" : ", ", name);
  }

  const Ornament& ornament_;
  FontPointer font_;
  DrawPointer draw_;
  double tolerance_, capital_ = 1, x_ = 0;
  std::vector<FriBidiChar> text_;
  std::size_t outline_points_ = 0, corners_ = 0;
  bool is_far_ = false;
  std::string missing_;
  ShapedLine line_;
};

}  // namespace

Result<ShapedLine> shape_line(const Ornament& ornament, double tolerance) {
  RELIEVO_TRY(FontPointer font, open_font(ornament));
  return LineShaper(ornament, std::move(font), tolerance).shape();
}

Result<void> check_text(const Ornament& ornament) {
  RELIEVO_CHECK(shape_line(ornament, .01));
  return {};
}

}  // namespace relievo
