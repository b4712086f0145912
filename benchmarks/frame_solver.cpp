// The linear algebra of one Newton iteration on the square frame, by arcwall and by CHOLMOD called directly: one
// factorization and two right-hand sides, and the assembly of K besides.
//
//   frame_solver UNKNOWNS
#include <cholmod.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "benchmarks/figures.hpp"
#include "benchmarks/models.hpp"
#include "core/algebra/ldlt.hpp"
#include "core/algebra/solvers/pattern.hpp"

namespace {

using namespace arcwall;
using namespace arcwall::bench;

int repetitions = 3;  // one for the greatest frames

// The least CPU time of some calls [s].
template <typename Work>
double least_seconds(const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repetitions; ++i) {
    const double start = cpu_seconds();
    work();
    least = std::min(least, cpu_seconds() - start);
  }
  return least;
}

struct Seconds {
  double analysis = 0.0, factorization = 0.0, solution = 0.0;
};

void print(Index size, const std::string& which, const Seconds& seconds) {
  const std::string work = "frame " + which;
  print_figure(work, size, "analysis", "s", seconds.analysis);
  print_figure(work, size, "factorization", "s", seconds.factorization);
  print_figure(work, size, "two solutions", "s", seconds.solution);
  print_figure(work, size, "factorization and two solutions", "s", seconds.factorization + seconds.solution);
}

Seconds by_arcwall(const SparseMatrix& K, const Matrix& right) {
  Ldlt ldlt;
  Seconds seconds;
  const double start = cpu_seconds();
  ldlt.factorize(K);
  const double first = cpu_seconds() - start;
  seconds.factorization = least_seconds([&] { ldlt.factorize(K); });
  seconds.analysis = std::max(0.0, first - seconds.factorization);
  seconds.solution = least_seconds([&] {
    Matrix X = right;
    ldlt.solve(X);
  });
  return seconds;
}

// CHOLMOD's own view of the lower triangle and the right-hand sides: no numbers are copied.
class Cholmod {
 public:
  Cholmod(const SparseMatrix& K, const Matrix& right, int supernodal, int ordering) : pattern_(K) {
    cholmod_l_start(&common_);
    common_.supernodal = supernodal;
    common_.print = 0;
    common_.nmethods = 1;
    common_.method[0].ordering = ordering;
    matrix_.nrow = matrix_.ncol = static_cast<std::size_t>(K.cols());
    matrix_.nzmax = static_cast<std::size_t>(K.nonZeros());
    matrix_.p = pattern_.columns.data();
    matrix_.i = pattern_.rows.data();
    matrix_.x = const_cast<double*>(K.valuePtr());
    matrix_.stype = -1;
    matrix_.itype = CHOLMOD_LONG;
    matrix_.xtype = CHOLMOD_REAL;
    matrix_.dtype = CHOLMOD_DOUBLE;
    matrix_.sorted = matrix_.packed = 1;
    right_.nrow = right_.d = static_cast<std::size_t>(right.rows());
    right_.ncol = static_cast<std::size_t>(right.cols());
    right_.nzmax = right_.nrow * right_.ncol;
    right_.x = const_cast<double*>(right.data());
    right_.xtype = CHOLMOD_REAL;
    right_.dtype = CHOLMOD_DOUBLE;
  }
  ~Cholmod() {
    cholmod_l_free_factor(&factor_, &common_);
    cholmod_l_finish(&common_);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  Seconds measured() {
    Seconds seconds;
    const double start = cpu_seconds();
    factor_ = cholmod_l_analyze(&matrix_, &common_);
    seconds.analysis = cpu_seconds() - start;
    if (factor_ == nullptr) return seconds;
    seconds.factorization = least_seconds([&] { cholmod_l_factorize(&matrix_, factor_, &common_); });
    seconds.solution = least_seconds([&] {
      cholmod_dense* X = cholmod_l_solve(CHOLMOD_A, factor_, &right_, &common_);
      cholmod_l_free_dense(&X, &common_);
    });
    return seconds;
  }

  double operations() const { return common_.fl; }  // of the factorization

  // Whether this library has the ordering, and the matrix was factorized.
  bool usable() const { return factor_ != nullptr && common_.status >= CHOLMOD_OK; }

 private:
  cholmod_common common_{};
  Pattern pattern_;
  cholmod_sparse matrix_{};
  cholmod_dense right_{};
  cholmod_factor* factor_ = nullptr;
};

void print_cholmod(Index size, const SparseMatrix& K, const Matrix& right, const char* which, int supernodal,
                   int ordering) {
  Cholmod cholmod(K, right, supernodal, ordering);
  const Seconds seconds = cholmod.measured();
  if (!cholmod.usable()) return;
  print(size, which, seconds);
  print_figure(std::string("frame ") + which, size, "operations", "", cholmod.operations());
}

}  // namespace

int main(int count, char** arguments) {
  const Index size = count == 2 ? std::atol(arguments[1]) : 0;
  if (size < 100) {
    std::fprintf(stderr, "usage: frame_solver UNKNOWNS (100 or more)\n");
    return 2;
  }
  if (size >= 500000) repetitions = 1;
  const Model model = square_frame(square_side(size));
  const State state = rest(*model.structure);
  Linearization now;
  model.structure->linearize(state, now);
  const double assembly = least_seconds([&] { model.structure->linearize(state, now); });
  Matrix right(now.F.size(), 2);
  right << now.F_lambda, Vector::Ones(now.F.size());

  print_figure("frame", size, "assembly", "s", assembly);
  print(size, "arcwall", by_arcwall(now.K, right));
  print_cholmod(size, now.K, right, "CHOLMOD simplicial AMD", CHOLMOD_SIMPLICIAL, CHOLMOD_AMD);
  print_cholmod(size, now.K, right, "CHOLMOD simplicial METIS", CHOLMOD_SIMPLICIAL, CHOLMOD_METIS);
  print_cholmod(size, now.K, right, "CHOLMOD supernodal METIS", CHOLMOD_SUPERNODAL, CHOLMOD_METIS);
}
