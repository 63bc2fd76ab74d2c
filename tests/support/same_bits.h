// Expects that results have the same bits with any number of threads, and with or without AVX2.
#pragma once

#include <gtest/gtest.h>

#include "core/simd.h"
#include "relievo/core/parallel.h"

namespace relievo::test {

// Expects that make() returns the same with one, two and four threads.
template <typename F>
void expect_same_for_any_threads(F&& make) {
  set_thread_count(1);
  const auto one = make();
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    EXPECT_TRUE(make() == one) << threads << " threads";
  }
  set_thread_count(0);
}

// Expects that make() returns the same with and without AVX2, if this processor has it.
template <typename F>
void expect_same_without_avx2(F&& make) {
  const auto wide = make();
  allow_avx2(false);
  EXPECT_TRUE(make() == wide) << "without AVX2";
  allow_avx2(true);
}

}  // namespace relievo::test
