#include "elements/classic_beam_lanes.hpp"

namespace arcwall {

namespace {

using Material = ClassicBeamMaterial<Lanes>;

ARCWALL_IN_PLACE void evaluate_lanes(const Material& material, const Lanes* u, Lanes* f, Lanes* K) {
  const BasicChordMotion<Lanes> at = motion_of(material.x, material.y, material.chord, u);
  const ClassicBeamEnergy<Lanes> U(material, at);
  const BasicChordSlopes<Lanes> slopes = U.slopes();
  nodal_forces(at, slopes, f);
  if (K != nullptr) nodal_stiffness(at, slopes, U.curvatures(), K);
}

// Four lanes are two vectors of two everywhere, and one of four where the processor has them. Sums and products are
// rounded alike: no others are allowed to be joined.
#ifdef __x86_64__
[[gnu::target("avx")]] void evaluate_wide(const Material& material, const Lanes* u, Lanes* f, Lanes* K) {
  evaluate_lanes(material, u, f, K);
}
#endif

}  // namespace

ClassicBeamLanes::ClassicBeamLanes(const std::array<const ClassicBeam*, Lanes::count>& beams) {
  for (int lane = 0; lane < Lanes::count; ++lane) {
    const ClassicBeamMaterial<double>& beam = beams[static_cast<std::size_t>(lane)]->material();
    material_.x.set(lane, beam.x);
    material_.y.set(lane, beam.y);
    material_.chord.set(lane, beam.chord);
    material_.length.set(lane, beam.length);
    material_.b.set(lane, beam.b);
    material_.s.set(lane, beam.s);
    material_.c.set(lane, beam.c);
    material_.shortening.set(lane, beam.shortening);
    material_.stretching.set(lane, beam.stretching);
    material_.bending.set(lane, beam.bending);
    material_.tilting.set(lane, beam.tilting);
    material_.flexibility.set(lane, beam.flexibility);
  }
}

void ClassicBeamLanes::evaluate(const Lanes* u, Lanes* f, Lanes* K) const {
#ifdef __x86_64__
  if (has_wide_registers()) return evaluate_wide(material_, u, f, K);
#endif
  evaluate_lanes(material_, u, f, K);
}

}  // namespace arcwall
