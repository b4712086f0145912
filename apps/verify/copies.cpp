#include "apps/verify/copies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/events_json.hpp"
#include "apps/output/exit_status.hpp"
#include "apps/output/result_json.hpp"
#include "model/deck/writer.hpp"

namespace arcwall::verify {

using Json = nlohmann::ordered_json;

namespace {

// The greatest of the numbers of an object or a list, by which round-off of the others is measured.
double size_of(const Json& numbers) {
  double size = 0.0;
  for (const Json& one : numbers)
    if (one.is_number()) size = std::max(size, std::abs(one.get<double>()));
  return size;
}

std::string shown(const Json& value) {
  constexpr std::size_t most = 60;
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= most ? text : text.substr(0, most) + "…";
}

class JsonComparison {
 public:
  JsonComparison(std::string check, Findings& findings) : check_(std::move(check)), findings_(findings) {}

  // `size`: of the numbers beside this one.
  void compare(const Json& stored, const Json& expected, const std::string& path, double size = 0.0) {
    if (stored.is_number() && expected.is_number()) {
      const double value = expected.get<double>(), bound = 1e-12 * std::max(std::abs(value), size);
      findings_.compare(check_, std::abs(stored.get<double>() - value), bound, path);
    } else if (stored.is_object() && expected.is_object()) {
      compare_members(stored, expected, path);
    } else if (stored.is_array() && expected.is_array() && stored.size() == expected.size()) {
      for (std::size_t i = 0; i < expected.size(); ++i)
        compare(stored[i], expected[i], fmt::format("{}[{}]", path, i), size_of(expected));
    } else {
      findings_.require(check_, stored == expected,
                        fmt::format("{} is {} instead of {}", path, shown(stored), shown(expected)));
    }
  }

 private:
  // Numbers that stand beside each other in an event differ in kind; those of monitors and modes do not.
  void compare_members(const Json& stored, const Json& expected, const std::string& path) {
    const bool alike = path.ends_with("monitors") || path.ends_with("mode");
    const std::string before = path.empty() ? "" : path + ".";
    for (const auto& [key, value] : expected.items()) {
      findings_.require(check_, stored.contains(key), before + key + " is missing");
      if (stored.contains(key)) compare(stored[key], value, before + key, alike ? size_of(expected) : 0.0);
    }
    for (const auto& [key, value] : stored.items())
      findings_.require(check_, expected.contains(key), before + key + " is more than the run has");
  }

  std::string check_;
  Findings& findings_;
};

Json parsed(const std::string& text, const std::string& check, Findings& findings) {
  Json json = Json::parse(text, nullptr, false);
  findings.require(check, json.is_object(), "it cannot be read");
  return json.is_object() ? json : Json();
}

void check_events_json(const std::string& text, const Record& record, Findings& findings) {
  const std::string check = "events.json repeats the run";
  findings.at("events.json", 0, 0);
  const Json stored = parsed(text, check, findings), expected = events_json(record);
  if (stored.is_null()) return;
  JsonComparison comparison(check, findings);
  for (const char* key : {"deck", "branches"}) comparison.compare(stored.value(key, Json()), expected.at(key), key);
  const Json& events = expected.at("events");
  const Json listed = stored.value("events", Json());
  const bool complete = listed.is_array() && listed.size() == events.size();
  findings.require(check, complete, fmt::format("{} events instead of {}", listed.size(), events.size()));
  if (!complete) return;
  for (std::size_t i = 0; i < events.size(); ++i) {
    findings.at("events.json", record.events[i].branch, record.events[i].step);
    comparison.compare(listed[i], events[i], fmt::format("event {}", i));
  }
}

void check_result_json(const std::string& text, const Json& expected, Findings& findings) {
  const std::string check = "result.json repeats the run";
  findings.at("result.json", 0, 0);
  Json stored = parsed(text, check, findings);
  if (stored.is_null()) return;
  Json wanted = expected;
  for (const char* of_the_day : {"program", "libraries", "seconds"}) {
    stored.erase(of_the_day);
    wanted.erase(of_the_day);
  }
  // A run whose standard output was cut off says so by its status, and its record that it was interrupted.
  const bool was_cut_off = wanted.value("status", 0) == static_cast<int>(ExitStatus::interrupted) &&
                           stored.value("status", Json()) == static_cast<int>(ExitStatus::file_error);
  if (was_cut_off) wanted["status"] = stored["status"];
  JsonComparison(check, findings).compare(stored, wanted, "");
}

}  // namespace

void check_json(const std::string& check, const std::string& text, Json expected, const std::vector<std::string>& but,
                Findings& findings) {
  Json stored = parsed(text, check, findings);
  if (stored.is_null()) return;
  for (const std::string& key : but) {
    stored.erase(key);
    expected.erase(key);
  }
  JsonComparison(check, findings).compare(stored, expected, "");
}

void check_copies(const Model& model, const Record& record, const RunDescription& run, const StoredFiles& files,
                  Findings& findings) {
  check_events_json(files.events_json, record, findings);
  const int status = static_cast<int>(exit_status(record));
  check_result_json(files.result_json, result_json(model, run, record, {}, status), findings);
  findings.at("deck.toml", 0, 0);
  findings.require("deck.toml equals the deck", files.deck_toml == deck::to_toml(model.given_deck()),
                   "it is not the deck of the checkpoint with its defaults");
}

}  // namespace arcwall::verify
