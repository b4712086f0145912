#pragma once

#include <string>

#include "apps/output/events_json.hpp"
#include "model/event_names.hpp"
#include "model/record.hpp"
#include "python/engine/python.hpp"

namespace arcwall::python {

/// A column of path.csv by its name, one value a point: numbers as an array, with nan where there is none, words as a
/// list, with None. Raises KeyError for other names.
py::object column(const Record& record, const std::string& name);

/// Monitor i, one value a point.
py::array_t<double> monitor_column(const Record& record, std::size_t monitor);

/// The names of the columns that column() knows, in the order of path.csv; the monitors stand behind the first four.
std::vector<std::string> column_names(const Record& record);

/// The lines of the report's curve: branch, stability, and the first and last of their points.
py::list lines(const Record& record);

/// What a class whose record() is a Record has in common with others: its columns, states, events and branches.
template <typename Class>
void bind_record(Class& bound) {
  using Self = typename Class::type;
  bound.def("size", [](const Self& self) { return self.record().points.size(); })
      .def("columns",
           [](const Self& self) {
             py::list list;
             for (const RecordColumn& one : self.record().columns) list.append(py::make_tuple(one.name, one.unit));
             return list;
           })
      .def("column_names", [](const Self& self) { return column_names(self.record()); })
      .def(
          "column", [](const Self& self, const std::string& name) { return column(self.record(), name); },
          py::arg("name"))
      .def(
          "monitor", [](const Self& self, std::size_t i) { return monitor_column(self.record(), i); },
          py::arg("monitor"))
      .def("lines", [](const Self& self) { return lines(self.record()); })
      .def("title", [](const Self& self) { return self.record().title; })
      .def("units",
           [](const Self& self) {
             const Record& record = self.record();
             return py::make_tuple(record.length_unit, record.force_unit, record.energy_unit);
           })
      .def("events", [](const Self& self) { return to_python(events_json(self.record())); })
      .def(
          "state",
          [](const Self& self, std::size_t point) {
            const State& state = self.record().points.at(point).state;
            const auto contacts = static_cast<std::ptrdiff_t>(state.active_set.contacts());
            std::vector<bool> closed(state.active_set.begin(), state.active_set.begin() + contacts);
            return py::make_tuple(to_frozen_array(state.x), state.lambda, closed);
          },
          py::arg("point"));
}

}  // namespace arcwall::python
