#pragma once

#include <concepts>
#include <cstdint>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "contact/sliding_contact.hpp"
#include "continuation/event_curves/event_system.hpp"
#include "continuation/path_point.hpp"

/// Values to and from JSON trees, exactly: what is kept of a run. A structure is an array of its parts in the order in
/// which `serialize(archive)`, a member of it, or `parts(archive, value)`, a function beside it, visits them; one visit
/// serves both ways. Objects that are shared are stored once, where they are met first, and shared again when read.
namespace arcwall {

/// What is read does not fit: the bytes are not what a checkpoint of this program and deck can be.
class BadArchive : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the states of a run belong to.
struct ArchiveModel {
  const System* system = nullptr;
  std::vector<const System*> later{};            ///< of the stages that have begun after the first
  std::vector<const SlidingContact*> sliding{};  ///< of each stage that has begun; empty where contact is tied to nodes
  const EventSystem* event = nullptr;  ///< of the system's event that is followed, whose states may be met, too

  /// Whether a state has the unknowns of its active set, and that is an active set of the system. A state without
  /// anything is.
  bool owns(const State& state) const;
  bool owns(const ActiveSet& active_set) const;

 private:
  template <class Holds>
  bool any(const Holds& holds) const;  // of the systems
};

namespace archive_detail {

template <typename T, typename Archive>
concept SerializesItself = requires(T& value, Archive& archive) {
  value.serialize(archive);
};

template <typename T>
struct IsList : std::false_type {};
template <typename T>
struct IsList<std::vector<T>> : std::true_type {};
template <typename T>
struct IsList<std::deque<T>> : std::true_type {};

template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};

nlohmann::json from_numbers(const double* values, Index rows, Index columns);
Matrix to_numbers(const nlohmann::json& json);

}  // namespace archive_detail

/// Writes values as the entries of an array.
class ArchiveWriter {
 public:
  static constexpr bool reads = false;

  /// What `model` names must outlive this.
  explicit ArchiveWriter(const ArchiveModel& model);

  template <typename... T>
  void operator()(T&... values) {
    (json_.push_back(written(values)), ...);
  }

  void require(bool) const {}

  /// That states of an event may follow.
  void set_event(const EventSystem* event) { shared_->model.event = event; }

  const nlohmann::json& json() const { return json_; }

 private:
  using Json = nlohmann::json;
  struct Shared {
    ArchiveModel model;
    std::vector<const void*> layouts{}, branch_points{};  // in the order in which they were met
  };

  explicit ArchiveWriter(std::shared_ptr<Shared> shared) : shared_(std::move(shared)) {}

  // The place of an object among those met before; empty for a new one, which takes the next place.
  static std::optional<std::size_t> met(std::vector<const void*>& before, const void* object);

  template <typename T>
  Json structure(T& value) {
    ArchiveWriter inner(shared_);
    if constexpr (archive_detail::SerializesItself<T, ArchiveWriter>)
      value.serialize(inner);
    else
      parts(inner, value);
    return std::move(inner.json_);
  }

  template <typename T>
  Json written(T& value) {
    using namespace archive_detail;
    using Plain = std::remove_const_t<T>;
    if constexpr (std::is_enum_v<Plain>) {
      return static_cast<std::int64_t>(value);
    } else if constexpr (std::is_arithmetic_v<Plain> || std::same_as<Plain, std::string>) {
      return value;
    } else if constexpr (std::same_as<Plain, Vector> || std::same_as<Plain, Matrix>) {
      return from_numbers(value.data(), value.rows(), value.cols());
    } else if constexpr (IsOptional<Plain>::value) {
      return value ? Json::array({written(*value)}) : Json(nullptr);
    } else if constexpr (IsList<Plain>::value) {
      Json list = Json::array();
      for (auto& entry : value) list.push_back(written(entry));
      return list;
    } else if constexpr (std::same_as<Plain, ActiveSet>) {
      return active_set(value);
    } else if constexpr (std::same_as<Plain, std::shared_ptr<const BranchPoint>>) {
      return branch_point(value);
    } else {
      return structure(value);
    }
  }

  Json active_set(const ActiveSet& active_set);
  Json layout(const Layout& layout);
  Json branch_point(const std::shared_ptr<const BranchPoint>& point);

  std::shared_ptr<Shared> shared_;
  Json json_ = Json::array();
};

/// Reads the entries of an array into values, in their order. Throws BadArchive where they do not fit.
class ArchiveReader {
 public:
  static constexpr bool reads = true;

  /// `json` and what `model` names must outlive this. Without a model no states can be read.
  ArchiveReader(const nlohmann::json& json, const ArchiveModel& model);

  template <typename... T>
  void operator()(T&... values) {
    (read(next(), values), ...);
  }

  void require(bool holds) const {
    if (!holds) throw BadArchive("values that do not belong together");
  }

  const ArchiveModel& model() const { return shared_->model; }

  /// The systems and contacts of stages that are known to have begun now.
  void set_stages(ArchiveModel model) {
    shared_->model.later = std::move(model.later);
    shared_->model.sliding = std::move(model.sliding);
  }

  /// That states of an event may follow.
  void set_event(const EventSystem* event) { shared_->model.event = event; }

  /// Whether all entries have been read.
  bool at_end() const { return at_ == json_.size(); }

 private:
  using Json = nlohmann::json;
  static constexpr std::int64_t greatest_count = std::int64_t{1} << 29;  // no run counts further; sums fit every type
  struct Shared {
    ArchiveModel model;
    std::vector<std::shared_ptr<const Layout>> layouts;
    std::vector<std::shared_ptr<const BranchPoint>> branch_points;
  };

  ArchiveReader(const Json& json, std::shared_ptr<Shared> shared) : shared_(std::move(shared)), json_(json) {
    require(json_.is_array());
  }

  const Json& next() {
    require(!at_end());
    return json_[at_++];
  }

  template <typename T>
  void structure(const Json& json, T& value) {
    ArchiveReader inner(json, shared_);
    if constexpr (archive_detail::SerializesItself<T, ArchiveReader>)
      value.serialize(inner);
    else
      parts(inner, value);
    require(inner.at_end());
  }

  template <typename T>
  void read(const Json& json, T& value) {
    using namespace archive_detail;
    if constexpr (std::same_as<T, bool>) {
      require(json.is_boolean());
      value = json.get<bool>();
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(whole_number(json, 0, greatest(T{})));
    } else if constexpr (std::integral<T>) {
      static_assert(sizeof(T) >= sizeof(std::int32_t));
      value = static_cast<T>(whole_number(json, std::signed_integral<T> ? -greatest_count : 0, greatest_count));
    } else if constexpr (std::floating_point<T>) {
      require(json.is_number());
      value = json.get<T>();
    } else if constexpr (std::same_as<T, std::string>) {
      require(json.is_string());
      value = json.get<std::string>();
    } else if constexpr (std::same_as<T, Vector>) {
      const Matrix numbers = to_numbers(json);
      require(numbers.cols() == 1);
      value = numbers.col(0);
    } else if constexpr (std::same_as<T, Matrix>) {
      value = to_numbers(json);
    } else if constexpr (IsOptional<T>::value) {
      value.reset();
      if (json.is_null()) return;
      require(json.is_array() && json.size() == 1);
      read(json[0], value.emplace());
    } else if constexpr (IsList<T>::value) {
      require(json.is_array());
      value.clear();
      for (const Json& entry : json) read(entry, value.emplace_back());
    } else if constexpr (std::same_as<T, ActiveSet>) {
      value = active_set(json);
    } else if constexpr (std::same_as<T, std::shared_ptr<const BranchPoint>>) {
      value = branch_point(json);
    } else {
      structure(json, value);
    }
  }

  std::int64_t whole_number(const Json& json, std::int64_t least, std::int64_t most) const;
  ActiveSet active_set(const Json& json);
  std::shared_ptr<const BranchPoint> branch_point(const Json& json);
  std::shared_ptr<const Layout> layout(const Json& json);
  std::shared_ptr<const Layout> layout_of_event(const Json& json);

  std::shared_ptr<Shared> shared_;
  const Json& json_;
  std::size_t at_ = 0;
};

}  // namespace arcwall
