#pragma once

#include <cstdint>
#include <vector>

#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// A layout to be changed: its points, where they are and what they bear, and the elements between them.
struct LayoutEdit {
  const SlidingBody& body;
  ElementsPerSegment elements{};
  std::vector<SlidingContactLayout::Point> points{};
  std::vector<Index> strands{};        ///< of the points, ascending
  std::vector<std::uint8_t> closed{};  ///< of the points
  std::vector<double> forces{};        ///< of the points; those of open ones do not matter
  std::vector<double> frictions{};     ///< of the points, along the obstacle; likewise of those without friction
  std::vector<double> held{};          ///< the places on the obstacle that friction holds these at [length]
  Vector s{};                          ///< of the points
  SlidingContactLayout::Lying lying{};

  /// Per strand and point load whether a pressed part hands it on to its obstacle. That of a load at the edge of a part
  /// is left as it is when the layout is made.
  std::vector<std::vector<std::uint8_t>> handed_on{};

  /// Of the free ends, in the order of SlidingSetting::free_ends.
  std::vector<std::uint8_t> ends_closed{};
  std::vector<double> end_forces{};
  SlidingContactLayout::EndRubbings end_rubbings{};
  std::vector<double> end_frictions{}, ends_held{};  ///< as those of the points

  /// Elements of the segment before a point, and of that behind it.
  int& elements_before(std::size_t point) { return segment(point).elements; }
  int& elements_behind(std::size_t point) { return segment(point, 1).elements; }

  /// Lets the one element behind a point lie straight, as long as that part is flat and has no other.
  void straighten_behind(std::size_t point) { segment(point, 1).straight = true; }

  double& place(std::size_t point) { return s[static_cast<Index>(point)]; }

  /// Elements that the two segments beside a point have as one: of a point that waits, those that it found.
  int elements_without(std::size_t point);

  /// How many elements a part has that segments make up which end at points that wait: what it has without these. Also
  /// of a segment that ends at none.
  int undivided_at(Index strand, double place) const;

  /// A place with a point of its own.
  struct Entry {
    SlidingContactLayout::Point point{};
    Index strand = 0;
    double s = 0.0;
    bool closed = false;
    double force = 0.0;
  };

  /// The segment in which the entry falls becomes two of these numbers of elements, neither of them neutral unless the
  /// entry says so; which point it is now.
  std::size_t insert(const Entry& entry, int elements_before, int elements_behind);

  /// Inserts the closed edge of a zone near an end of a strand: `outer` is the span up to the end, with so many
  /// elements. Returns which point it is.
  std::size_t insert_near_end(const StrandEnd& end, double place, std::size_t obstacle,
                              SlidingContactLayout::Span outer, SlidingContactLayout::Span inner, int elements_outside,
                              double force = 0.0);

  /// The segments before and behind a point become one with so many elements.
  void erase(std::size_t point, int of_both);

  /// Takes a point out that has come to an end of its strand, so that its part is pressed on its obstacle up to there,
  /// with so many elements.
  void press_up_to_end(std::size_t point, bool last, int elements_of_part);

  /// A point that has waited is touched: the segments beside it are parts of their own from now on.
  void touch(std::size_t point);

  /// A part of a strand between its points, the nodes of its loads and its ends.
  struct Part {
    double from, to;
    std::size_t place;  ///< among the strand's segments
  };
  Part part_at(Index strand, double s) const;

  /// Gives a point load of a strand a node, which divides a segment into two with elements of one length but for
  /// rounding, or takes it.
  void give_node(Index strand, Index load);
  void take_node(Index strand, Index load);
  bool has_node(Index strand, Index load) const;

  /// Says on which obstacle a strand without points is pressed all along; empty: on none.
  void set_lying(Index strand, std::optional<std::size_t> obstacle);

  /// How far a place is inside a part that lies on a wall in this way, in elements; negative outside.
  double depth_in_part(Index strand, double s, SlidingContactLayout::Span span) const;

  /// How many elements are asked for between a place and the nearest point of its strand; empty without points.
  std::optional<double> elements_to_point(Index strand, double s) const;

 private:
  // Segments of a strand from one end to the other at points that wait, and these.
  struct Run {
    std::size_t first, last;
    double from, to;
    std::vector<std::size_t> waiting;
  };
  Run run_around(Index strand, std::size_t place) const;
  int undivided(Index strand, const Run& run) const;
  void set_undivided(const Run& run, int elements_of_all);
  void settle_undivided(Index strand, std::size_t place);

  bool is_first_of_strand(std::size_t point) const { return point == 0 || strands[point - 1] != strands[point]; }
  MeshSegment& segment(std::size_t point, std::size_t beyond = 0);
  std::size_t segment_before(std::size_t point) const;
};

/// The layout of a state, with what its points bear, before any change.
LayoutEdit edit_of(const SlidingBody& body, const SlidingState& at);

/// Takes the nodes of point loads that points have come too near to, and gives one to those that they have left. Loads
/// inside parts that lie on a wall have none: pressed parts hand them on, others with such a load are not valid.
void settle_loads(LayoutEdit& edit);

/// Gives parts of about one length equally many elements, and free parts without contacts those that are asked for,
/// where nothing but the mesh changes: what is behind a change of contacts is the same equilibrium on the same
/// elements.
void divide_evenly(LayoutEdit& edit);

/// Divides the parts beside points that wait for their first touch, and nothing else.
void divide_beside_waiting(LayoutEdit& edit);

/// The layout that has been made of one, with its loads settled and nodes in the middles of neutral spans.
std::shared_ptr<const SlidingContactLayout> layout_of(LayoutEdit edit);

}  // namespace arcwall::sliding
