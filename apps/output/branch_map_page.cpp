#include "apps/output/branch_map_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/markup.hpp"
#include "apps/output/report_data.hpp"
#include "apps/output/shown_number.hpp"
#include "model/version.hpp"

namespace arcwall {

using OrderedJson = nlohmann::ordered_json;

namespace {

// --- branches.json
// -----------------------------------------------------------------------------------------------------

OrderedJson finite(double value) { return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr); }

template <class Value>
OrderedJson or_null(const std::optional<Value>& value) {
  return value ? OrderedJson(*value) : OrderedJson(nullptr);
}

OrderedJson segment_json(const Record& record, const BranchMapSegment& segment, std::size_t id) {
  const RecordPoint &first = record.points[segment.first], &last = record.points[segment.last];
  return {{"id", id},
          {"branch", segment.branch},
          {"steps", {first.step, last.step}},
          {"contact_pattern", segment.contact_pattern},
          {"lambda", {finite(first.lambda), finite(last.lambda)}},
          {"energy", {finite(first.energy), finite(last.energy)}},
          {"unstable", or_null(segment.unstable)},
          {"images", segment.images}};
}

// --- the picture ----------------------------------------------------------------------------------------------------

constexpr double width = 900.0, left = 70.0, right = 200.0, top = 10.0, lane = 18.0, bottom = 40.0;

struct Axis {
  double low, high;
  double x(double lambda) const { return left + (lambda - low) / (high - low) * (width - left - right); }
};

std::string count_text(const std::optional<Index>& unstable) { return unstable ? std::to_string(*unstable) : "?"; }

std::string name_of(const BranchMapSegment& segment, std::size_t id) {
  return fmt::format("{}: {}", id, segment.contact_pattern.empty() ? "no contact" : plain(segment.contact_pattern, 40));
}

double lane_of(std::size_t segment) { return top + lane * (double(segment) + 0.5); }

// Dashed where the state is unstable, as along the curves.
std::string segment_svg(const Record& record, const Axis& axis, const BranchMapSegment& segment, std::size_t id) {
  const RecordPoint &a = record.points[segment.first], &b = record.points[segment.last];
  const double y = lane_of(id), end = std::max(axis.x(a.lambda), axis.x(b.lambda));
  std::string label = fmt::format("{}, λ from {} to {}, unstable {}", name_of(segment, id), shown_number(a.lambda, 8),
                                  shown_number(b.lambda, 8), count_text(segment.unstable));
  return fmt::format(
             "<g><title>{}</title><line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
             "stroke-width=\"4\"{}/>",
             escaped(label), axis.x(a.lambda), y, axis.x(b.lambda), y, branch_colour(segment.branch),
             segment.unstable == Index{0} ? "" : " stroke-dasharray=\"5 4\"") +
         fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{} ({})</text></g>\n", end + 8.0, y + 4.0,
                     escaped(name_of(segment, id)), count_text(segment.unstable));
}

std::string edge_svg(const Axis& axis, const BranchMapEdge& edge) {
  if (!edge.to || *edge.to == edge.from) return "";
  const double x = axis.x(edge.lambda);
  return fmt::format(
      "<g><title>{}, λ = {}, from {} to {}</title><line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
      "stroke=\"#888\"{}/></g>\n",
      edge.kind, shown_number(edge.lambda, 8), edge.from, *edge.to, x, lane_of(edge.from), x, lane_of(*edge.to),
      edge.kind == "jump" ? " stroke-width=\"2\" stroke-dasharray=\"2 3\"" : "");
}

std::string axis_svg(const Axis& axis, double y) {
  constexpr int parts = 4;
  std::string svg = fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#888\"/>\n",
                                left, y, width - right, y);
  for (int i = 0; i <= parts; ++i) {
    const double lambda = axis.low + (axis.high - axis.low) * i / parts;
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", axis.x(lambda), y + 18.0,
                       shown_number(lambda, 4));
  }
  return svg + fmt::format("<text class=\"axis\" x=\"{:.1f}\" y=\"{:.1f}\">λ</text>\n", width - right + 14.0, y + 18.0);
}

std::string picture(const Record& record, const BranchMap& map) {
  Axis axis{.low = infinity, .high = -infinity};
  for (const BranchMapSegment& segment : map.segments)
    for (const std::size_t end : {segment.first, segment.last}) {
      axis.low = std::min(axis.low, record.points[end].lambda);
      axis.high = std::max(axis.high, record.points[end].lambda);
    }
  if (!(axis.low < axis.high)) return "";
  const double y = lane_of(map.segments.size());
  std::string svg = fmt::format(
      "<svg id=\"branch-map\" class=\"chart\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"States over λ "
      "and the events between them\">\n",
      width, y + bottom);
  for (const BranchMapEdge& edge : map.edges) svg += edge_svg(axis, edge);
  for (std::size_t i = 0; i < map.segments.size(); ++i) svg += segment_svg(record, axis, map.segments[i], i);
  return svg + axis_svg(axis, y) + "</svg>\n";
}

// Where which states are stable, neighbouring ranges with the same ones together.
std::string stable_rows(const BranchMap& map) {
  std::vector<BranchMapRange> ranges;
  for (const BranchMapRange& range : map.ranges) {
    const bool goes_on = !ranges.empty() && ranges.back().high == range.low && ranges.back().stable == range.stable &&
                         ranges.back().least == range.least;
    if (goes_on)
      ranges.back().high = range.high;
    else
      ranges.push_back(range);
  }
  const auto name = [&](std::size_t segment) { return escaped(name_of(map.segments[segment], segment)); };
  std::string rows;
  for (const BranchMapRange& range : ranges) {
    std::string stable;
    for (const std::size_t segment : range.stable) stable += (stable.empty() ? "" : ", ") + name(segment);
    rows += fmt::format("<tr><td class=\"figure\">{}</td><td class=\"figure\">{}</td><td>{}</td><td>{}</td></tr>\n",
                        shown_number(range.low, 8), shown_number(range.high, 8), stable.empty() ? "none" : stable,
                        range.least ? name(*range.least) : "");
  }
  return rows;
}

}  // namespace

OrderedJson branch_map_json(const Record& record, const BranchMap& map) {
  OrderedJson segments = OrderedJson::array(), edges = OrderedJson::array(), ranges = OrderedJson::array();
  for (std::size_t i = 0; i < map.segments.size(); ++i) segments.push_back(segment_json(record, map.segments[i], i));
  for (const BranchMapEdge& edge : map.edges)
    edges.push_back({{"kind", edge.kind},
                     {"lambda", finite(edge.lambda)},
                     {"events", edge.events},
                     {"from", edge.from},
                     {"to", or_null(edge.to)}});
  for (const BranchMapRange& range : map.ranges)
    ranges.push_back({{"lambda", {finite(range.low), finite(range.high)}},
                      {"states", range.states},
                      {"stable", range.stable},
                      {"least", or_null(range.least)}});
  return {{"deck", record.deck},
          {"version", program_version()},
          {"segments", std::move(segments)},
          {"edges", std::move(edges)},
          {"ranges", std::move(ranges)}};
}

std::string branch_map_section(const Record& record, const BranchMap& map) {
  if (map.segments.empty()) return "";
  return "<section aria-labelledby=\"branch-map-title\"><h2 id=\"branch-map-title\">Branch map</h2>\n<div "
         "class=\"scroll\" tabindex=\"0\">" +
         picture(record, map) +
         "</div>\n<p class=\"note\">Horizontal lines are segments of branches, with their contact pattern. Vertical "
         "lines "
         "are events between segments. Dotted lines are jumps. Dashed segments are unstable; brackets give the number "
         "of unstable directions.</p>\n<div class=\"scroll\" tabindex=\"0\"><table id=\"stable\"><thead><tr><th "
         "class=\"figure\">from "
         "λ</th><th "
         "class=\"figure\">to</th><th>stable</th><th>minimum energy</th></tr></thead><tbody>\n" +
         stable_rows(map) + "</tbody></table></div></section>";
}

}  // namespace arcwall
