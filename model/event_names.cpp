#include "model/event_names.hpp"

#include <array>
#include <cassert>

namespace arcwall {

namespace {

constexpr std::array event_kinds{EventKind::start,
                                 EventKind::end,
                                 EventKind::contact_closes,
                                 EventKind::contact_opens,
                                 EventKind::contact_spreads,
                                 EventKind::contact_splits,
                                 EventKind::contact_shrinks,
                                 EventKind::contacts_merge,
                                 EventKind::contact_transfers,
                                 EventKind::contact_slips,
                                 EventKind::contact_sticks,
                                 EventKind::limit_point,
                                 EventKind::contact_limit_point,
                                 EventKind::turning_point,
                                 EventKind::value_crossing,
                                 EventKind::reversal,
                                 EventKind::branch_point,
                                 EventKind::user};

constexpr std::array end_reasons{EndReason::stop,
                                 EndReason::closed_loop,
                                 EndReason::reached_branch,
                                 EndReason::switched_branch,
                                 EndReason::jumped,
                                 EndReason::max_points,
                                 EndReason::max_time,
                                 EndReason::interrupted,
                                 EndReason::min_step,
                                 EndReason::singular,
                                 EndReason::not_finite,
                                 EndReason::no_continuation,
                                 EndReason::control_turns,
                                 EndReason::wall_end,
                                 EndReason::equilibrium_family,
                                 EndReason::not_modelled,
                                 EndReason::rigid_body_motion,
                                 EndReason::jammed,
                                 EndReason::unstable};

template <class List>
std::optional<typename List::value_type> with_text(const List& list, std::string_view text) {
  for (const auto value : list) {
    if (to_text(value) == text) return value;
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_text(EventKind kind) {
  switch (kind) {
    case EventKind::start:
      return "start";
    case EventKind::end:
      return "end";
    case EventKind::contact_closes:
      return "contact-closes";
    case EventKind::contact_opens:
      return "contact-opens";
    case EventKind::contact_spreads:
      return "contact-spreads";
    case EventKind::contact_splits:
      return "contact-splits";
    case EventKind::contact_shrinks:
      return "contact-shrinks";
    case EventKind::contacts_merge:
      return "contacts-merge";
    case EventKind::contact_transfers:
      return "contact-transfers";
    case EventKind::contact_slips:
      return "contact-slips";
    case EventKind::contact_sticks:
      return "contact-sticks";
    case EventKind::limit_point:
      return "limit-point";
    case EventKind::contact_limit_point:
      return "contact-limit-point";
    case EventKind::turning_point:
      return "turning-point";
    case EventKind::value_crossing:
      return "value-crossing";
    case EventKind::reversal:
      return "reversal";
    case EventKind::branch_point:
      return "branch-point";
    case EventKind::user:
      return "user";
  }
  assert(false);
  return {};
}

std::string_view to_text(ContactMode mode) {
  switch (mode) {
    case ContactMode::open:
      return "open";
    case ContactMode::closed:
      return "closed";
    case ContactMode::sticks:
      return "stick";
    case ContactMode::slips_forward:
      return "slip+";
    case ContactMode::slips_backward:
      return "slip-";
  }
  assert(false);
  return {};
}

std::string_view to_text(EndReason reason) {
  switch (reason) {
    case EndReason::stop:
      return "stop";
    case EndReason::closed_loop:
      return "closed_loop";
    case EndReason::reached_branch:
      return "reached_branch";
    case EndReason::switched_branch:
      return "switched_branch";
    case EndReason::jumped:
      return "jumped";
    case EndReason::max_points:
      return "max_points";
    case EndReason::max_time:
      return "max_time";
    case EndReason::interrupted:
      return "interrupted";
    case EndReason::min_step:
      return "min_step";
    case EndReason::singular:
      return "singular";
    case EndReason::not_finite:
      return "not_finite";
    case EndReason::no_continuation:
      return "no_continuation";
    case EndReason::control_turns:
      return "control_turns";
    case EndReason::wall_end:
      return "wall_end";
    case EndReason::equilibrium_family:
      return "equilibrium_family";
    case EndReason::not_modelled:
      return "not_modelled";
    case EndReason::rigid_body_motion:
      return "rigid_body_motion";
    case EndReason::jammed:
      return "jammed";
    case EndReason::unstable:
      return "unstable";
  }
  assert(false);
  return {};
}

std::string_view to_text(Stability stability) {
  switch (stability) {
    case Stability::stable:
      return "stable";
    case Stability::unstable:
      return "unstable";
    case Stability::undecided:
      return "undecided";
  }
  assert(false);
  return {};
}

std::string_view to_text(BranchType type) {
  switch (type) {
    case BranchType::pitchfork:
      return "pitchfork";
    case BranchType::transcritical:
      return "transcritical";
    case BranchType::one_sided:
      return "one-sided";
    case BranchType::multiple:
      return "multiple";
  }
  assert(false);
  return {};
}

std::string_view to_text(Extremum extremum) { return extremum == Extremum::maximum ? "maximum" : "minimum"; }

std::optional<EventKind> event_kind(std::string_view text) { return with_text(event_kinds, text); }

std::optional<EndReason> end_reason(std::string_view text) { return with_text(end_reasons, text); }

std::string_view explanation(EndReason reason) {
  switch (reason) {
    case EndReason::stop:
      return "a bound of the deck was met";
    case EndReason::closed_loop:
      return "the branch closed";
    case EndReason::reached_branch:
      return "a branch point of another branch was reached";
    case EndReason::switched_branch:
      return "the path continues along another branch";
    case EndReason::jumped:
      return "the run continues after a jump on another branch";
    case EndReason::max_points:
      return "the limit on points was met";
    case EndReason::max_time:
      return "the limit on time was met";
    case EndReason::interrupted:
      return "the run was interrupted";
    case EndReason::min_step:
      return "no step above path.min_step converges";
    case EndReason::singular:
      return "the tangent stiffness is singular";
    case EndReason::not_finite:
      return "the numbers are not finite";
    case EndReason::no_continuation:
      return "no equilibrium continues the path beyond a change of contact";
    case EndReason::control_turns:
      return "the controlled quantity turns back";
    case EndReason::wall_end:
      return "a contact reached the end of its wall";
    case EndReason::equilibrium_family:
      return "a one-parameter family of equilibria lies ahead";
    case EndReason::not_modelled:
      return "the path reaches a contact configuration that is not modelled";
    case EndReason::rigid_body_motion:
      return "an unconstrained body was moved by more than 20 times the structure's size";
    case EndReason::jammed:
      return "friction, or a support that a wall has reached, admits no motion";
    case EndReason::unstable:
      return "the structure lost its stability, and no state after a jump is known";
  }
  assert(false);
  return {};
}

std::string_view what_to_try(EndReason reason) {
  switch (reason) {
    case EndReason::stop:
    case EndReason::closed_loop:
    case EndReason::reached_branch:
    case EndReason::switched_branch:
    case EndReason::jumped:
    case EndReason::max_points:
    case EndReason::max_time:
    case EndReason::interrupted:
      return {};
    case EndReason::min_step:
      return "a finer mesh (member.NAME.elements) or a smaller path.max_step; --verbose writes steps.jsonl with the "
             "outcome of each attempted step";
    case EndReason::singular:
      return "a small imperfection, so that one branch is left; or a finer mesh";
    case EndReason::not_finite:
      return "a smaller path.max_step; check the orders of magnitude of stiffnesses and loads";
    case EndReason::no_continuation:
      return "a finer mesh, or a small imperfection: several contacts change at one point, and no continuation "
             "direction was found";
    case EndReason::control_turns:
      return "path.method = \"spherical\", which follows the path through turning points";
    case EndReason::wall_end:
      return "a longer wall, a closed outline, or a bound in path.stop before the end of the wall";
    case EndReason::equilibrium_family:
      return "a small imperfection, or path.equilibrium_family = \"symmetric\"; or contact.points = \"nodes\", and "
             "check that the loads converge with the number of elements";
    case EndReason::not_modelled:
      return "increase member.NAME.elements; if that does not help, set contact.points = \"nodes\" or contact.method = "
             "\"penalty\", and check that the loads converge with the number of elements";
    case EndReason::rigid_body_motion:
      return "a support or a wall that restrains it, or [[prescribed]] instead of the load";
    case EndReason::jammed:
      return "a stop or a reversing stage before that; less friction; a wall that ends before the support";
    case EndReason::unstable:
      return "path.branches = \"most-stable\", which follows the path through its unstable part; a small imperfection, "
             "or a wall that stops the motion";
  }
  assert(false);
  return {};
}

}  // namespace arcwall
