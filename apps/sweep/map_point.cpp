#include "apps/sweep/map_point.hpp"

#include <fmt/format.h>

#include "apps/output/markup.hpp"
#include "apps/sweep/case_list.hpp"
#include "apps/sweep/map_axis.hpp"

namespace arcwall::sweep {

namespace {

// `case 7`, or `12 cases near`.
std::string which(const MapPoint& point) {
  return point.cases > 1 ? fmt::format("{} cases near", point.cases) : fmt::format("case {}", point.number);
}

// `k [cm]` and 2: `k = 2 cm`.
std::string value_text(const std::string& title, const std::string& value) {
  const std::size_t bracket = title.rfind(" [");
  if (bracket == std::string::npos || title.back() != ']') return title + " = " + value;
  return fmt::format("{} = {} {}", title.substr(0, bracket), value,
                     title.substr(bracket + 2, title.size() - bracket - 3));
}

}  // namespace

std::string load_axis(const MapTitles& titles) {
  return titles.load + (titles.unit.empty() ? "" : ", times " + titles.unit);
}

std::string tip(const MapTitles& titles, const MapPoint& point, std::optional<double> reference) {
  const auto text_of = [&](const Json& value) {
    return point.cases > 1 && value.is_number() ? short_number(value.get<double>()) : label(value);
  };
  std::string content = which(point) + "\n" + value_text(titles.x, text_of(point.x));
  if (!titles.y.empty()) content += "\n" + value_text(titles.y, text_of(point.y));
  if (!point.note.empty()) content += "\n" + point.note;
  if (!point.load) content += "\nno such event";
  if (point.load)
    content += fmt::format("\n{}{} is {}{}", point.cases > 1 ? "the mean " : "", titles.load, short_number(*point.load),
                           titles.unit.empty() ? "" : ", times " + titles.unit);
  if (point.load && reference && *reference != 0.0)
    content += fmt::format("\n{} times λ₀", short_number(*point.load / *reference));
  if (point.failed) content += "\nfailed";
  if (!point.link.empty()) content += "\na click opens its report";
  return "<title>" + escaped(plain(content)) + "</title>";
}

std::string pointed_at(const std::string& tip, const std::string& link, const std::string& mark) {
  const std::string group = "<g>" + tip + mark + "</g>";
  return (link.empty() ? group : "<a href=\"" + escaped(link) + "\">" + group + "</a>") + "\n";
}

}  // namespace arcwall::sweep
