#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/output/report_content.hpp"
#include "apps/output/svg_chart.hpp"

/// The curve of a run as a still picture, and its legend.
namespace arcwall {

inline constexpr const char* jump_colour = "#d55e00";

/// λ over one monitor; without monitors over the arc length. Of a movement λ is the way, which is drawn across.
Chart path_chart(const Record& record, const ReportContent& content, std::optional<std::size_t> monitor);

/// The kinds of lines, and of lines and marks, as lists.
std::string legend_of_lines(const Record& record, const std::vector<Overlay>& overlays);
std::string legend(const Record& record, const std::vector<Overlay>& overlays);

}  // namespace arcwall
