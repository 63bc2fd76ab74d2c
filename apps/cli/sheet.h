// A contact sheet: pictures in a table, each with lines of text beneath.
#pragma once

#include <string>
#include <vector>

#include "relievo/core/image.h"
#include "relievo/picture/preview.h"

namespace relievo::app::cli {

struct SheetCell {
  Image8 picture;                  // one channel
  std::vector<std::string> lines;  // beneath it
};

// Rows of cells on a light ground; cells are as large as the largest, rows may differ in length.
Image8 make_sheet(const std::vector<std::vector<SheetCell>>& rows);

}  // namespace relievo::app::cli
