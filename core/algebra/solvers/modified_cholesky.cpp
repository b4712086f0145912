#include "core/algebra/solvers/modified_cholesky.hpp"

#include <dlfcn.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "core/algebra/near_null.hpp"
#include "core/algebra/solvers/cholmod_factor.hpp"
#include "core/algebra/symmetric_eigen.hpp"

namespace arcwall {

namespace {

constexpr Index large = 5000;     // unknowns from which this pays
constexpr double coupled = 40.0;  // operations per entry of L from which dense blocks pay
constexpr double stiff = 8.0;     // springs, over what they are added to: S loses a digit at most
// With more than so many a matrix is refused. A spring takes a factorization that fails, once a step, and a solution
// with each matrix; the more operations there are an entry of L, the more is lost by single columns.
constexpr double worth_springs = 32.0;
constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();

// CHOLMOD asks for four threads for loops over single blocks, whatever the machine has; waiting for each other takes
// them longer than the work. Where no region of OpenMP may be active, one thread does all. This serves programs other
// than trace-path, which has no teams at all (apps/one_thread.cpp).
class OneThread {
 public:
  OneThread() {
    if (set_levels_ != nullptr) set_levels_(0);
  }
  ~OneThread() {
    if (set_levels_ != nullptr) set_levels_(before_);
  }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  template <typename Function>
  static Function* found(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
  }

  void (*set_levels_)(int) = found<void(int)>("omp_set_max_active_levels");
  int before_ = set_levels_ != nullptr ? found<int()>("omp_get_max_active_levels")() : 0;
};

class ModifiedCholesky final : public SymmetricFactors {
 public:
  explicit ModifiedCholesky(const SparseMatrix& A) : pattern_(A) {
    cholmod_common& common = llt_.common;
    common.supernodal = CHOLMOD_SUPERNODAL;
    cholmod_sparse a = cholmod_view(pattern_, A.valuePtr());
    // Nested dissection where the library has it. METIS draws from rand(), whose numbers threads share: orders that are
    // found at once would not be those that are found alone.
    static std::mutex drawing;
    const std::lock_guard<std::mutex> alone(drawing);
    for (const int ordering : {CHOLMOD_METIS, CHOLMOD_AMD}) {
      common.method[0].ordering = ordering;
      llt_.factor = cholmod_l_analyze(&a, &common);
      if (llt_.factor != nullptr) break;
    }
    most_springs_ = std::max(worth_springs, common.fl / (8.0 * common.lnz));
  }

  // Springs stand from here on alone, so that results do not depend on what was done before.
  void expect_near_null(const Matrix& vectors) override {
    soft_ = vectors;
    springs_.clear();
    refuses_ = false;
  }

  FactorStatus factorize(const SparseMatrix& A, const MatrixProperties& /*known*/) override {
    if (!is_finite(A)) return FactorStatus::not_finite;
    if (llt_.factor == nullptr || refuses_) return FactorStatus::singular;
    const OneThread one_thread;
    choose_springs(A);
    while (!factorize_with_springs(A))
      if (!support_more(A)) {
        refuses_ = true;
        return FactorStatus::singular;
      }
    return read_pivots() && eliminate_springs() ? FactorStatus::ok : FactorStatus::singular;
  }

  bool refused() const override { return true; }

  // (1)
  void solve(Eigen::Ref<Matrix> X) const override {
    const OneThread one_thread;
    llt_.solve(X);
    if (springs_.empty()) return;
    const Matrix forces = springs_left_.solve(at_springs(X));
    X.noalias() += responses_ * forces;
  }

  // Of K̂: what springs add to the diagonal and take away again is in it.
  double weighted(const Eigen::Ref<const Vector>& v) const override {
    const Vector u = v(llt_.order()).cwiseAbs();
    double sum = 0.0;
    Vector at_rows;
    for (std::size_t s = 0; s < llt_.factor->nsuper; ++s) {
      const Block part = block(s);
      at_rows.resize(part.rows);
      for (Index i = 0; i < part.rows; ++i) at_rows[i] = u[part.row[i]];
      for (Index j = 0; j < part.columns; ++j) {
        const Index rows = part.rows - j;
        const Eigen::Map<const Vector> column(part.values + j * part.rows + j, rows);
        sum += std::pow(column.cwiseAbs().dot(at_rows.tail(rows)), 2);  // (|L|ᵀ |v|)_j
      }
    }
    return sum;
  }

 private:
  struct Spring {
    Index at;  // unknown
    double k;
  };

  // A dense block of L, whose first rows are those of its columns; column by column.
  struct Block {
    Index first, columns, rows;
    const SuiteSparse_long* row;
    const double* values;
  };

  Block block(std::size_t s) const {
    const cholmod_factor& L = *llt_.factor;
    const auto* column = static_cast<const SuiteSparse_long*>(L.super);
    const auto* rows = static_cast<const SuiteSparse_long*>(L.pi);
    const auto* values = static_cast<const SuiteSparse_long*>(L.px);
    return {.first = column[s],
            .columns = column[s + 1] - column[s],
            .rows = rows[s + 1] - rows[s],
            .row = static_cast<const SuiteSparse_long*>(L.s) + rows[s],
            .values = static_cast<const double*>(L.x) + values[s]};
  }

  void choose_springs(const SparseMatrix& A) {
    if (soft_.rows() == A.cols())
      for (const auto& vector : soft_.colwise()) add_spring(A, near_null_place(A.diagonal(), vector));
    soft_.resize(0, 0);
    for (Spring& spring : springs_) spring.k = stiffness_of(A, spring.at);
    std::erase_if(springs_, [](const Spring& spring) { return spring.k == 0.0; });
  }

  // Where the matrix fails. False if that is of no use.
  bool support_more(const SparseMatrix& A) {
    return double(springs_.size()) < most_springs_ && add_spring(A, near_null_place(A.diagonal(), unresisted()));
  }

  // False if there is one already, or nothing that tells how stiff it should be.
  bool add_spring(const SparseMatrix& A, Index at) {
    const double k = stiffness_of(A, at);
    const bool stands = std::any_of(springs_.begin(), springs_.end(), [&](const Spring& one) { return one.at == at; });
    if (stands || !(k > 0.0)) return false;
    springs_.push_back({.at = at, .k = k});
    return true;
  }

  static double stiffness_of(const SparseMatrix& A, Index at) {
    const Index diagonal = A.outerIndexPtr()[at];
    const bool there = diagonal < A.nonZeros() && A.innerIndexPtr()[diagonal] == at;
    return there ? stiff * std::abs(A.valuePtr()[diagonal]) : 0.0;
  }

  // False if a pivot is not positive.
  bool factorize_with_springs(const SparseMatrix& A) {
    cholmod_sparse a = cholmod_view(pattern_, A.valuePtr());
    if (!springs_.empty()) {
      sprung_.assign(A.valuePtr(), A.valuePtr() + A.nonZeros());
      for (const Spring& spring : springs_) sprung_[static_cast<std::size_t>(A.outerIndexPtr()[spring.at])] += spring.k;
      a.x = sprung_.data();
    }
    cholmod_l_factorize(&a, llt_.factor, &llt_.common);
    return llt_.factor->minor == llt_.factor->n;
  }

  // Where the pivot of column j has failed, K̂ does not resist v = (−K̂₁₁⁻¹ K̂₁ⱼ, 1, 0):  vᵀ K̂ v = dⱼ ≤ 0. By the columns
  // of L before j:  Lᵀ v = 0 there.
  Vector unresisted() const {
    const auto failed = static_cast<Index>(llt_.factor->minor);
    Vector v = Vector::Zero(llt_.size());
    v[failed] = 1.0;
    for (std::size_t s = llt_.factor->nsuper; s-- > 0;) {
      const Block part = block(s);
      for (Index j = std::min(part.columns, failed - part.first) - 1; j >= 0; --j) {
        const double* column = part.values + j * part.rows;
        double sum = 0.0;
        for (Index i = j + 1; i < part.rows && part.row[i] <= failed; ++i) sum += column[i] * v[part.row[i]];
        v[part.first + j] = -sum / column[j];
      }
    }
    Vector by_unknowns(v.size());
    by_unknowns(llt_.order()) = v;
    return by_unknowns;
  }

  bool read_pivots() {
    const cholmod_factor& L = *llt_.factor;
    if (llt_.common.status < CHOLMOD_OK || L.xtype != CHOLMOD_REAL) return false;
    pivots_ = {};
    bool usable = true;
    for (std::size_t s = 0; s < L.nsuper; ++s) {
      const Block part = block(s);
      for (Index j = 0; j < part.columns; ++j)
        usable = pivots_.add(std::pow(part.values[j * part.rows + j], 2)) && usable;
    }
    return usable;
  }

  // Y and S. Seen from K, each eigenvalue of k S stands for a pivot over the stiffness of a spring; it is the
  // difference of 1 and of what may be as much.
  bool eliminate_springs() {
    const auto count = static_cast<Index>(springs_.size());
    responses_.setZero(llt_.size(), count);
    if (count == 0) return true;
    Vector k(count);
    for (Index j = 0; j < count; ++j) {
      const Spring& spring = springs_[static_cast<std::size_t>(j)];
      responses_(spring.at, j) = 1.0;
      k[j] = spring.k;
    }
    llt_.solve(responses_);
    Matrix S = -at_springs(responses_);
    S.diagonal() += k.cwiseInverse();
    if (!S.allFinite()) return false;
    springs_left_.compute(S);
    const Vector root = k.cwiseSqrt();
    const Matrix scaled = root.asDiagonal() * (0.5 * (S + S.transpose())) * root.asDiagonal();
    const Vector values = symmetric_eigenvalues(scaled);
    bool usable = values.allFinite();
    for (const double value : values)
      usable = pivots_.add(value * k.maxCoeff()) && std::abs(value) > rounding && usable;
    pivots_.signs.positive = llt_.size() - pivots_.signs.negative;
    return usable;
  }

  // Eᵀ X
  Matrix at_springs(const Eigen::Ref<const Matrix>& X) const {
    Matrix rows(static_cast<Index>(springs_.size()), X.cols());
    for (Index j = 0; j < rows.rows(); ++j) rows.row(j) = X.row(springs_[static_cast<std::size_t>(j)].at);
    return rows;
  }

  CholmodFactor llt_;
  double most_springs_ = 0.0;
  Matrix soft_;  // vectors that have no springs yet
  bool refuses_ = false;
  std::vector<Spring> springs_;
  std::vector<double> sprung_;                // values of K̂
  Matrix responses_;                          // Y
  Eigen::PartialPivLU<Matrix> springs_left_;  // S
  Pattern pattern_;
};

// Whether dense blocks pay, as CHOLMOD itself decides: in an order that costs next to nothing to find.
bool couples_widely(const SparseMatrix& A) {
  CholmodFactor simplicial;
  simplicial.common.supernodal = CHOLMOD_SIMPLICIAL;
  simplicial.common.method[0].ordering = CHOLMOD_AMD;
  const Pattern pattern(A);
  cholmod_sparse a = cholmod_view(pattern, A.valuePtr());
  simplicial.factor = cholmod_l_analyze(&a, &simplicial.common);
  return simplicial.factor != nullptr && simplicial.common.fl >= coupled * simplicial.common.lnz;
}

}  // namespace

std::unique_ptr<SymmetricFactors> modified_cholesky(const SparseMatrix& A) {
  if (A.cols() < large || !couples_widely(A)) return nullptr;
  return any_modified_cholesky(A);
}

std::unique_ptr<SymmetricFactors> any_modified_cholesky(const SparseMatrix& A) {
  return std::make_unique<ModifiedCholesky>(A);
}

}  // namespace arcwall
