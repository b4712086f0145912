#pragma once

#include <fmt/format.h>

#include <string>

#include "tests/model/traced_session.hpp"
#include "tests/support/deck_tables.hpp"

/// Decks with compliant walls, and what is read off their runs.
namespace arcwall::compliant_test {

using namespace test::tables;

using test::event_of;
using test::events_of;
using test::traced;

inline const Record& record(const Session& run) { return run.record(); }

inline double last(const Session& run, std::size_t monitor) { return run.points().back().monitors[monitor]; }

/// A beam of EI = 100 and length 2 over a bed at 1e-4, pressed in its middle by λ `load`; `more`: keys of its section.
inline std::string beam_over_bed(const std::string& theory, int elements, double load, std::string_view more = "") {
  return title("Beam over a bed") + units("m", "N") + material("m", 1.0e7) + general_section("s", 1.0, 1.0e-5, more) +
         points({{"left", -1.0, 0.0}, {"right", 1.0, 0.0}}) + member("beam", "left", "right", theory, elements) +
         supports({{"left", "x z"}, {"right", "z"}}) + force("beam:0.5", 0.0, -load) +
         flat_wall("bed", "below", -1e-4, on_axis) + contact("method = \"compliant\"; law = { stiffness = 1e5 }") +
         path("step = 0.1; stop = { lambda = [-0.5, 1.0] }") + monitor("middle", "beam:0.5", "z") +
         wall_monitor("bed", "bed", "force-z") + wall_monitor("edge", "bed", "contact-start", "member = \"beam\"");
}

/// A column of 2 cm in a channel with one wall, under the load λ.
inline std::string column_in_channel(const std::string& theory, int elements, double stiffness) {
  return title("Column in a compliant channel") + units("cm", "kN") + material("steel", 2.1e4, "nu = 0.3") +
         rectangle("square", 0.1, 0.1) + points({{"left", 0.0, 0.0}, {"right", 2.0, 0.0}}) +
         member("column", "left", "right", theory, elements, imperfection({{1, 2.0e-3}, {3, 3.0e-4}}), "steel",
                "square") +
         supports({{"left", "x z"}, {"right", "z"}}) + force("right", -1.0, 0.0) +
         flat_wall("upper", "above", 0.15, on_axis) +
         contact(fmt::format(R"(method = "compliant"; law = {{ stiffness = {} }})", stiffness)) +
         path(R"(step = 0.05; stop = { lambda = [-1.0, 9.0], event = "limit-point" })") +
         monitor("mid", "column:0.5", "z") + wall_monitor("bed", "upper", "force-z");
}

}  // namespace arcwall::compliant_test
