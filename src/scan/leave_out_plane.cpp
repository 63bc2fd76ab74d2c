#include "scan/leave_out_plane.h"

#include <algorithm>
#include <utility>

#include "core/disjoint_sets.h"

namespace relievo {
namespace {

// A connected set of the points that remain when the plane is left out: the box of all its points, and the
// number of its points that are high over the plane.
struct LeftPiece {
  Box box;
  std::size_t high = 0;
};

// Leaves out the remains of a plane: pieces that stay low over it for their size, because depth cameras bend
// tables, and boards have ridges. Also leaves out debris: pieces that are much smaller than the largest one.
void drop_low_pieces(const SupportPlane& plane, const Cloud& cloud, const Spacing& spacing,
                     std::vector<Index>& visible) {
  constexpr double low = 4;             // height, in tolerances
  constexpr double flat = .05;          // height, as a share of the diagonal of the piece's box
  constexpr double connected = 3;       // distance, in local spacings, as for floating noise: see visible.cpp
  constexpr double high_share = .1;     // least share of high points in a figure
  constexpr double debris_share = .03;  // least size of a piece, as a share of the largest piece
  std::vector<std::uint8_t> is_left(cloud.size(), 0);
  for (const Index i : visible) is_left[i] = 1;
  DisjointSets sets(cloud.size());
  for (const Index i : visible)
    for (const Index j : spacing.nearest[i])
      if (j != no_index && is_left[j] &&
          (cloud.points[i] - cloud.points[j]).norm() < connected * static_cast<double>(spacing.local[i]))
        sets.join(i, j);
  std::vector<LeftPiece> pieces;
  std::vector<Index> numbers(cloud.size(), no_index);  // number of each piece, by its representative
  const auto piece_of = [&](Index i) -> LeftPiece& {
    Index& number = numbers[sets.find(i)];
    if (number == no_index) {
      number = static_cast<Index>(pieces.size());
      pieces.emplace_back();
    }
    return pieces[number];
  };
  for (const Index i : visible) piece_of(i).box.extend(cloud.points[i]);
  for (const Index i : visible) {
    LeftPiece& piece = piece_of(i);
    const double height = plane.normal.dot(cloud.points[i]) - plane.offset;
    piece.high += height > std::max(low * plane.tolerance, flat * piece.box.diagonal());
  }
  std::vector<Index> rest;
  for (const Index i : visible)
    if (static_cast<double>(piece_of(i).high) >= high_share * static_cast<double>(sets.size_of(i)))
      rest.push_back(i);
  std::size_t largest = 0;
  for (const Index i : rest) largest = std::max(largest, sets.size_of(i));
  const double least = debris_share * static_cast<double>(largest);
  std::erase_if(rest, [&](Index i) { return static_cast<double>(sets.size_of(i)) < least; });
  if (!rest.empty()) visible = std::move(rest);
}

}  // namespace

void leave_out_plane(const SupportPlane& plane, const Spacing& spacing, Cloud& cloud,
                     const ShownPoints& shown) {
  const auto is_taken = [&](Index i) { return plane.takes(cloud.points[i], cloud.normals[i]); };
  std::erase_if(shown.visible, is_taken);
  std::erase_if(shown.hole_fill, is_taken);
  const Vec3f normal = plane.normal.cast<float>();
  std::erase_if(cloud.outlines, [&](const OutlineSegment& s) {
    return plane.takes(s.from, normal) && plane.takes(s.to, normal);
  });
  drop_low_pieces(plane, cloud, spacing, shown.visible);
}

}  // namespace relievo
