#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

/// Tables of a deck as text, in its words. A deck is a sum of them in any order, after its title. `keys` and `more` are
/// keys of the table as a deck has them, with `; ` between them.
namespace arcwall::test::tables {

inline const std::string constant = "constant = true";            ///< of a load or a movement
inline const std::string on_axis = "contact_surface = \"axis\"";  ///< of a wall
inline const std::string flipped = "sign = -1";                   ///< of a monitor
inline const std::string moving_contact = "[contact]\npoints = \"moving\"\n";

inline std::string title(std::string_view title) { return fmt::format("title = \"{}\"\n", title); }

/// A number as decks have them: with a point, and all its digits.
inline std::string number(double value) {
  std::string text = fmt::format("{}", value);
  return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
}

/// A line for each key.
inline std::string lines(std::string_view keys) {
  std::string text;
  for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end + 2) {
    end = std::min(keys.find("; ", begin), keys.size());
    text.append(keys.substr(begin, end - begin)).append("\n");
  }
  return text;
}

inline std::string table(std::string_view header, std::string_view keys) {
  return fmt::format("{}\n{}", header, lines(keys));
}

inline std::string path(std::string_view keys) { return table("[path]", keys); }
inline std::string contact(std::string_view keys) { return table("[contact]", keys); }
inline std::string units(std::string_view length, std::string_view force) {
  return fmt::format("[units]\nlength = \"{}\"\nforce = \"{}\"\n", length, force);
}

inline std::string material(std::string_view name, double E, std::string_view more = "") {
  return fmt::format("[material.{}]\nE = {}\n{}", name, number(E), lines(more));
}

inline std::string general_section(std::string_view name, double A, double I, std::string_view more = "") {
  return fmt::format("[section.{}]\nshape = \"general\"\nA = {}\nI = {}\n{}", name, number(A), number(I), lines(more));
}

inline std::string rectangle(std::string_view name, double width, double height, std::string_view more = "") {
  return fmt::format("[section.{}]\nshape = \"rectangle\"\nwidth = {}\nheight = {}\n{}", name, number(width),
                     number(height), lines(more));
}

struct Point {
  std::string_view name;
  double x, z;
};
inline std::string points(std::initializer_list<Point> points) {
  std::string text = "[point]\n";
  for (const auto& [name, x, z] : points) text += fmt::format("{} = [{}, {}]\n", name, number(x), number(z));
  return text;
}

/// A member of material m and section s. The theory may have keys of its own: `elastica; order = 6`.
inline std::string member(std::string_view name, std::string_view from, std::string_view to, std::string_view theory,
                          int elements, std::string_view more = "", std::string_view material = "m",
                          std::string_view section = "s") {
  const std::size_t end = std::min(theory.find("; "), theory.size());
  return fmt::format("[member.{}]\nfrom = \"{}\"\nto = \"{}\"\nmaterial = \"{}\"\nsection = \"{}\"\nelements = {}\n",
                     name, from, to, material, section, elements) +
         fmt::format("theory = \"{}\"\n", theory.substr(0, end)) +
         lines(theory.substr(std::min(end + 2, theory.size()))) + lines(more);
}

/// A bar of engineering strain, of material m and section s.
inline std::string bar(std::string_view name, std::string_view from, std::string_view to) {
  return member(name, from, to, "truss", 1, "strain = \"engineering\"");
}

/// A sum of sines as imperfection of a member.
struct Sine {
  int waves;
  double amplitude;
};
inline std::string imperfection(std::initializer_list<Sine> sines) {
  std::string text;
  for (const auto& [waves, amplitude] : sines)
    text +=
        fmt::format("{}{{ shape = \"sine\", amplitude = {}, waves = {} }}", text.empty() ? "" : ", ", amplitude, waves);
  return "imperfection = [" + text + "]";
}

/// What is held at points, in words as `x z rotation`.
struct Held {
  std::string_view at, words;
};
inline std::string supports(std::initializer_list<Held> supports) {
  std::string text = "[support]\n";
  for (const auto& [at, words] : supports) {
    text += fmt::format("{} = [\"", at);
    for (const char c : words) text += c == ' ' ? std::string("\", \"") : std::string(1, c);
    text += "\"]\n";
  }
  return text;
}

inline std::string prescribed(std::string_view at, std::string_view keys) {
  return fmt::format("[[prescribed]]\nat = \"{}\"\n{}", at, lines(keys));
}

inline std::string force(std::string_view at, double x, double z, std::string_view more = "") {
  return fmt::format("[[load]]\nat = \"{}\"\nforce = [{}, {}]\n{}", at, number(x), number(z), lines(more));
}

inline std::string distributed(std::string_view on, double x, double z, std::string_view more = "") {
  return fmt::format("[[load]]\non = \"{}\"\ndistributed = [{}, {}]\n{}", on, number(x), number(z), lines(more));
}

inline std::string wall(std::string_view name, std::string_view keys) {
  return fmt::format("[[wall]]\nname = \"{}\"\n{}", name, lines(keys));
}

inline std::string flat_wall(std::string_view name, std::string_view side, double z, std::string_view more = "") {
  return fmt::format("[[wall]]\nname = \"{}\"\nside = \"{}\"\nprofile = {{ type = \"flat\", z = {} }}\n{}", name, side,
                     number(z), lines(more));
}

/// Flat walls `upper` and `lower` at ±z.
inline std::string channel(double z, std::string_view more = "") {
  return flat_wall("upper", "above", z, more) + flat_wall("lower", "below", -z, more);
}

/// Of a wall that axes of members touch, with friction.
inline std::string rough(double friction) { return fmt::format("{}; friction = {}", on_axis, friction); }

inline std::string monitor(std::string_view name, std::string_view at, std::string_view component,
                           std::string_view more = "") {
  return fmt::format("[[monitor]]\nname = \"{}\"\nat = \"{}\"\ncomponent = \"{}\"\n{}", name, at, component,
                     lines(more));
}

inline std::string wall_monitor(std::string_view name, std::string_view wall, std::string_view component,
                                std::string_view more = "") {
  return fmt::format("[[monitor]]\nname = \"{}\"\nwall = \"{}\"\ncomponent = \"{}\"\n{}", name, wall, component,
                     lines(more));
}

inline std::string stage(std::string_view name, std::string_view drives, double step, double low, double high) {
  return fmt::format("[[stage]]\nname = \"{}\"\ndrives = [\"{}\"]\nstep = {}\nstop = {{ lambda = [{}, {}] }}\n", name,
                     drives, step, low, high);
}

}  // namespace arcwall::test::tables
