#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/output/files.hpp"
#include "apps/sweep/results.hpp"
#include "core/types.hpp"
#include "model/deck/deck.hpp"

namespace arcwall::sweep {

/// A planned sweep with all that its cases came to so far. Cases and results are read one after the other and are not
/// in memory together: the place of each record alone is, 16 bytes a case.
class Collection {
 public:
  /// Of a planned folder; cases that have not been run are part of it. InputError, OutputError.
  explicit Collection(std::filesystem::path folder);

  const Sweep& sweep() const { return sweep_; }

  /// Of the first case; without members if it cannot be read.
  const deck::Deck& deck() const { return deck_; }

  /// The file of the deck.
  const std::string& deck_file() const { return deck_file_; }

  std::size_t size() const { return size_; }
  const std::filesystem::path& folder() const { return folder_; }
  const Results& results() const { return results_; }

  /// Calls `each` for every case in their order.
  void visit(const std::function<void(const Case&, const CaseResult&)>& each) const;

 private:
  std::filesystem::path folder_;
  std::size_t size_;
  Sweep sweep_;  // without its rows
  Results results_;
  deck::Deck deck_{};
  std::string deck_file_{};
};

/// The value that a case gives to a varied key.
const Json& value_of(const Case& one, const std::string& key);

/// Why cases failed, or have not been run.
struct Failure {
  std::string reason{};
  std::size_t count = 0;
  std::vector<int> first{};  ///< of their numbers, and one more than `listed()` names
};

/// What values a key has.
struct KeyRange {
  static constexpr std::size_t most_distinct = 40;

  bool numbers = true;  ///< all of them
  double low = infinity, high = -infinity;
  std::vector<Json> distinct{};  ///< each once, as they turn up; one more than `most_distinct` where there are more

  void add(const Json& value);
};

/// What is known of all cases together.
struct Overview {
  std::size_t ran = 0, failed = 0;         ///< have results; of these, or not run: as CaseResult::failed() has it
  std::vector<Failure> failures{};         ///< each reason once, in the order of the first case that has it
  std::vector<std::string> monitors{};     ///< in the order in which they turn up
  std::vector<std::string> event_kinds{};  ///< of events other than starts and ends, in a fixed order
  bool has_snaps = false;
  std::map<std::string, KeyRange> keys{};

  /// What a case adds.
  void add(const Case& one, const CaseResult& result);
};

Overview overview(const Collection& collection);

/// `3, 8, 12, …`: the first few of the numbers.
std::string listed(const Failure& failure);

/// cases.csv, one row a case, and sweep.csv, one row an event of each case, written case by case. Of curves sweep.csv
/// has the special points, and curves.csv all of their points.
class Tables {
 public:
  Tables(const Collection& collection, const Overview& of_all);
  void add(const Case& one, const CaseResult& result);

  /// Puts both in place. Throws OutputError.
  void finish();

 private:
  // Writes in larger parts.
  struct Buffered {
    StagedFile file;
    std::string text{};

    void add(const std::string& more);
    void finish();
  };

  bool of_curves() const { return collection_.sweep().traced == Traced::curve; }
  void begin_curves(const std::string& titles);
  void add_curve(const std::string& begin, const CaseResult& result);

  const Collection& collection_;
  std::vector<std::string> monitors_;
  Buffered cases_, events_;
  std::unique_ptr<Buffered> curves_{};
};

}  // namespace arcwall::sweep
