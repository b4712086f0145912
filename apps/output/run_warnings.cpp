#include "apps/output/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace arcwall {

namespace {

bool has_constants(const deck::Deck& deck) {
  const auto constant = [](const auto& driven) { return driven.constant; };
  return std::any_of(deck.loads.begin(), deck.loads.end(), constant) ||
         std::any_of(deck.prescribed.begin(), deck.prescribed.end(), constant);
}

}  // namespace

std::string warning_of_start(const Model& model, const Record& record) {
  if (record.points.empty()) return {};
  const std::optional<Index> unstable = record.points.front().count.unstable;
  if (!unstable || *unstable == 0) return {};
  const std::string directions = fmt::format("{} unstable direction{}", *unstable, *unstable == 1 ? "" : "s");
  if (!has_constants(model.whole_deck()))
    return "the path starts at a state with " + directions + ", which a real structure would leave";
  return "the constant loads and movements lead to a state with " + directions +
         ": on the way there a real structure would have left this equilibrium for another one. The path that is "
         "traced "
         "starts on an unstable branch; make the loads smaller, give the structure an imperfection, or let λ drive "
         "them";
}

std::vector<std::string> run_warnings(const Model& model, const Record& record) {
  std::vector<std::string> all = model.warnings();
  if (std::string start = warning_of_start(model, record); !start.empty()) all.push_back(std::move(start));
  return all;
}

}  // namespace arcwall
