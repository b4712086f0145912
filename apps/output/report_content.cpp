#include "apps/output/report_content.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/output/branch_map_page.hpp"
#include "apps/output/library_versions.hpp"
#include "apps/output/report_head.hpp"
#include "apps/output/run_warnings.hpp"
#include "apps/output/shown_number.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/words.hpp"
#include "model/deck/writer.hpp"
#include "model/version.hpp"

namespace arcwall {

namespace {

std::optional<std::size_t> first_force(const Model& model) {
  using enum deck::Component;
  const auto is_force = [](const MonitorColumn& column) {
    const deck::Component of = column.component;
    return of == reaction_x || of == reaction_z || of == reaction_moment || of == force_x || of == force_z ||
           of == axial_force;
  };
  const auto& all = model.monitors();
  const auto found = std::find_if(all.begin(), all.end(), is_force);
  return found == all.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - all.begin()));
}

// `column: euler-bernoulli, 40 elements, E = 21000 kN/cm², A = 0.02 cm², I = 2e-05 cm⁴`
std::string member_text(const deck::Deck& deck, const deck::Member& member) {
  const auto quantity = [&](const char* name, double value, const deck::Dimension& unit) {
    return fmt::format(", {} = {}", name, with_unit(shown_number(value, 6), unit_text(unit, deck.units)));
  };
  std::string text = fmt::format("{}: {}, {}", member.name, deck::text_of(deck::theory_words, member.theory),
                                 counted(static_cast<std::size_t>(member.elements), "element", "elements"));
  if (const deck::Material* const material = find(deck.materials, member.material))
    text += quantity("E", material->E, deck::unit::stress);
  if (const deck::Section* const section = find(deck.sections, member.section)) {
    const auto add = [&](const deck::SectionProperties& of) {
      text += quantity("A", of.A, deck::unit::area);
      if (member.theory != Theory::truss) text += quantity("I", of.I, deck::unit::second_moment);
      if (of.height) text += quantity("h", *of.height, deck::unit::length);
    };
    add(properties(*section, 0.0));
    if (!tapers(*section)) return text;
    text += "; at its end";
    add(properties(*section, 1.0));
  }
  return text;
}

template <class List, class Text>
std::string listed_texts(const List& list, Text text) {
  constexpr std::size_t most = 4;
  std::string all;
  for (std::size_t i = 0; i < std::min(list.size(), most); ++i) all += (i == 0 ? "" : "; ") + text(list[i]);
  return all + (list.size() > most ? fmt::format("; and {} more", list.size() - most) : "");
}

std::vector<std::pair<std::string, std::string>> key_numbers_of(const Model& model) {
  const deck::Deck& deck = model.whole_deck();
  std::vector<std::pair<std::string, std::string>> numbers;
  const auto add = [&](const std::string& name, const std::string& value) {
    if (!value.empty()) numbers.emplace_back(name, value);
  };
  add("λ multiplies", listed_texts(driven_by_lambda(deck), [](const LoadText& load) { return load.text; }));
  add("members", listed_texts(deck.members, [&](const deck::Member& member) { return member_text(deck, member); }));
  add("walls", listed_texts(deck.walls, [](const deck::Wall& wall) { return wall.name; }));
  add("springs",
      listed_texts(deck.springs, [&](const deck::Spring& spring) { return spring_text(spring, deck.units); }));
  add("mesh", fmt::format("{}, {}", counted(static_cast<std::size_t>(model.structure().node_count()), "node", "nodes"),
                          counted(static_cast<std::size_t>(model.structure().size({})), "unknown", "unknowns")));
  for (const std::string& assignment : deck.source.assignments) add("--set", assignment);
  return numbers;
}

std::vector<std::string> turning_known(const Model& model) {
  std::vector<std::string> names;
  for (const Watch& watch : model.watched()) names.push_back(watch.label);
  return names;
}

}  // namespace

ReportContent report_content(const Model& model, const Record& record, const DrawnScenes& drawn) {
  ReportContent content{.description = model.deck().description,
                        .warning = warning_of_start(model, record),
                        .loads = driven_by_lambda(model.whole_deck()),
                        .force = first_force(model),
                        .turning_known = turning_known(model),
                        .deck_text = deck::to_toml(model.given_deck()),
                        .shapes = draw(drawn, setting_of(model)),
                        .branch_map = branch_map_section(record, branch_map_of(model, record)),
                        .key_numbers = key_numbers_of(model)};
  for (const deck::Stage& stage : model.whole_deck().stages)
    content.loads_of_stages.push_back(driven_by_lambda(model.whole_deck(), &stage));
  const auto add = [&](const std::string& name, const std::string& value) { content.facts.emplace_back(name, value); };
  add("deck", record.deck);
  for (const std::string& assignment : model.deck().source.assignments) add("--set", assignment);
  add("nodes", std::to_string(model.structure().node_count()));
  add("unknowns", std::to_string(model.structure().size({})));
  Index iterations = 0;
  for (const RecordPoint& point : record.points) iterations += point.iterations;
  add("iterations", std::to_string(iterations));
  add("trace-path", program_version());
  for (const auto& [name, version] : library_versions()) add(name, version);
  return content;
}

}  // namespace arcwall
