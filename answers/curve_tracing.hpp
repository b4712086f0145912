#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answers/curve_points.hpp"
#include "continuation/tracer.hpp"

namespace arcwall {

class ArchiveReader;
class ArchiveWriter;

/// Traces a deck's path up to the event that its `[curve]` names, and then that event while the number varies, first to
/// lesser values than the deck's own and then to greater ones (docs/theory.md, section 14): point by point.
class CurveTracing {
 public:
  /// Throws InputError where the deck is wrong, or has an event that cannot be followed.
  explicit CurveTracing(const deck::Deck& deck);
  CurveTracing(const CurveTracing&) = delete;
  CurveTracing& operator=(const CurveTracing&) = delete;
  ~CurveTracing();

  /// One more point, of the path or of the curve. False when the curve has both its ends, or there is none.
  bool advance();

  /// Whether that is so.
  bool has_ended() const { return stage_ == Stage::ended; }

  /// Whether the path has come to its event, so that there is a curve.
  bool has_begun() const { return stage_ != Stage::path; }

  /// Ends the curve where it is; curve() says so.
  void stop(const BranchEnd& end);

  /// What was traced so far, from the end with the least value to the other one.
  EventCurve curve() const;

  const DeckFamily& family() const { return family_; }

  /// Visits all that changes; a tracing of the same deck into which it is read goes on to the same last bit.
  void serialize(ArchiveWriter& archive);
  void serialize(ArchiveReader& archive);

 private:
  enum class Stage { path, less, greater, ended };

  // Points outwards from the event of the deck's own value, which is the first, with specials by their number.
  struct Side {
    std::vector<CurvePoint> points{};
    std::vector<CurveSpecial> specials{};

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(points, specials);
    }
  };

  // How the event is followed, as plain values.
  struct Followed {
    FollowedEvent event{};
    std::string watched{};  // what turns or passes a value there, if anything
    double lambda_scale = 1.0;
    SideCounts counts{};  // at the event

    template <typename Archive>
    void serialize(Archive& archive);
  };

  template <typename Archive>
  void visit(Archive& archive);
  bool complete(Side& side) const;
  bool has_event(const State& state) const;

  const deck::EventToFollow& asked() const { return *deck_.curve; }
  double sign() const { return stage_ == Stage::less ? -1.0 : 1.0; }
  Side& side() { return stage_ == Stage::less ? less_ : greater_; }
  bool has_room(Stage stage) const;
  void take_event(const FoundEvent& found);
  void make_system();
  TraceOptions trace_options() const;
  bool advance_side();
  void go_on_to(Stage stage);
  CurveSpecial special(const Event& event, std::size_t point) const;
  void add_end(Side& side, const BranchEnd& end, double sign) const;
  void add_ends(EventCurve& curve) const;

  deck::Deck deck_;
  deck::DeckNumber number_;
  DeckFamily family_;
  Stage stage_ = Stage::path;
  std::string problem_{};
  std::optional<BranchEnd> stopped_{};
  std::unique_ptr<EventHunt> hunt_;  // until the event is found
  Followed followed_{};              // from then on
  std::unique_ptr<EventSystem> system_{};
  std::unique_ptr<CurveReader> reader_{};
  State start_{};
  Side less_{}, greater_{};
  std::unique_ptr<Tracer> tracer_{};  // of the side under way
  SideCounts counts_{};               // of its last point
};

}  // namespace arcwall
