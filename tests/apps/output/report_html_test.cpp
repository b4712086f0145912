#include "apps/output/report_html.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <regex>

#include "apps/output/answers.hpp"
#include "apps/output/report_data.hpp"
#include "apps/output/report_parts.hpp"
#include "apps/output/shown_number.hpp"
#include "tests/apps/output/sample_record.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::report_html_test {

using namespace test::tables;
namespace {

using Json = nlohmann::ordered_json;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::string page_of(const Record& record, const ReportContent& content) { return ReportPage(record, content).text(); }

// The page without what the program brings along.
std::string own_part(std::string page) {
  for (const std::string_view part : {report_parts().library, report_parts().style, report_parts().script}) {
    const std::size_t at = part.empty() ? std::string::npos : page.find(part);
    if (at != std::string::npos) page.erase(at, part.size());
  }
  return page;
}

Json data_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = page.find(begin) + begin.size();
  return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(ReportData, HasCurvesEventsAndShapes) {
  const Json data = report_data(sample_record(), {});

  EXPECT_EQ(data["columns"].dump(), R"([{"name":"mid","title":"mid [cm]"},{"name":"turn","title":"turn [rad]"}])");
  EXPECT_EQ(data["points"]["lambda"].dump(), "[0.0,0.1,0.05]");
  EXPECT_EQ(data["points"]["arc"].dump(), "[0.0,0.3,0.5]");  // ten digits
  EXPECT_EQ(data["points"]["monitors"].dump(), "[[0.0,0.3333333333,0.2],[0.0,0.0,null]]");
  EXPECT_EQ(data["points"]["unstable"].dump(), "[0,null,1]");
  EXPECT_EQ(data["lines"].size(), 2u);
  EXPECT_EQ(data["lines"][0]["stability"], "stable");
  EXPECT_EQ(data["lines"][1]["stability"], "unstable");
  ASSERT_EQ(data["events"].size(), 4u);
  EXPECT_EQ(data["events"][1]["point"], 1);
  EXPECT_EQ(data["events"][1]["what"], "upper at column:0.25, upper at column:0.5, upper at column:0.75 and 1 more");
  EXPECT_TRUE(data["shapes"].empty());
}

TEST(ReportData, PointsWithUncertainEventsHaveALoadAsText) {
  Record record = sample_record();
  EXPECT_EQ(report_data(record, {})["uncertain"].dump(), "[]");
  record.points[1].lambda = record.events[1].lambda = record.events[2].lambda = 0.123456789012;
  record.events[2].lambda_uncertainty = 1e-9;  // 8 digits are sure
  EXPECT_EQ(report_data(record, {})["uncertain"].dump(), "[]");
  record.events[2].lambda_uncertainty = 1e-8;
  EXPECT_EQ(report_data(record, {})["uncertain"].dump(), R"([[1,"0.1234568"]])");
  record.events[2].lambda_uncertainty = 0.004;
  EXPECT_EQ(report_data(record, {})["uncertain"].dump(), R"([[1,"0.123 ± 0.005"]])");
}

TEST(ReportData, ManyBranchesHaveColours) {
  for (Index i = 0; i < 100; ++i) EXPECT_TRUE(std::regex_match(branch_colour(i), std::regex("#[0-9A-F]{6}")));
  for (Index i = 0; i < 7; ++i)
    for (Index j = 0; j < i; ++j) EXPECT_NE(branch_colour(i), branch_colour(j));
}

TEST(ReportHtml, IsOnePageWithAllThatItNeeds) {
  const std::string page = page_of(sample_record(), {.deck_text = "title = \"A sample\"\n"});

  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  const std::string own = own_part(page);
  EXPECT_EQ(own.find("{{"), std::string::npos);
  EXPECT_NE(own.find("default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data: blob:"),
            std::string::npos);
  // Nothing is fetched from anywhere.
  EXPECT_FALSE(std::regex_search(own, std::regex("(src|href)=\"(?!data:,|#)")));
}

// Without scripts there is a chart for each monitor, and every table.
TEST(ReportHtml, CanBeReadWithoutScripts) {
  const std::string page = own_part(
      page_of(sample_record(),
              {.description = "How & why", .deck_text = "title = \"A sample\"\n", .facts = {{"nodes", "41"}}}));

  EXPECT_EQ(count(page, "<svg class=\"chart\""), 2u);
  EXPECT_EQ(count(page, "<tr data-point="), 4u);
  EXPECT_NE(page.find("contact closes"), std::string::npos);
  EXPECT_NE(page.find("ended: mid = 0.2 (stop)"), std::string::npos);
  EXPECT_NE(page.find("title = &quot;A sample&quot;"), std::string::npos);
  EXPECT_NE(page.find("<dt>nodes</dt><dd>41</dd>"), std::string::npos);
  EXPECT_NE(page.find("How &amp; why"), std::string::npos);
}

TEST(ReportHtml, ShowsNoDigitThatIsNotSureAndSaysSo) {
  Record record = sample_record();
  EXPECT_EQ(own_part(page_of(record, {})).find(" ± "), std::string::npos);
  record.branches.push_back({.id = 1, .parent = 0, .origin = 2, .points = 0});
  record.points[1].lambda = record.events[2].lambda = 1.0120114646;
  record.events[2].lambda_uncertainty = 0.038;
  const std::string page = own_part(page_of(record, {}));
  EXPECT_EQ(page.find("λ = 1.012"), std::string::npos);
  EXPECT_NE(page.find("<td class=\"figure\">1.01 ± 0.05</td>"), std::string::npos);
  EXPECT_NE(page.find(", λ = 1.01 ± 0.05;"), std::string::npos);
  EXPECT_EQ(count(page, "<p class=\"note\">λ = a ± b: "), 1u);
}

TEST(ReportHtml, TextsOfTheDeckAreNoMarkup) {
  const std::string hostile = "</script><script>alert(1)</script>{{data}}\u202E<!--";
  Record record = sample_record();
  record.title = record.deck = record.energy_unit = hostile;
  record.columns[0].unit = hostile;
  record.branches[0].end->detail = hostile;
  record.events[3].branch_end->detail = hostile;

  const std::string page =
      own_part(page_of(record, {.description = hostile, .deck_text = hostile, .facts = {{hostile, hostile}}}));

  EXPECT_EQ(count(page, "alert(1)"), count(page, "&lt;script&gt;alert(1)&lt;/script&gt;") +
                                         count(page, "\\u003cscript\\u003ealert(1)\\u003c/script\\u003e"));
  EXPECT_EQ(count(page, "<script"), 3u);
  EXPECT_EQ(count(page, "\u202E"), 0u);
  EXPECT_EQ(count(page, "{{data"), count(page, "alert(1)"));
  EXPECT_EQ(data_of(page)["columns"][0]["title"], "mid [</script><script>alert(1)</script>{{data…]");
}

TEST(ReportHtml, NothingButAnEndIsAPageToo) {
  Record record{.deck = "deck.toml"};
  record.branches.push_back({.end = BranchEnd{EndReason::singular, ""}});
  const std::string page = own_part(page_of(record, {}));
  EXPECT_NE(page.find("<h1>deck.toml</h1>"), std::string::npos);
  EXPECT_NE(page.find("the tangent stiffness is singular (singular)"), std::string::npos);
}

TEST(ReportHtml, EveryBranchThatEndedEarlySaysSoAtTheTop) {
  Record record = sample_record();
  EXPECT_EQ(own_part(page_of(record, {})).find("class=\"early\""), std::string::npos);
  record.branches.push_back({.id = 1, .end = BranchEnd{EndReason::min_step, "no step above 1e-8 succeeds"}});
  record.branches.push_back({.id = 2, .end = BranchEnd{EndReason::max_points, "2000 points"}});
  const std::string page = own_part(page_of(record, {}));
  const std::string top = page.substr(0, page.find("<main>"));
  EXPECT_EQ(count(top, "class=\"early\""), 2u);
  EXPECT_EQ(count(top, "<b>Branch 1 ended early</b>: no step above 1e-8 succeeds (min_step). To go on: "), 1u) << top;
  EXPECT_EQ(count(top, "<b>Branch 2 ended early</b>"), 1u);
  for (Index id = 3; id < 20; ++id) record.branches.push_back({.id = id, .end = BranchEnd{EndReason::min_step, ""}});
  EXPECT_EQ(count(own_part(page_of(record, {})), "11 further branches ended early"), 1u);
}

// Loads, energies and forces of contact, too: far below their greatest is what round-off leaves of zero.
TEST(ReportData, RoundoffOfLoadsAndEnergiesIsShownAsZero) {
  Record record = sample_record();
  record.points[0].lambda = 1e-16;
  record.points[0].energy = -1e-14;
  const Json points = report_data(record, {})["points"];
  EXPECT_EQ(points["lambda"].dump(), "[0.0,0.1,0.05]");
  EXPECT_EQ(points["energy"].dump(), "[0.0,-2.5,-3.0]");
  EXPECT_EQ(points["contacts"].dump(), "[0,3,3]");
}

TEST(ReportHtml, OtherRunsAndMeasuredPointsAreDrawnOverTheSameMonitors) {
  const Record record = sample_record();
  Overlay other = overlay_of(record, "fine <1>");
  const Overlay measured{
      .name = "test.csv", .measured = true, .values = {{"lambda", {0.02, 0.04}}, {"mid", {0.1, 0.2}}}, .firsts = {0}};
  const std::string page = own_part(page_of(record, {.overlays = {other, measured}}));
  EXPECT_EQ(count(page, "fine &lt;1&gt;</li>"), 1u);
  EXPECT_EQ(count(page, "measured: test.csv</li>"), 1u);
  const Json data = data_of(page)["overlays"];
  ASSERT_EQ(data.size(), 2u);
  EXPECT_EQ(data[0]["values"]["mid"].dump(), "[0.0,0.3333333333,0.2]");
  EXPECT_EQ(data[1]["values"]["lambda"].dump(), "[0.02,0.04]");
  const std::size_t first_chart = page.find("<svg class=\"chart\""),
                    second_chart = page.find("<svg class=\"chart\"", first_chart + 1);
  const std::string of_mid = page.substr(first_chart, second_chart - first_chart);
  EXPECT_EQ(count(of_mid, overlay_colour(0)), 1u);
  EXPECT_EQ(count(of_mid, overlay_colour(1)), 2u) << "a mark a point";
}

// M and Q of a cantilever under a force F at its tip, in the limit of small loads: M = F (L − s), Q = −dM/ds = F, of
// one sign along the member; at the face σ = M h/2I.
TEST(ReportData, SectionForcesOfACantileverAreThoseOfStatics) {
  const test::TracedDeck run(title("A cantilever") + units("cm", "kN") + material("steel", 2.1e4) +
                             rectangle("square", 0.1, 0.1) + points({{"wall", 0.0, 0.0}, {"tip", 2.0, 0.0}}) +
                             supports({{"wall", "x z rotation"}}) +
                             member("beam", "wall", "tip", "elastica", 8, "", "steel", "square") +
                             force("tip", 0.0, 1.0) + path("step = 1e-6; stop = { lambda = [-1.0, 1e-6] }"));
  const Record& record = run.record();
  const ReportContent content = report_content(run.model(), record, scenes_to_draw(run.model(), record));
  const Json data = report_data(record, content.shapes);
  const double F = record.points.back().lambda;
  ASSERT_GT(F, 0.0);
  const Json& samples = data["shapes"].back()["forces"][0];
  ASSERT_GE(samples.size(), 30u);
  for (const Json& sample : samples) {
    const double s = 2.0 * sample[1].get<double>();
    EXPECT_NEAR(sample[2].get<double>(), 0.0, 1e-4 * F);
    EXPECT_NEAR(sample[3].get<double>(), F, 1e-4 * F);
    EXPECT_NEAR(sample[4].get<double>(), F * (2.0 - s), 1e-4 * F);
  }
  EXPECT_EQ(data["members"][0]["name"], "beam");
  EXPECT_NEAR(data["members"][0]["EI"].get<double>(), 2.1e4 * 1e-4 / 12.0, 1e-12);
  EXPECT_EQ(data["members"][0]["half"], 0.05);
  EXPECT_EQ(data["members"][0]["allowable"], 0.0);  // none is given
}

// A column that buckles: the tree has its branches, and every point has a shape.
TEST(ReportHtml, ARunHasShapesAndBranches) {
  const test::TracedDeck run(
      title("A column") + units("cm", "kN") + material("steel", 2.1e4) + rectangle("square", 0.1, 0.1) +
      points({{"left", 0.0, 0.0}, {"right", 2.0, 0.0}}) + supports({{"left", "x z"}, {"right", "z"}}) +
      member("column", "left", "right", "euler-bernoulli", 8, "", "steel", "square") + force("right", -1.0, 0.0) +
      monitor("mid", "column:0.5", "z") + path(R"(step = 0.1; branches = "all"; stop = { lambda = [-1.0, 0.6] })"));
  const Record& record = run.record();

  const std::string page = page_of(record, report_content(run.model(), record, scenes_to_draw(run.model(), record)));

  ASSERT_GT(record.branches.size(), 1u);
  const Json data = data_of(own_part(page));
  EXPECT_EQ(data["shapes"].size(), record.points.size());
  EXPECT_EQ(data["shapes"].back()["point"], record.points.size() - 1);
  EXPECT_EQ(count(page, "</b></span> leaves at <span data-point="), record.branches.size() - 1);
  EXPECT_NE(page.find("its mirror image is not traced"), std::string::npos);
  EXPECT_NE(page.find("<dt>unknowns</dt><dd>"), std::string::npos);
}

// A rotation is measured by 1 rad, another quantity by the greatest value of its unit.
TEST(ReportData, RoundoffIsShownAsZero) {
  Record record = sample_record();
  record.columns = {{"mid", "cm"}, {"side", "cm"}};
  for (RecordPoint& point : record.points) point.monitors = {1.0, 1e-15};
  record.points.back().monitors = {-2.0, -1e-11};
  EXPECT_EQ(report_data(record, {})["points"]["monitors"].dump(), "[[1.0,1.0,-2.0],[0.0,0.0,-1e-11]]");
}

TEST(ReportHtml, SaysWhatLambdaMultipliesAndHowHeightsAreDrawn) {
  const test::TracedDeck run(test::example("channel"), {"path.stop.lambda=[-1.0, 0.5]", "load.0.force=[-2.0, 0.0]"});
  ReportContent content = report_content(run.model(), run.record(), scenes_to_draw(run.model(), run.record()));
  content.shapes.stretch = 10.0;
  const std::string page = own_part(page_of(run.record(), content));
  EXPECT_EQ(data_of(page)["load_title"], "load factor λ, times 2 kN");
  EXPECT_EQ(count(page, "λ multiplies the load at right force (-2, 0) kN."), 1u);
  EXPECT_NE(page.find("load factor λ, times 2 kN</text>"), std::string::npos);
  const std::size_t stage = page.find("<svg id=\"stage\""), note = page.find("Vertical scale exaggerated 10 times"),
                    happening = page.find("id=\"happening\"");
  EXPECT_LT(stage, note);
  EXPECT_LT(note, happening);
}

// Two bars of half-span 5 and rise h, Green strain: λ is greatest at w = h (1 − 1/√3), where the other branch of the
// curve has that load at w = h (1 + 2/√3); at h (1 + 1/√3) it snaps back (closed form of tests/published).
TEST(ReportHtml, SaysFirstWhatTheRunAnswers) {
  const test::TracedDeck truss(test::example("truss"), {"path.jumps=true"});
  const double h = 0.5, c = 1e5 / std::pow(25.0 + h * h, 1.5), root = std::sqrt(3.0);
  const double from = h * (1.0 - 1.0 / root), to = h * (1.0 + 2.0 / root),
               load = c * from * (from - h) * (from - 2.0 * h);
  const auto potential = [&](double w) { return c * w * w * (w * w / 4.0 - h * w + h * h) - load * w; };

  const std::vector<std::string> said = answers(truss.record(), std::nullopt);

  ASSERT_EQ(said.size(), 1u);
  std::smatch found;
  ASSERT_TRUE(std::regex_match(said[0], found,
                               std::regex("Snaps at λ = ([-0-9.]+), from w = ([0-9.]+) m to w = ([0-9.]+) m; releases "
                                          "([0-9.]+) kN m; snaps back at λ = ([-0-9.]+); the cycle dissipates "
                                          "([0-9.]+) kN m\\.")))
      << said[0];
  const double released = potential(from) - potential(to);
  const std::array<double, 6> closed_form{load, from, to, released, -load, 2.0 * released};
  constexpr double of_five_digits = 5e-5;
  for (std::size_t i = 0; i < closed_form.size(); ++i)
    EXPECT_NEAR(std::stod(found[i + 1]), closed_form[i], of_five_digits * std::abs(closed_form[i])) << said[0];
  EXPECT_NE(page_of(truss.record(), {}).find("<li>" + said[0] + "</li>"), std::string::npos);
}

TEST(ReportHtml, SaysThatEveryPointIsStable) {
  const test::TracedDeck truss(test::example("truss"), {"path.stop.w=[-0.1,0.1]"});

  const std::vector<std::string> said = answers(truss.record(), std::nullopt);

  ASSERT_EQ(said.size(), 1u);
  EXPECT_TRUE(std::regex_match(said[0], std::regex("Stable at every point, to λ = .*, where w = 0\\.1 m\\.")))
      << said[0];
}

TEST(ReportHtml, SaysWhereStabilityIsLost) {
  const test::TracedDeck portal(test::example("portal"));
  const RecordEvent& branch_point = test::event_of(portal, EventKind::branch_point);

  const std::vector<std::string> said = answers(portal.record(), std::nullopt);

  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0], "Loses stability at λ = " + shown_number(branch_point.lambda, 5) + ", at a branch point.");
}

// Of a movement the force is the answer: of each stage its greatest and its least, in the order of the path.
TEST(ReportHtml, SaysTheGreatestForcesOfAMovement) {
  const test::TracedDeck snap_fit(test::example("snap-fit-friction"));
  const auto text = [&](int turn) {
    const RecordEvent& event = test::event_of(snap_fit, EventKind::turning_point, turn);
    return shown_number(event.monitors[0], 5) + " N at λ = " + shown_number(event.lambda, 5);
  };

  const std::vector<std::string> said = answers(snap_fit.record(), 0);

  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(said[0], "insert: push rises to " + text(1) + " and falls to " + text(2) + ".");
  EXPECT_EQ(said[1], "remove: push falls to " + text(3) + " and rises to " + text(4) + ".");
  EXPECT_TRUE(said[2].starts_with("Stable at every point")) << said[2];
  const std::string page = page_of(snap_fit.record(), report_content(snap_fit.model(), snap_fit.record(), {}));
  for (const std::string& sentence : said) EXPECT_NE(page.find("<li>" + sentence + "</li>"), std::string::npos);
  for (const char* stage : {"insert", "remove"})
    EXPECT_NE(page.find("<p class=\"note\">Stage " + std::string(stage) + ": λ multiplies the wall catch by "),
              std::string::npos);
}

}  // namespace
}  // namespace arcwall::report_html_test
