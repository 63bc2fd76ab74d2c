// Finds nearest neighbours in two and three dimensions. Only this file uses nanoflann. Tested by
// tests/scan/spacing_test.cpp and tests/scan/boundary_test.cpp.
#pragma once

#include <cstdio>
#include <memory>
#include <span>
#include <utility>
#include <vector>

// nanoflann prints a line before it throws std::bad_alloc. The macro suppresses the line, because the library must
// not print.
#define fprintf(...) static_cast<void>(0)
#include <nanoflann.hpp>
#undef fprintf

#include "relievo/core/types.h"

namespace relievo {

// A k-d tree over points of type Vec2 or Vec3, which must outlive it. Concurrent queries are safe.
template <typename Point>
class KdTree {
 public:
  using Match = std::pair<Index, double>;  // index of a point, squared distance to the query

  explicit KdTree(std::span<const Point> points) : adaptor_{points} {
    if (!points.empty())
      tree_ = std::make_unique<Tree>(dimension, adaptor_, nanoflann::KDTreeSingleIndexAdaptorParams(12));
  }

  // Writes the indices and squared distances of the k points nearest to `query` to the arrays, nearest first.
  // Returns the number of points found: k, or the size of the tree if that is less. If `query` is a point of
  // the tree, it is found, too.
  std::size_t nearest(const Point& query, std::size_t k, Index* indices, double* distances_sq) const {
    if (!tree_) return 0;
    NearestSet found(k);
    found.init(indices, distances_sq);
    tree_->findNeighbors(found, query.data(), nanoflann::SearchParams());
    return found.size();
  }

  // Replaces `matches` by all points nearer than `radius`, in an arbitrary but reproducible order.
  void within(const Point& query, double radius, std::vector<Match>& matches) const {
    matches.clear();
    if (tree_)
      tree_->radiusSearch(query.data(), radius * radius, matches, nanoflann::SearchParams(0, 0, false));
  }

 private:
  static constexpr int dimension = Point::RowsAtCompileTime;

  struct Adaptor {
    std::span<const Point> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
      return points[i][static_cast<Eigen::Index>(axis)];
    }
    template <typename Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Adaptor, double, Index>,
                                          Adaptor, dimension, Index>;

  // Stops the search once k points coincide with the query, because no point can be nearer. nanoflann would still
  // visit all other points at the same position, which takes quadratic time in clouds with many coincident points.
  struct NearestSet : nanoflann::KNNResultSet<double, Index> {
    using Base = nanoflann::KNNResultSet<double, Index>;
    using Base::Base;
    double worstDist() const { return Base::worstDist() > 0 ? Base::worstDist() : -1; }
  };

  Adaptor adaptor_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace relievo
