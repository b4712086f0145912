#pragma once

#include "continuation/event_curves/event_system.hpp"
#include "continuation/explorer.hpp"
#include "model/checkpoint/archive.hpp"

/// The parts of the values that are kept, in their order.
namespace arcwall {

/// The last value of an enumeration.
constexpr std::int64_t greatest(Stability) { return static_cast<std::int64_t>(Stability::undecided); }
constexpr std::int64_t greatest(EventKind) { return static_cast<std::int64_t>(EventKind::user); }
constexpr std::int64_t greatest(Extremum) { return static_cast<std::int64_t>(Extremum::minimum); }
constexpr std::int64_t greatest(BranchType) { return static_cast<std::int64_t>(BranchType::multiple); }
constexpr std::int64_t greatest(ContactMode) { return static_cast<std::int64_t>(ContactMode::slips_backward); }
constexpr std::int64_t greatest(EndReason) { return static_cast<std::int64_t>(EndReason::unstable); }

constexpr std::int64_t greatest(SlidingContactLayout::Span) {
  return static_cast<std::int64_t>(SlidingContactLayout::Span::pressed);
}

template <typename Archive>
void parts(Archive& archive, SlidingContactLayout::Rubbing& rubbing) {
  archive(rubbing.mode, rubbing.w, rubbing.s, rubbing.stretch, rubbing.slipped);
}

template <typename Archive>
void parts(Archive& archive, SlidingContactLayout::Point& point) {
  archive(point.obstacle, point.behind, point.before, point.neutral_behind, point.neutral_before, point.pinch,
          point.undivided, point.rubbing);
}

template <typename Archive>
void parts(Archive& archive, MeshSegment& segment) {
  archive(segment.elements, segment.load, segment.pressed, segment.handed_on, segment.straight);
}

template <typename Archive>
void parts(Archive& archive, State& state) {
  archive(state.x, state.lambda, state.active_set);
  if constexpr (Archive::reads) archive.require(archive.model().owns(state));
}

template <typename Archive>
void parts(Archive& archive, Row& row) {
  archive(row.dx, row.dlambda);
}

template <typename Archive>
void parts(Archive& archive, EventBorder& border) {
  archive(border.column, border.row, border.scale);
}

template <typename Archive>
void parts(Archive& archive, EventSystem::Meaning& meaning) {
  archive(meaning.active_set, meaning.weights, meaning.multipliers, meaning.guards, meaning.border);
  const auto is_whole = [&](const Vector& of) { return of.size() == 0 || of.size() == meaning.weights.size(); };
  if constexpr (Archive::reads)
    archive.require(archive.model().owns(meaning.active_set) &&
                    archive.model().system->size(meaning.active_set) == meaning.weights.size() &&
                    is_whole(meaning.border.column) && is_whole(meaning.border.row.dx));
}

template <typename Archive>
void parts(Archive& archive, Direction& direction) {
  archive(direction.dx, direction.dlambda);
}

template <typename Archive>
void parts(Archive& archive, NearNull& pairs) {
  Matrix vectors = *pairs.vectors;
  archive(pairs.values, vectors);
  archive.require(pairs.values.size() == vectors.cols());
  if constexpr (Archive::reads) pairs.vectors = std::move(vectors);
}

template <typename Archive>
void parts(Archive& archive, StabilityCount& count) {
  archive(count.unstable, count.stability);
}

template <typename Archive>
void parts(Archive& archive, PathPoint& point) {
  archive(point.state, point.tangent, point.arc, point.negative_eigenvalues, point.count, point.nearest,
          point.iterations, point.residual, point.unsettled, point.guards, point.guard_rates);
  archive.require(point.guards.size() == point.guard_rates.size() || point.guard_rates.size() == 0);
  archive.require(point.tangent.dx.size() == point.state.x.size() || point.tangent.dx.size() == 0);
}

template <typename Archive>
void parts(Archive& archive, BranchPoint::Way& way) {
  archive(way.active_set, way.direction);
  if constexpr (Archive::reads)
    archive.require(archive.model().owns(State{.x = way.direction.dx, .lambda = 0.0, .active_set = way.active_set}));
}

template <typename Archive>
void parts(Archive& archive, BranchPoint& point) {
  archive(point.type, point.state, point.along, point.mode, point.modes, point.other, point.ways, point.multiplicity,
          point.change, point.lambda_uncertainty, point.mesh_artefact, point.at_corner);
  const auto fits = [&](const Direction& direction) {
    return direction.dx.size() == 0 || direction.dx.size() == point.state.x.size();
  };
  archive.require(fits(point.along) && fits(point.mode) && fits(point.other));
}

template <typename Archive>
void parts(Archive& archive, Continuum& family) {
  archive(family.parts, family.energy, family.length);
}

template <typename Archive>
void parts(Archive& archive, Event& event) {
  archive(event.kind, event.label, event.state, event.arc, event.residual, event.lambda_uncertainty, event.unconfirmed,
          event.extremum, event.unstable_before, event.unstable_after, event.guards, event.continuum, event.branching);
}

template <typename Archive>
void parts(Archive& archive, BranchEnd& end) {
  archive(end.reason, end.detail, end.partner, end.continuum);
}

template <typename Archive>
void parts(Archive& archive, Arc& arc) {
  archive(arc.to, arc.events);
}

template <typename Archive>
void parts(Archive& archive, KnownPoint& known) {
  archive(known.state, known.branch);
}

template <typename Archive>
void parts(Archive& archive, EnteredBranch& entered) {
  archive(entered.begin, entered.tangent, entered.first, entered.distance);
  archive.require(entered.tangent.dx.size() == entered.begin.x.size());
  archive.require(entered.first.x.size() == entered.begin.x.size());
}

template <typename Archive>
void parts(Archive& archive, BranchStart& start) {
  archive(start.state, start.sense, start.forward, start.entered, start.mode, start.distance, start.lambda_scale,
          start.known);
  archive.require(start.sense == 1 || start.sense == -1);
  archive.require(!start.forward || start.forward->dx.size() == start.state.x.size());
  archive.require(start.mode.dx.size() == 0 || start.mode.dx.size() == start.state.x.size());
}

template <typename Archive>
void parts(Archive& archive, BranchRecord& record) {
  archive(record.id, record.parent, record.origin, record.depth, record.sign, record.mirror_image, record.found,
          record.after_jump, record.end);
}

}  // namespace arcwall
