// Finds the parts of a table of heights that are not heights, such as labels of rows.
// Tested by tests/io/height_text_test.cpp.
#pragma once

#include <optional>

#include "io/readers.h"
#include "io/xyz.h"
#include "relievo/scan/depth_image.h"

namespace relievo::io {

// Returns the layout of a text whose table begins behind other lines, such as those of an instrument or rows
// without any value; nothing if no line has 8 numbers.
std::optional<XyzLayout> find_table_behind_words(const Source& source);

// Removes the numbers of columns above a table, as spreadsheets and pandas write them, and those of rows on its
// left. Beside an empty corner these may be places at equal distances, which give the size of pixels.
void drop_labels(DepthImage& table);

}  // namespace relievo::io
