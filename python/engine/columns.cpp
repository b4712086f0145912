#include "python/engine/columns.hpp"

#include <cmath>
#include <limits>

#include "apps/output/path_lines.hpp"
#include "model/dissipation.hpp"

namespace arcwall::python {

namespace {

template <typename Number, typename Of>
py::array_t<Number> numbers(const Record& record, const Of& of) {
  py::array_t<Number> array(static_cast<py::ssize_t>(record.points.size()));
  Number* to = array.mutable_data();
  for (const RecordPoint& point : record.points) *to++ = of(point);
  return array;
}

template <typename Of>
py::list words(const Record& record, const Of& of) {
  py::list list;
  for (const RecordPoint& point : record.points) list.append(of(point));
  return list;
}

double or_nan(const std::optional<Index>& count) {
  return count ? static_cast<double>(*count) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

py::object column(const Record& record, const std::string& name) {
  using Integer = std::int64_t;
  using P = const RecordPoint&;
  if (name == "branch") return numbers<Integer>(record, [](P at) { return at.branch; });
  if (name == "step") return numbers<Integer>(record, [](P at) { return at.step; });
  if (name == "arc") return numbers<double>(record, [](P at) { return at.arc; });
  if (name == "lambda") return numbers<double>(record, [](P at) { return at.lambda; });
  if (name == "unstable") return numbers<double>(record, [](P at) { return or_nan(at.count.unstable); });
  if (name == "contacts") return numbers<Integer>(record, [](P at) { return at.contacts; });
  if (name == "slipping") return numbers<Integer>(record, [](P at) { return slipping_contacts(at); });
  if (name == "dissipation") return numbers<double>(record, [](P at) { return total_dissipation(at); });
  if (name == "energy") return numbers<double>(record, [](P at) { return at.energy; });
  if (name == "iterations") return numbers<Integer>(record, [](P at) { return at.iterations; });
  if (name == "residual") return numbers<double>(record, [](P at) { return at.residual; });
  if (name == "unstable_load_control")
    return numbers<double>(record, [](P at) { return or_nan(at.unstable_load_control); });
  if (name == "stability") return words(record, [](P at) { return py::str(std::string(to_text(at.count.stability))); });
  if (name == "stage") return words(record, [&](P at) { return py::str(record.stage_of(at.branch)); });
  if (name == "event")
    return words(record, [](P at) -> py::object {
      if (!at.event) return py::none();
      return py::str(std::string(to_text(*at.event)));
    });
  throw py::key_error(name);
}

py::array_t<double> monitor_column(const Record& record, std::size_t monitor) {
  if (monitor >= record.columns.size()) throw py::index_error("there is no such monitor");
  return numbers<double>(record, [monitor](const RecordPoint& at) { return at.monitors[monitor]; });
}

py::list lines(const Record& record) {
  py::list list;
  for (const PathLine& line : path_lines(record))
    list.append(py::make_tuple(line.branch, std::string(to_text(line.stability)), line.first, line.last));
  return list;
}

std::vector<std::string> column_names(const Record& record) {
  std::vector<std::string> names{"branch", "step", "arc", "lambda", "unstable", "stability", "contacts"};
  if (record.has_friction) names.emplace_back("slipping");
  names.emplace_back("energy");
  if (record.has_friction) names.emplace_back("dissipation");
  names.insert(names.end(), {"iterations", "event"});
  if (record.moves_supports) names.emplace_back("unstable_load_control");
  if (!record.stages.empty()) names.emplace_back("stage");
  return names;
}

}  // namespace arcwall::python
