#include "answers/search.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "answers/contact_pattern.hpp"
#include "answers/element_slopes.hpp"
#include "answers/path_at_lambda.hpp"
#include "continuation/equilibria/deflated_newton.hpp"
#include "continuation/equilibria/equilibrium_at.hpp"
#include "continuation/tracer.hpp"
#include "core/algebra/near_null.hpp"
#include "core/nearly_equal.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

// All lengths in the path metric of the deck's mesh.
constexpr Index modes_of_each = 6;  // equilibrium known
constexpr double least_push = 0.02, greatest_push = 0.5;

bool is_one(const DeckMesh& mesh, const CountedState& a, const CountedState& b) {
  return a.count.unstable == b.count.unstable &&
         mesh.distance(mesh.unknowns(a.state), mesh.unknowns(b.state)) <= mesh.same_on_path();
}

// Whether the mesh tells how the body bends: else the state may be none of the body.
bool is_resolved(const Model& model, const State& state) {
  return greatest_slope(model, state) <= greatest_resolved_slope;
}

// Numbers from a seed that are the same everywhere: the standard fixes the engine, not the distributions.
class Draws {
 public:
  Draws(int seed, Index number) {
    std::seed_seq from{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(number)};
    engine_.seed(from);
  }

  double between(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(between(0.0, double(count))));
  }
  double sign() { return (engine_() >> 63) != 0 ? 1.0 : -1.0; }

 private:
  std::mt19937_64 engine_;
};

// The equilibria of a structure at one λ, known and found.
class SearchAt {
 public:
  SearchAt(const Model& model, RecordSearch& record, Draws draws)
      : model_(model),
        record_(record),
        mesh_(model),
        mirror_(model.structure()),
        newton_(mesh_.system(), DeflatedNewton::Contacts::follow, model.options().factorization),
        draws_(draws) {}

  // An equilibrium of a traced branch.
  void add_known(const CountedState& state) {
    const OfShape known = shape_of(state);
    if (is_known(known)) return;  // λ is that of a point, where two segments meet
    ++record_.known;
    known_.push_back(known);
    add_images(add_source(of_nodes(known.x)), {known});
  }

  // One of a branch that is not known better.
  void add_known_about(const Vector& x) {
    nearly_known_.push_back(x);
    ++record_.known;
    add_images(add_source(of_nodes(nearly_known_.back())), {});
  }

  // What is found by so many guesses, and by the images of what is known.
  std::vector<CountedState> look(int tries) {
    sources_.push_back({.state = nodal(Vector::Zero(mesh_.size()))});
    for (int i = 0; i < tries; ++i) {
      try_images();
      attempt(guess());
    }
    try_images();
    return std::move(found_);
  }

 private:
  // Where guesses begin.
  struct Source {
    State state{};
    std::optional<Matrix> modes{};
  };

  // An equilibrium of the path by what tells it from others.
  struct OfShape {
    Vector x{};
    std::optional<Index> unstable{};
  };

  OfShape shape_of(const CountedState& one) const {
    return {.x = mesh_.unknowns(one.state), .unstable = one.count.unstable};
  }

  State nodal(const Vector& x) const { return mesh_.state(x, record_.lambda); }
  Vector unknowns(const State& nodal) const { return nodal.x.head(mesh_.size()); }

  // The equilibrium of nodes beside one of the path, or that itself where there is none.
  State of_nodes(const Vector& x) const {
    DeflatedNewton plain(mesh_.system(), DeflatedNewton::Contacts::follow, model_.options().factorization);
    const DeflatedResult result = plain.from(nodal(x));
    const bool is_near =
        result.end == DeflatedEnd::arrived && mesh_.distance(unknowns(result.state), x) <= mesh_.same_of_nodes();
    return is_near ? result.state : nodal(x);
  }

  const State& add_source(const State& of_nodes) {
    newton_.deflate(unknowns(of_nodes));
    sources_.push_back({.state = of_nodes});
    return sources_.back().state;
  }

  // The images of an equilibrium of nodes: those that are equilibria themselves are known with it, and so are those of
  // the equilibria of the path that belong to it; the others are guesses.
  void add_images(const State& of_nodes, const std::vector<OfShape>& of_path) {
    const std::vector<Vector> images = mirror_.of(of_nodes);
    for (std::size_t i = 0; i < images.size(); ++i) {
      const auto exact = newton_.beside(nodal(images[i]));
      if (!exact) {
        images_.push_back(images[i]);
        continue;
      }
      for (const OfShape& one : of_path) known_.push_back({.x = mirror_.of(nodal(one.x))[i], .unstable = one.unstable});
      if (newton_.is_known(*exact)) continue;  // it is its own image
      newton_.deflate(unknowns(*exact));
      count(SearchOutcome::mirror_image);
    }
  }

  bool is_known(const OfShape& shape) const {
    const auto is_it = [&](const OfShape& known) {
      return known.unstable == shape.unstable && mesh_.distance(known.x, shape.x) <= mesh_.same_on_path();
    };
    const auto is_near = [&](const Vector& x) { return mesh_.distance(x, shape.x) <= mesh_.same_of_nodes(); };
    return std::any_of(known_.begin(), known_.end(), is_it) ||
           std::any_of(nearly_known_.begin(), nearly_known_.end(), is_near);
  }

  void try_images() {
    while (!images_.empty()) {
      const Vector image = std::move(images_.back());
      images_.pop_back();
      attempt(image);
    }
  }

  void count(SearchOutcome outcome) { ++record_.outcomes[static_cast<std::size_t>(outcome)]; }

  void attempt(const Vector& guess) {
    const DeflatedResult result = newton_.from(nodal(guess));
    if (result.end == DeflatedEnd::not_found) return count(SearchOutcome::not_found);
    if (result.end == DeflatedEnd::known) return count(SearchOutcome::known);
    const std::vector<CountedState> there = in_path_formulation(result.state);
    std::vector<OfShape> added;
    bool is_of_mesh = there.empty();
    for (const CountedState& one : there) {
      const OfShape shape = shape_of(one);
      if (is_known(shape)) continue;
      if (!is_resolved(model_, one.state)) {
        is_of_mesh = true;
        continue;
      }
      found_.push_back(one);
      known_.push_back(shape);
      added.push_back(shape);
    }
    if (added.empty()) {
      newton_.deflate(unknowns(result.state));
      return count(is_of_mesh ? SearchOutcome::nodes_only : SearchOutcome::known);
    }
    count(SearchOutcome::found);
    add_images(add_source(result.state), added);
  }

  // The equilibria of the path to which one of nodes leads, counted: the likeliest first.
  std::vector<CountedState> in_path_formulation(const State& nodes) const {
    constexpr int roots = 3;  // with the contacts of a guess: those that pull or enter obstacles are none of the path
    std::vector<CountedState> found;
    const bool slides = model_.sliding() != nullptr;
    for (const State& guess :
         slides ? mesh_.in_path_formulation(nodes) : std::vector<State>{model_.with_kinks(nodes)}) {
      DeflatedNewton newton(model_.system(), DeflatedNewton::Contacts::keep, model_.options().factorization);
      for (int i = 0; i < roots; ++i) {
        const DeflatedResult root = newton.from(guess);
        if (root.end != DeflatedEnd::arrived) break;
        newton.deflate(root.state.x);
        if (auto there = equilibrium_at_lambda(model_.system(), root.state, model_.options()))
          found.push_back(std::move(*there));
        if (!slides) break;
      }
    }
    return found;
  }

  // A source, pushed along one or two of its modes.
  Vector guess() {
    Source& source = sources_[draws_.below(sources_.size())];
    Vector x = unknowns(source.state);
    if (!source.modes) source.modes = modes(x);
    const auto modes_known = static_cast<std::size_t>(source.modes->cols());
    for (std::size_t left = 1 + draws_.below(2); left > 0 && modes_known > 0; --left) {
      const double push = least_push * std::pow(greatest_push / least_push, draws_.between(0.0, 1.0));
      x += draws_.sign() * push * source.modes->col(static_cast<Index>(draws_.below(modes_known)));
    }
    return x;
  }

  // Of the structure without its obstacles: those hold what is to come off them.
  Matrix modes(const Vector& x) const {
    const Structure& structure = model_.structure();
    Linearization at;
    structure.linearize({.x = x, .lambda = record_.lambda, .active_set = {}}, at);
    const auto solver = model_.options().factorization();
    if (!at.K.coeffs().allFinite() || solver->factorize(at.K, {}) != FactorStatus::ok) return {};
    return *near_null(*solver, at.K, structure.weights({}), modes_of_each, Convergence::loose).vectors;
  }

  const Model& model_;
  RecordSearch& record_;
  DeckMesh mesh_;
  MirrorImages mirror_;
  DeflatedNewton newton_;
  Draws draws_;
  std::vector<Source> sources_;
  std::vector<Vector> images_, nearly_known_;
  std::vector<OfShape> known_;
  std::vector<CountedState> found_;
};

// Five values of λ over the range of the events, or of the points where there are none.
std::vector<double> spread_over(const Record& record) {
  constexpr int count = 5;
  double low = infinity, high = -infinity;
  const auto reach = [&](double lambda) {
    low = std::min(low, lambda);
    high = std::max(high, lambda);
  };
  for (const RecordEvent& event : record.events)
    if (event.kind != EventKind::start && event.kind != EventKind::end) reach(event.lambda);
  if (low >= high)
    for (const RecordPoint& point : record.points) reach(point.lambda);
  std::vector<double> values;
  for (int i = 0; i < count && low < high; ++i) values.push_back(low + (high - low) * (i + 0.5) / count);
  return values;
}

RecordFound told(const Model& model, const CountedState& found) {
  RecordFound record{.contact_pattern = contact_pattern_of(stretches_of(model, found.state)),
                     .energy = model.energy(found.state),
                     .unstable = found.count.unstable};
  for (const MonitorColumn& column : model.monitors()) record.monitors.push_back(column.quantity->value(found.state));
  return record;
}

bool is_beyond_stop(const Model& model, const State& state) {
  const auto& bounds = model.deck().path.stop.bounds;
  return std::any_of(bounds.begin(), bounds.end(), [&](const deck::StopBounds& bound) {
    const MonitorColumn* const column = deck::find(model.monitors(), bound.name);
    const double value = column != nullptr ? column->quantity->value(state) : state.lambda;
    return !(value >= bound.low && value <= bound.high);
  });
}

CountedState counted(const OnPath& there) { return {.state = there.state, .count = {.unstable = there.unstable}}; }

// Between a point of a record and the next one, where a straight line has the λ.
Vector shape_between(const DeckMesh& mesh, const Record& record, std::size_t point, double lambda) {
  const RecordPoint &a = record.points[point], &b = record.points[point + 1];
  const double part = (lambda - a.lambda) / (b.lambda - a.lambda);
  return (1.0 - part) * mesh.unknowns(a.state) + part * mesh.unknowns(b.state);
}

// The branch that passes a state.
std::optional<Index> branch_through(const Model& model, const Record& record, const CountedState& state) {
  const DeckMesh mesh(model);
  for (const std::size_t point : crossings(record, state.state.lambda)) {
    const auto there = at_crossing(model, record, point, state.state.lambda);
    if (there && is_one(mesh, counted(*there), state)) return record.points[point].branch;
  }
  return std::nullopt;
}

bool leads_off(const Model& model, const BranchStart& start) {
  Tracer tracer(model.system(), start, model.options());
  return tracer.next() && tracer.next();
}

}  // namespace

std::optional<BranchStart> Search::next() {
  if (!model_.deck().path.search) return std::nullopt;
  if (!values_) values_ = model_.deck().path.search_at.empty() ? spread_over(record_) : model_.deck().path.search_at;
  for (;;) {
    if (pending_.empty()) {
      if (done_ >= static_cast<Index>(values_->size())) return std::nullopt;
      search_at((*values_)[static_cast<std::size_t>(done_++)]);
      continue;
    }
    const Pending next = std::move(pending_.front());
    pending_.pop_front();
    RecordFound& found = record_.searches.back().found[static_cast<std::size_t>(next.found)];
    if (!may_begin(next, found)) continue;
    found.fate = FoundFate::traced;
    found.branches.push_back(static_cast<Index>(record_.branches.size()));
    return next.start();
  }
}

// Whether a branch is to be traced from there; if not, `found` says why.
bool Search::may_begin(const Pending& next, RecordFound& found) const {
  if (next.sense < 0) {  // against the way in which a branch has begun there, but around a loop there is one way
    if (found.fate == FoundFate::on_branch || found.fate == FoundFate::beyond_stop) return false;
    if (found.fate == FoundFate::traced) {
      const auto& end = record_.branches[static_cast<std::size_t>(found.branches.front())].end;
      if (end && end->reason == EndReason::closed_loop) return false;
    }
  } else if (is_beyond_stop(model_, next.state)) {
    found.fate = FoundFate::beyond_stop;
    return false;
  } else if (const auto branch = branch_through(model_, record_, {next.state, {.unstable = found.unstable}})) {
    found.fate = FoundFate::on_branch;
    found.branches = {*branch};
    return false;
  }
  if (leads_off(model_, next.start())) return true;
  if (found.fate == FoundFate::pending) found.fate = FoundFate::not_traced;
  return false;
}

bool comes_of_search(const Record& record, const RecordBranch& branch) {
  return branch.found ||
         (branch.parent && comes_of_search(record, record.branches[static_cast<std::size_t>(*branch.parent)]));
}

std::optional<BranchEnd> end_of_found_branch(const Model& model, const Record& record) {
  constexpr double near = 0.1;  // of two steps that pass one state [path metric]
  constexpr Index fewest = 4;   // points of a loop
  const RecordBranch& branch = record.branches.back();
  if (!comes_of_search(record, branch)) return std::nullopt;
  if (!is_resolved(model, record.points.back().state))
    return BranchEnd{.reason = EndReason::not_modelled,
                     .detail = "an element bends too far there for this mesh; give the members more elements"};
  if (branch.points < fewest) return std::nullopt;
  const std::size_t last = record.points.size() - 2;
  const double lambda = record.points[last + 2 - static_cast<std::size_t>(branch.points)].lambda;  // where it began
  std::vector<std::size_t> passed = crossings(record, lambda);
  if (passed.empty() || passed.back() != last) return std::nullopt;
  passed.pop_back();
  const DeckMesh mesh(model);
  const Vector here = shape_between(mesh, record, last, lambda);
  std::erase_if(passed, [&](std::size_t point) {
    return mesh.distance(shape_between(mesh, record, point, lambda), here) > near;
  });
  if (passed.empty()) return std::nullopt;
  const auto there = at_crossing(model, record, last, lambda);
  for (const std::size_t point : passed) {
    const auto before = at_crossing(model, record, point, lambda);
    if (!there || !before || !is_one(mesh, counted(*there), counted(*before))) continue;
    const Index other = record.points[point].branch;
    if (other == branch.id)
      return BranchEnd{.reason = EndReason::closed_loop, .detail = "the branch came back to its start"};
    return BranchEnd{.reason = EndReason::reached_branch,
                     .detail = "continues along branch " + std::to_string(other),
                     .partner = static_cast<int>(other)};
  }
  return std::nullopt;
}

std::optional<BranchEnd> end_where_it_walks_back(const Model& model, const Record& record) {
  const std::vector<RecordPoint>& points = record.points;
  const RecordPoint& last = points.back();
  const auto is_on_branch = [&](std::size_t i) { return points[i].branch == last.branch; };
  if (points.size() < 4) return std::nullopt;
  const std::size_t to = points.size() - 2;  // the last point of those at which nothing has moved
  std::size_t from = to;
  while (from > 0 && is_on_branch(from - 1) && nearly_equal(points[from - 1].lambda, points[to].lambda) &&
         nearly_equal(points[from - 1].energy, points[to].energy))
    --from;
  const auto changes = [&](std::size_t i) { return points[i].event && changes_contact(*points[i].event); };
  if (from == to || from == 0 || !is_on_branch(from - 1) || !changes(from) || !changes(to)) return std::nullopt;
  const bool turns =
      (points[from].lambda - points[from - 1].lambda) * (last.lambda - points[to].lambda) < 0.0 && is_on_branch(to);
  const DeckMesh mesh(model);
  if (!turns || !mesh.is_complete()) return std::nullopt;
  std::vector<std::size_t> before = crossings(record, last.lambda);
  std::erase_if(before, [&](std::size_t point) { return point >= from || !is_on_branch(point); });
  if (before.empty()) return std::nullopt;
  const auto there = at_crossing(model, record, before.back(), last.lambda);
  if (!there || !is_one(mesh, counted(*there), {last.state, {.unstable = last.count.unstable}})) return std::nullopt;
  return BranchEnd{.reason = EndReason::not_modelled,
                   .detail =
                       "the path returns along itself after two contact changes between which nothing moves; no other "
                       "continuation was found"};
}

void Search::search_at(double lambda) {
  RecordSearch& search = record_.searches.emplace_back();
  search.lambda = lambda;
  SearchAt at(model_, search, Draws(model_.deck().path.search_seed, done_));
  for (const std::size_t point : crossings(record_, lambda)) {
    if (const auto there = at_crossing(model_, record_, point, lambda))
      at.add_known(counted(*there));
    else
      at.add_known_about(shape_between(DeckMesh(model_), record_, point, lambda));
  }
  for (const CountedState& found : at.look(model_.deck().path.search_guesses)) {
    for (const int sense : {1, -1})
      pending_.push_back({.state = found.state, .sense = sense, .found = static_cast<Index>(search.found.size())});
    search.found.push_back(told(model_, found));
  }
}

}  // namespace arcwall
