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

inline constexpr Words<Theory, 5> theory_words{{{"euler-bernoulli", Theory::euler_bernoulli},
                                                {"essenburg", Theory::essenburg},
                                                {"reissner", Theory::reissner},
                                                {"elastica", Theory::elastica},
                                                {"truss", Theory::truss}}};
inline constexpr Words<Dof, 3> spring_direction_words{{{"x", Dof::x}, {"z", Dof::z}, {"rotation", Dof::rotation}}};
inline constexpr Words<SpringLaw::Interpolation, 2> interpolation_words{
    {{"smooth", SpringLaw::Interpolation::smooth}, {"linear", SpringLaw::Interpolation::linear}}};
inline constexpr Words<LoadFrame, 2> frame_words{{{"global", LoadFrame::global}, {"member", LoadFrame::member}}};
inline constexpr Words<LoadMeasure, 2> per_words{{{"length", LoadMeasure::axis}, {"x", LoadMeasure::plan}}};
inline constexpr Words<MovedFrom, 2> moved_from_words{{{"rest", MovedFrom::rest}, {"stage", MovedFrom::stage}}};
inline constexpr Words<QuadraticTerm, 2> along_words{
    {{"fixed", QuadraticTerm::fixed}, {"director", QuadraticTerm::director}}};
inline constexpr Words<TrussStrain, 3> strain_words{
    {{"green", TrussStrain::green}, {"engineering", TrussStrain::engineering}, {"log", TrussStrain::log}}};
inline constexpr Words<Dof, 5> direction_words{{{"x", Dof::x},
                                                {"z", Dof::z},
                                                {"rotation", Dof::rotation},
                                                {"thickness", Dof::thickness},
                                                {"thickness2", Dof::thickness2}}};

/// Planes of symmetry across an axis, which hold that direction and the rotation.
inline constexpr Words<Dof, 2> symmetry_words{{{"symmetry-x", Dof::x}, {"symmetry-z", Dof::z}}};
inline constexpr Words<Side, 2> side_words{{{"above", Side::above}, {"below", Side::below}}};
inline constexpr Words<Keep, 2> keep_words{{{"outside", Keep::outside}, {"inside", Keep::inside}}};
inline constexpr Words<ContactSurface, 2> contact_surface_words{
    {{"face", ContactSurface::face}, {"axis", ContactSurface::axis}}};
inline constexpr Words<ContactLaw::Method, 4> contact_method_words{{{"multiplier", ContactLaw::Method::rigid},
                                                                    {"penalty", ContactLaw::Method::penalty},
                                                                    {"augmented", ContactLaw::Method::augmented},
                                                                    {"compliant", ContactLaw::Method::compliant}}};
inline constexpr Words<ContactPoints, 2> contact_points_words{
    {{"nodes", ContactPoints::nodes}, {"moving", ContactPoints::moving}}};
inline constexpr Words<FrictionAt, 2> friction_at_words{{{"touch", FrictionAt::touch}, {"axis", FrictionAt::axis}}};
inline constexpr Words<Component, 27> component_words{{{"x", Component::x},
                                                       {"z", Component::z},
                                                       {"rotation", Component::rotation},
                                                       {"face-above-z", Component::face_above_z},
                                                       {"face-below-z", Component::face_below_z},
                                                       {"reaction-x", Component::reaction_x},
                                                       {"reaction-z", Component::reaction_z},
                                                       {"reaction-moment", Component::reaction_moment},
                                                       {"axial-force", Component::axial_force},
                                                       {"moment", Component::moment},
                                                       {"force-x", Component::force_x},
                                                       {"force-z", Component::force_z},
                                                       {"friction-force", Component::friction_force},
                                                       {"friction-use", Component::friction_use},
                                                       {"dissipation", Component::dissipation},
                                                       {"slip", Component::slip},
                                                       {"gap", Component::gap},
                                                       {"contact-start", Component::contact_start},
                                                       {"contact-end", Component::contact_end},
                                                       {"max-moment", Component::max_moment},
                                                       {"max-stress", Component::max_stress},
                                                       {"utilisation", Component::utilisation},
                                                       {"greatest-pressure", Component::greatest_pressure},
                                                       {"least-pressure", Component::least_pressure},
                                                       {"mean-pressure", Component::mean_pressure},
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
inline constexpr Words<BranchPolicy, 4> branches_words{{{"primary", BranchPolicy::primary},
                                                        {"most-stable", BranchPolicy::most_stable},
                                                        {"all", BranchPolicy::all},
                                                        {"jump", BranchPolicy::jump}}};
inline constexpr Words<EventSearch, 3> events_words{
    {{"locate", EventSearch::locate}, {"detect", EventSearch::detect}, {"none", EventSearch::none}}};

inline constexpr Words<ContinuumChoice, 2> equilibrium_family_words{
    {{"symmetric", ContinuumChoice::symmetric}, {"stop", ContinuumChoice::stop}}};

inline constexpr Words<EventKind, 14> stop_event_words{{{"contact-closes", EventKind::contact_closes},
                                                        {"contact-opens", EventKind::contact_opens},
                                                        {"contact-spreads", EventKind::contact_spreads},
                                                        {"contact-splits", EventKind::contact_splits},
                                                        {"contact-shrinks", EventKind::contact_shrinks},
                                                        {"contacts-merge", EventKind::contacts_merge},
                                                        {"contact-transfers", EventKind::contact_transfers},
                                                        {"contact-slips", EventKind::contact_slips},
                                                        {"contact-sticks", EventKind::contact_sticks},
                                                        {"limit-point", EventKind::limit_point},
                                                        {"contact-limit-point", EventKind::contact_limit_point},
                                                        {"turning-point", EventKind::turning_point},
                                                        {"value-crossing", EventKind::value_crossing},
                                                        {"branch-point", EventKind::branch_point}}};

inline constexpr Words<EventKind, 10> curve_event_words{{{"limit-point", EventKind::limit_point},
                                                         {"branch-point", EventKind::branch_point},
                                                         {"contact-closes", EventKind::contact_closes},
                                                         {"contact-spreads", EventKind::contact_spreads},
                                                         {"contact-splits", EventKind::contact_splits},
                                                         {"contact-shrinks", EventKind::contact_shrinks},
                                                         {"contacts-merge", EventKind::contacts_merge},
                                                         {"contact-limit-point", EventKind::contact_limit_point},
                                                         {"turning-point", EventKind::turning_point},
                                                         {"value-crossing", EventKind::value_crossing}}};

}  // namespace arcwall::deck
