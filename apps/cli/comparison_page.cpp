#include "cli/comparison_page.h"

#include "common/wording.h"
#include "relievo/core/text.h"
#include "relievo/io/write.h"

namespace relievo::app::cli {
namespace {

// The ground of the pictures is transparent, so the page has a neutral grey behind them. Negative margins
// cancel the padding inside the pictures, so that plates and text align. The model stays visible while the
// user scrolls.
constexpr std::string_view style = R"(
:root { color-scheme: light dark; }
body { margin: 2rem; font: 15px/1.45 system-ui, sans-serif; background: #e4e4e4; color: #222; }
th, td { padding: 0 2rem 1.5rem 0; vertical-align: top; text-align: left; font-variant-numeric: tabular-nums; }
thead th { padding-bottom: .3rem; }
img { display: block; max-width: 16rem; max-height: 26rem; margin: -.6rem -.9rem -.3rem; }
td[rowspan] img { position: sticky; top: 1rem; }
@media (prefers-color-scheme: dark) { body { background: #333; color: #ddd; } }
)";

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? std::to_integer<unsigned>(bytes[i]) : 0; };
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned bits = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (unsigned k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string picture(const Image8& image, std::string_view description) {
  return cat("<img alt=\"", description, "\" src=\"data:image/png;base64,", base64(write_png(image)), "\">");
}

std::string fixed(double value, int digits) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, digits);
  return {text, end.ptr};
}

std::string cell(const ComparedRelief& relief) {
  const Measures& m = relief.measures;
  const std::string name = cat("Relief by ", relief.method, ", ", 100 * relief.height, " % high");
  return cat("<td>", picture(relief.picture, name), "shading ", fixed(m.shading, 3), ", angle ",
             fixed(m.angle_deg, 1), "°<br>detail ", fixed(m.detail[0], 3), ", ", fixed(m.detail[1], 3), ", ",
             fixed(m.detail[2], 3), "<br>order ", fixed(m.order, 3), ", used ", fixed(m.height_used, 2),
             "<br>jump ", fixed(m.jump_step, 2), ", rim ", fixed(m.rim_step, 2), "<br>fray ",
             fixed(m.silhouette_fray_deg, 1), "°, at jumps ", fixed(m.jump_fray_deg, 1), "°, facets ",
             fixed(m.facet_angle_deg, 1), "°, longest side ", fixed(m.longest_side, 1),
             relief.parameters.empty() ? "" : "<br>", relief.parameters, "</td>\n");
}

std::string table(const Comparison& comparison) {
  const std::size_t columns = comparison.methods.size(), rows = comparison.reliefs.size() / columns;
  std::string html = "<table>\n<thead><tr><th>Height<th>Model";
  for (const std::string_view method : comparison.methods) html += cat("<th>", method);
  html += "</thead>\n";
  for (std::size_t row = 0; row < rows; ++row) {
    const auto first = comparison.reliefs.begin() + static_cast<std::ptrdiff_t>(row * columns);
    html += cat("<tr><th>", 100 * first->height, " %</th>");
    // The model is the same for all heights, so it is embedded once.
    if (row == 0) html += cat("<td rowspan=", rows, ">", picture(comparison.model, "The model"), "</td>\n");
    for (std::size_t i = 0; i < columns; ++i) html += cell(*(first + static_cast<std::ptrdiff_t>(i)));
  }
  return html + "</table>\n";
}

}  // namespace

std::string comparison_page(const Comparison& comparison) {
  const std::string title = cat("Reliefs of ", escaped_markup(comparison.scan));
  std::string html = cat(
      "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>", title, "</title><style>", style,
      "</style>\n<h1>", title, "</h1>\n<p>", comparison.visible_points, " visible points, ",
      comparison.measured_pixels,
      " pixels measured. Heights are shares of the width. The reliefs are better the larger shading, detail, "
      "order and used are, and the smaller all others are.</p>\n");
  for (const std::string& remark : comparison.remarks)
    html += cat("<p>", escaped_markup(as_sentence(remark)), "</p>\n");
  return html + table(comparison) + "</html>\n";
}

}  // namespace relievo::app::cli
