#include <cmath>

#include "io/text.h"
#include "relievo/io/read.h"

namespace relievo {

Result<DepthCamera> parse_camera(std::string_view text) {
  std::string blanks(text);
  for (char& c : blanks)
    if (c == ',' || c == '\n' || c == '\r') c = ' ';
  std::vector<double> n;
  io::Words words(blanks);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    const auto number = io::parse_number(word);
    if (!number || !std::isfinite(*number) || n.size() == 9)
      return option_error(
          "camera",
          "expected FX,FY,CX,CY, the nine numbers of a camera matrix or a file with either, found " +
              io::in_quotes(text));
    n.push_back(*number);
  }
  if (n.size() == 9) n = {n[0], n[4], n[2], n[5]};
  if (n.size() != 4 || !(n[0] > 0) || !(n[1] > 0))
    return option_error("camera",
                        "expected FX,FY,CX,CY with positive focal lengths, found " + io::in_quotes(text));
  return DepthCamera{n[0], n[1], n[2], n[3]};
}

}  // namespace relievo
