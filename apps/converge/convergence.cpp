#include "apps/converge/convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "answers/sessions.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/writer.hpp"
#include "model/event_names.hpp"
#include "model/model.hpp"

namespace arcwall {

namespace {

constexpr double nearest_other = 0.1;     // parts of a range by which one event may differ from mesh to mesh
constexpr double stiffer_springs = 10.0;  // of walls, in the run that tells how far they give way
constexpr double roundoff = 1e-12;        // of λ, what Newton's method leaves

std::vector<std::size_t> located(const Record& record) {
  std::vector<std::size_t> events;
  for (std::size_t i = 0; i < record.events.size(); ++i)
    if (record.events[i].kind != EventKind::start && record.events[i].kind != EventKind::end) events.push_back(i);
  return events;
}

// The ranges of λ and of the monitors on the path, by which events are told apart.
struct Ranges {
  double lambda = 1.0;
  std::vector<double> monitors{};
  std::vector<double> roundoff{};  // of the monitors
};

Ranges ranges_of(const Record& record) {
  const auto range = [&](auto value) {
    double least = infinity, most = -infinity;
    for (const RecordPoint& point : record.points) {
      least = std::min(least, value(point));
      most = std::max(most, value(point));
    }
    return most > least ? most - least : 1.0;
  };
  Ranges ranges{.lambda = range([](const RecordPoint& point) { return point.lambda; })};
  for (std::size_t i = 0; i < record.columns.size(); ++i) {
    ranges.monitors.push_back(range([i](const RecordPoint& point) { return point.monitors[i]; }));
    ranges.roundoff.push_back(record.columns[i].roundoff);
  }
  return ranges;
}

std::vector<std::string> walls_of(const RecordEvent& event) {
  std::vector<std::string> walls;
  for (const RecordContact& contact : event.contacts) walls.push_back(contact.label.wall);
  std::sort(walls.begin(), walls.end());
  walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
  return walls;
}

// The greatest difference of two events as a part of its range; infinite where they are of different kinds.
double distance(const RecordEvent& a, const RecordEvent& b, const Ranges& ranges) {
  if (a.kind != b.kind || a.monitor != b.monitor || a.value != b.value || walls_of(a) != walls_of(b)) return infinity;
  double greatest = std::abs(a.lambda - b.lambda) / ranges.lambda;
  for (std::size_t i = 0; i < a.monitors.size(); ++i)
    if (const double apart = std::abs(a.monitors[i] - b.monitors[i]); apart > ranges.roundoff[i])
      greatest = std::max(greatest, apart / ranges.monitors[i]);
  return greatest;
}

deck::Deck with_elements(const deck::Deck& deck, const std::vector<int>& elements) {
  deck::Deck finer = without_answers(deck);
  for (std::size_t i = 0; i < finer.members.size(); ++i) finer.members[i].elements = elements[i];
  return deck::read_deck_text(deck::to_toml(finer), deck.source.file);
}

std::vector<int> elements_of(const deck::Deck& deck) {
  std::vector<int> elements;
  for (const deck::Member& member : deck.members) elements.push_back(member.elements);
  return elements;
}

// Bars are straight: a second element would make them mechanisms.
bool can_be_divided(const deck::Member& member) { return member.theory != Theory::truss; }

// A whole part of each member's elements, if that makes a deck: all its places must stay nodes, for one.
std::optional<std::vector<int>> coarser(const deck::Deck& deck, int factor) {
  std::vector<int> elements = elements_of(deck);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!can_be_divided(deck.members[i])) continue;
    if (elements[i] % factor != 0) return std::nullopt;
    elements[i] /= factor;
  }
  try {
    const Model model(with_elements(deck, elements));
  } catch (const InputError&) {
    return std::nullopt;
  }
  return elements;
}

std::vector<int> finer(const deck::Deck& deck, std::vector<int> elements, int factor) {
  constexpr int most = 1'000'000;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!can_be_divided(deck.members[i])) continue;
    if (elements[i] > most / factor)
      throw InputError(fmt::format("a mesh would have more than {} elements in a member; ask for fewer levels", most));
    elements[i] *= factor;
  }
  return elements;
}

// False if it was stopped.
bool trace(const deck::Deck& deck, const MeshStudy& study, MeshRun& run) {
  Session session = make_session({.deck = deck.source.file, .deck_text = deck::to_toml(deck)});
  if (!session.begin()) run.problem = session.problem();
  while (run.problem.empty() && session.next() != nullptr)
    if (study.stopped && study.stopped()) return false;
  run.record = session.record();
  return true;
}

bool has_springs_for_walls(const deck::Deck& deck) {
  return !deck.walls.empty() && deck.contact.method == ContactLaw::Method::penalty && deck.contact.penalty;
}

deck::Deck with_stiffer_springs(deck::Deck deck) {
  deck.contact.penalty = stiffer_springs * *deck.contact.penalty;
  return deck;
}

// Whether a contact has slipped before an event, or slips from there on.
bool is_behind_a_slip(const Record& record, const RecordEvent& event) {
  const auto begins_to_slip = [](const RecordContact& contact) {
    return contact.friction && slips(contact.friction->mode);
  };
  return std::any_of(record.events.begin(), record.events.end(), [&](const RecordEvent& before) {
    return before.id < event.id && std::any_of(before.contacts.begin(), before.contacts.end(), begins_to_slip);
  });
}

void compare(const Convergence& study, bool has_stiffer, bool behind_a_slip, ConvergedValue& of) {
  std::vector<double> values;
  for (const auto& value : of.on_mesh)
    if (value) values.push_back(*value);
  if (values.empty()) return;
  const bool gaps = std::adjacent_find(of.on_mesh.begin(), of.on_mesh.end(), [](const auto& a, const auto& b) {
                      return a.has_value() && !b.has_value();
                    }) != of.on_mesh.end();
  const double unsure = std::max(of.uncertainty, roundoff * std::abs(values.back()));
  if (behind_a_slip) {
    of.limit = {.value = values.back(), .irregular = "it depends on the way that led there"};
  } else if (gaps) {
    of.limit = {.value = values.back(), .irregular = "not on every finer mesh"};
  } else {
    of.limit = extrapolated(values, study.factor, unsure);
  }
  if (of.penalty && of.limit.error) *of.limit.error += *of.penalty;
  if (has_stiffer && !of.penalty) {  // how far the springs give way is not known
    of.limit.error.reset();
    if (of.limit.irregular.empty()) of.limit.irregular = "not with stiffer springs";
  }
  if (const auto& own = of.on_mesh[study.own_mesh]; own && of.limit.error)
    of.error_of_deck = std::abs(of.limit.value - *own) + *of.limit.error;
}

// One event with all that match it; `of` is the mesh that has it.
ConvergedEvent gathered(const Convergence& study, std::size_t of, std::size_t event,
                        const std::vector<std::vector<std::optional<std::size_t>>>& on) {
  ConvergedEvent one{.event = study.meshes[of].record.events[event]};
  const std::size_t meshes = study.meshes.size();
  one.lambda.on_mesh.resize(meshes);
  one.monitors.resize(one.event.monitors.size());
  for (ConvergedValue& monitor : one.monitors) monitor.on_mesh.resize(meshes);
  for (std::size_t mesh = 0; mesh < meshes; ++mesh) {
    const auto index = mesh == of ? std::optional(event) : mesh < of ? on[mesh][event] : std::nullopt;
    if (!index) continue;
    const Record& record = study.meshes[mesh].record;
    const RecordEvent& same = record.events[*index];
    const Ranges ranges = ranges_of(record);
    one.lambda.on_mesh[mesh] = same.lambda;
    one.lambda.uncertainty = std::max(one.lambda.uncertainty, same.lambda_uncertainty);
    for (std::size_t i = 0; i < one.monitors.size(); ++i) {
      if (!std::isfinite(same.monitors[i])) continue;
      // A monitor is as uncertain as λ, as a part of its range, and its round-off is that of the range.
      const double part = same.lambda_uncertainty / ranges.lambda + roundoff;
      one.monitors[i].on_mesh[mesh] = same.monitors[i];
      one.monitors[i].uncertainty = std::max(one.monitors[i].uncertainty, part * ranges.monitors[i]);
    }
  }
  return one;
}

}  // namespace

// Pairs are chosen so that their order is kept and the sum of their distances, with a price for each event left alone,
// is least.
std::vector<std::optional<std::size_t>> matched(const Record& record, const Record& other) {
  const std::vector<std::size_t> a = located(record), b = located(other);
  const Ranges ranges = ranges_of(record);
  const auto pair_cost = [&](std::size_t i, std::size_t j) {
    const double d = distance(record.events[a[i]], other.events[b[j]], ranges);
    return d <= nearest_other ? d : infinity;
  };
  std::vector<std::vector<double>> cost(a.size() + 1, std::vector<double>(b.size() + 1, 0.0));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i + j == 0) continue;
      cost[i][j] = infinity;
      if (i > 0) cost[i][j] = std::min(cost[i][j], cost[i - 1][j] + nearest_other);
      if (j > 0) cost[i][j] = std::min(cost[i][j], cost[i][j - 1] + nearest_other);
      if (i > 0 && j > 0) cost[i][j] = std::min(cost[i][j], cost[i - 1][j - 1] + pair_cost(i - 1, j - 1));
    }
  std::vector<std::optional<std::size_t>> match(record.events.size());
  for (std::size_t i = a.size(), j = b.size(); i > 0 && j > 0;) {
    if (cost[i][j] == cost[i - 1][j - 1] + pair_cost(i - 1, j - 1)) {
      match[a[--i]] = b[--j];
    } else if (cost[i][j] == cost[i - 1][j] + nearest_other) {
      --i;
    } else {
      --j;
    }
  }
  return match;
}

namespace {

void compare_events(Convergence& study, const std::optional<Record>& stiffer) {
  const std::size_t meshes = study.meshes.size();
  std::vector<std::vector<bool>> taken(meshes);
  for (std::size_t mesh = 0; mesh < meshes; ++mesh) taken[mesh].resize(study.meshes[mesh].record.events.size());
  for (std::size_t of = meshes; of-- > 0;) {  // events that only coarser meshes have come last
    const Record& record = study.meshes[of].record;
    std::vector<std::vector<std::optional<std::size_t>>> on;
    for (std::size_t mesh = 0; mesh < of; ++mesh) on.push_back(matched(record, study.meshes[mesh].record));
    std::map<EventKind, Index> numbers;
    for (const std::size_t event : located(record)) {
      const Index number = ++numbers[record.events[event].kind];
      if (taken[of][event]) continue;
      ConvergedEvent one = gathered(study, of, event, on);
      one.number = number;
      one.behind_a_slip = is_behind_a_slip(record, one.event);
      for (std::size_t mesh = 0; mesh < of; ++mesh)
        if (on[mesh][event]) taken[mesh][*on[mesh][event]] = true;
      study.events.push_back(std::move(one));
    }
  }
  const Record& own = study.meshes[study.own_mesh].record;
  const auto on_stiffer = stiffer ? matched(own, *stiffer) : std::vector<std::optional<std::size_t>>();
  for (ConvergedEvent& one : study.events) {
    for (std::size_t i = 0; stiffer && i < own.events.size(); ++i)
      if (own.events[i].kind == one.event.kind && own.events[i].lambda == one.lambda.on_mesh[study.own_mesh] &&
          on_stiffer[i]) {
        const RecordEvent& there = stiffer->events[*on_stiffer[i]];
        const auto penalty = [](double soft, double stiff) {  // it goes with one over the stiffness
          return std::abs(stiff - soft) / (1.0 - 1.0 / stiffer_springs);
        };
        one.lambda.penalty = penalty(own.events[i].lambda, there.lambda);
        for (std::size_t k = 0; k < one.monitors.size(); ++k)
          one.monitors[k].penalty = penalty(own.events[i].monitors[k], there.monitors[k]);
      }
    compare(study, stiffer.has_value(), one.behind_a_slip, one.lambda);
    for (ConvergedValue& monitor : one.monitors) compare(study, stiffer.has_value(), one.behind_a_slip, monitor);
  }
}

}  // namespace

std::optional<Convergence> converge(const deck::Deck& deck, const MeshStudy& study) {
  Convergence found{.deck = std::filesystem::path(deck.source.file).filename().string(),
                    .title = deck.title,
                    .factor = static_cast<double>(study.factor)};
  for (const deck::Member& member : deck.members) found.members.push_back(member.name);
  const auto coarse = coarser(deck, study.factor);
  if (!coarse)
    found.notes.push_back(
        fmt::format("The first mesh is the deck's own: with one {}th of its elements for each member there is no deck.",
                    study.factor));
  std::vector<int> elements = coarse.value_or(elements_of(deck));
  double times = coarse ? 1.0 / study.factor : 1.0;
  found.own_mesh = coarse ? 1 : 0;
  for (int level = 0; level < study.levels; ++level) {
    MeshRun& run = found.meshes.emplace_back(MeshRun{.times = times, .elements = elements});
    if (study.begins) study.begins(run);
    if (!trace(with_elements(deck, elements), study, run)) return std::nullopt;
    if (level + 1 < study.levels) elements = finer(deck, std::move(elements), study.factor);
    times *= study.factor;
  }
  std::optional<Record> stiffer;
  if (has_springs_for_walls(deck)) {
    MeshRun run;
    const deck::Deck own = with_elements(deck, found.meshes[found.own_mesh].elements);
    if (!trace(with_stiffer_springs(own), study, run)) return std::nullopt;
    stiffer = std::move(run.record);
    found.notes.emplace_back(
        "Walls are springs: the error includes their compression, from a run with springs ten times as stiff.");
  }
  found.columns = found.meshes.back().record.columns;
  compare_events(found, stiffer);
  return found;
}

}  // namespace arcwall
