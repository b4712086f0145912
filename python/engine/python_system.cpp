#include "python/engine/python_system.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/text.hpp"

namespace arcwall::python {

namespace {

std::string text_of(double number) { return std::isnan(number) ? "nan" : number > 0.0 ? "inf" : "-inf"; }

// The lower triangle of a symmetric matrix by columns, rows ascending.
struct LowerTriangle {
  std::vector<std::size_t> begins{0};  // of the columns, and the end
  std::vector<SparseIndex> rows{};
  std::vector<double> values{};
  std::optional<std::string> not_finite{};  // the first such entry of either triangle, in words

  void add(Index row, double value) {
    rows.push_back(static_cast<SparseIndex>(row));
    values.push_back(value);
  }
  void end_column() { begins.push_back(rows.size()); }
  // A hole above the diagonal is one below, where it is seen.
  void end() {
    if (not_finite && !values.empty()) values.front() = std::numeric_limits<double>::quiet_NaN();
  }
  void look_at(Index row, Index column, double value) {
    if (not_finite || std::isfinite(value)) return;
    not_finite = text_of(value) + " in entry (" + std::to_string(row) + ", " + std::to_string(column) + ")";
  }
};

std::string type_of(const py::object& object) { return py::str(py::type::of(object).attr("__name__")); }

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

[[noreturn]] void fail(PyObject* type, const std::string& text) {
  PyErr_SetString(type, text.c_str());
  throw py::error_already_set();
}

// Without what numpy would drop on the way to real numbers.
py::array real_array(const py::object& returned, const std::string& what) {
  const py::array array = py::array::ensure(returned);
  if (!array) {
    PyErr_Clear();
    fail(PyExc_TypeError, what + " returned a " + type_of(returned) + ", which is no array of numbers");
  }
  if (const char kind = array.dtype().kind(); std::string("fiub").find(kind) == std::string::npos)
    fail(PyExc_TypeError,
         what + " returned an array of " + std::string(py::str(array.dtype())) + "; real numbers are wanted");
  return array;
}

std::string square_text(Index n) { return "(" + std::to_string(n) + ", " + std::to_string(n) + ")"; }

[[noreturn]] void fail_on_asymmetry(Index i, Index j, double lower, double upper) {
  fail(PyExc_ValueError, "jacobian(x, lam) is not symmetric: entry (" + std::to_string(i) + ", " + std::to_string(j) +
                             ") is " + round_trip(lower) + ", its mirror image " + round_trip(upper) +
                             "; equations that are no derivatives of an energy cannot be traced");
}

// Mirror images may differ by what difference quotients do.
constexpr double symmetric_within = 1e-6;  // of the greatest entry

LowerTriangle lower_triangle_of_dense(const py::object& returned, Index n) {
  using Dense = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const py::array array = real_array(returned, "jacobian(x, lam)");
  if (array.ndim() != 2 || array.shape(0) != n || array.shape(1) != n)
    fail(PyExc_ValueError,
         "jacobian(x, lam) returned shape " + shape_text(array) + "; " + square_text(n) + " is wanted");
  const Dense dense(array);
  const Eigen::Map<const LongRows> J(dense.data(), n, n);
  const double tolerance = symmetric_within * J.cwiseAbs().maxCoeff<Eigen::PropagateNumbers>();
  LowerTriangle lower;
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i) {
      lower.look_at(i, j, J(i, j));
      lower.look_at(j, i, J(j, i));
      if (std::abs(J(i, j) - J(j, i)) > tolerance) fail_on_asymmetry(i, j, J(i, j), J(j, i));
      lower.add(i, J(i, j));
    }
    lower.end_column();
  }
  lower.end();
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
      fail(PyExc_ValueError, "jacobian(x, lam) returned a sparse matrix whose parts do not fit together");
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
    fail(PyExc_ValueError, "jacobian(x, lam) returned shape " + std::string(py::str(static_cast<py::handle>(shape))) +
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
      lower.look_at(i, j, value);
      if (i != j && std::abs(value - J.at(j, i)) > symmetric_within * greatest)
        fail_on_asymmetry(i, j, value, J.at(j, i));
      if (i >= j) lower.add(i, value);
    }
    lower.end_column();
  }
  lower.end();
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

// The first entry that is not finite, in words.
std::optional<std::string> place_not_finite(const Vector& values) {
  for (Index i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) return text_of(values[i]) + " in entry " + std::to_string(i);
  return std::nullopt;
}

}  // namespace

Vector vector_from(const py::object& returned, Index size, const std::string& what) {
  const py::array array = real_array(returned, what);
  if (array.ndim() != 1 || array.shape(0) != size)
    fail(PyExc_ValueError,
         what + " returned shape " + shape_text(array) + "; (" + std::to_string(size) + ",) is wanted");
  const py::array_t<double, py::array::c_style | py::array::forcecast> values(array);
  return Eigen::Map<const Vector>(values.data(), size);
}

double number_from(const py::object& returned, const std::string& what) {
  const py::array array = real_array(returned, what);
  if (array.size() != 1)
    fail(PyExc_ValueError, what + " returned shape " + shape_text(array) + "; one number is wanted");
  return array.attr("item")().cast<double>();
}

void add_state(const py::error_already_set& error, const py::object& x, double lambda, const std::string& what) {
  const py::object value = error.value();
  if (PyObject_SetAttrString(value.ptr(), "arcwall_state", py::make_tuple(x, lambda).ptr()) != 0) PyErr_Clear();
  if (py::hasattr(value, "add_note")) value.attr("add_note")("raised by " + what + " at lam = " + round_trip(lambda));
}

void raise(const char* name, const std::string& before, const NotFinite& of) {
  const py::object error =
      py::module_::import("arcwall.errors").attr(name)(before + of.what + " at lam = " + round_trip(of.state.lambda));
  error.attr("arcwall_state") = py::make_tuple(to_frozen_array(of.state.x), of.state.lambda);
  PyErr_SetObject(py::type::of(error).ptr(), error.ptr());
  throw py::error_already_set();
}

PythonSystem::PythonSystem(const py::object& system, Vector weights)
    : energy_(py::none()), weights_(std::move(weights)) {
  const auto method = [&](const char* name) {
    const py::object found = py::getattr(system, name, py::none());
    if (!PyCallable_Check(found.ptr()))
      fail(PyExc_TypeError, "a system has the methods residual(x, lam), jacobian(x, lam) and dlam(x, lam); " +
                                type_of(system) + " has no " + name);
    return found;
  };
  residual_ = method("residual");
  jacobian_ = method("jacobian");
  dlam_ = method("dlam");
  if (py::hasattr(system, "energy")) energy_ = method("energy");
}

// The first function of a state tells. What is asked at states that are no numbers themselves says nothing.
void PythonSystem::note(const std::string& what, const std::optional<std::string>& where, const State& state) const {
  const bool told = not_finite_ && not_finite_->state == state;
  if (where && !told && state.x.allFinite()) not_finite_ = {.what = what + " returned " + *where, .state = state};
}

Vector PythonSystem::residual_at(const State& state) const {
  const std::string what = "residual(x, lam)";
  Vector F =
      asked(residual_, what, state, [&](const py::object& of) { return vector_from(of, weights_.size(), what); });
  note(what, place_not_finite(F), state);
  return F;
}

void PythonSystem::residual(const State& state, Eigen::Ref<Vector> F) const { F = residual_at(state); }

void PythonSystem::linearize(const State& state, Linearization& out) const {
  const Index n = weights_.size();
  const std::string dlam = "dlam(x, lam)", jacobian = "jacobian(x, lam)";
  out.F = residual_at(state);
  out.F_lambda = asked(dlam_, dlam, state, [&](const py::object& of) { return vector_from(of, n, dlam); });
  note(dlam, place_not_finite(out.F_lambda), state);
  const LowerTriangle lower = asked(jacobian_, jacobian, state, [&](const py::object& of) {
    return py::hasattr(of, "tocsc") ? lower_triangle_of_sparse(of, n) : lower_triangle_of_dense(of, n);
  });
  note(jacobian, lower.not_finite, state);
  const bool laid_out = out.pattern_of.has_value() && out.K.cols() == n;
  if (laid_out && written(lower, out.K)) return;
  out.K = united_pattern(lower, laid_out ? out.K : SparseMatrix(), n);
  written(lower, out.K);
  out.pattern_of = state.active_set;
}

double PythonSystem::energy(const State& state) const {
  if (energy_.is_none()) return std::numeric_limits<double>::quiet_NaN();
  const std::string what = "energy(x, lam)";
  const double energy = asked(energy_, what, state, [&](const py::object& of) { return number_from(of, what); });
  if (!std::isfinite(energy)) raise("NotFinite", "", {.what = what + " returned " + text_of(energy), .state = state});
  return energy;
}

}  // namespace arcwall::python
