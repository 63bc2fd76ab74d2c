#include "solver/supernode_panel.h"

#include <algorithm>
#include <cmath>

#include "core/simd.h"

namespace relievo::solver {
namespace {

// Arguments of C -= A B^T, where C has `rows` x `columns` elements, A `rows` x `depth`, and B `columns` x `depth`. All
// are stored by columns. If `is_lower`, only the lower triangle of the square at the top of C is computed.
struct Product {
  double* c;
  const double* a;
  const double* b;
  std::size_t c_stride, a_stride, b_stride;
  Index rows, columns, depth;
  bool is_lower;
};

constexpr Index narrow = 8;  // at most this many columns are eliminated or inverted one by one

RELIEVO_INLINE Double4& at(double* p) {
  return *reinterpret_cast<Double4*>(p);
}
RELIEVO_INLINE const Double4& at(const double* p) {
  return *reinterpret_cast<const Double4*>(p);
}

// Subtracts the product from a tile of C with 4 * Height rows and Width columns. The tile stays in registers.
// Only the columns of A and B from `from` up to, but not including, `to` are multiplied.
template <int Height, int Width>
RELIEVO_INLINE void subtract_tile(const Product& p, Index i, Index j, Index from, Index to) {
  Double4 sum[Height][Width] = {};
  const double* a = p.a + i + from * p.a_stride;
  const double* b = p.b + j + from * p.b_stride;
  for (Index k = from; k < to; ++k, a += p.a_stride, b += p.b_stride)
    for (int h = 0; h < Height; ++h)
      for (int w = 0; w < Width; ++w) sum[h][w] += at(a + 4 * h) * b[w];
  for (int w = 0; w < Width; ++w)
    for (int h = 0; h < Height; ++h) at(p.c + i + 4 * h + (j + w) * p.c_stride) -= sum[h][w];
}

template <int Width>
RELIEVO_INLINE void subtract_strip(const Product& p, Index j, Index from, Index to) {
  Index i = p.is_lower ? j : 0;
  for (; i + 4 < p.rows; i += 8) subtract_tile<2, Width>(p, i, j, from, to);
  if (i < p.rows) subtract_tile<1, Width>(p, i, j, from, to);
}

RELIEVO_INLINE void subtract(const Product& p) {
  const Index block = 128;  // this many columns of A stay in the cache
  for (Index from = 0; from < p.depth; from += block) {
    const Index to = std::min(p.depth, from + block);
    Index j = 0;
    for (; j + 4 <= p.columns; j += 4) subtract_strip<4>(p, j, from, to);
    if (p.columns - j == 3) subtract_strip<3>(p, j, from, to);
    if (p.columns - j == 2) subtract_strip<2>(p, j, from, to);
    if (p.columns - j == 1) subtract_strip<1>(p, j, from, to);
  }
}

// Adds factor * x to y for the elements [from, to), and for up to three padding elements after them.
RELIEVO_INLINE void add_multiple(double* y, const double* x, double factor, Index from, Index to) {
  for (Index i = from; i < to; i += 4) at(y + i) += at(x + i) * factor;
}

RELIEVO_INLINE void scale(double* x, double factor, Index from, Index to) {
  for (Index i = from; i < to; i += 4) at(x + i) *= factor;
}

// Eliminates the columns [begin, begin + width) one by one. Returns the same as eliminate_columns(). After a
// failure it continues with pivots of 1, so that no element becomes infinite.
RELIEVO_INLINE Index eliminate(FrontalMatrix& front, Index begin, Index width,
                               std::span<const double> smallest_pivot) {
  const Index end = begin + width;
  Index failed = no_index;
  for (Index j = begin; j < end; ++j) {
    double* column = front.column(j);
    if (!(column[j] > smallest_pivot[j]) && failed == no_index) failed = j;
    const double pivot = failed == no_index ? std::sqrt(column[j]) : 1;
    scale(column, 1 / pivot, j + 1, front.rows);
    column[j] = pivot;
    for (Index c = j + 1; c < end; ++c) add_multiple(front.column(c), column, -column[c], c, front.rows);
  }
  return failed;
}

// Inverts the columns [begin, begin + width) one by one, from the last to the first. The columns to the right
// of column j are already inverted.
RELIEVO_INLINE void invert(FrontalMatrix& front, Index begin, Index width) {
  const Index end = begin + width;
  for (Index j = end; j-- > begin;) {
    double* column = front.column(j);
    double inside[narrow];
    for (Index c = j + 1; c < end; ++c) {
      inside[c - begin] = column[c];
      column[c] = 0;
    }
    for (Index c = j + 1; c < end; ++c)
      add_multiple(column, front.column(c), inside[c - begin], c, front.rows);
    const double inverse = 1 / column[j];
    scale(column, -inverse, j + 1, front.rows);
    column[j] = inverse;
  }
}

void subtract_product(const Product& p) {
  RELIEVO_WIDE(subtract(p));
}

// Returns about half of the width, as a multiple of `narrow`, so that only the last block of columns is
// incomplete.
Index first_half(Index width) {
  return (width / 2 + narrow - 1) / narrow * narrow;
}

// Eliminates the left half of the columns, updates the right half by a matrix product, and then eliminates
// the right half. Halves are halved again until few columns are left, so that matrix products do nearly all
// arithmetic.
Index eliminate_recursively(FrontalMatrix& front, Index begin, Index width,
                            std::span<const double> smallest_pivot) {
  if (width <= narrow) return RELIEVO_WIDE(eliminate(front, begin, width, smallest_pivot));
  const Index half = first_half(width), middle = begin + half;
  const Index failed = eliminate_recursively(front, begin, half, smallest_pivot);
  const double* left = front.column(begin) + middle;
  subtract_product({front.column(middle) + middle, left, left, front.stride, front.stride, front.stride,
                    front.rows - middle, width - half, half, true});
  const Index failed_later = eliminate_recursively(front, middle, width - half, smallest_pivot);
  return std::min(failed, failed_later);
}

// Inverts the right half of the columns, then the left half. The blocks of both halves change in this order:
//
//   given:          right columns:   rows below La:       left columns:
//   La              La               La                   La^-1
//   Lb  Lc          Lb  Wc           Wc Lb       Wc       -Wc Lb La^-1           Wc
//   Ld  Le          Ld  We           Ld + We Lb  We       -(Ld + We Lb) La^-1    We
//
// Wc is Lc^-1, and We is -Le Lc^-1.
void invert_recursively(FrontalMatrix& front, Index begin, Index width, std::vector<double>& scratch) {
  if (width <= narrow) return RELIEVO_WIDE(invert(front, begin, width));
  const Index half = first_half(width), middle = begin + half, rest = width - half;
  invert_recursively(front, middle, rest, scratch);
  scratch.resize(std::max(scratch.size(), std::size_t{half} * rest));
  for (Index c = 0; c < half; ++c) {
    double* inside = front.column(begin + c) + middle;
    for (Index r = 0; r < rest; ++r) scratch[c + std::size_t{r} * half] = -inside[r];
    std::fill_n(inside, rest, 0.0);
  }
  // The product reads the undefined elements above the diagonal of Wc, so they are set to 0.
  for (Index c = 1; c < rest; ++c) std::fill_n(front.column(middle + c) + middle, c, 0.0);
  subtract_product({front.column(begin) + middle, front.column(middle) + middle, scratch.data(), front.stride,
                    front.stride, half, front.rows - middle, half, rest, false});
  invert_recursively(front, begin, half, scratch);
}

}  // namespace

void FrontalMatrix::reset(Index new_rows) {
  rows = new_rows;
  stride = (new_rows + 3 + 3) / 4 * 4;  // whole vectors of four elements, at least three of them padding
  data.assign(std::size_t{stride} * new_rows + 8, 0.0);
}

Index eliminate_columns(FrontalMatrix& front, Index width, std::span<const double> smallest_pivot) {
  const Index failed = eliminate_recursively(front, 0, width, smallest_pivot);
  const double* left = front.column(0) + width;
  if (width < front.rows)
    subtract_product({front.column(width) + width, left, left, front.stride, front.stride, front.stride,
                      front.rows - width, front.rows - width, width, true});
  return failed;
}

void invert_columns(FrontalMatrix& front, Index width) {
  std::vector<double> scratch;
  invert_recursively(front, 0, width, scratch);
}

}  // namespace relievo::solver
