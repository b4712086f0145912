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
                                 EventKind::contact_gathers,
                                 EventKind::contact_passes,
                                 EventKind::limit_point,
                                 EventKind::contact_limit_point,
                                 EventKind::displacement_limit,
                                 EventKind::branch_point,
                                 EventKind::user};

constexpr std::array end_reasons{
    EndReason::stop,       EndReason::closed_loop, EndReason::joined,      EndReason::branched,
    EndReason::max_points, EndReason::max_time,    EndReason::interrupted, EndReason::min_step,
    EndReason::singular,   EndReason::not_finite,  EndReason::no_ray,      EndReason::turning_control,
    EndReason::wall_end,   EndReason::continuum,   EndReason::unsupported, EndReason::adrift};

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
    case EventKind::contact_gathers:
      return "contact-gathers";
    case EventKind::contact_passes:
      return "contact-passes";
    case EventKind::limit_point:
      return "limit-point";
    case EventKind::contact_limit_point:
      return "contact-limit-point";
    case EventKind::displacement_limit:
      return "displacement-limit";
    case EventKind::branch_point:
      return "branch-point";
    case EventKind::user:
      return "user";
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
    case EndReason::joined:
      return "joined";
    case EndReason::branched:
      return "branched";
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
    case EndReason::no_ray:
      return "no_ray";
    case EndReason::turning_control:
      return "turning_control";
    case EndReason::wall_end:
      return "wall_end";
    case EndReason::continuum:
      return "family";
    case EndReason::unsupported:
      return "unsupported";
    case EndReason::adrift:
      return "adrift";
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
    case BranchType::symmetric:
      return "symmetric";
    case BranchType::asymmetric:
      return "asymmetric";
    case BranchType::one_sided:
      return "one-sided";
    case BranchType::undetermined:
      return "undetermined";
  }
  assert(false);
  return {};
}

std::optional<EventKind> event_kind(std::string_view text) { return with_text(event_kinds, text); }

std::optional<EndReason> end_reason(std::string_view text) { return with_text(end_reasons, text); }

bool changes_contact(EventKind kind) {
  switch (kind) {
    case EventKind::contact_closes:
    case EventKind::contact_opens:
    case EventKind::contact_spreads:
    case EventKind::contact_gathers:
    case EventKind::contact_passes:
      return true;
    case EventKind::start:
    case EventKind::end:
    case EventKind::limit_point:
    case EventKind::contact_limit_point:
    case EventKind::displacement_limit:
    case EventKind::branch_point:
    case EventKind::user:
      return false;
  }
  assert(false);
  return false;
}

std::string_view explanation(EndReason reason) {
  switch (reason) {
    case EndReason::stop:
      return "a bound of the deck was met";
    case EndReason::closed_loop:
      return "the branch closed";
    case EndReason::joined:
      return "a branch point of another branch was reached";
    case EndReason::branched:
      return "the path goes on along another branch";
    case EndReason::max_points:
      return "the limit on points was met";
    case EndReason::max_time:
      return "the limit on time was met";
    case EndReason::interrupted:
      return "the run was interrupted";
    case EndReason::min_step:
      return "no step above the least length succeeds";
    case EndReason::singular:
      return "the equations are singular";
    case EndReason::not_finite:
      return "the numbers are not finite";
    case EndReason::no_ray:
      return "no equilibrium leaves a change of contact";
    case EndReason::turning_control:
      return "the controlled quantity turns back";
    case EndReason::wall_end:
      return "a contact reached the end of its wall";
    case EndReason::continuum:
      return "a continuum of equilibria lies ahead";
    case EndReason::unsupported:
      return "something lies ahead that is not modelled";
    case EndReason::adrift:
      return "a body that nothing holds was pushed away";
  }
  assert(false);
  return {};
}

std::string_view what_to_try(EndReason reason) {
  switch (reason) {
    case EndReason::stop:
    case EndReason::closed_loop:
    case EndReason::joined:
    case EndReason::branched:
    case EndReason::max_points:
    case EndReason::max_time:
    case EndReason::interrupted:
      return {};
    case EndReason::min_step:
      return "a finer mesh (member.NAME.elements), or a smaller path.max_step; --verbose writes steps.jsonl, which "
             "says why each step was cut back";
    case EndReason::singular:
      return "a small imperfection, so that the path has one way on; or a finer mesh";
    case EndReason::not_finite:
      return "a smaller path.max_step; look whether a stiffness or a load of the deck is off by powers of ten";
    case EndReason::no_ray:
      return "a finer mesh, or a small imperfection: several contacts change at one place and none of the ways on "
             "holds";
    case EndReason::turning_control:
      return "path.method = \"spherical\", which follows the path through turning points";
    case EndReason::wall_end:
      return "a longer wall, an outline that goes all around, or a bound in path.stop before its end";
    case EndReason::continuum:
      return "a small imperfection, which singles one equilibrium of the continuum out; or contact.points = \"nodes\", "
             "where loads depend on the mesh: compare several numbers of elements";
    case EndReason::unsupported:
      return "more elements for the members (member.NAME.elements), where they bend much in one; else contact.points = "
             "\"nodes\" or contact.method = \"penalty\", which have no such limit, but contact at nodes: loads then "
             "depend on the mesh, so compare several numbers of elements";
    case EndReason::adrift:
      return "a support or a wall that holds the body there; or [[prescribed]], which moves it instead of a load";
  }
  assert(false);
  return {};
}

}  // namespace arcwall
