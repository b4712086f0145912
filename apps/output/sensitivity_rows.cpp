#include "apps/output/sensitivity_rows.hpp"

#include "apps/output/events_text.hpp"
#include "apps/output/shown_number.hpp"
#include "model/event_names.hpp"

namespace arcwall {

std::vector<TableColumn> sensitivity_columns() {
  const auto figure = [](const char* title) { return TableColumn{title, TableColumn::Side::right}; };
  return {figure("id"), figure("λ"),     {"kind"},          {"number"},
          figure("is"), figure("dλ/dn"), figure("% per %"), {"why none"}};
}

std::vector<std::vector<std::string>> sensitivity_rows(const Record& record) {
  std::vector<std::vector<std::string>> rows;
  for (const RecordEvent& event : record.events)
    for (const RecordSensitivity& one : event.sensitivity)
      rows.push_back({std::to_string(event.id), shown_lambda(event, 8), std::string(to_text(event.kind)), one.key,
                      shown_number(one.value, 8), one.slope ? shown_number(*one.slope, 8) : "none",
                      per_cent(event, one), one.why_none});
  return rows;
}

std::string per_cent(const RecordEvent& event, const RecordSensitivity& sensitivity) {
  const bool is_singular = event.kind == EventKind::limit_point || event.kind == EventKind::branch_point ||
                           event.kind == EventKind::contact_limit_point;
  if (!is_singular || !sensitivity.slope || event.lambda == 0.0) return "";
  return shown_number(*sensitivity.slope * sensitivity.value / event.lambda, 5);
}

}  // namespace arcwall
