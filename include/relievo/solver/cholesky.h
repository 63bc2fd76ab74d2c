// Factor once, solve per frame: a sparse symmetric positive definite system whose graph is nearly planar.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <span>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

// Owns the factorisation of one matrix, in single precision, and a copy of the matrix. How it works:
// docs/cholesky.md. Concurrent solves are safe, each with a workspace of its own. The results are the same
// bits for any number of threads.
class Cholesky {
 public:
  struct Factor;

  // What solves need besides the factor; about 5 floats per unknown, and 2 doubles from the first solve in
  // double on. It belongs to the factorisation that made it, which must outlive it; one solve at a time.
  class Workspace {
   public:
    Workspace(Workspace&&) noexcept;
    Workspace& operator=(Workspace&&) noexcept;
    ~Workspace();

    // Bytes held.
    std::size_t memory() const;

    struct Storage;

   private:
    friend class Cholesky;
    explicit Workspace(std::unique_ptr<Storage> storage);
    std::unique_ptr<Storage> storage_;
  };

  // Factors A, of which the lower triangle is read. A 0 x 0 matrix is fine.
  //
  // `positions` says where in the plane the unknowns are, if A belongs to a planar graph such as a
  // triangulation: one point per unknown, or none. They only steer the order of elimination; wrong ones cost
  // memory and time, never correctness. Errors: kind geometry if A is not square, has an entry that is not
  // finite, or is not positive definite (a pivot at most 1e-14 times its diagonal entry); kind option if
  // there are positions, but not one per unknown.
  static Result<Cholesky> factor(const Eigen::SparseMatrix<double>& A, std::span<const Vec2> positions = {});

  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;
  ~Cholesky();

  // Number of unknowns.
  std::size_t size() const;

  // From now on unknown i stands at element numbers[i] of b and x; their other elements are neither read nor
  // written. One number per unknown, no two the same.
  void renumber(std::span<const Index> numbers);

  // Bytes held, workspaces not counted.
  std::size_t memory() const;

  Workspace make_workspace() const;

  // All of these write to x the solution of A x = b. b and x have size() elements (see also
  // renumber()) and may be the same storage. With a workspace nothing is allocated (see there for the first
  // solve in double).

  // One substitution in single precision: an error of about 1e-6 of the largest |x| for a well-shaped
  // triangulation.
  void solve(std::span<const float> b, std::span<float> x, Workspace& workspace) const;

  // Substitution, then refinement in double until the largest element of the residual is 1e-13 of that of b
  // or stops falling: two substitutions as a rule.
  void solve(std::span<const double> b, std::span<double> x, Workspace& workspace) const;
  void solve(std::span<const double> b, std::span<double> x) const;

  // One step of refinement of an x close to the solution: its residual in double, a substitution in single
  // precision. b and x must not be the same storage.
  void refine(std::span<const double> b, std::span<double> x, Workspace& workspace) const;

 private:
  explicit Cholesky(std::unique_ptr<Factor> factor);
  std::unique_ptr<Factor> factor_;
};

}  // namespace relievo
