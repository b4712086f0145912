#pragma once

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

}  // namespace arcwall::verify
