#include "apps/output/sensitivity_rows.hpp"

#include <algorithm>
#include <cstddef>

#include "apps/output/events_text.hpp"
#include "apps/output/shown_number.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

// The monitors that have a rate at an event.
std::vector<std::size_t> with_rates(const Record& record) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < record.columns.size(); ++i) {
    const auto is_known = [&](const RecordSensitivity& one) { return i < one.rates.size() && one.rates[i]; };
    const auto has_it = [&](const RecordEvent& event) {
      return std::any_of(event.sensitivity.begin(), event.sensitivity.end(), is_known);
    };
    if (std::any_of(record.events.begin(), record.events.end(), has_it)) list.push_back(i);
  }
  return list;
}

}  // namespace

std::vector<TableColumn> sensitivity_columns(const Record& record) {
  const auto figure = [](const std::string& title) { return TableColumn{title, TableColumn::Side::right}; };
  std::vector<TableColumn> columns{figure("id"), figure("λ"),     {"kind"},         {"number"},
                                   figure("is"), figure("dλ/dn"), figure("% per %")};
  for (const std::size_t i : with_rates(record)) columns.push_back(figure("d(" + record.columns[i].name + ")/dn"));
  columns.push_back({"why none"});
  return columns;
}

std::vector<std::vector<std::string>> sensitivity_rows(const Record& record) {
  std::vector<std::vector<std::string>> rows;
  const std::vector<std::size_t> monitors = with_rates(record);
  for (const RecordEvent& event : record.events)
    for (const RecordSensitivity& one : event.sensitivity) {
      rows.push_back({std::to_string(event.id), shown_lambda(event, 8), std::string(to_text(event.kind)), one.key,
                      shown_number(one.value, 8), one.slope ? shown_number(*one.slope, 8) : "none",
                      per_cent(event, one)});
      for (const std::size_t i : monitors)
        rows.back().push_back(i < one.rates.size() && one.rates[i] ? shown_number(*one.rates[i], 6) : "");
      rows.back().push_back(one.why_none);
    }
  return rows;
}

std::string per_cent(const RecordEvent& event, const RecordSensitivity& sensitivity) {
  const bool is_singular = event.kind == EventKind::limit_point || event.kind == EventKind::branch_point ||
                           event.kind == EventKind::contact_limit_point;
  if (!is_singular || !sensitivity.slope || event.lambda == 0.0) return "";
  return shown_number(*sensitivity.slope * sensitivity.value / event.lambda, 5);
}

}  // namespace arcwall
