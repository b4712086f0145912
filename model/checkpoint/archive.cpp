#include "model/checkpoint/archive.hpp"

#include <algorithm>
#include <cstring>

#include "contact/friction_layout.hpp"
#include "contact/slip_layout.hpp"
#include "model/checkpoint/parts.hpp"

namespace arcwall {

using Json = nlohmann::json;

namespace {

constexpr const char* of_an_event = "event";
constexpr const char* of_friction = "friction";
constexpr const char* of_slips = "slips";

bool has_only_statuses(const ActiveSet& active_set) {
  return std::all_of(active_set.begin(), active_set.end(), [](std::uint8_t closed) { return closed <= 1; });
}

bool is_as_at_rest(const SlipLayout& layout, const SlipLayout* at_rest) {
  return at_rest != nullptr && layout.points().size() == at_rest->points().size() &&
         layout.dissipated().size() == at_rest->dissipated().size();
}

bool is_of(const System& system, const ActiveSet& active_set) {
  const ActiveSet open = system.open_active_set();
  if ((active_set.layout() == nullptr) != (open.layout() == nullptr)) return false;
  if (const auto* slips = dynamic_cast<const SlipLayout*>(active_set.layout().get()))
    return is_as_at_rest(*slips, dynamic_cast<const SlipLayout*>(open.layout().get())) &&
           active_set.size() == open.size() && has_only_statuses(active_set);
  if (const auto* friction = dynamic_cast<const FrictionLayout*>(active_set.layout().get()))
    return friction->contacts().size() == open.contacts() && active_set.size() == open.size() &&
           has_only_statuses(active_set);
  const auto* layout = dynamic_cast<const SlidingContactLayout*>(active_set.layout().get());
  const auto* at_rest = dynamic_cast<const SlidingContactLayout*>(open.layout().get());
  const auto points = [](const SlidingContactLayout* on) { return on ? on->points().size() : 0; };
  return active_set.size() + points(at_rest) == open.size() + points(layout) && has_only_statuses(active_set);
}

}  // namespace

template <class Holds>
bool ArchiveModel::any(const Holds& holds) const {
  return (system != nullptr && holds(*system)) ||
         std::any_of(later.begin(), later.end(), [&](const System* one) { return holds(*one); });
}

bool ArchiveModel::owns(const ActiveSet& active_set) const {
  if (active_set.layout() && EventSystem::meaning_of(*active_set.layout()))
    return system != nullptr && event != nullptr && active_set.empty();
  return any([&](const System& one) { return is_of(one, active_set); });
}

bool ArchiveModel::owns(const State& state) const {
  if (state.x.size() == 0 && state.active_set == ActiveSet()) return true;
  if (state.active_set.layout() && EventSystem::meaning_of(*state.active_set.layout()))
    return owns(state.active_set) && state.x.size() == event->size(state.active_set);
  return any(
      [&](const System& one) { return is_of(one, state.active_set) && state.x.size() == one.size(state.active_set); });
}

namespace archive_detail {

Json from_numbers(const double* values, Index rows, Index columns) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(rows * columns) * sizeof(double));
  if (!bytes.empty()) std::memcpy(bytes.data(), values, bytes.size());
  return Json::array({rows, columns, Json::binary(std::move(bytes))});
}

Matrix to_numbers(const Json& json) {
  const auto is_size = [](const Json& number) {
    return number.is_number_unsigned() && number.get<std::uint64_t>() <= (std::uint64_t{1} << 30);
  };
  if (!json.is_array() || json.size() != 3 || !is_size(json[0]) || !is_size(json[1]) || !json[2].is_binary())
    throw BadArchive("no block of numbers where there should be one");
  const auto rows = json[0].get<std::uint64_t>(), columns = json[1].get<std::uint64_t>();
  const Json::binary_t& bytes = json[2].get_binary();
  if (rows * columns * sizeof(double) != bytes.size()) throw BadArchive("a block of numbers of a wrong size");
  Matrix numbers(static_cast<Index>(rows), static_cast<Index>(columns));
  if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

}  // namespace archive_detail

ArchiveWriter::ArchiveWriter(const ArchiveModel& model) : shared_(std::make_shared<Shared>(Shared{.model = model})) {
  shared_->layouts.push_back(model.system->open_active_set().layout().get());
}

std::optional<std::size_t> ArchiveWriter::met(std::vector<const void*>& before, const void* object) {
  const auto known = std::find(before.begin(), before.end(), object);
  if (known != before.end()) return static_cast<std::size_t>(known - before.begin());
  before.push_back(object);
  return std::nullopt;
}

Json ArchiveWriter::active_set(const ActiveSet& active_set) {
  Json json = Json::array({Json::binary(std::vector<std::uint8_t>(active_set.begin(), active_set.end()))});
  if (!active_set.layout()) return json;
  if (const auto place = met(shared_->layouts, active_set.layout().get())) {
    json.push_back(*place);
    return json;
  }
  json.push_back(layout(*active_set.layout()));
  return json;
}

// Of an event, and of friction, the first entry is a text.
Json ArchiveWriter::layout(const Layout& any) {
  ArchiveWriter inner(shared_);
  if (const EventSystem::Meaning* const meaning = EventSystem::meaning_of(any)) {
    std::string what = of_an_event;
    EventSystem::Meaning copy = *meaning;
    inner(what, copy);
    return std::move(inner.json_);
  }
  if (const auto* const friction = dynamic_cast<const FrictionLayout*>(&any)) {
    std::string what = of_friction;
    std::vector<FrictionLayout::Contact> contacts = friction->contacts();
    inner(what, contacts);
    return std::move(inner.json_);
  }
  if (const auto* const slips = dynamic_cast<const SlipLayout*>(&any)) {
    std::string what = of_slips;
    std::vector<SlipLayout::Point> points = slips->points();
    std::vector<double> dissipated = slips->dissipated();
    inner(what, points, dissipated);
    return std::move(inner.json_);
  }
  const auto& layout = dynamic_cast<const SlidingContactLayout&>(any);
  const auto& stages = shared_->model.sliding;
  const auto is_its = [&](const SlidingContact* contact) { return layout.is_of(contact->body()); };
  auto stage = static_cast<Index>(std::find_if(stages.begin(), stages.end(), is_its) - stages.begin());
  ElementsPerSegment cut = layout.mesh().elements_per_segment();
  std::vector<SlidingContactLayout::Point> points = layout.points();
  Vector origin = layout.origin();
  SlidingContactLayout::Lying lying = layout.lying();
  SlidingContactLayout::EndRubbings ends = layout.end_rubbings();
  inner(stage, cut, points, origin, lying, ends);
  return std::move(inner.json_);
}

Json ArchiveWriter::branch_point(const std::shared_ptr<const BranchPoint>& point) {
  if (!point) return nullptr;
  if (const auto place = met(shared_->branch_points, point.get())) return *place;
  BranchPoint copy = *point;
  return structure(copy);
}

ArchiveReader::ArchiveReader(const Json& json, const ArchiveModel& model)
    : ArchiveReader(json, std::make_shared<Shared>(Shared{.model = model, .layouts = {}, .branch_points = {}})) {
  if (model.system) shared_->layouts.push_back(model.system->open_active_set().layout());
}

std::int64_t ArchiveReader::whole_number(const Json& json, std::int64_t least, std::int64_t most) const {
  require(json.is_number_integer());
  if (json.is_number_unsigned()) require(json.get<std::uint64_t>() <= static_cast<std::uint64_t>(most));
  const auto number = json.get<std::int64_t>();
  require(number >= least && number <= most);
  return number;
}

ActiveSet ArchiveReader::active_set(const Json& json) {
  require(json.is_array() && (json.size() == 1 || json.size() == 2) && json[0].is_binary());
  const Json::binary_t& closed = json[0].get_binary();
  ActiveSet active_set(closed.size(), 0, json.size() == 2 ? layout(json[1]) : nullptr);
  for (std::size_t j = 0; j < closed.size(); ++j) active_set[j] = closed[j];
  const std::size_t kinks = model().system ? model().system->open_active_set().kinks() : 0;
  if (kinks == 0 || closed.size() < kinks) return active_set;
  ActiveSet contacts(closed.size() - kinks, 0, active_set.layout());
  for (std::size_t j = 0; j < contacts.size(); ++j) contacts[j] = closed[j];
  return contacts.with_kinks(std::span(closed).last(kinks));
}

std::shared_ptr<const Layout> ArchiveReader::layout(const Json& json) {
  if (!json.is_array())
    return shared_->layouts[static_cast<std::size_t>(
        whole_number(json, 0, static_cast<std::int64_t>(shared_->layouts.size()) - 1))];
  if (!json.empty() && json[0] == of_friction) {
    std::string what;
    std::vector<FrictionLayout::Contact> contacts;
    ArchiveReader inner(json, shared_);
    inner(what, contacts);
    require(inner.at_end());
    shared_->layouts.push_back(std::make_shared<const FrictionLayout>(std::move(contacts)));
    return shared_->layouts.back();
  }
  if (!json.empty() && json[0] == of_slips) {
    std::string what;
    std::vector<SlipLayout::Point> points;
    std::vector<double> dissipated;
    ArchiveReader inner(json, shared_);
    inner(what, points, dissipated);
    require(inner.at_end());
    shared_->layouts.push_back(std::make_shared<const SlipLayout>(std::move(points), std::move(dissipated)));
    return shared_->layouts.back();
  }
  if (!json.empty() && json[0].is_string()) return layout_of_event(json);
  Index stage = 0;
  ElementsPerSegment cut;
  std::vector<SlidingContactLayout::Point> points;
  Vector origin;
  SlidingContactLayout::Lying lying;
  SlidingContactLayout::EndRubbings ends;
  ArchiveReader inner(json, shared_);
  inner(stage, cut, points, origin, lying, ends);
  require(inner.at_end() && stage < static_cast<Index>(model().sliding.size()));
  shared_->layouts.push_back(model().sliding[static_cast<std::size_t>(stage)]->layout_of(
      cut, std::move(points), origin, std::move(lying), std::move(ends)));
  require(shared_->layouts.back() != nullptr);
  return shared_->layouts.back();
}

// Its place comes before that of the layout that its own active set may have.
std::shared_ptr<const Layout> ArchiveReader::layout_of_event(const Json& json) {
  const std::size_t place = shared_->layouts.size();
  shared_->layouts.emplace_back();
  std::string what;
  EventSystem::Meaning meaning;
  ArchiveReader inner(json, shared_);
  inner(what, meaning);
  require(inner.at_end() && what == of_an_event && model().event != nullptr);
  shared_->layouts[place] = EventSystem::with_meaning(std::move(meaning));
  return shared_->layouts[place];
}

std::shared_ptr<const BranchPoint> ArchiveReader::branch_point(const Json& json) {
  if (json.is_null()) return nullptr;
  auto& known = shared_->branch_points;
  if (!json.is_array())
    return known[static_cast<std::size_t>(whole_number(json, 0, static_cast<std::int64_t>(known.size()) - 1))];
  auto point = std::make_shared<BranchPoint>();
  structure(json, *point);
  known.push_back(std::move(point));
  return known.back();
}

}  // namespace arcwall
