#pragma once

#include "model/checkpoint/parts.hpp"
#include "model/record.hpp"

/// The parts of a record that are kept, in their order.
namespace arcwall {

template <typename Archive>
void parts(Archive& archive, ContactLabel& label) {
  archive(label.wall, label.member, label.fraction, label.tributary);
}

template <typename Archive>
void parts(Archive& archive, RecordFriction& friction) {
  archive(friction.mode, friction.force, friction.coefficient, friction.slip, friction.tangent_x, friction.tangent_z,
          friction.anchor);
}

template <typename Archive>
void parts(Archive& archive, RecordFrictionWay::Contact& contact) {
  archive(contact.label, contact.mode);
}

template <typename Archive>
void parts(Archive& archive, RecordFrictionWay& way) {
  archive(way.contacts, way.lambda_sense, way.dissipation, way.unstable, way.taken);
}

template <typename Archive>
void parts(Archive& archive, RecordSlip& slip) {
  archive(slip.contact, slip.force, slip.force_rate, slip.place.w, slip.place.s, slip.place.stretch, slip.rates.w,
          slip.rates.s, slip.rates.stretch, slip.rolls, slip.before);
}

template <typename Archive>
void parts(Archive& archive, RecordForce& force) {
  archive(force.label, force.x, force.force, force.pressure, force.friction);
}

template <typename Archive>
void parts(Archive& archive, RecordRates& rates) {
  archive(rates.lambda, rates.energy, rates.monitors);
}

template <typename Archive>
void parts(Archive& archive, RecordPoint& point) {
  archive(point.branch, point.step, point.arc, point.lambda, point.monitors, point.count, point.unstable_load_control,
          point.contacts, point.energy, point.iterations, point.residual, point.event, point.forces, point.dissipation,
          point.slips, point.rates, point.rates_after, point.state);
}

template <typename Archive>
void parts(Archive& archive, RecordContact& contact) {
  archive(contact.label, contact.x, contact.force, contact.friction);
}

template <typename Archive>
void parts(Archive& archive, RecordSensitivity& sensitivity) {
  archive(sensitivity.key, sensitivity.value, sensitivity.slope, sensitivity.rates, sensitivity.why_none);
}

template <typename Archive>
void parts(Archive& archive, RecordStretch& stretch) {
  archive(stretch.label, stretch.is_zone, stretch.force);
}

/// What a record alone owns is kept as what may be missing.
template <typename T, typename Archive>
void keep_owned(Archive& archive, std::shared_ptr<const T>& owned) {
  std::optional<T> value;
  if (owned) value = *owned;
  archive(value);
  if constexpr (Archive::reads) owned = value ? std::make_shared<const T>(std::move(*value)) : nullptr;
}

template <typename Archive>
void parts(Archive& archive, RecordReturn& back);

template <typename Archive>
void parts(Archive& archive, RecordJump& jump) {
  archive(jump.reason, jump.why, jump.lambda, jump.monitors, jump.contacts, jump.contact_pattern, jump.energy,
          jump.energy_released, jump.unstable, jump.on_branch, jump.arc, jump.point, jump.energy_dissipated,
          jump.destinations, jump.state);
  keep_owned(archive, jump.on_return);
}

template <typename Archive>
void parts(Archive& archive, RecordReturn& back) {
  archive(back.lambda, back.kind, back.monitors);
  keep_owned(archive, back.jump);
}

template <typename Archive>
void parts(Archive& archive, RecordEvent& event) {
  archive(event.id, event.kind, event.branch, event.step, event.arc, event.lambda, event.monitors,
          event.unstable_before, event.unstable_after, event.unstable_load_control, event.residual,
          event.lambda_uncertainty, event.contacts, event.extremum, event.monitor, event.value, event.branch_end,
          event.branch_type, event.multiplicity, event.unconfirmed, event.mesh_artefact, event.branches, event.mode,
          event.sensitivity, event.continuum, event.ways, event.all_ways_known);
  keep_owned(archive, event.jump);
}

template <typename Archive>
void parts(Archive& archive, RecordBranchPoint& point) {
  archive(point.point, point.event);
}

template <typename Archive>
void parts(Archive& archive, RecordBranch& branch) {
  archive(branch.id, branch.stage, branch.parent, branch.origin, branch.mirror_image, branch.found, branch.after_jump,
          branch.points, branch.least_lambda, branch.greatest_lambda, branch.end);
}

constexpr std::int64_t greatest(FoundFate) { return static_cast<std::int64_t>(FoundFate::not_traced); }

template <typename Archive>
void parts(Archive& archive, RecordFound& found) {
  archive(found.contact_pattern, found.monitors, found.energy, found.unstable, found.fate, found.branches);
}

template <typename Archive>
void parts(Archive& archive, RecordSearch& search) {
  archive(search.lambda, search.known);
  for (Index& tries : search.outcomes) archive(tries);
  archive(search.found);
}

}  // namespace arcwall
