#pragma once

#include "contact/contact_scales.hpp"
#include "elements/structure.hpp"
#include "model/deck/deck.hpp"

namespace arcwall {

/// The scales of a deck's contact. Forces below the tolerance of guards times theirs count as zero: small against what
/// λ brings in a step, above the round-off of the mesh. `held` is the structure with supports for what nothing but
/// contact holds.
ContactScales contact_scales(const deck::Deck& deck, const Structure& structure, const Structure& held,
                             double first_step);

/// See TraceOptions. No less than a force is known to.
double mesh_error_of_forces(const ContactScales& scales);

}  // namespace arcwall
