#include "apps/sweep/case_list.hpp"

#include "core/error.hpp"
#include "core/text.hpp"
#include "model/deck/value.hpp"

namespace arcwall::sweep {

namespace {

std::string joined(const Json& array) {
  std::string text;
  for (const Json& item : array) text += (text.empty() ? "" : ", ") + toml_text(item);
  return "[" + text + "]";
}

std::string inline_table(const Json& object) {
  std::string text;
  for (const auto& [key, value] : object.items())
    text += (text.empty() ? " " : ", ") + deck::key_text(key) + " = " + toml_text(value);
  return "{" + text + " }";
}

// Nothing if the line is no case.
bool read_case(const std::string& line, Case& one) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object() || !json.contains("case") || !json.contains("deck") || !json.contains("set")) return false;
  if (!json["case"].is_number_integer() || !json["deck"].is_string() || !json["set"].is_object()) return false;
  one.number = json["case"].get<int>();
  one.deck = json["deck"].get<std::string>();
  for (const auto& [key, value] : json["set"].items()) one.set.emplace_back(key, value);
  return true;
}

}  // namespace

std::string toml_text(const Json& value) {
  if (value.is_string()) return deck::in_quotes(value.get<std::string>());
  if (value.is_number_float()) return round_trip(value.get<double>());
  if (value.is_array()) return joined(value);
  if (value.is_object()) return inline_table(value);
  return value.dump();
}

std::string label(const Json& value) { return value.is_string() ? value.get<std::string>() : toml_text(value); }

std::vector<std::string> assignments(const Case& one) {
  std::vector<std::string> texts;
  for (const auto& [key, value] : one.set) texts.push_back(key + "=" + toml_text(value));
  return texts;
}

std::vector<Case> cases(const Sweep& sweep, const std::string& deck) {
  std::vector<Case> result;
  for (const std::vector<Json>& row : sweep.rows) {
    Case one{.number = static_cast<int>(result.size()), .deck = deck};
    for (std::size_t i = 0; i < row.size(); ++i) one.set.emplace_back(sweep.keys[i].name, row[i]);
    for (const Tie& tie : sweep.ties)
      one.set.emplace_back(tie.key.name, number(tie.offset + tie.factor * row[tie.to].get<double>()));
    result.push_back(std::move(one));
  }
  return result;
}

std::string to_text(const std::vector<Case>& cases) {
  std::string text;
  for (const Case& one : cases) {
    Json json{{"case", one.number}, {"set", Json::object()}, {"deck", one.deck}};
    for (const auto& [key, value] : one.set) json["set"][key] = value;
    text += json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  }
  return text;
}

namespace {

std::filesystem::path list_of(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / case_list_name;
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw InputError({Diagnostic{.file = folder.string(),
                                 .message = "is no planned sweep: it has no " + std::string(case_list_name),
                                 .cure = "plan one with trace-path sweep plan SWEEP.toml --out " + folder.string()}});
  return file;
}

[[noreturn]] void fail_as_empty(const std::filesystem::path& folder) {
  throw OutputError((folder / case_list_name).string() + ": holds no case; plan the sweep again in a new folder");
}

}  // namespace

CaseReader::CaseReader(const std::filesystem::path& folder) : lines_(list_of(folder)), file_(folder / case_list_name) {}

std::optional<Case> CaseReader::next() {
  std::string line;
  if (!lines_.next(line)) return std::nullopt;
  Case one;
  if (!read_case(line, one) || one.number != number_)
    throw InputError({Diagnostic{.file = file_.string(),
                                 .line = number_ + 1,
                                 .message = "is not the line of case " + std::to_string(number_),
                                 .cure = "plan the sweep again in a new folder"}});
  ++number_;
  return one;
}

bool CaseReader::skip() {
  std::string line;
  if (!lines_.next(line)) return false;
  ++number_;
  return true;
}

std::size_t count_cases(const std::filesystem::path& folder) {
  CaseReader reader(folder);
  std::size_t count = 0;
  while (reader.skip()) ++count;
  if (count == 0) fail_as_empty(folder);
  return count;
}

}  // namespace arcwall::sweep
