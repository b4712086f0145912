#pragma once

#include <memory>
#include <vector>

#include "contact/multiplier_contact.hpp"
#include "contact/sliding_contact.hpp"
#include "elements/incremental_structure.hpp"
#include "elements/kinked_springs.hpp"
#include "elements/sliding_structure.hpp"
#include "model/body.hpp"
#include "model/compliant_contact.hpp"
#include "model/deck/deck.hpp"
#include "model/loose_bodies.hpp"

namespace arcwall {

/// Stores a deck's structure with its contacts, layer on layer; system() is the outermost one. A model traces two: one
/// that λ loads, and one in which the constant loads and movements grow with λ from 0 to 1. What is null is not there.
struct Assembly {
  std::shared_ptr<const deck::Deck> deck{};  ///< whose structure and walls these are
  bool is_ramp = false;                      ///< λ scales what is constant, and nothing else acts
  LooseHolds holds{};                        ///< springs of the structure where supports do not hold it
  std::vector<Index> held{};                 ///< nodes of these
  std::unique_ptr<Structure> structure{};
  std::unique_ptr<IncrementalStructure> increments{};     ///< of load increments
  std::unique_ptr<SlidingStructure> sliding_structure{};  ///< of contact with moving points
  std::unique_ptr<MultiplierContact> contact{};           ///< at the nodes of `structure`
  std::unique_ptr<CompliantContact> compliant{};
  std::unique_ptr<SlidingContact> sliding{};
  std::unique_ptr<Body> body{};
  std::unique_ptr<KinkedSprings> kinked{};  ///< if laws of springs have kinks

  /// Adds the contact with the deck's walls. `candidates`: nodes that may touch rigid ones. `stiffness_of_holds`: of
  /// the springs that hold loose bodies [force/length].
  void add_contact(std::vector<Candidate> candidates, const ContactScales& scales, double stiffness_of_holds);

  /// Adds the view of the structure that is independent of its mesh, and the kinks of spring laws.
  void add_body();

  const System& system() const;

  /// Returns the query of the contacts; null if there are no walls.
  const ContactQuery* contacts() const;

  /// Returns the state without loads at λ = 0, from where λ goes towards a value.
  State start(double toward) const;

  /// Returns the state with the statuses of kinks; computes missing ones from the elongations.
  State with_kinks(State state) const { return kinked ? kinked->with_kinks(std::move(state)) : state; }
};

}  // namespace arcwall
