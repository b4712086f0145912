#pragma once

#include <memory>

#include "core/algebra/factorization.hpp"

namespace arcwall {

/// UMFPACK's LU with pivoting of a general square matrix, all entries given.
class Lu final : public Factorization {
 public:
  Lu();
  ~Lu() override;
  Lu(Lu&&) noexcept;
  Lu& operator=(Lu&&) noexcept;

  FactorStatus factorize(const SparseMatrix& matrix) override;
  void solve(Eigen::Ref<Matrix> X) const override;
  std::optional<Inertia> inertia() const override { return std::nullopt; }

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace arcwall
