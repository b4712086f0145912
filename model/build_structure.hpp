#pragma once

#include <map>
#include <string>
#include <vector>

#include "elements/structure.hpp"
#include "model/deck/deck.hpp"

namespace arcwall {

/// Collects what is wrong with a deck beyond its single keys; throws all of it at once.
class DeckProblems {
 public:
  /// `source` must outlive this.
  explicit DeckProblems(const deck::Source& source) : source_(source) {}

  void add(const deck::Position& position, std::string key, std::string message, std::string cure = {}) {
    found_.push_back(deck::diagnostic_at(source_, position, std::move(key), std::move(message), std::move(cure)));
  }
  bool empty() const { return found_.empty(); }
  std::size_t count() const { return found_.size(); }

  /// Throws InputError if anything was added.
  void raise() const {
    if (!found_.empty()) throw InputError(found_);
  }

 private:
  const deck::Source& source_;
  std::vector<Diagnostic> found_;
};

/// Where a deck's names are in the structure.
class Places {
 public:
  std::map<std::string, Index> joints{}, members{};
  std::map<std::string, Index>
      rotations{};                     ///< degrees of freedom of the joints at which a member is joined without a hinge
  std::map<std::string, Vec2> ends{};  ///< where the joints stand, stress-free [length]

  /// A node of a member's mesh, or a joint.
  struct Node {
    Index node = 0;
    const MemberMesh* member = nullptr;  ///< null for a joint
    std::size_t position = 0;            ///< in the member's mesh
  };

  /// `meshes` by member index; must outlive the result.
  Node find(const deck::Place& place, const std::vector<MemberMesh>& meshes) const;
};

/// The structure of a deck, or what is wrong with it.
struct StructureOfDeck {
  StructureBuilder builder{};
  Places places{};
};

/// That of the deck, or the coarsest with the same joints.
enum class Mesh { of_deck, coarsest };

StructureOfDeck describe_structure(const deck::Deck& deck, DeckProblems& problems, Mesh mesh = Mesh::of_deck);

/// Adds a problem if the structure, in its coarsest model, can move without strain.
void check_mechanism(const deck::Deck& deck, DeckProblems& problems);

}  // namespace arcwall
