#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/sweep/collection.hpp"

namespace arcwall::sweep {

/// A load that cases have: λ or a monitor at the snap, or at the first event of a kind.
struct LoadKind {
  std::string title{};    ///< `λ of the snap`
  std::string event{};    ///< empty: the snap
  std::string monitor{};  ///< empty: λ

  std::optional<double> of(const CaseResult& result) const;
};

/// Of λ, or of these monitors.
std::vector<LoadKind> load_kinds(const Overview& of_all, const std::vector<std::string>& monitors);

/// report.html: one page that needs no other file and no network. It takes cases one after the other and keeps no more
/// than it draws: every case, or, of more than a page can show, some spread evenly over their numbers.
class SweepPage {
 public:
  /// `keys`: those of the varied keys that are drawn first; `monitors`: those that are drawn instead of λ, if any.
  SweepPage(const Collection& collection, const Overview& of_all, const std::vector<std::string>& keys,
            const std::vector<std::string>& monitors);

  void add(const Case& one, const CaseResult& result);

  std::string text() const;

 private:
  Json data() const;
  void add_curve(const CaseResult& result);

  const Collection& collection_;
  const Overview& of_all_;
  std::vector<std::string> keys_;
  std::vector<LoadKind> loads_;
  Json numbers_ = Json::array(), failed_ = Json::array(), reports_ = Json::array();  // of each drawn case
  std::vector<Json> values_, of_loads_;                                              // of each key, and of each load
  Json curves_ = Json::array();
  std::size_t curve_count_ = 0, curve_points_ = 0;
};

}  // namespace arcwall::sweep
