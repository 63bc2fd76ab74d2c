// The slopes of the layered style for frames: those of write_slopes() to the last bit, of eight points at a time.
// Tested by tests/relief/layered_slopes_test.cpp.
#pragma once

#include <span>

#include "relief/style.h"
#include "relief/weight_table.h"

namespace relievo {

// Writes the target slope of every point, with w_k = weight(k).
void write_slopes(const SlopeInput& input, const LayeredStyle& style, const WeightTable& weight,
                  std::span<Vec2f> slopes);

}  // namespace relievo
