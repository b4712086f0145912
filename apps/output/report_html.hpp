#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/output/filled_page.hpp"
#include "apps/output/report_content.hpp"
#include "apps/output/report_parts.hpp"

namespace arcwall {

/// report.html: one page that needs no other file and no network.
class ReportPage {
 public:
  /// `carried`: what stands in the page beside its own text; without scripts it is the contents of another page.
  ReportPage(const Record& record, const ReportContent& content, const ReportParts& carried = report_parts());
  ReportPage(const ReportPage&) = delete;
  ReportPage& operator=(const ReportPage&) = delete;

  /// A megabyte of it is what every page has. They live as long as this.
  const Pieces& pieces() const { return pieces_; }

  std::string text() const;

 private:
  PageFields fields_;
  Pieces pieces_;
};

/// The report's curve alone, with its legend, as an element that can stand in any page: λ, which multiplies these
/// loads, over a monitor, or over the arc length.
std::string curve_html(const Record& record, const std::vector<LoadText>& loads, std::optional<std::size_t> monitor);

}  // namespace arcwall
