#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/output/load_text.hpp"
#include "apps/output/record.hpp"
#include "apps/output/shape_pictures.hpp"
#include "apps/study.hpp"

namespace arcwall {

/// What stands on the page beside the record.
struct ReportContent {
  std::string description{};                                 ///< the deck's
  std::vector<LoadText> loads{};                             ///< those that λ multiplies
  std::string deck_text{};                                   ///< with every default written out
  std::vector<std::pair<std::string, std::string>> facts{};  ///< name and value: counts, versions
  ShapePictures shapes{};
};

ReportContent report_content(const Study& study, const Record& record);

/// report.html: one page that needs no other file and no network.
std::string report_html(const Record& record, const ReportContent& content);

}  // namespace arcwall
