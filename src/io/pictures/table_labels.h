// Finds the parts of a table of heights that are not heights, such as labels of rows.
// Tested by tests/io/height_text_test.cpp.
#pragma once

#include <optional>

#include "io/readers.h"
#include "io/xyz.h"
#include "relievo/scan/depth_image.h"

namespace relievo::io {

// Returns the layout of a text whose table begins after other lines, such as the settings of an instrument or
// rows without any value. Returns nothing if no line has 8 numbers.
std::optional<XyzLayout> find_table_behind_words(const Source& source);

// Removes the row above the table that numbers the columns, and the column on the left that numbers the rows,
// as spreadsheets and pandas write them. If the corner between them is empty, they may also be coordinates at
// equal distances; these distances become the size of pixels.
void drop_labels(DepthImage& table);

}  // namespace relievo::io
