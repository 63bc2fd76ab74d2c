#include "batch/caption.h"

#include <algorithm>
#include <string>

namespace relievo::app::batch {
namespace {

constexpr int columns = 5, rows = 8;

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
static_assert(letters.size() == 95 * 2 * columns);

int digit(char c) {
  return c <= '9' ? c - '0' : c - 'A' + 10;
}

int column_of(char letter, int column) {
  const bool is_known = letter >= ' ' && letter <= '~';
  const int at = ((is_known ? letter : '?') - ' ') * columns + column;
  return 16 * digit(letters[static_cast<std::size_t>(2 * at)]) +
         digit(letters[static_cast<std::size_t>(2 * at + 1)]);
}

}  // namespace

void write_caption(Image8& image, const CaptionPlace& place, std::string_view text,
                   const std::array<std::uint8_t, 3>& colour) {
  const auto most = static_cast<std::size_t>(std::max(2, place.width / letter_width_px));
  const std::string line =
      text.size() <= most ? std::string(text) : std::string(text.substr(0, most - 2)) + "..";
  const int left = place.left + (place.width - letter_width_px * static_cast<int>(line.size())) / 2;
  for (std::size_t i = 0; i < line.size(); ++i)
    for (int x = 0; x < columns; ++x)
      for (int y = 0; y < rows; ++y)
        if ((column_of(line[i], x) >> y & 1) != 0)
          std::ranges::copy(
              colour,
              image.pixels.begin() + static_cast<std::ptrdiff_t>(image.index(
                                         left + letter_width_px * static_cast<int>(i) + x, place.top + y)));
}

}  // namespace relievo::app::batch
