// Compiled without joined operations: the sums here know the round-off of each.
#include "core/algebra/quadratic_form.hpp"

#include <limits>

#include "core/lanes.hpp"

namespace arcwall {

namespace {

constexpr int lanes = 32;  // sums side by side: so many that the compiler keeps the loops over them

// Sums of products with twice the digits (Ogita, Rump and Oishi 2005).
struct Sums {
  double high[lanes] = {}, low[lanes] = {};

  ARCWALL_IN_PLACE void add(const double* a, const double* b) {
    for (int lane = 0; lane < lanes; ++lane) {
      const double product = a[lane] * b[lane], error = std::fma(a[lane], b[lane], -product);
      const double sum = high[lane] + product, part = sum - high[lane];
      low[lane] += ((high[lane] - (sum - part)) + (product - part)) + error;
      high[lane] = sum;
    }
  }
};

// Of all sums together, likewise.
double total(const Sums& a, const Sums& b) {
  double high = 0.0, low = 0.0;
  for (const Sums* sums : {&a, &b})
    for (int lane = 0; lane < lanes; ++lane) {
      const double next = sums->high[lane], sum = high + next, part = sum - high;
      low += ((high - (sum - part)) + (next - part)) + sums->low[lane];
      high = sum;
    }
  return high + low;
}

// Entries of K in turns, those beside the diagonal twice.
struct Entries {
  static constexpr int most = 4 * lanes;

  double value[most], at_row[most], at_column[most];
  int count = 0;
};

class Form {
 public:
  ARCWALL_IN_PLACE void add(Entries& entries) {
    while (entries.count % lanes != 0) {
      const int unused = entries.count++;
      entries.value[unused] = entries.at_row[unused] = entries.at_column[unused] = 0.0;
    }
    for (int first = 0; first < entries.count; first += lanes) {
      const double *k = entries.value + first, *row = entries.at_row + first, *column = entries.at_column + first;
      double product[lanes], error[lanes];
      for (int lane = 0; lane < lanes; ++lane) {
        product[lane] = k[lane] * row[lane];
        error[lane] = std::fma(k[lane], row[lane], -product[lane]);
        magnitude_[lane] += std::abs(product[lane] * column[lane]);
      }
      products_.add(product, column);
      errors_.add(error, column);
    }
    entries.count = 0;
  }

  QuadraticForm result() const {
    double magnitude = 0.0;
    for (const double part : magnitude_) magnitude += part;
    return {.value = total(products_, errors_), .roundoff = std::numeric_limits<double>::epsilon() * magnitude};
  }

 private:
  Sums products_, errors_;
  double magnitude_[lanes] = {};
};

ARCWALL_IN_PLACE QuadraticForm form_of(const SparseMatrix& K, const Eigen::Ref<const Vector>& v) {
  Form form;
  Entries entries;
  for (Index column = 0; column < K.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(K, column); entry; ++entry) {
      const int next = entries.count++;
      entries.value[next] = entry.value();
      entries.at_row[next] = v[entry.row()];
      entries.at_column[next] = entry.row() == column ? v[column] : 2.0 * v[column];
      if (entries.count == Entries::most) form.add(entries);
    }
  form.add(entries);
  return form.result();
}

// std::fma is a call where the compiler may not count on the instruction; the numbers are the same.
#ifdef __x86_64__
[[gnu::target("avx2,fma")]] QuadraticForm form_in_registers(const SparseMatrix& K, const Eigen::Ref<const Vector>& v) {
  return form_of(K, v);
}
#endif

}  // namespace

QuadraticForm quadratic_form(const SparseMatrix& K, const Eigen::Ref<const Vector>& v) {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return form_in_registers(K, v);
#endif
  return form_of(K, v);
}

}  // namespace arcwall
