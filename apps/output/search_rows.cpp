#include "apps/output/search_rows.hpp"

#include <cmath>
#include <numeric>

#include "apps/output/exit_status.hpp"
#include "apps/output/shown_number.hpp"

namespace arcwall {

using OrderedJson = nlohmann::ordered_json;

namespace {

constexpr int lambda_digits = 8;

const char* to_text(SearchOutcome outcome) {
  switch (outcome) {
    case SearchOutcome::found:
      return "found";
    case SearchOutcome::mirror_image:
      return "mirror_image";
    case SearchOutcome::known:
      return "known";
    case SearchOutcome::nodes_only:
      return "nodes_only";
    case SearchOutcome::not_found:
      return "not_found";
  }
  return "";
}

const char* to_text(FoundFate fate) {
  switch (fate) {
    case FoundFate::pending:
      return "pending";
    case FoundFate::traced:
      return "traced";
    case FoundFate::on_branch:
      return "on_branch";
    case FoundFate::beyond_stop:
      return "beyond_stop";
    case FoundFate::not_traced:
      return "not_traced";
  }
  return "";
}

Index guesses(const RecordSearch& search) {
  return std::accumulate(search.outcomes.begin(), search.outcomes.end(), Index{0});
}

// `traced as branches 2 and 3`
std::string fate_text(const RecordFound& found) {
  std::string branches;
  for (const Index branch : found.branches) branches += (branches.empty() ? "" : " and ") + std::to_string(branch);
  switch (found.fate) {
    case FoundFate::pending:
      return "not traced yet";
    case FoundFate::traced:
      return (found.branches.size() == 1 ? "branch " : "branches ") + branches;
    case FoundFate::on_branch:
      return "on branch " + branches;
    case FoundFate::beyond_stop:
      return "beyond path.stop, not traced";
    case FoundFate::not_traced:
      return "no step from it converges, not traced";
  }
  return "";
}

OrderedJson finite_or_null(double value) { return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr); }

OrderedJson found_json(const Record& record, const RecordFound& found) {
  OrderedJson monitors = OrderedJson::object();
  for (std::size_t i = 0; i < found.monitors.size(); ++i)
    monitors[record.columns[i].name] = finite_or_null(found.monitors[i]);
  return {{"contact_pattern", found.contact_pattern},
          {"monitors", std::move(monitors)},
          {"energy", finite_or_null(found.energy)},
          {"unstable", found.unstable ? OrderedJson(*found.unstable) : OrderedJson(nullptr)},
          {"became", to_text(found.fate)},
          {"branches", found.branches}};
}

}  // namespace

std::vector<TableColumn> search_columns() {
  const auto figure = [](std::string title) { return TableColumn{std::move(title), TableColumn::Side::right}; };
  return {figure("λ"),     figure("on branches"), figure("guesses"),  figure("found"), figure("mirror_image"),
          figure("known"), figure("nodes_only"),  figure("not_found")};
}

std::vector<std::vector<std::string>> search_rows(const Record& record) {
  std::vector<std::vector<std::string>> rows;
  for (const RecordSearch& search : record.searches) {
    std::vector<std::string>& row = rows.emplace_back();
    row = {shown_number(search.lambda, lambda_digits), std::to_string(search.known), std::to_string(guesses(search))};
    for (const Index count : search.outcomes) row.push_back(std::to_string(count));
  }
  return rows;
}

std::vector<TableColumn> found_columns(const Record& record) {
  const auto figure = [](std::string title) { return TableColumn{std::move(title), TableColumn::Side::right}; };
  std::vector<TableColumn> columns{figure("λ"), {"found"}};
  for (const RecordColumn& column : record.columns)
    columns.push_back(figure(column.name + (column.unit.empty() ? "" : " [" + column.unit + "]")));
  columns.push_back(figure("energy"));
  columns.push_back(figure("unstable"));
  columns.push_back({"traced as"});
  return columns;
}

std::vector<std::vector<std::string>> found_rows(const Record& record) {
  std::vector<std::vector<std::string>> rows;
  for (const RecordSearch& search : record.searches)
    for (const RecordFound& found : search.found) {
      std::vector<std::string>& row = rows.emplace_back();
      row = {shown_number(search.lambda, lambda_digits),
             found.contact_pattern.empty() ? "no contact" : found.contact_pattern};
      for (const double value : found.monitors) row.push_back(shown_number(value, 6));
      row.push_back(shown_number(found.energy, 6));
      row.push_back(found.unstable ? std::to_string(*found.unstable) : "?");
      row.push_back(fate_text(found));
    }
  return rows;
}

std::string search_note() {
  return "A search is not complete: more guesses, another seed or other values of λ may find further equilibria.";
}

OrderedJson search_json(const Record& record) {
  if (record.searches.empty()) return nullptr;
  OrderedJson at = OrderedJson::array();
  for (const RecordSearch& search : record.searches) {
    OrderedJson outcomes = OrderedJson::object(), found = OrderedJson::array();
    for (std::size_t i = 0; i < search.outcomes.size(); ++i)
      outcomes[to_text(static_cast<SearchOutcome>(i))] = search.outcomes[i];
    for (const RecordFound& one : search.found) found.push_back(found_json(record, one));
    at.push_back({{"lambda", finite_or_null(search.lambda)},
                  {"known", search.known},
                  {"guesses", guesses(search)},
                  {"outcomes", std::move(outcomes)},
                  {"found", std::move(found)}});
  }
  OrderedJson ended_early = OrderedJson::array();
  for (const Index branch : found_that_ended_early(record)) ended_early.push_back(branch);
  return {{"at", std::move(at)}, {"ended_early", std::move(ended_early)}, {"note", search_note()}};
}

std::string found_at(const Record& record, const RecordBranch& branch) {
  for (const RecordSearch& search : record.searches)
    for (const RecordFound& found : search.found)
      if (branch.found && found.fate == FoundFate::traced)
        for (const Index one : found.branches)
          if (one == branch.id) return "at λ = " + shown_number(search.lambda, 10) + ", found";
  return "";
}

}  // namespace arcwall
