#include "python/engine/python_system.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/text.hpp"

namespace arcwall::python {

namespace {

// The lower triangle of a symmetric matrix by columns, rows ascending.
struct LowerTriangle {
  std::vector<std::size_t> begins{0};  // of the columns, and the end
  std::vector<SparseIndex> rows{};
  std::vector<double> values{};

  void add(Index row, double value) {
    rows.push_back(static_cast<SparseIndex>(row));
    values.push_back(value);
  }
  void end_column() { begins.push_back(rows.size()); }
};

std::string type_of(const py::object& object) { return py::str(py::type::of(object).attr("__name__")); }

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

// Without what numpy would drop on the way to real numbers.
py::array real_array(const py::object& returned, const std::string& what) {
  const py::array array = py::array::ensure(returned);
  if (!array) {
    PyErr_Clear();
    throw py::type_error(what + " returned a " + type_of(returned) + ", which is no array of numbers");
  }
  if (const char kind = array.dtype().kind(); std::string("fiub").find(kind) == std::string::npos)
    throw py::type_error(what + " returned an array of " + std::string(py::str(array.dtype())) +
                         "; real numbers are wanted");
  return array;
}

std::string square_text(Index n) { return "(" + std::to_string(n) + ", " + std::to_string(n) + ")"; }

[[noreturn]] void fail_on_asymmetry(Index i, Index j, double lower, double upper) {
  throw py::value_error("jacobian(x, lam) is not symmetric: entry (" + std::to_string(i) + ", " + std::to_string(j) +
                        ") is " + round_trip(lower) + ", its mirror image " + round_trip(upper) +
                        "; equations that are no derivatives of an energy cannot be traced");
}

// Mirror images may differ by what difference quotients do.
constexpr double symmetric_within = 1e-6;  // of the greatest entry

LowerTriangle lower_triangle_of_dense(const py::object& returned, Index n) {
  using Dense = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const py::array array = real_array(returned, "jacobian(x, lam)");
  if (array.ndim() != 2 || array.shape(0) != n || array.shape(1) != n)
    throw py::value_error("jacobian(x, lam) returned shape " + shape_text(array) + "; " + square_text(n) +
                          " is wanted");
  const Dense dense(array);
  const Eigen::Map<const LongRows> J(dense.data(), n, n);
  const double tolerance = symmetric_within * J.cwiseAbs().maxCoeff();
  LowerTriangle lower;
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i) {
      if (std::abs(J(i, j) - J(j, i)) > tolerance) fail_on_asymmetry(i, j, J(i, j), J(j, i));
      lower.add(i, J(i, j));
    }
    lower.end_column();
  }
  return lower;
}

// Compressed columns as scipy has them, rows ascending and each once.
struct ScipyColumns {
  py::array_t<double, py::array::c_style | py::array::forcecast> values;
  py::array_t<std::int32_t, py::array::c_style | py::array::forcecast> rows, begins;

  ScipyColumns(const py::object& matrix, Index n)
      : values(real_array(matrix.attr("data"), "jacobian(x, lam)")),
        rows(matrix.attr("indices")),
        begins(matrix.attr("indptr")) {
    const bool sizes = begins.ndim() == 1 && begins.shape(0) == n + 1 && rows.ndim() == 1 && values.ndim() == 1 &&
                       rows.shape(0) == values.shape(0) && begins.at(0) == 0 && begins.at(n) <= rows.shape(0);
    if (!sizes || !std::is_sorted(begins.data(), begins.data() + n + 1) ||
        std::any_of(rows.data(), rows.data() + begins.at(n), [n](std::int32_t row) { return row < 0 || row >= n; }))
      throw py::value_error("jacobian(x, lam) returned a sparse matrix whose parts do not fit together");
  }

  // 0 where nothing is stored.
  double at(Index row, Index column) const {
    const std::int32_t* const first = rows.data() + begins.data()[column];
    const std::int32_t* const last = rows.data() + begins.data()[column + 1];
    const std::int32_t* const found = std::lower_bound(first, last, static_cast<std::int32_t>(row));
    return found != last && *found == row ? values.data()[found - rows.data()] : 0.0;
  }
};

LowerTriangle lower_triangle_of_sparse(const py::object& returned, Index n) {
  const py::tuple shape = returned.attr("shape");
  if (shape.size() != 2 || shape[0].cast<Index>() != n || shape[1].cast<Index>() != n)
    throw py::value_error("jacobian(x, lam) returned shape " + std::string(py::str(static_cast<py::handle>(shape))) +
                          "; " + square_text(n) + " is wanted");
  py::object matrix = returned.attr("tocsc")();
  if (!matrix.attr("has_canonical_format").cast<bool>()) {
    matrix = matrix.attr("copy")();
    matrix.attr("sum_duplicates")();
  }
  const ScipyColumns J(matrix, n);
  double greatest = 0.0;
  for (Index k = 0; k < J.begins.at(n); ++k) greatest = std::max(greatest, std::abs(J.values.data()[k]));
  LowerTriangle lower;
  for (Index j = 0; j < n; ++j) {
    for (Index k = J.begins.data()[j]; k < J.begins.data()[j + 1]; ++k) {
      const Index i = J.rows.data()[k];
      const double value = J.values.data()[k];
      if (i != j && std::abs(value - J.at(j, i)) > symmetric_within * greatest)
        fail_on_asymmetry(i, j, value, J.at(j, i));
      if (i >= j) lower.add(i, value);
    }
    lower.end_column();
  }
  return lower;
}

// Writes the values into a matrix of that pattern or a greater one; false if it has not all of these entries.
bool written(const LowerTriangle& lower, SparseMatrix& K) {
  K.coeffs().setZero();
  for (Index j = 0; j < K.cols(); ++j) {
    SparseIndex at = K.outerIndexPtr()[j];
    const SparseIndex end = K.outerIndexPtr()[j + 1];
    for (std::size_t k = lower.begins[static_cast<std::size_t>(j)]; k < lower.begins[static_cast<std::size_t>(j) + 1];
         ++k) {
      while (at < end && K.innerIndexPtr()[at] < lower.rows[k]) ++at;
      if (at == end || K.innerIndexPtr()[at] != lower.rows[k]) return false;
      K.valuePtr()[at] = lower.values[k];
    }
  }
  return true;
}

// All entries that either has, and the diagonal. A pattern only grows, so that one of as many entries is the same.
SparseMatrix united_pattern(const LowerTriangle& lower, const SparseMatrix& K, Index n) {
  std::vector<Eigen::Triplet<double, SparseIndex>> entries;
  for (Index j = 0; j < n; ++j) {
    const auto column = static_cast<SparseIndex>(j);
    entries.emplace_back(column, column, 0.0);
    for (std::size_t k = lower.begins[static_cast<std::size_t>(j)]; k < lower.begins[static_cast<std::size_t>(j) + 1];
         ++k)
      entries.emplace_back(lower.rows[k], column, 0.0);
  }
  if (K.cols() == n)
    for (Index j = 0; j < n; ++j)
      for (SparseMatrix::InnerIterator entry(K, j); entry; ++entry)
        entries.emplace_back(static_cast<SparseIndex>(entry.row()), static_cast<SparseIndex>(j), 0.0);
  SparseMatrix pattern(n, n);
  pattern.setFromTriplets(entries.begin(), entries.end());
  return pattern;
}

}  // namespace

Vector vector_from(const py::object& returned, Index size, const std::string& what) {
  const py::array array = real_array(returned, what);
  if (array.ndim() != 1 || array.shape(0) != size)
    throw py::value_error(what + " returned shape " + shape_text(array) + "; (" + std::to_string(size) +
                          ",) is wanted");
  const py::array_t<double, py::array::c_style | py::array::forcecast> values(array);
  return Eigen::Map<const Vector>(values.data(), size);
}

double number_from(const py::object& returned, const std::string& what) {
  const py::array array = real_array(returned, what);
  if (array.size() != 1)
    throw py::value_error(what + " returned shape " + shape_text(array) + "; one number is wanted");
  return array.attr("item")().cast<double>();
}

py::object called(const py::object& function, const std::string& what, const State& state) {
  const py::array_t<double> x = to_frozen_array(state.x);
  try {
    return function(x, state.lambda);
  } catch (py::error_already_set& error) {
    const py::object value = error.value();
    const std::string note = "raised by " + what + " at lam = " + round_trip(state.lambda);
    if (PyObject_SetAttrString(value.ptr(), "arcwall_state", py::make_tuple(x, state.lambda).ptr()) != 0) PyErr_Clear();
    if (py::hasattr(value, "add_note")) value.attr("add_note")(note);
    throw;
  }
}

PythonSystem::PythonSystem(const py::object& system, Vector weights)
    : energy_(py::none()), weights_(std::move(weights)) {
  const auto method = [&](const char* name) {
    const py::object found = py::getattr(system, name, py::none());
    if (!PyCallable_Check(found.ptr()))
      throw py::type_error("a system has the methods residual(x, lam), jacobian(x, lam) and dlam(x, lam); " +
                           type_of(system) + " has no " + name);
    return found;
  };
  residual_ = method("residual");
  jacobian_ = method("jacobian");
  dlam_ = method("dlam");
  if (py::hasattr(system, "energy")) energy_ = method("energy");
}

void PythonSystem::residual(const State& state, Eigen::Ref<Vector> F) const {
  F = vector_from(called(residual_, "residual(x, lam)", state), weights_.size(), "residual(x, lam)");
}

void PythonSystem::linearize(const State& state, Linearization& out) const {
  const Index n = weights_.size();
  out.F = vector_from(called(residual_, "residual(x, lam)", state), n, "residual(x, lam)");
  out.F_lambda = vector_from(called(dlam_, "dlam(x, lam)", state), n, "dlam(x, lam)");
  const py::object J = called(jacobian_, "jacobian(x, lam)", state);
  const LowerTriangle lower = py::hasattr(J, "tocsc") ? lower_triangle_of_sparse(J, n) : lower_triangle_of_dense(J, n);
  const bool laid_out = out.pattern_of.has_value() && out.K.cols() == n;
  if (laid_out && written(lower, out.K)) return;
  out.K = united_pattern(lower, laid_out ? out.K : SparseMatrix(), n);
  written(lower, out.K);
  out.pattern_of = state.piece;
}

double PythonSystem::energy(const State& state) const {
  if (energy_.is_none()) return std::numeric_limits<double>::quiet_NaN();
  return number_from(called(energy_, "energy(x, lam)", state), "energy(x, lam)");
}

}  // namespace arcwall::python
