#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/deck/deck.hpp"

/// The words a deck has for each choice, for reading and for writing.
namespace arcwall::deck {

template <class Enum, std::size_t count>
using Words = std::array<std::pair<std::string_view, Enum>, count>;

template <class Enum, std::size_t count>
std::optional<Enum> from_text(const Words<Enum, count>& words, std::string_view text) {
  for (const auto& [word, value] : words) {
    if (word == text) return value;
  }
  return std::nullopt;
}

/// `value` must be among the words.
template <class Enum, std::size_t count>
std::string text_of(const Words<Enum, count>& words, Enum value) {
  std::string_view text = words.front().first;
  for (const auto& [word, candidate] : words) {
    if (candidate == value) text = word;
  }
  return std::string(text);
}

template <class Enum, std::size_t count>
std::vector<std::string> texts(const Words<Enum, count>& words) {
  std::vector<std::string> result;
  for (const auto& word : words) result.emplace_back(word.first);
  return result;
}

enum class ImperfectionWord { sine };

inline constexpr Words<ImperfectionWord, 1> imperfection_words{{{"sine", ImperfectionWord::sine}}};

inline constexpr Words<Theory, 5> theory_words{{{"classic", Theory::classic},
                                                {"essenburg", Theory::essenburg},
                                                {"exact", Theory::exact},
                                                {"elastica", Theory::elastica},
                                                {"truss", Theory::truss}}};
inline constexpr Words<Along, 2> along_words{{{"fixed", Along::fixed}, {"director", Along::director}}};
inline constexpr Words<Strain, 3> strain_words{
    {{"green", Strain::green}, {"engineering", Strain::engineering}, {"log", Strain::log}}};
inline constexpr Words<Direction, 5> direction_words{{{"x", Direction::x},
                                                      {"z", Direction::z},
                                                      {"rotation", Direction::rotation},
                                                      {"thickness", Direction::thickness},
                                                      {"thickness2", Direction::thickness2}}};
inline constexpr Words<Side, 2> side_words{{{"above", Side::above}, {"below", Side::below}}};
inline constexpr Words<ActsOn, 2> acts_on_words{{{"face", ActsOn::face}, {"axis", ActsOn::axis}}};
inline constexpr Words<ContactMethod, 3> contact_method_words{{{"multiplier", ContactMethod::multiplier},
                                                               {"penalty", ContactMethod::penalty},
                                                               {"augmented", ContactMethod::augmented}}};
inline constexpr Words<ContactPoints, 2> contact_points_words{
    {{"nodes", ContactPoints::nodes}, {"sliding", ContactPoints::sliding}}};
inline constexpr Words<Component, 12> component_words{{{"x", Component::x},
                                                       {"z", Component::z},
                                                       {"rotation", Component::rotation},
                                                       {"face-above-z", Component::face_above_z},
                                                       {"face-below-z", Component::face_below_z},
                                                       {"reaction-x", Component::reaction_x},
                                                       {"reaction-z", Component::reaction_z},
                                                       {"reaction-moment", Component::reaction_moment},
                                                       {"axial-force", Component::axial_force},
                                                       {"moment", Component::moment},
                                                       {"thickness", Component::thickness},
                                                       {"thickness2", Component::thickness2}}};
inline constexpr Words<Component, 3> control_words{
    {{"x", Component::x}, {"z", Component::z}, {"rotation", Component::rotation}}};
inline constexpr Words<PathMethod, 8> path_method_words{{{"load", PathMethod::load},
                                                         {"displacement", PathMethod::displacement},
                                                         {"riks", PathMethod::riks},
                                                         {"normal-plane", PathMethod::normal_plane},
                                                         {"cylindrical", PathMethod::cylindrical},
                                                         {"spherical", PathMethod::spherical},
                                                         {"pseudo-arclength", PathMethod::pseudo_arclength},
                                                         {"incremental", PathMethod::incremental}}};
inline constexpr Words<Branches, 3> branches_words{
    {{"primary", Branches::primary}, {"follow", Branches::follow}, {"all", Branches::all}}};
inline constexpr Words<Events, 3> events_words{
    {{"locate", Events::locate}, {"detect", Events::detect}, {"none", Events::none}}};

inline constexpr Words<StopEvent, 8> stop_event_words{{{"contact-closes", StopEvent::contact_closes},
                                                       {"contact-opens", StopEvent::contact_opens},
                                                       {"contact-spreads", StopEvent::contact_spreads},
                                                       {"contact-gathers", StopEvent::contact_gathers},
                                                       {"limit-point", StopEvent::limit_point},
                                                       {"contact-limit-point", StopEvent::contact_limit_point},
                                                       {"displacement-limit", StopEvent::displacement_limit},
                                                       {"branch-point", StopEvent::branch_point}}};

}  // namespace arcwall::deck
