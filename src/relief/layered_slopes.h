// The slopes of the layered style for frames, of eight points at a time.
// Tested by tests/relief/layered_slopes_test.cpp.
#pragma once

#include <span>

#include "relief/style.h"
#include "relief/weight_table.h"

namespace relievo {

// Writes the same bits as write_slopes().
void write_slopes_by_eight(const SlopeInput& input, const LayeredStyle& style, const WeightTable& weight,
                           std::span<Vec2f> slopes);

}  // namespace relievo
