#include "core/height_span.h"

#include <gtest/gtest.h>

#include <vector>

namespace relievo {
namespace {

TEST(HeightSpan, IncludesTheBase) {
  EXPECT_EQ(height_span(std::vector<double>{}), 0);
  EXPECT_EQ(height_span(std::vector<double>{1, 3}), 3);
  EXPECT_EQ(height_span(std::vector<double>{-2, -1}), 2);
  EXPECT_EQ(height_span(std::vector<double>{-2, 5}), 7);
}

}  // namespace
}  // namespace relievo
