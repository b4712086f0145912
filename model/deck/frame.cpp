#include "model/deck/frame.hpp"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "model/deck/deck_keys.hpp"

namespace arcwall::deck {

namespace {

// Passes through a deck as its writer does, and converts each number by the unit of its key.
class KeyConverter final : public Keys {
 public:
  explicit KeyConverter(const Frame& frame) : frame_(frame) {}

  bool table(const Key&, Form, const std::function<void(Keys&)>& keys_of_table, std::string_view) override {
    keys_of_table(*this);
    return false;
  }
  bool applies(bool condition, const char*, const std::string&, const std::string&) override { return condition; }

 protected:
  bool declare(const Key&, const Target& target, const Declared& declared) override {
    const Dimension& unit = declared.unit;
    if (auto* const number = std::get_if<std::optional<double>*>(&target); number != nullptr && **number)
      convert(***number, unit, unit.axis);
    if (auto* const vector = std::get_if<Vector*>(&target)) {
      const bool is_place = unit.axis == Axis::both;
      convert((*vector)->x, unit, is_place ? Axis::x : Axis::none);
      convert((*vector)->z, unit, is_place ? Axis::z : Axis::none);
    }
    if (auto* const numbers = std::get_if<std::vector<double>*>(&target))
      for (double& number : **numbers) convert(number, unit, unit.axis);
    return false;
  }
  bool each_table(const Key&, ListForm, const std::vector<std::string>& names, const UseTable& use,
                  std::string_view) override {
    for (std::size_t i = 0; i < names.size(); ++i) use(*this, {.index = i});
    return true;
  }
  void each_entry(const std::vector<std::string>& names, const std::vector<std::string_view>&,
                  const UseKey& use) override {
    for (std::size_t i = 0; i < names.size(); ++i) use({names[i], Presence::required}, {.index = i});
  }

 private:
  using Axis = Dimension::Axis;

  void convert(double& value, const Dimension& unit, Axis axis) const {
    if (axis == Axis::x) value -= frame_.origin.x;
    if (axis == Axis::z) value -= frame_.origin.z;
    value *= frame_.factor(-unit.length);
  }

  const Frame& frame_;
};

// Units of these keys depend on another key.
void convert_law(std::optional<TableLaw>& law, bool by_length, const Frame& frame) {
  if (!law) return;
  const int of_force = (law->direction == Dof::rotation ? 1 : 0) - (by_length ? 1 : 0);
  if (law->direction != Dof::rotation)
    for (double& u : law->displacement) u *= frame.factor(-1);
  for (double& force : law->force) force *= frame.factor(-of_force);
}

struct LawConverter {
  const Frame& frame;
  void operator()(GroundSpring& spring) const { convert_law(spring.law, false, frame); }
  void operator()(PointToPointSpring& spring) const { convert_law(spring.law, false, frame); }
  void operator()(Foundation& foundation) const { convert_law(foundation.law, true, frame); }
};

}  // namespace

// Below 2⁻²⁰ and above 2²⁰ the unit of length is so chosen that the size is again between these; from 64 sizes away the
// origin is moved. It is a multiple of a power of two below the size and no farther away than the structure, so that
// the differences are exact.
Frame frame_of(const Deck& deck) {
  constexpr double range = 40.0, far = 64.0;
  std::unordered_map<std::string, Vector> points;
  for (const Point& point : deck.points) points.emplace(point.name, point.at);
  Vector low{infinity, infinity}, high{-infinity, -infinity};
  for (const Member& member : deck.members)
    for (const std::string& end : {member.from, member.to}) {
      const Vector& at = points.at(end);
      low = {std::min(low.x, at.x), std::min(low.z, at.z)};
      high = {std::max(high.x, at.x), std::max(high.z, at.z)};
    }
  const double size = std::max(high.x - low.x, high.z - low.z);
  if (!(size > 0.0) || !std::isfinite(size)) return {};
  const double grid = std::exp2(std::floor(std::log2(size)));
  const auto origin = [&](double least, double greatest) {
    const double centre = 0.5 * least + 0.5 * greatest;
    return std::abs(centre) >= far * size ? grid * std::trunc(centre / grid) : 0.0;
  };
  return {.origin = {origin(low.x, high.x), origin(low.z, high.z)},
          .exponent = static_cast<int>(range * std::round(std::log2(size) / range))};
}

Deck in_frame(Deck deck, const Frame& frame) {
  if (frame.is_users()) return deck;
  for (Wall& wall : deck.walls)
    if (auto* const line = std::get_if<LineProfile>(&wall.profile); line != nullptr && !wall.outline)
      line->z = std::fma(line->slope, frame.origin.x, line->z - frame.origin.z);
  KeyConverter converter(frame);
  declare_keys(converter, deck);
  for (Load& load : deck.loads)
    if (auto* const heat = std::get_if<Heat>(&load.action)) heat->gradient *= frame.factor();
  for (Spring& spring : deck.springs) std::visit(LawConverter{frame}, spring.kind);
  deck.frame = frame;
  return deck;
}

}  // namespace arcwall::deck
