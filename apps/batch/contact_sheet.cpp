#include "batch/contact_sheet.h"

#include <spng.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

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

constexpr int letter_columns = 5, letter_rows = 8;

// The glyphs of the characters ' ' to '~'. Each glyph has five columns, from left to right. A column is two
// hexadecimal digits; the lowest bit is its top pixel.
constexpr std::string_view letters =
    "000000000000005F00000007000700147F147F14242A7F2A12231308646236495620500008070300"
    "001C2241000041221C002A1C7F1C2A08083E08080080703000080808080800006060002010080402"
    "3E5149453E00427F400072494949462141494D331814127F1027454545393C4A4949314121110907"
    "3649494936464949291E000014000000403400000008142241141414141400412214080201590906"
    "3E415D594E7C1211127C7F494949363E414141227F4141413E7F494949417F090909013E41415173"
    "7F0808087F00417F41002040413F017F081422417F404040407F021C027F7F0408107F3E4141413E"
    "7F090909063E4151215E7F09192946264949493203017F01033F4040403F1F2040201F3F4038403F"
    "631408146303047804036159494D43007F4141410204081020004141417F04020102044040404040"
    "000307080020545478407F284444383844444428384444287F385454541800087E090218A4A49C78"
    "7F0804047800447D40002040403D007F1028440000417F40007C047804787C080404783844444438"
    "FC1824241818242418FC7C08040408485454542404043F44243C4040207C1C2040201C3C4030403C"
    "44281028444C9090907C4464544C440008364100000077000000413608000201020402";
static_assert(letters.size() == 95 * 2 * letter_columns);

int digit(char c) {
  return c <= '9' ? c - '0' : c - 'A' + 10;
}

int column_of(char letter, int column) {
  const bool is_known = letter >= ' ' && letter <= '~';
  const int at = ((is_known ? letter : '?') - ' ') * letter_columns + column;
  return 16 * digit(letters[static_cast<std::size_t>(2 * at)]) +
         digit(letters[static_cast<std::size_t>(2 * at + 1)]);
}

}  // namespace

void write_caption(Image8& image, const CaptionPlace& place, std::string_view text, const Colour& colour) {
  const auto most = static_cast<std::size_t>(std::max(2, place.width / letter_width_px));
  const std::string line =
      text.size() <= most ? std::string(text) : std::string(text.substr(0, most - 2)) + "..";
  const int left = place.left + (place.width - letter_width_px * static_cast<int>(line.size())) / 2;
  for (std::size_t i = 0; i < line.size(); ++i)
    for (int x = 0; x < letter_columns; ++x)
      for (int y = 0; y < letter_rows; ++y)
        if ((column_of(line[i], x) >> y & 1) != 0)
          set(image, left + letter_width_px * static_cast<int>(i) + x, place.top + y, colour);
}

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
