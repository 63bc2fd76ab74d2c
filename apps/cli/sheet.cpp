#include "cli/sheet.h"
#include "relievo/core/image.h"

#include <algorithm>

#include "cli/letters.h"

namespace relievo::app::cli {
namespace {

constexpr int gap_px = 16;
constexpr std::uint8_t ground = 236, ink = 24;

struct CellSize {
  int width = 0, picture = 0, height = 0;  // pixels, without gaps; `picture` is its height
};

CellSize largest(const std::vector<std::vector<SheetCell>>& rows) {
  CellSize size;
  for (const auto& row : rows)
    for (const SheetCell& cell : row) {
      size.width = std::max(size.width, cell.picture.width);
      size.picture = std::max(size.picture, cell.picture.height);
      for (const std::string& line : cell.lines)
        size.width = std::max(size.width, static_cast<int>(line.size()) * letter_width_px);
      size.height = std::max(
          size.height, size.picture + gap_px / 2 + static_cast<int>(cell.lines.size()) * letter_height_px);
    }
  return size;
}

void paste(const Image8& picture, int x, int y, Image8& sheet) {
  for (int row = 0; row < picture.height; ++row)
    std::copy_n(picture.pixels.begin() + std::ptrdiff_t{row} * picture.width, picture.width,
                sheet.pixels.begin() + std::ptrdiff_t{y + row} * sheet.width + x);
}

}  // namespace

Image8 make_sheet(const std::vector<std::vector<SheetCell>>& rows) {
  const CellSize size = largest(rows);
  std::size_t columns = 0;
  for (const auto& row : rows) columns = std::max(columns, row.size());
  Image8 sheet{gap_px + static_cast<int>(columns) * (size.width + gap_px),
               gap_px + static_cast<int>(rows.size()) * (size.height + gap_px),
               1,
               {}};
  sheet.pixels.assign(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height), ground);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const int x = gap_px + static_cast<int>(c) * (size.width + gap_px);
      const int y = gap_px + static_cast<int>(r) * (size.height + gap_px);
      const SheetCell& cell = rows[r][c];
      paste(cell.picture, x + (size.width - cell.picture.width) / 2, y, sheet);
      for (std::size_t l = 0; l < cell.lines.size(); ++l)
        write_text(sheet, x, y + size.picture + gap_px / 2 + static_cast<int>(l) * letter_height_px,
                   cell.lines[l], ink);
    }
  return sheet;
}

}  // namespace relievo::app::cli
