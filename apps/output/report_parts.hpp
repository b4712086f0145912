#pragma once

#include <string_view>

namespace arcwall {

/// What the program carries of report.html and of the page of `explore`; apps/report/ has the sources.
struct ReportParts {
  std::string_view page{};     ///< with `{{name}}` where something is to be filled in
  std::string_view style{};    ///< CSS
  std::string_view script{};   ///< JavaScript: show_report()
  std::string_view library{};  ///< plotly with its licence; empty if the program was built without

  std::string_view sheet{}, picture{};  ///< as `page`, of a printed sheet and of the curve alone
  std::string_view sheet_style{};       ///< theirs, on top of `style`

  std::string_view sweep{};         ///< as `page`, of a sweep
  std::string_view sweep_script{};  ///< JavaScript: show_sweep()
  std::string_view map_library{};   ///< as `library`, with heat maps and contour lines

  std::string_view explorer_page{}, explorer_style{}, explorer_script{};
};

const ReportParts& report_parts();

}  // namespace arcwall
