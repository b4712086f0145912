#include "apps/sweep/sweep_report.hpp"

#include <fmt/format.h>

#include "apps/output/markup.hpp"
#include "model/version.hpp"

namespace arcwall::sweep {

namespace {

// Without it the pictures of every load are shown, one below the other.
constexpr const char* script_text =
    "const choice = document.getElementById('choice');\n"
    "const loads = [...document.querySelectorAll('section.load')];\n"
    "const show = () => loads.forEach((load, i) => { load.hidden = i !== choice.selectedIndex; });\n"
    "choice.closest('p').hidden = false;\n"
    "choice.addEventListener('change', show);\n"
    "show();\n";

// SHA-256 of script_text in base64, by which the page's policy knows it; held by a test.
constexpr const char* script_hash = "xh/y96HR8Sx2lDEfrSaBuAeujPbCvd02xpSOKmyr6xY=";

// The looks of a run's report.
constexpr const char* style_text =
    ":root { color-scheme: light dark; --ink: #1c1f23; --soft: #5b6470; --line: #d9dde2; --ground: #f4f5f7; "
    "--paper: #fff; --accent: #0072b2; }\n"
    "@media (prefers-color-scheme: dark) { :root { --ink: #e6e8eb; --soft: #a3acb7; --line: #3a414a; --ground: "
    "#14171a; "
    "--paper: #1d2125; --accent: #56b4e9; } }\n"
    "* { box-sizing: border-box; }\n"
    "body { margin: 0; background: var(--ground); color: var(--ink); font: 15px/1.45 system-ui, \"Segoe UI\", Roboto, "
    "Arial, sans-serif; overflow-wrap: anywhere; }\n"
    "header, main { max-width: 1320px; margin: 0 auto; padding: 0 20px; }\n"
    "h1 { font-size: 26px; line-height: 1.2; margin: 22px 0 4px; }\n"
    "h2 { font-size: 16px; margin: 0 0 10px; }\n"
    "section { background: var(--paper); border: 1px solid var(--line); border-radius: 8px; padding: 16px 18px; "
    "margin: 16px 0; }\n"
    "section[hidden] { display: none; }\n"
    ".views { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); gap: 16px; }\n"
    "svg { width: 100%; height: auto; display: block; }\n"
    "svg text { font-size: 12px; }\n"
    "svg text:not([fill]) { fill: currentColor; }\n"
    "svg a { cursor: pointer; }\n"
    "svg a:hover rect, svg a:hover circle { stroke: var(--accent); stroke-width: 2; }\n"
    "figure { margin: 0; min-width: 0; }\n"
    ".map { grid-column: 1 / -1; max-width: 640px; }\n"
    "figcaption, .note { color: var(--soft); font-size: 13px; margin: 4px 0 8px; }\n"
    "select { font: inherit; color: inherit; background: var(--paper); border: 1px solid var(--line); border-radius: "
    "6px; padding: 5px 11px; max-width: 100%; }\n"
    "table { border-collapse: collapse; }\n"
    "th { text-align: left; color: var(--soft); font-size: 13px; }\n"
    "th, td { border-bottom: 1px solid var(--line); padding: 3px 14px 3px 0; vertical-align: top; }\n"
    "td.number { text-align: right; }\n";

std::string summary(const Collection& collection, const Overview& of_all) {
  std::string keys;
  for (const Key& key : collection.sweep().keys) keys += (keys.empty() ? "" : ", ") + key.name;
  return fmt::format("<p>{} of {} cases of {} have been run. Varied: {}.</p>\n", of_all.ran, collection.size(),
                     escaped(plain(collection.deck_file())), escaped(plain(keys)));
}

std::string failure_table(const Overview& of_all) {
  if (of_all.failures.empty())
    return "<section><p>Every case ended as its deck says, or early after its snap.</p></section>\n";
  std::string rows;
  for (const Failure& failure : of_all.failures)
    rows += fmt::format("<tr><td>{}</td><td class=\"number\">{}</td><td>{}</td></tr>\n", escaped(failure.reason),
                        failure.count, listed(failure));
  return "<section><h2>Cases that failed, by reason</h2>\n<table>\n"
         "<tr><th>reason</th><th>cases</th><th>which</th></tr>\n" +
         rows + "</table></section>\n";
}

std::string figure(const std::string& svg, const std::string& caption, const std::string& attributes = "") {
  return svg.empty()
             ? ""
             : "<figure" + attributes + ">\n<figcaption>" + escaped(caption) + "</figcaption>\n" + svg + "</figure>\n";
}

std::string load_section(const DrawnCases& drawn, std::size_t load) {
  std::string pictures, panels;
  for (std::size_t key = 0; key < drawn.keys_drawn(); ++key) {
    const LoadLines lines = drawn.lines(load, key);
    const std::string over = plain(lines.titles.x);
    pictures += figure(lines_svg(lines), "Lines join cases that differ in " + over + " alone") +
                figure(knockdown_svg(lines),
                       "The same as parts of λ₀, the load of the line’s case in which " + over + " is nearest to 0");
    if (key == 0)
      panels = figure(panels_svg(lines), "A panel for each " + plain(lines.titles.y) + ", the other lines in grey");
  }
  return "<section class=\"load\">\n<h2>" + escaped(drawn.loads()[load].title) + "</h2>\n<div class=\"views\">\n" +
         figure(svg(drawn.map(load)),
                std::string(drawn.are_means() ? "The mean of the cases near each place" : "Each case") +
                    (drawn.keys_drawn() == 1 ? "" : "; lines join equal loads, those of the marks on the bar"),
                " class=\"map\"") +
         pictures + "</div>\n" + panels + "</section>\n";
}

std::string curves_html(const DrawnCases& drawn) {
  if (!has_lines(drawn.curves())) return "";
  const std::string svg = lines_svg(drawn.curves());
  return "<section>\n<h2>Curves of the event</h2>\n<div class=\"views\">\n" +
         figure(svg, "A line for each case; a mark is a point of its curve") + "</div>\n</section>\n";
}

std::string loads_html(const DrawnCases& drawn) {
  if (drawn.loads().empty()) return "<section><p>No case has an event yet.</p></section>\n";
  std::string options, sections;
  for (std::size_t i = 0; i < drawn.loads().size(); ++i) {
    options += "<option>" + escaped(drawn.loads()[i].title) + "</option>\n";
    sections += load_section(drawn, i);
  }
  const char* const means =
      drawn.are_means() ? "There are more cases than a page can show: each mark is the mean of all cases near it, "
                          "whatever their other keys. "
                        : "";
  return "<p hidden><label>Load: <select id=\"choice\">\n" + options + "</select></label></p>\n" + sections +
         "<p class=\"note\">" + means +
         "Hollow: the case has no such event. Crossed: the case failed. The pointer on a case shows its numbers; a "
         "click "
         "opens its own report where trace-path report has written one into its folder before the sweep was "
         "collected.</p>\n<script>" +
         script_text + "</script>\n";
}

}  // namespace

std::string report_html(const Collection& collection, const Overview& of_all, const DrawnCases& drawn) {
  const std::string title = escaped(plain(collection.sweep().title));
  return fmt::format(
             "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
             "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
             "script-src 'sha256-{}'; img-src data:\">\n"
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
             "<link rel=\"icon\" href=\"data:,\">\n"
             "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<header>\n<h1>{}</h1>\n",
             script_hash, title, style_text, title) +
         summary(collection, of_all) + "</header>\n<main>\n" + curves_html(drawn) + loads_html(drawn) +
         failure_table(of_all) +
         fmt::format(
             "<p class=\"note\">All numbers: cases.csv (one row a case) and sweep.csv (one row {}). trace-path "
             "{}.</p>\n",
             collection.sweep().traced == Traced::curve ? "a special point; all points in curves.csv" : "an event",
             program_version()) +
         "</main>\n</body>\n</html>\n";
}

}  // namespace arcwall::sweep
