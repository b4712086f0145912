#pragma once

#include <string>

#include "apps/output/report_content.hpp"

/// What stands at the top of a report, of a sheet and of a picture, as elements of HTML.
namespace arcwall {

/// `limit point`.
std::string words(EventKind kind);

/// `1 event`, `2 events`.
std::string counted(std::size_t count, const std::string& one, const std::string& several);

/// The deck's title, or its name without one. Not escaped.
std::string report_title(const Record& record);

/// `channel.toml, trace-path 0.1.0`, escaped.
std::string report_source(const Record& record);

/// What the run answers, as a list; empty if nothing.
std::string list_of_answers(const Record& record, const ReportContent& content);

/// What the reader has to know first: which branches did not end where the deck says, why, and what can be done.
std::string early_ends(const Record& record, const std::string& warning);

}  // namespace arcwall
