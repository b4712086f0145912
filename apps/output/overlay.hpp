#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/path_cubics.hpp"
#include "model/record.hpp"

namespace arcwall {

/// Points that are drawn into the curves of a run's report: another run, or something measured.
struct Overlay {
  std::string name{};
  bool measured = false;                                ///< drawn as marks instead of lines
  std::map<std::string, std::vector<double>> values{};  ///< of the same length each: `lambda`, or the name of a monitor
  std::vector<double> arc{};                            ///< of a run: arc length at its points
  std::map<std::string, std::vector<double>> rates_before{}, rates_after{};  ///< of a run: derivatives of values by it
  std::vector<std::size_t> firsts{};  ///< where a new line begins: 0, and the first points of branches
};

/// The load factor and the monitors of a run.
Overlay overlay_of(const Record& record, const std::string& name);

/// The step from point i − 1 to point i of a run, in two of its columns; empty where a tangent is not known.
std::optional<CubicStep> cubic_step(const Overlay& overlay, std::size_t i, const std::string& across,
                                    const std::string& up);

/// Columns of a CSV file: its first line has their names, `lambda` and names of monitors, with or without units in
/// brackets; every further line a number or nothing for each. Throws InputError, which names `file` and the line, for
/// what is none, has no column of `columns` besides, or no numbers.
Overlay measured_points(const std::string& text, const std::string& file, const std::vector<RecordColumn>& columns);

}  // namespace arcwall
