#include "batch/contact_sheet.h"

#include <spng.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "batch/caption.h"

namespace relievo::app::batch {
namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr Colour paper = {236, 236, 234}, empty_tile = {222, 221, 218}, cross = {178, 92, 84},
                 ink = {70, 68, 64};
constexpr int gap_px = 10;

Image8 filled(int width, int height, const Colour& colour) {
  Image8 image{width, height, 3, {}};
  image.pixels.resize(image.index(0, height));
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = colour[i % 3];
  return image;
}

void set(Image8& image, int x, int y, const Colour& colour) {
  std::ranges::copy(colour, image.pixels.begin() + static_cast<std::ptrdiff_t>(image.index(x, y)));
}

// Returns the mean colour of the pixels of a rectangle, which must not be empty.
Colour mean_colour(const Image8& image, int x0, int y0, int x1, int y1) {
  std::array<unsigned, 3> sum{};
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += image[image.index(x, y) + k];
  const auto count = static_cast<unsigned>((x1 - x0) * (y1 - y0));
  Colour mean{};
  for (std::size_t k = 0; k < 3; ++k) mean[k] = static_cast<std::uint8_t>((sum[k] + count / 2) / count);
  return mean;
}

Image8 crossed_out(int side) {
  Image8 tile = filled(side, side, empty_tile);
  const int first = side * 3 / 8, last = side * 5 / 8;
  for (int i = first; i < last; ++i)
    for (int wide = 0; wide < 3 && i + wide < side; ++wide) {
      set(tile, i + wide, i, cross);
      set(tile, i + wide, side - 1 - i, cross);
    }
  return tile;
}

void put(const Image8& tile, int left, int top, Image8& sheet) {
  for (int y = 0; y < tile.height; ++y)
    std::copy_n(tile.pixels.begin() + static_cast<std::ptrdiff_t>(tile.index(0, y)), tile.index(0, 1),
                sheet.pixels.begin() + static_cast<std::ptrdiff_t>(sheet.index(left, top + y)));
}

}  // namespace

Image8 read_png(std::span<const std::byte> bytes) {
  const std::unique_ptr<spng_ctx, decltype([](spng_ctx* each) { spng_ctx_free(each); })> spng(
      spng_ctx_new(0));
  spng_ihdr header;
  if (!spng || spng_set_png_buffer(spng.get(), bytes.data(), bytes.size()) != 0 ||
      spng_get_ihdr(spng.get(), &header) != 0)
    return {};
  Image8 image;
  image.resize(static_cast<int>(header.width), static_cast<int>(header.height), 3);
  const int failed =
      spng_decode_image(spng.get(), image.pixels.data(), image.pixels.size(), SPNG_FMT_RGB8, 0);
  return failed == 0 ? image : Image8{};
}

Image8 tile_of_preview(const Image8& preview, int side) {
  const int width = preview.width / 2, height = preview.height;
  if (width < 1 || height < 1) return {};
  const double scale = std::min(1.0, side / static_cast<double>(std::max(width, height)));
  const int small_width = std::max(1, static_cast<int>(width * scale)),
            small_height = std::max(1, static_cast<int>(height * scale));
  Image8 tile = filled(side, side, paper);
  const int left = (side - small_width) / 2, top = (side - small_height) / 2;
  for (int y = 0; y < small_height; ++y)
    for (int x = 0; x < small_width; ++x) {
      const int x0 = x * width / small_width, y0 = y * height / small_height;
      const int x1 = std::max(x0 + 1, (x + 1) * width / small_width),
                y1 = std::max(y0 + 1, (y + 1) * height / small_height);
      set(tile, left + x, top + y, mean_colour(preview, x0, y0, x1, y1));
    }
  return tile;
}

Image8 contact_sheet(const std::vector<Tile>& tiles, int side) {
  const auto count = static_cast<int>(tiles.size());
  const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(count)))),
            rows = (count + columns - 1) / columns;
  const int step = side + gap_px, row_step = step + caption_height_px;
  Image8 sheet = filled(columns * step + gap_px, rows * row_step + gap_px, paper);
  const Image8 missing = crossed_out(side);
  for (int i = 0; i < count; ++i) {
    const auto& [picture, name] = tiles[static_cast<std::size_t>(i)];
    const int left = gap_px + i % columns * step, top = gap_px + i / columns * row_step;
    put(picture.empty() ? missing : picture, left, top, sheet);
    write_caption(sheet, {left, top + side + 3, side}, name, ink);
  }
  return sheet;
}

}  // namespace relievo::app::batch
