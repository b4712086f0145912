#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/sweep/collection.hpp"
#include "apps/sweep/load_lines.hpp"
#include "apps/sweep/load_map.hpp"

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

/// The cases as maps and lines show them: each alone, or, where they would be too much for a page, all those near one
/// another as their mean. It takes cases one after the other and keeps no more than it draws.
class DrawnCases {
 public:
  /// `keys`: one or two of the varied keys; `monitors`: those that are drawn instead of λ, if any.
  DrawnCases(const Collection& collection, const Overview& of_all, const std::vector<std::string>& keys,
             const std::vector<std::string>& monitors);

  void add(const Case& one, const CaseResult& result);

  const std::vector<LoadKind>& loads() const { return loads_; }

  /// Whether cases are drawn as means.
  bool are_means() const { return are_means_; }

  /// Over the one or two keys. No points where no case has been run.
  LoadMap map(std::size_t load) const;

  /// How many keys are drawn: one or two.
  std::size_t keys_drawn() const { return titles_.y.empty() ? 1 : 2; }

  /// The curves of events of the cases, λ over the number, as lines: of each the same number of points at most, and of
  /// no more than a page can show.
  const LoadLines& curves() const { return curves_; }

  /// Over one of the keys that are drawn. Means are joined along that key, whatever the values of further keys.
  LoadLines lines(std::size_t load, std::size_t key) const;

 private:
  struct One {
    int number = 0;
    std::vector<Json> values{};  // of `order_`
    std::vector<std::optional<double>> loads{};
    bool failed = false;
    bool has_page = false;
  };
  struct Mean {
    struct Load {
      int count = 0;
      double sum = 0.0, low = infinity, high = -infinity;
    };
    int cases = 0, failed = 0;
    std::vector<Load> loads{};
  };

  Json near(std::size_t key, const Json& value) const;
  MapPoint point(const One& one, std::size_t load, std::size_t first_noted) const;
  MapPoint point(const std::pair<Json, Json>& at, const Mean& mean, std::size_t load) const;
  std::string note(const One& one, std::size_t first) const;
  MapTitles titles_of(std::size_t load) const;
  void add_curve(const Case& one, const CaseResult& result);

  const Collection& collection_;
  std::vector<std::string> order_;  // of the keys: those drawn first
  std::vector<std::string> order_titles_{};
  std::vector<KeyRange> ranges_{};  // of the keys that are drawn
  std::vector<LoadKind> loads_;
  MapTitles titles_{};
  bool are_means_ = false;
  int parts_ = 0;  // of each key, where cases are drawn as means
  LoadLines curves_{};
  std::vector<One> cases_{};
  std::map<std::pair<Json, Json>, Mean> means_{};
};

}  // namespace arcwall::sweep
