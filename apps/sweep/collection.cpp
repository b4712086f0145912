#include "apps/sweep/collection.hpp"

#include <algorithm>

#include "apps/output/csv.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/deck/reader.hpp"

namespace arcwall::sweep {

namespace {

// Empty for what is not known.
std::string cell(const Json& value) { return value.is_null() ? "" : csv_cell(label(value)); }

std::string cell(const std::optional<double>& value) { return value ? round_trip(*value) : ""; }

Json member(const Json& object, const char* key) { return object.is_object() ? object.value(key, Json()) : Json(); }

std::string case_cells(const Collection& collection, std::size_t i) {
  std::string text = std::to_string(collection.cases[i].number);
  for (const Key& key : collection.sweep.keys) text += "," + cell(value_of(collection.cases[i], key.name));
  return text;
}

std::string case_titles(const Collection& collection) {
  std::string text = "case";
  for (const Key& key : collection.sweep.keys) text += "," + csv_cell(key.name);
  return text;
}

// Of all cases, in the order in which they turn up.
std::vector<std::string> monitors(const Collection& collection) {
  std::vector<std::string> names;
  for (const CaseResult& result : collection.results) {
    if (result.events.empty()) continue;
    for (const auto& [name, value] : result.events.front().at("monitors").items())
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

// A copy of the deck may have been changed since.
deck::Deck deck_of(const Case& one, const std::filesystem::path& folder) {
  try {
    return deck::read_deck((folder / one.deck).string(), assignments(one));
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

Collection collect(const std::filesystem::path& folder) {
  Collection collection{.cases = read_cases(folder)};
  collection.sweep = read_sweep((folder / sweep_file_name).string());
  collection.deck = deck_of(collection.cases.front(), folder);
  for (const Case& one : collection.cases) collection.results.push_back(read_result(folder, one.number));
  return collection;
}

const Json& value_of(const Case& one, const std::string& key) {
  static const Json nothing;
  const auto found = std::find_if(one.set.begin(), one.set.end(), [&](const auto& pair) { return pair.first == key; });
  return found == one.set.end() ? nothing : found->second;
}

std::string sweep_csv(const Collection& collection) {
  const std::vector<std::string> names = monitors(collection);
  std::string text = case_titles(collection) + ",event,kind,branch,step,arc,lambda";
  for (const std::string& name : names) text += "," + csv_cell(name);
  text += ",unstable_before,unstable_after,reason\n";
  for (std::size_t i = 0; i < collection.cases.size(); ++i) {
    const std::string begin = case_cells(collection, i);
    for (const Json& event : collection.results[i].events) {
      text += begin;
      for (const char* key : {"id", "kind", "branch", "step", "arc", "lambda"}) text += "," + cell(member(event, key));
      const Json values = member(event, "monitors");
      for (const std::string& name : names) text += "," + cell(member(values, name.c_str()));
      for (const char* key : {"unstable_before", "unstable_after", "reason"}) text += "," + cell(member(event, key));
      text += "\n";
    }
  }
  return text;
}

std::string cases_csv(const Collection& collection) {
  std::string text = case_titles(collection) +
                     ",status,reason,detail,first_contact,limit_loads,snap_load,branches,points,events,iterations\n";
  for (std::size_t i = 0; i < collection.cases.size(); ++i) {
    const CaseResult& result = collection.results[i];
    std::string limits;
    for (const double load : limit_loads(result)) limits += (limits.empty() ? "" : " ") + round_trip(load);
    text += case_cells(collection, i) + "," + (result.status ? std::to_string(*result.status) : "") + "," +
            result.reason + "," + csv_cell(result.detail) + "," + cell(first_load(result, {"contact-closes"})) + "," +
            limits + "," + cell(snap_load(result));
    for (const char* key : {"branches", "points", "events", "iterations"})
      text += "," + cell(member(result.counts, key));
    text += "\n";
  }
  return text;
}

std::vector<Failure> failures(const Collection& collection) {
  std::vector<Failure> list;
  for (std::size_t i = 0; i < collection.cases.size(); ++i) {
    const CaseResult& result = collection.results[i];
    if (!result.failed()) continue;
    const auto same = [&](const Failure& failure) { return failure.reason == result.reason; };
    auto found = std::find_if(list.begin(), list.end(), same);
    if (found == list.end()) found = list.insert(list.end(), Failure{.reason = result.reason});
    found->cases.push_back(collection.cases[i].number);
  }
  return list;
}

std::string listed(const std::vector<int>& numbers) {
  constexpr std::size_t most = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(numbers.size(), most); ++i)
    text += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
  return text + (numbers.size() > most ? ", …" : "");
}

}  // namespace arcwall::sweep
