#include "apps/sweep/collection.hpp"

#include <algorithm>

#include "apps/output/csv.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/deck/reader.hpp"
#include "model/event_names.hpp"

namespace arcwall::sweep {

namespace {

// Empty for what is not known.
std::string cell(const Json& value) {
  if (value.is_null()) return "";
  return value.is_number() ? label(value) : csv_cell(label(value));
}

std::string cell(const std::optional<double>& value) { return value ? round_trip(*value) : ""; }

Json member(const Json& object, const char* key) { return object.is_object() ? object.value(key, Json()) : Json(); }

std::string case_cells(const Sweep& sweep, const Case& one) {
  std::string text = std::to_string(one.number);
  for (const Key& key : sweep.keys) text += "," + cell(value_of(one, key.name));
  return text;
}

std::string case_titles(const Sweep& sweep) {
  std::string text = "case";
  for (const Key& key : sweep.keys) text += "," + csv_cell(key.name);
  return text;
}

// A copy of the deck may have been changed since.
deck::Deck deck_of(const Case& one, const std::filesystem::path& folder) {
  try {
    return deck::read_deck((folder / one.deck).string(), assignments(one));
  } catch (const InputError&) {
    return {};
  }
}

Case first_case(const std::filesystem::path& folder) { return CaseReader(folder).next().value(); }

template <class Value>
void add_once(std::vector<Value>& list, const Value& value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

constexpr std::size_t most_listed = 10;

}  // namespace

Collection::Collection(std::filesystem::path folder)
    : folder_(std::move(folder)),
      size_(count_cases(folder_)),
      sweep_(read_sweep((folder_ / sweep_file_name).string(), Rows::left_out)),
      results_(folder_, size_) {
  const Case first = first_case(folder_);
  deck_ = deck_of(first, folder_);
  deck_file_ = first.deck;
}

void Collection::visit(const std::function<void(const Case&, const CaseResult&)>& each) const {
  CaseReader cases(folder_);
  while (const auto one = cases.next()) each(*one, results_.read(one->number));
}

const Json& value_of(const Case& one, const std::string& key) {
  static const Json nothing;
  const auto found = std::find_if(one.set.begin(), one.set.end(), [&](const auto& pair) { return pair.first == key; });
  return found == one.set.end() ? nothing : found->second;
}

// --- Overview
// ---------------------------------------------------------------------------------------------------------

void KeyRange::add(const Json& value) {
  if (!value.is_number()) numbers = false;
  if (value.is_number()) {
    low = std::min(low, value.get<double>());
    high = std::max(high, value.get<double>());
  }
  if (distinct.size() <= most_distinct) add_once(distinct, value);
}

void Overview::add(const Case& one, const CaseResult& result) {
  for (const auto& [key, value] : one.set) keys[key].add(value);
  if (result.there) ++ran;
  if (result.failed()) {
    ++failed;
    const auto same = [&](const Failure& failure) { return failure.reason == result.reason; };
    auto found = std::find_if(failures.begin(), failures.end(), same);
    if (found == failures.end()) found = failures.insert(found, Failure{.reason = result.reason});
    ++found->count;
    if (found->first.size() <= most_listed) found->first.push_back(one.number);
  }
  if (result.events.empty()) return;
  for (const auto& [name, value] : result.events.front().at("monitors").items()) add_once(monitors, name);
  for (const Json& event : result.events) add_once(event_kinds, event.value("kind", std::string()));
  has_snaps = has_snaps || snap_load(result).has_value();
}

Overview overview(const Collection& collection) {
  Overview all;
  collection.visit([&](const Case& one, const CaseResult& result) { all.add(one, result); });
  std::vector<std::string> in_order;
  for (const char* const name : {"worst", "begins", "ends", "cusp", "crossing"})  // of curves
    if (std::find(all.event_kinds.begin(), all.event_kinds.end(), name) != all.event_kinds.end())
      in_order.emplace_back(name);
  for (const EventKind kind :
       {EventKind::contact_closes, EventKind::contact_opens, EventKind::contact_spreads, EventKind::contact_splits,
        EventKind::contact_shrinks, EventKind::contacts_merge, EventKind::contact_transfers, EventKind::contact_slips,
        EventKind::contact_sticks, EventKind::limit_point, EventKind::contact_limit_point, EventKind::turning_point,
        EventKind::value_crossing, EventKind::reversal, EventKind::branch_point}) {
    const std::string name(to_text(kind));
    if (std::find(all.event_kinds.begin(), all.event_kinds.end(), name) != all.event_kinds.end())
      in_order.push_back(name);
  }
  all.event_kinds = std::move(in_order);
  return all;
}

std::string listed(const Failure& failure) {
  std::string text;
  for (std::size_t i = 0; i < std::min(failure.first.size(), most_listed); ++i)
    text += (i > 0 ? ", " : "") + std::to_string(failure.first[i]);
  return text + (failure.count > most_listed ? ", …" : "");
}

// --- Tables
// -----------------------------------------------------------------------------------------------------------

void Tables::Buffered::add(const std::string& more) {
  constexpr std::size_t enough = std::size_t{1} << 18;
  text += more;
  if (text.size() < enough) return;
  file.write(text);
  text.clear();
}

void Tables::Buffered::finish() {
  file.write(text);
  file.close();
}

Tables::Tables(const Collection& collection, const Overview& of_all)
    : collection_(collection),
      monitors_(of_all.monitors),
      cases_{.file = StagedFile(collection.folder() / "cases.csv")},
      events_{.file = StagedFile(collection.folder() / "sweep.csv")} {
  const std::string titles = case_titles(collection.sweep());
  if (of_curves()) {
    begin_curves(titles);
    return;
  }
  cases_.add(titles + ",status,reason,detail,first_contact,limit_loads,snap_load,branches,points,events,iterations\n");
  std::string text = titles + ",event,kind,branch,step,arc,lambda";
  for (const std::string& name : monitors_) text += "," + csv_cell(name);
  events_.add(text + ",unstable_before,unstable_after,reason\n");
}

// Titles of what curves have.
void Tables::begin_curves(const std::string& titles) {
  curves_.reset(new Buffered{.file = StagedFile(collection_.folder() / "curves.csv")});
  cases_.add(titles + ",status,reason,detail,points,least_lambda,greatest_lambda\n");
  std::string text = titles + ",kind,point,key,lambda";
  for (const std::string& name : monitors_) text += "," + csv_cell(name);
  events_.add(text + ",reason,why\n");
  curves_->add(titles + ",point,key,lambda\n");
}

void Tables::add_curve(const std::string& begin, const CaseResult& result) {
  std::optional<double> least, greatest;
  for (std::size_t i = 0; i < result.curve.size(); ++i) {
    const auto [key, lambda] = result.curve[i];
    least = std::min(least.value_or(lambda), lambda);
    greatest = std::max(greatest.value_or(lambda), lambda);
    curves_->add(begin + "," + std::to_string(i) + "," + round_trip(key) + "," + round_trip(lambda) + "\n");
  }
  cases_.add(begin + "," + (result.status ? std::to_string(*result.status) : "") + "," + result.reason + "," +
             csv_cell(result.detail) + "," + cell(member(result.counts, "points")) + "," + cell(least) + "," +
             cell(greatest) + "\n");
  for (const Json& special : result.events) {
    std::string text = begin;
    for (const char* key : {"kind", "point", "key", "lambda"}) text += "," + cell(member(special, key));
    const Json values = member(special, "monitors");
    for (const std::string& name : monitors_) text += "," + cell(member(values, name.c_str()));
    for (const char* key : {"reason", "why"}) text += "," + cell(member(special, key));
    events_.add(text + "\n");
  }
}

void Tables::add(const Case& one, const CaseResult& result) {
  const std::string begin = case_cells(collection_.sweep(), one);
  if (of_curves()) return add_curve(begin, result);
  std::string limits;
  for (const double load : limit_loads(result)) limits += (limits.empty() ? "" : " ") + round_trip(load);
  std::string text = begin + "," + (result.status ? std::to_string(*result.status) : "") + "," + result.reason + "," +
                     csv_cell(result.detail) + "," + cell(first_load(result, {"contact-closes"})) + "," + limits + "," +
                     cell(snap_load(result));
  for (const char* key : {"branches", "points", "events", "iterations"}) text += "," + cell(member(result.counts, key));
  cases_.add(text + "\n");
  for (const Json& event : result.events) {
    text = begin;
    for (const char* key : {"id", "kind", "branch", "step", "arc", "lambda"}) text += "," + cell(member(event, key));
    const Json values = member(event, "monitors");
    for (const std::string& name : monitors_) text += "," + cell(member(values, name.c_str()));
    for (const char* key : {"unstable_before", "unstable_after", "reason"}) text += "," + cell(member(event, key));
    events_.add(text + "\n");
  }
}

void Tables::finish() {
  cases_.finish();
  events_.finish();
  cases_.file.put_in_place();
  events_.file.put_in_place();
  if (!curves_) return;
  curves_->finish();
  curves_->file.put_in_place();
}

}  // namespace arcwall::sweep
