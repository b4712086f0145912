#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "model/record.hpp"

namespace arcwall {

/// events.json. Numbers that are not finite and counts that are unknown are null.
nlohmann::ordered_json events_json(const Record& record);

/// One event as it stands in events.json.
nlohmann::ordered_json event_json(const Record& record, const RecordEvent& event);

/// One row of path.csv as an object with the columns' names.
nlohmann::ordered_json point_json(const Record& record, const RecordPoint& point);

/// `{"reason", "detail"}`.
nlohmann::ordered_json end_json(const BranchEnd& end);

/// The document as text in lines, or on one line; bytes that are not UTF-8 (in the name of a file) are replaced.
enum class JsonLayout { lines, one_line };
std::string to_text(const nlohmann::ordered_json& json, JsonLayout layout);

}  // namespace arcwall
