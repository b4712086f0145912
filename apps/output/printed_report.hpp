#pragma once

#include <string>

#include "apps/output/report_content.hpp"

/// A run as it is printed, without scripts.
namespace arcwall {

/// One sheet A4: answers, curve, shapes, key numbers and tables.
std::string sheet_html(const Record& record, const ReportContent& content);

/// The curve with its title, for a picture.
std::string picture_html(const Record& record, const ReportContent& content);

}  // namespace arcwall
