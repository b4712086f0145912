#include "apps/converge/extrapolation.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall {

namespace {

constexpr double least_order = 0.5;  // below, the values settle too slowly to say where
constexpr double most_order = 12.0;  // above, two errors have cancelled
constexpr double same_order = 1.0;   // by which orders of three meshes each may differ

double greatest(double a, double b) { return std::max(std::abs(a), std::abs(b)); }

}  // namespace

// With errors C hᵖ the differences d₁ = λ₂ − λ₁ and d₂ = λ₃ − λ₂ have the ratio rᵖ, r the factor, and what is left of
// the error of λ₃ is d₂/(rᵖ − 1).
Extrapolation extrapolated(const std::vector<double>& values, double factor, double unsure) {
  const std::size_t n = values.size();
  Extrapolation result{.value = values.back()};
  if (n == 1) {
    result.irregular = "on one mesh only";
    return result;
  }
  const double last = values[n - 1] - values[n - 2];
  result.error = std::abs(last) + unsure;
  if (n == 2) {
    result.irregular = "on two meshes only";
    return result;
  }
  const double before = values[n - 2] - values[n - 3];
  if (std::abs(last) <= unsure) return result;  // no error of the mesh is seen
  result.error = greatest(before, last) + unsure;
  const double ratio = before / last;
  const double order = ratio > 0.0 ? std::log(ratio) / std::log(factor) : 0.0;
  if (!(order >= least_order && order <= most_order)) {
    result.irregular = ratio < 0.0 ? "the values swing" : "the values do not settle with an order";
    return result;
  }
  if (n > 3) {
    const double earlier = (values[n - 3] - values[n - 4]) / before;
    const double other = earlier > 0.0 ? std::log(earlier) / std::log(factor) : 0.0;
    if (std::abs(other - order) > same_order) {
      result.irregular = "the order is another one on coarser meshes";
      return result;
    }
  }
  const double left = last / (ratio - 1.0);
  result.order = order;
  result.value += left;
  result.error = std::abs(left) + unsure;
  return result;
}

}  // namespace arcwall
