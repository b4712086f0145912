#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>

#include "core/algebra/factorization.hpp"
#include "tests/support/models.hpp"

// A program may put a factorization of its own in place of the library's.
namespace arcwall::other_factorization_test {

namespace {

// Eigen's simplicial LDLᵀ in the order of approximate minimum degree, which makes no use of what else is known.
class EigenLdlt final : public Factorization {
 public:
  explicit EigenLdlt(int& matrices) : matrices_(matrices) {}

  FactorStatus factorize(const SparseMatrix& lower_triangle, const MatrixProperties&) override {
    ++matrices_;
    ok_ = false;
    if (!all_finite(lower_triangle.coeffs())) return FactorStatus::not_finite;
    ldlt_.compute(lower_triangle);
    ok_ = ldlt_.info() == Eigen::Success;
    return ok_ ? FactorStatus::ok : FactorStatus::singular;
  }

  void solve(Eigen::Ref<Matrix> X) const override { X = ldlt_.solve(Matrix(X)); }

  std::optional<Inertia> inertia() const override {
    if (!ok_) return std::nullopt;
    const Vector D = ldlt_.vectorD();
    return Inertia{.negative = (D.array() < 0.0).count(), .positive = (D.array() > 0.0).count()};
  }

  double pivot_ratio() const override {
    if (!ok_) return 0.0;
    const Vector D = ldlt_.vectorD().cwiseAbs();
    return D.minCoeff() / D.maxCoeff();
  }

  double growth(const SparseMatrix& lower_triangle) const override {
    return ldlt_.vectorD().cwiseAbs().maxCoeff() / lower_triangle.coeffs().abs().maxCoeff();
  }

  double roundoff(const Eigen::Ref<const Vector>& v) const override {
    const SparseMatrix L = SparseMatrix(ldlt_.matrixL()).cwiseAbs();
    const Vector z = L.transpose() * (ldlt_.permutationP() * Vector(v.cwiseAbs()));
    return std::numeric_limits<double>::epsilon() * z.cwiseAbs2().dot(ldlt_.vectorD().cwiseAbs());
  }

 private:
  int& matrices_;
  bool ok_ = false;
  Eigen::SimplicialLDLT<SparseMatrix> ldlt_;
};

// The path by the library's factorization, and by the other one.
void expect_same_path(const Structure& structure, TraceOptions options) {
  int matrices = 0;
  const test::Branch expected = test::trace(structure, options);
  options.factorization = [&] { return std::make_unique<EigenLdlt>(matrices); };
  const test::Branch found = test::trace(structure, options);
  test::expect_same_events(events_of(found), events_of(expected), {.relative = 1e-9, .at_displacement_limits = 1e-8});
  EXPECT_EQ(found.arcs.size(), expected.arcs.size());
  EXPECT_GT(matrices, static_cast<int>(found.arcs.size())) << "one an iteration";
}

}  // namespace

TEST(OtherFactorization, FindsTheSnapOfLeesFrame) {
  const auto structure = test::lee_frame(10);
  TraceOptions options{.step = {.first = 0.1}};
  options.target_values = {test::stop_at(*structure, 2, Dof::z, -90.0)};
  expect_same_path(*structure, options);
}

TEST(OtherFactorization, FindsTheBranchPointsOfAColumn) {
  const auto structure = test::Column{.EA = 1e4, .elements = 20}.structure();
  TraceOptions options{.step = {.first = 1.0, .max = 10.0}};
  options.target_values = {test::stop_at_lambda(100.0)};
  expect_same_path(*structure, options);
}

}  // namespace arcwall::other_factorization_test
