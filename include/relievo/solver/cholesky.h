// Solves sparse symmetric positive definite systems whose graph is nearly planar. A matrix is factored once;
// every frame solves systems with it.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <span>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo::solver {

// Owns the factorisation of a matrix, in single precision, and a copy of the matrix
// (docs/decisions/solver.md). Concurrent solves are safe if each has its own workspace. Results have the same
// bits for any number of threads.
class Cholesky {
 public:
  struct Factor;

  // Scratch memory of solves: about 5 floats per unknown, plus 2 doubles per unknown from the first solve in
  // double precision on. A workspace belongs to the factorisation that made it, which must outlive the
  // workspace. Only one solve at a time may use a workspace.
  class Workspace {
   public:
    Workspace(Workspace&&) noexcept;
    Workspace& operator=(Workspace&&) noexcept;
    ~Workspace();

    // Returns the number of bytes of memory in use.
    std::size_t memory() const;

    struct Storage;

   private:
    friend class Cholesky;
    explicit Workspace(std::unique_ptr<Storage> storage);
    std::unique_ptr<Storage> storage_;
  };

  // Factors A, reading only its lower triangle. A 0 x 0 matrix is allowed.
  //
  // `positions` are the positions of the unknowns in the plane if A belongs to a planar graph, such as a
  // triangulation: one point per unknown, or none. They only guide the elimination order; wrong positions
  // cost memory and time, but never correctness. Errors: kind geometry if A is not square, has an entry that
  // is not finite, or is not positive definite (a pivot is at most 1e-14 times its diagonal entry); kind
  // option if the number of positions is neither 0 nor the number of unknowns.
  static Result<Cholesky> factor(const Eigen::SparseMatrix<double>& A, std::span<const Vec2> positions = {});

  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;
  ~Cholesky();

  // Returns the number of unknowns.
  std::size_t size() const;

  // Renumbers the unknowns for later solves: unknown i becomes element numbers[i] of b and x. All other
  // elements are neither read nor written. `numbers` has a different number for each unknown.
  void renumber(std::span<const Index> numbers);

  // Returns the number of bytes of memory in use, without workspaces.
  std::size_t memory() const;

  Workspace make_workspace() const;

  // The following functions write the solution of A x = b to x. b and x have size() elements (but see
  // renumber()) and may be the same memory. With a workspace they allocate nothing, except in the first solve
  // in double precision.

  // Solves by one substitution in single precision. For a well-shaped triangulation the error is about 1e-6
  // of the largest |x|.
  void solve(std::span<const float> b, std::span<float> x, Workspace& workspace) const;

  // Solves by substitution. Then refines the solution in double precision until the largest element of the
  // residual is at most 1e-13 times the largest element of b, or no longer decreases. Two substitutions are
  // usually enough.
  void solve(std::span<const double> b, std::span<double> x, Workspace& workspace) const;
  void solve(std::span<const double> b, std::span<double> x) const;

 private:
  explicit Cholesky(std::unique_ptr<Factor> factor);
  std::unique_ptr<Factor> factor_;
};

}  // namespace relievo::solver
