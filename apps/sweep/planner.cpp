#include "apps/sweep/planner.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "answers/event_curve.hpp"
#include "apps/output/files.hpp"
#include "model/deck/given_points.hpp"
#include "model/deck/numbers.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/toml_source.hpp"
#include "model/deck/value.hpp"
#include "model/model.hpp"

namespace arcwall::sweep {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(Diagnostic diagnostic) { throw InputError(std::vector<Diagnostic>{std::move(diagnostic)}); }

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

// What is wrong with the cases: each thing once, with the first case that has it.
class Complaints {
 public:
  /// `base`: what is wrong with the deck as it stands. Cases whose values do not mend it have it too, in words that may
  /// differ with their values.
  Complaints(const Sweep& sweep, std::vector<Diagnostic> base) : sweep_(sweep), base_(std::move(base)) {}

  void add(const Case& one, const InputError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      const auto in_base = std::find_if(base_.begin(), base_.end(), [&](const Diagnostic& other) {
        return std::tie(other.file, other.line, other.column, other.key) ==
               std::tie(diagnostic.file, diagnostic.line, diagnostic.column, diagnostic.key);
      });
      Diagnostic here = in_base == base_.end() ? at_its_key(one, diagnostic) : *in_base;
      const auto [place, is_new] = places_.try_emplace(to_text(here), found_.size());
      if (is_new) found_.push_back({.diagnostic = std::move(here), .first = one.number});
      ++found_[place->second].cases;
    }
  }

  void throw_if_any() const {
    constexpr std::size_t most_shown = 30;
    if (found_.empty()) return;
    std::vector<Complaint> in_order = found_;
    std::stable_sort(in_order.begin(), in_order.end(), [](const Complaint& a, const Complaint& b) {
      return std::pair(a.diagnostic.line, a.diagnostic.column) < std::pair(b.diagnostic.line, b.diagnostic.column);
    });
    std::vector<Diagnostic> shown;
    for (const Complaint& one : in_order) {
      if (shown.size() == most_shown) break;
      shown.push_back(one.diagnostic);
      shown.back().message += one.cases == 1 ? " (case " + std::to_string(one.first) + ")"
                                             : " (" + std::to_string(one.cases) + " cases, the first is case " +
                                                   std::to_string(one.first) + ")";
    }
    if (found_.size() > shown.size())
      shown.push_back({.file = sweep_.source.file,
                       .message = std::to_string(found_.size() - shown.size()) + " more things are wrong"});
    throw InputError(std::move(shown));
  }

 private:
  struct Complaint {
    Diagnostic diagnostic{};
    int first = 0;
    int cases = 0;
  };

  const Key& key(std::size_t of_case) const {
    return of_case < sweep_.keys.size() ? sweep_.keys[of_case] : sweep_.ties[of_case - sweep_.keys.size()].key;
  }

  // Of a key that is none the value does not matter.
  static bool names_its_key(const Diagnostic& diagnostic) {
    const std::string last = diagnostic.key.substr(diagnostic.key.rfind('.') + 1);
    return diagnostic.message.starts_with(deck::in_quotes(last) + " is not a key");
  }

  // What a deck's reader says of a `--set` is said of the line of the sweep that the value comes from.
  Diagnostic at_its_key(const Case& one, const Diagnostic& diagnostic) const {
    const std::vector<std::string> texts = assignments(one);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (diagnostic.file != deck::origin_of(texts[i])) continue;
      const bool any_value = diagnostic.key == key(i).name && names_its_key(diagnostic);
      Diagnostic here =
          deck::diagnostic_at(sweep_.source, key(i).position, any_value ? key(i).name : deck::on_one_line(texts[i]),
                              diagnostic.message, diagnostic.cure);
      if (!diagnostic.key.empty() && diagnostic.key != key(i).name) here.message = diagnostic.key + ": " + here.message;
      return here;
    }
    return diagnostic;
  }

  const Sweep& sweep_;
  std::vector<Diagnostic> base_;
  std::map<std::string, std::size_t> places_;
  std::vector<Complaint> found_;
};

// Builds the model; reports all that is wrong with the deck for what is traced of it.
void check(const Plan& plan, const deck::Deck& deck) {
  const Model model(deck);
  if (plan.sweep.traced == Traced::path) return;
  if (!deck.curve)
    throw InputError({Diagnostic{.file = deck.source.file,
                                 .key = "curve",
                                 .message = "the deck does not say which event is followed",
                                 .cure = "add a table [curve], or leave out command = \"curve\" of the sweep"}});
  require_curve(deck);
}

// Of two names of one value the later one would be set behind the other, which would have no effect.
void refuse_second_names(const Plan& plan, const deck::Value& root) {
  std::vector<Key> keys = plan.sweep.keys;
  for (const Tie& tie : plan.sweep.ties) keys.push_back(tie.key);
  std::map<std::string, std::string> names;
  for (const Key& key : keys) {
    const auto [first, is_new] = names.try_emplace(deck::written_key(root, key.name), key.name);
    if (!is_new)
      fail(deck::diagnostic_at(plan.sweep.source, key.position, key.name,
                               "is another name of " + first->second + ", which is varied, too",
                               "vary the value under one name"));
  }
}

std::vector<Diagnostic> problems_of_base(const Plan& plan, const deck::Value& root, const std::string& deck_file) {
  try {
    check(plan, deck::read_deck_value(root, deck_file));
  } catch (const InputError& error) {
    return error.diagnostics();
  }
  return {};
}

// The deck's text is taken apart once.
void check_cases(const Plan& plan, const std::string& deck_file) {
  deck::Value root;
  try {
    root = deck::parse_deck(plan.deck_text, deck_file);
  } catch (const InputError& error) {
    Complaints complaints(plan.sweep, error.diagnostics());
    for (const Case& one : plan.cases) complaints.add(one, error);
    complaints.throw_if_any();
  }
  refuse_second_names(plan, root);
  Complaints complaints(plan.sweep, problems_of_base(plan, root, deck_file));
  for (const Case& one : plan.cases) {
    try {
      check(plan, deck::read_deck_value(root, deck_file, assignments(one)));
    } catch (const InputError& error) {
      complaints.add(one, error);
    }
  }
  complaints.throw_if_any();
}

std::string content_if_any(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) ? deck::read_text_file(file.string()) : std::string();
}

bool holds(const fs::path& folder, const Plan& plan) {
  return content_if_any(folder / sweep_file_name) == plan.sweep_text &&
         content_if_any(folder / case_list_name) == to_text(plan.cases) &&
         content_if_any(folder / plan.cases.front().deck) == plan.deck_text;
}

}  // namespace

Plan plan(const std::string& sweep_file) {
  Plan result{.sweep_text = deck::read_text_file(sweep_file)};
  result.sweep = read_sweep_text(result.sweep_text, sweep_file);
  const std::string deck_file = (fs::path(sweep_file).parent_path() / result.sweep.deck).string();
  const std::string name = file_name(deck_file);
  const auto fail_on_deck = [&](const std::string& message, const std::string& cure) {
    fail(deck::diagnostic_at(result.sweep.source, result.sweep.deck_position, "deck", message, cure));
  };
  if (name == sweep_file_name || name == case_list_name)
    fail_on_deck("a sweep's folder has a " + name + " of its own", "give the deck another name");
  try {
    result.deck_text = deck::read_deck_file(deck_file);
  } catch (const InputError& error) {
    const Diagnostic& problem = error.diagnostics().front();
    fail_on_deck(problem.file + ": " + problem.message, "name the deck from the folder of the sweep");
  }
  result.cases = cases(result.sweep, name);
  check_cases(result, deck_file);
  return result;
}

void write(const Plan& plan, const fs::path& folder) {
  std::error_code error;
  if (holds(folder, plan)) return;
  if (fs::exists(folder, error) && (!fs::is_directory(folder, error) || !fs::is_empty(folder, error)))
    throw OutputError(folder.string() + ": is there already and holds something else; name another folder with --out");
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + ": cannot be made: " + error.message());
  write_durably(folder / plan.cases.front().deck, plan.deck_text);
  write_durably(folder / sweep_file_name, plan.sweep_text);
  write_durably(folder / case_list_name, to_text(plan.cases));
}

}  // namespace arcwall::sweep
