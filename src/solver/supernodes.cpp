#include "solver/cholesky_factor.h"

#include <algorithm>
#include <numeric>

namespace relievo::solver {
namespace {

std::vector<Index> inverse(std::span<const Index> order) {
  std::vector<Index> place(order.size());
  for (Index i = 0; i < order.size(); ++i) place[order[i]] = i;
  return place;
}

// Returns the elimination tree. The parent of a column is the row of the factor's first entry below the diagonal. Uses
// Liu's algorithm (1990), with path compression in `ancestor`.
std::vector<Index> elimination_tree(const Graph& graph, std::span<const Index> order,
                                    std::span<const Index> place) {
  std::vector<Index> parent(order.size(), no_index), ancestor(order.size(), no_index);
  for (Index i = 0; i < order.size(); ++i) {
    for (const Index neighbour : graph.neighbours(order[i])) {
      // Climbs from each earlier neighbour to the root of its tree; i becomes the parent of that root.
      for (Index j = place[neighbour]; j < i;) {
        const Index next = ancestor[j];
        ancestor[j] = i;
        if (next == no_index) parent[j] = i;
        j = next;
      }
    }
  }
  return parent;
}

// Returns the nodes of a forest in an order in which children precede their parents and subtrees are
// contiguous. Requires parent[v] > v.
std::vector<Index> postorder(std::span<const Index> parent) {
  const auto n = static_cast<Index>(parent.size());
  std::vector<Index> child(n + 1, no_index), sibling(n, no_index), order, stack;
  for (Index v = n; v-- > 0;) {
    Index& first = child[parent[v] == no_index ? n : parent[v]];
    sibling[v] = first;
    first = v;
  }
  order.reserve(n);
  for (Index root = child[n]; root != no_index; root = sibling[root]) {
    stack.push_back(root);
    while (!stack.empty()) {
      const Index v = stack.back();
      if (child[v] != no_index) {
        stack.push_back(child[v]);
        child[v] = sibling[child[v]];
      } else {
        order.push_back(v);
        stack.pop_back();
      }
    }
  }
  return order;
}

// Finds the fundamental supernodes, which store no zeros. The rows of each supernode are not sorted; all are below
// its last column.
class Fundamental {
 public:
  Fundamental(const Graph& graph, std::vector<Index> order) : graph_(graph), order_(std::move(order)) {
    std::vector<Index> place = inverse(order_);
    column_parent_ = elimination_tree(graph_, order_, place);
    reorder(postorder(column_parent_));
  }

  Supernodes build() && {
    const std::vector<Index> place = inverse(order_);
    const auto n = static_cast<Index>(order_.size());
    mark_.assign(n, no_index);
    owner_.resize(n);
    children_.assign(n, 0);
    for (const Index p : column_parent_)
      if (p != no_index) ++children_[p];
    first_child_.assign(n, no_index);
    for (Index j = 0; j < n; ++j) add_column(j, place);
    finish();
    result_.order = std::move(order_);
    return std::move(result_);
  }

 private:
  void reorder(const std::vector<Index>& sequence) {
    const std::vector<Index> moved = inverse(sequence);
    std::vector<Index> order(order_.size()), parent(order_.size());
    for (Index i = 0; i < order.size(); ++i) {
      order[i] = order_[sequence[i]];
      const Index p = column_parent_[sequence[i]];
      parent[i] = p == no_index ? no_index : moved[p];
    }
    order_ = std::move(order);
    column_parent_ = std::move(parent);
  }

  // Returns whether column j has the same structure as the open supernode. This is so if the only child of j is the
  // previous column, and all neighbours of j that are eliminated later are already rows of the supernode.
  bool continues(Index j, std::span<const Index> place) const {
    if (j == 0 || column_parent_[j - 1] != j || children_[j] != 1) return false;
    const auto nearby = graph_.neighbours(order_[j]);
    return std::all_of(nearby.begin(), nearby.end(), [&](Index u) {
      return place[u] <= j || mark_[place[u]] == static_cast<Index>(result_.parent.size()) - 1;
    });
  }

  void add_column(Index j, std::span<const Index> place) {
    if (!continues(j, place)) {
      if (j > 0) close(j);
      open(j, place);
    }
    owner_[j] = static_cast<Index>(result_.parent.size()) - 1;
  }

  void add_row(Index row, Index j) {
    const Index self = static_cast<Index>(result_.parent.size()) - 1;
    if (row <= j || mark_[row] == self) return;
    mark_[row] = self;
    result_.rows.push_back(row);
  }

  // Begins a supernode at column j. Its rows are the neighbours of j that are eliminated later, and the rows of its
  // children.
  void open(Index j, std::span<const Index> place) {
    result_.parent.push_back(no_index);
    for (const Index u : graph_.neighbours(order_[j])) add_row(place[u], j);
    for (Index s = first_child_[j]; s != no_index; s = next_sibling_[s])
      for (std::size_t r = result_.begin[s]; r < result_.begin[s + 1]; ++r) add_row(result_.rows[r], j);
  }

  // Ends the open supernode before column `end`.
  void close(Index end) {
    const auto from = result_.rows.begin() + static_cast<std::ptrdiff_t>(result_.begin.back());
    result_.rows.erase(std::remove_if(from, result_.rows.end(), [&](Index r) { return r < end; }),
                       result_.rows.end());
    result_.begin.push_back(result_.rows.size());
    result_.first.push_back(end);
    const Index self = static_cast<Index>(result_.parent.size()) - 1, p = column_parent_[end - 1];
    next_sibling_.push_back(p == no_index ? no_index : first_child_[p]);
    if (p != no_index) first_child_[p] = self;
  }

  void finish() {
    const auto n = static_cast<Index>(order_.size());
    if (n > 0) close(n);
    for (Index s = 0; s < result_.size(); ++s) {
      const Index p = column_parent_[result_.first[s + 1] - 1];
      result_.parent[s] = p == no_index ? no_index : owner_[p];
    }
  }

  const Graph& graph_;
  std::vector<Index> order_, column_parent_, children_, mark_, owner_;
  // Per column, a linked list of the supernodes whose parent is this column.
  std::vector<Index> first_child_, next_sibling_;
  Supernodes result_;
};

// The cost of a supernode in a substitution, in units of one float read from memory: reading its panel,
// gathering and scattering each row below, and a measured constant of about 40. It decides which supernodes
// are merged.
double substitution_cost(Index width, Index below) {
  return static_cast<double>(panel_floats(width, below)) + 2.0 * below + 40;
}

// Decides which supernodes are merged with their parents. Returns for each supernode the topmost member of
// its group.
std::vector<Index> amalgamate(const Supernodes& nodes) {
  const Index n = nodes.size();
  std::vector<Index> width(n), group(n);
  for (Index s = 0; s < n; ++s) width[s] = nodes.width(s);
  // In postorder the merging of a child is final before its parent is considered. The last child is considered first,
  // because its structure is the most similar to that of the parent.
  std::vector<Index> first_child(n, no_index), sibling(n, no_index);
  for (Index s = 0; s < n; ++s) {
    group[s] = s;
    for (Index c = first_child[s]; c != no_index; c = sibling[c]) {
      const double apart =
          substitution_cost(width[c], nodes.below(c)) + substitution_cost(width[s], nodes.below(s));
      if (substitution_cost(width[c] + width[s], nodes.below(s)) > apart) continue;
      width[s] += width[c];
      group[c] = s;
    }
    if (const Index p = nodes.parent[s]; p != no_index) sibling[s] = first_child[p], first_child[p] = s;
  }
  for (Index s = n; s-- > 0;) group[s] = group[s] == s ? s : group[group[s]];
  return group;
}

// The groups of merged supernodes, in postorder of the merged tree.
struct Groups {
  std::vector<Index> top;     // per group: its topmost member
  std::vector<Index> number;  // per old supernode: its group
};

Groups number_groups(const Supernodes& nodes, std::span<const Index> group) {
  std::vector<Index> tops, dense(nodes.size(), no_index), parent;
  for (Index s = 0; s < nodes.size(); ++s)
    if (group[s] == s) {
      dense[s] = static_cast<Index>(tops.size());
      tops.push_back(s);
    }
  for (const Index s : tops)
    parent.push_back(nodes.parent[s] == no_index ? no_index : dense[group[nodes.parent[s]]]);
  const std::vector<Index> sequence = postorder(parent), place = inverse(sequence);
  Groups groups;
  for (const Index g : sequence) groups.top.push_back(tops[g]);
  for (Index s = 0; s < nodes.size(); ++s) groups.number.push_back(place[dense[group[s]]]);
  return groups;
}

// Orders the columns group by group. Returns the new index of each old column.
std::vector<Index> place_columns(const Supernodes& nodes, const Groups& groups, Supernodes& result) {
  std::vector<Index> next(groups.top.size() + 1, 0);
  for (Index s = 0; s < nodes.size(); ++s) next[groups.number[s] + 1] += nodes.width(s);
  std::partial_sum(next.begin(), next.end(), next.begin());
  result.first = next;
  result.order.resize(nodes.order.size());
  std::vector<Index> moved(nodes.order.size());
  for (Index s = 0; s < nodes.size(); ++s)
    for (Index j = nodes.first[s]; j < nodes.first[s + 1]; ++j) {
      moved[j] = next[groups.number[s]]++;
      result.order[moved[j]] = nodes.order[j];
    }
  return moved;
}

// Merges each group into one supernode. Its rows are those of the topmost member of the group. They include
// all rows of the other members that are outside the group.
Supernodes merged(const Supernodes& nodes, std::span<const Index> group) {
  const Groups groups = number_groups(nodes, group);
  Supernodes result;
  const std::vector<Index> moved = place_columns(nodes, groups, result);
  for (const Index top : groups.top) {
    for (const Index row : nodes.rows_of(top)) result.rows.push_back(moved[row]);
    std::sort(result.rows.begin() + static_cast<std::ptrdiff_t>(result.begin.back()), result.rows.end());
    result.begin.push_back(result.rows.size());
    const Index p = nodes.parent[top];
    result.parent.push_back(p == no_index ? no_index : groups.number[p]);
  }
  return result;
}

}  // namespace

Supernodes analyse(const Graph& graph, std::span<const Index> order) {
  const Supernodes nodes = Fundamental(graph, {order.begin(), order.end()}).build();
  return merged(nodes, amalgamate(nodes));
}

std::size_t panel_floats(Index width, Index below) {
  const std::size_t rows = (std::size_t{width} + below + 3) / 4 * 4;
  std::size_t floats = 0;
  for (std::size_t c = 0; c < width; c += 8) floats += std::min<std::size_t>(8, width - c) * (rows - c);
  return floats;
}

}  // namespace relievo::solver
