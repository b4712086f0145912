#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/types.hpp"

/// What the parts of the module arcwall._engine share. The package in python/arcwall makes classes of what they give:
/// here are plain values, and nothing is kept between calls but in objects of Python.
namespace arcwall::python {

namespace py = pybind11;

/// null, booleans, numbers, texts, lists and dicts.
py::object to_python(const nlohmann::ordered_json& json);

/// A copy that belongs to Python.
inline py::array_t<double> to_array(const Vector& values) { return py::array_t<double>(values.size(), values.data()); }
inline py::array_t<double> to_array(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// The same, which cannot be changed.
inline py::array_t<double> to_frozen_array(const Vector& values) {
  py::array_t<double> array = to_array(values);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Diagnostics as objects of arcwall.errors.
py::list to_python(const std::vector<Diagnostic>& diagnostics);

/// Raises what waits in Python, such as an interrupt by Ctrl-C. The interpreter's lock is held.
inline void raise_what_waits() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// An exception of a class of arcwall.errors, with one text.
[[noreturn]] void raise(const char* name, const std::string& text);

void bind_answers(py::module_& module);
void bind_decks(py::module_& module);
void bind_exploring(py::module_& module);
void bind_runs(py::module_& module);
void bind_systems(py::module_& module);

}  // namespace arcwall::python
