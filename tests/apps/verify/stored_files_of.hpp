#pragma once

#include <algorithm>
#include <string>

#include "apps/output/contacts_csv.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/path_csv.hpp"
#include "apps/verify/verify.hpp"

namespace arcwall::verify {

/// The files that a run would write.
inline StoredFiles stored_files_of(const Record& record) {
  return {.path_csv = path_csv(record, UnitLabels::shown),
          .contacts_csv = record.has_walls ? contacts_csv(record, UnitLabels::shown) : "",
          .events_json = to_text(events_json(record), JsonLayout::lines)};
}

/// Whether a verdict has looked at something.
inline bool has_check(const Verdict& verdict, const std::string& name) {
  const auto& checks = verdict.findings.checks();
  return std::any_of(checks.begin(), checks.end(), [&](const CheckSummary& check) { return check.name == name; });
}

}  // namespace arcwall::verify
