#include "solver/supernode_panel.h"

#include <algorithm>

#include "core/simd.h"

namespace relievo::solver {
namespace {

RELIEVO_INLINE Float8& eight(float* p) {
  return *reinterpret_cast<Float8*>(p);
}
RELIEVO_INLINE const Float8& eight(const float* p) {
  return *reinterpret_cast<const Float8*>(p);
}
RELIEVO_INLINE Float4& four(float* p) {
  return *reinterpret_cast<Float4*>(p);
}
RELIEVO_INLINE const Float4& four(const float* p) {
  return *reinterpret_cast<const Float4*>(p);
}

// Adds strip * b to `out`, for a strip of Width columns. Even and odd columns have separate sums, so that an
// addition need not wait for the previous one.
template <int Width>
RELIEVO_INLINE void add_strip(const float* strip, Index rows, const float* b, float* out) {
  float factor[Width];
  for (int w = 0; w < Width; ++w) factor[w] = b[w];
  Index r = 0;
  for (; r + 8 <= rows; r += 8, strip += 8 * Width) {
    Float8 even = eight(out + r), odd = {};
    for (int w = 0; w < Width; w += 2) even += eight(strip + 8 * w) * factor[w];
    for (int w = 1; w < Width; w += 2) odd += eight(strip + 8 * w) * factor[w];
    eight(out + r) = even + odd;
  }
  if (r == rows) return;
  Float4 sum = four(out + r);
  for (int w = 0; w < Width; ++w) sum += four(strip + 4 * w) * factor[w];
  four(out + r) = sum;
}

// Writes the sum of the elements of v[i] to sums[i], for i from 0 to 3.
RELIEVO_INLINE void add_across(const Float4* v, float* sums) {
  const Float4 ab =
      __builtin_shufflevector(v[0], v[1], 0, 4, 1, 5) + __builtin_shufflevector(v[0], v[1], 2, 6, 3, 7);
  const Float4 cd =
      __builtin_shufflevector(v[2], v[3], 0, 4, 1, 5) + __builtin_shufflevector(v[2], v[3], 2, 6, 3, 7);
  four(sums) = __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}

// Computes strip^T * x for a strip of Width columns, from the last row to the first; see
// multiply_transposed().
template <int Width>
RELIEVO_INLINE void multiply_strip(const float* strip, Index rows, const float* x, float* result) {
  Index r = rows / 8 * 8;
  const float* block = strip + std::size_t{r} * Width;
  Float4 half[8] = {};
  if (r < rows)
    for (int w = 0; w < Width; ++w) half[w] = four(block + 4 * w) * four(x + r);
  Float8 sum[Width] = {};
  while (r > 0) {
    r -= 8, block -= 8 * Width;
    for (int w = Width; w-- > 0;) sum[w] += eight(block + 8 * w) * eight(x + r);
  }
  for (int w = 0; w < Width; ++w)
    half[w] += __builtin_shufflevector(sum[w], sum[w], 0, 1, 2, 3) +
               __builtin_shufflevector(sum[w], sum[w], 4, 5, 6, 7);
  float sums[8];
  add_across(half, sums);
  if (Width > 4) add_across(half + 4, sums + 4);
  for (int w = 0; w < Width; ++w) result[w] = sums[w];
}

// Calls f<Width>() for the width of a strip, 1 to 8. The compiler can then unroll the loops over columns.
template <typename F>
RELIEVO_INLINE void with_width(Index width, F&& f) {
  switch (width) {
    case 1:
      return f.template operator()<1>();
    case 2:
      return f.template operator()<2>();
    case 3:
      return f.template operator()<3>();
    case 4:
      return f.template operator()<4>();
    case 5:
      return f.template operator()<5>();
    case 6:
      return f.template operator()<6>();
    case 7:
      return f.template operator()<7>();
    default:
      return f.template operator()<8>();
  }
}

// Adds W b to `out`. Returns a pointer to the end of the supernode's values.
RELIEVO_INLINE const float* add_product(NodeSize node, const float* values, const float* b, float* out) {
  const Index rows = padded_rows(node.width, node.below);
  Index c = 0;
  for (; c + 8 <= node.width; c += 8) {
    add_strip<8>(values, rows - c, b + c, out + c);
    values += std::size_t{8} * (rows - c);
  }
  if (c == node.width) return values;
  with_width(
      node.width - c, [&]<int Width>() __attribute__((always_inline)) {
        add_strip<Width>(values, rows - c, b + c, out + c);
      });
  return values + std::size_t{node.width - c} * (rows - c);
}

// Returns the number of values in the strips to the left of column c.
RELIEVO_INLINE std::size_t values_before(Index c, Index rows) {
  return std::size_t{c} * rows - std::size_t{c} * (c - strip_width) / 2;
}

// Computes W^T x. Reads the values exactly backwards, a pattern that the processor prefetches.
RELIEVO_INLINE void multiply_transposed(NodeSize node, const float* values, const float* x, float* result) {
  const Index rows = padded_rows(node.width, node.below);
  Index c = node.width / 8 * 8;
  if (c < node.width)
    with_width(
        node.width - c, [&]<int Width>() __attribute__((always_inline)) {
          multiply_strip<Width>(values + values_before(c, rows), rows - c, x + c, result + c);
        });
  while (c > 0) {
    c -= 8;
    multiply_strip<8>(values + values_before(c, rows), rows - c, x + c, result + c);
  }
}

RELIEVO_INLINE void forward(const Subtree& subtree) {
  alignas(32) float out[largest_subtree_rows + 8], b[largest_subtree_rows];
  const float* values = subtree.values;
  const std::uint16_t* rows = subtree.rows;
  float* own = subtree.work;
  for (const NodeSize node : subtree.nodes) {
    const Index count = node.width + node.below;
    for (Index i = 0; i < count; i += 8) eight(out + i) = Float8{};
    for (Index i = 0; i < node.width; ++i) b[i] = own[i], own[i] = 0;
    values = add_product(node, values, b, out);
    for (Index i = 0; i < count; ++i) subtree.work[rows[i]] += out[i];
    own += node.width;
    rows += padded_rows(node.width, node.below);
  }
}

// Copies work[rows[i]] to x[i]. Vectors are put together in registers, because the processor would stall if
// it loaded a vector from memory right after storing its elements one by one.
RELIEVO_INLINE void gather(const float* work, const std::uint16_t* rows, Index count, float* x) {
  Index i = 0;
  for (; i + 8 <= count; i += 8, rows += 8)
    eight(x + i) = Float8{work[rows[0]], work[rows[1]], work[rows[2]], work[rows[3]],
                          work[rows[4]], work[rows[5]], work[rows[6]], work[rows[7]]};
  if (i < count) four(x + i) = Float4{work[rows[0]], work[rows[1]], work[rows[2]], work[rows[3]]};
}

RELIEVO_INLINE std::size_t value_count(NodeSize node) {
  const Index rows = padded_rows(node.width, node.below), full = node.width / 8 * 8;
  return values_before(full, rows) + std::size_t{node.width - full} * (rows - full);
}

RELIEVO_INLINE void backward(const Subtree& end) {
  alignas(32) float x[largest_subtree_rows + 8];
  const float* values = end.values;
  const std::uint16_t* rows = end.rows;
  float* own = end.work;
  for (const NodeSize node : end.nodes) own += node.width;
  for (std::size_t s = end.nodes.size(); s-- > 0;) {
    const NodeSize node = end.nodes[s];
    values -= value_count(node);
    const Index count = padded_rows(node.width, node.below);
    rows -= count;
    own -= node.width;
    gather(end.work, rows, count, x);
    multiply_transposed(node, values, x, own);
  }
}

}  // namespace

void substitute_forward(const Subtree& subtree) {
  RELIEVO_WIDE(forward(subtree));
}

void substitute_backward(const Subtree& end) {
  RELIEVO_WIDE(backward(end));
}

void substitute_forward(NodeSize node, const float* values, float* work, float* scratch) {
  std::copy_n(work, node.width, scratch);
  std::fill_n(work, node.width, 0.0F);
  RELIEVO_WIDE(add_product(node, values, scratch, work));
}

void substitute_backward(NodeSize node, const float* values, float* work, float* scratch) {
  RELIEVO_WIDE(multiply_transposed(node, values, work, scratch));
  std::copy_n(scratch, node.width, work);
}

float* write_panel(FrontalMatrix& front, Index width, float* values) {
  const Index rows = padded_rows(width, front.rows - width);
  for (Index c = 0; c < width; c += strip_width) {
    const Index columns = std::min(strip_width, width - c);
    for (Index r = c; r < rows;) {
      const Index height = std::min<Index>(8, rows - r);
      for (Index w = 0; w < columns; ++w) {
        const double* column = front.column(c + w);
        for (Index i = r; i < r + height; ++i)
          *values++ = i >= c + w && i < front.rows ? static_cast<float>(column[i]) : 0.0F;
      }
      r += height;
    }
  }
  return values;
}

}  // namespace relievo::solver
