#include "model/deck/synonyms.hpp"

#include <algorithm>
#include <array>

#include "core/text.hpp"
#include "model/deck/key_list.hpp"

namespace arcwall::deck {

namespace {

using Use = Synonym::Use;

constexpr std::array<Synonym, 81> all_synonyms{{
    {"land", "output_at", Use::read},
    {"landing", "jumps", Use::read},
    {"search_tries", "search_guesses", Use::read},
    {"continuum", "equilibrium_family", Use::read},
    {"acts_on", "contact_surface", Use::read},
    {"keep", "structure", Use::read},
    {"over", "parameter", Use::read},
    {"file", "points", Use::read},
    {"follow", "most-stable", Use::read},
    {"sliding", "moving", Use::read},
    {"classic", "euler-bernoulli", Use::read},
    {"exact", "reissner", Use::read},
    {"greatest-moment", "max-moment", Use::read},
    {"contact-gathers", "contact-shrinks", Use::read},
    {"contact-passes", "contact-transfers", Use::read},
    {"displacement-limit", "turning-point", Use::read},
    {"euler", "euler-bernoulli"},
    {"bernoulli", "euler-bernoulli"},
    {"bernoulli-euler", "euler-bernoulli"},
    {"kirchhoff", "elastica"},
    {"timoshenko", "reissner"},
    {"simo-reissner", "reissner"},
    {"bar", "truss"},
    {"rod", "truss"},
    {"arc-length", "spherical"},
    {"arc-length", "pseudo-arclength"},
    {"arclength", "spherical"},
    {"arclength", "pseudo-arclength"},
    {"crisfield", "spherical"},
    {"rot", "rotation"},
    {"theta", "rotation"},
    {"phi", "rotation"},
    {"normal-force", "axial-force"},
    {"bending-moment", "moment"},
    {"stress", "max-stress"},
    {"utilization", "utilisation"},
    {"yield", "allowable"},
    {"strength", "allowable"},
    {"upper", "above"},
    {"top", "above"},
    {"lower", "below"},
    {"bottom", "below"},
    {"thermal", "temperature"},
    {"heat", "temperature"},
    {"dT", "temperature"},
    {"delta_t", "temperature"},
    {"alpha", "expansion"},
    {"cte", "expansion"},
    {"udl", "distributed"},
    {"line_load", "distributed"},
    {"winkler", "foundation"},
    {"bedding", "foundation"},
    {"k", "stiffness"},
    {"velocity", "motion"},
    {"displacement", "motion"},
    {"ux", "x"},
    {"uz", "z"},
    {"dx", "x"},
    {"dz", "z"},
    {"local", "member"},
    {"thermal_expansion", "expansion"},
    {"young", "E"},
    {"youngs_modulus", "E"},
    {"poisson", "nu"},
    {"angle", "rotation"},
    {"move", "motion"},
    {"center", "about"},
    {"centre", "about"},
    {"pivot", "about"},
    {"drive", "drives"},
    {"active", "drives"},
    {"until", "stop"},
    {"p", "pressure"},
    {"follower", "pressure"},
    {"q", "distributed"},
    {"T", "temperature"},
    {"temp", "temperature"},
    {"delta_T", "temperature"},
    {"kx", "stiffness"},
    {"kz", "stiffness"},
    {"spring_constant", "stiffness"},
}};

std::string found(std::string_view other, const std::vector<std::string>& candidates, auto&& is_used) {
  std::string words;
  for (const Synonym& one : all_synonyms)
    if (one.other == other && is_used(one) &&
        std::find(candidates.begin(), candidates.end(), one.word) != candidates.end())
      words += (words.empty() ? "" : " or ") + std::string(one.word);
  return words;
}

}  // namespace

std::span<const Synonym> synonyms() { return all_synonyms; }

std::string read_as(std::string_view other, const std::vector<std::string>& candidates) {
  return found(other, candidates, [](const Synonym& one) { return one.use == Use::read; });
}

std::string meant_by(std::string_view other, const std::vector<std::string>& candidates) {
  return found(other, candidates, [](const Synonym&) { return true; });
}

std::string nearest_meant(std::string_view word, const std::vector<std::string>& candidates) {
  std::vector<std::string> all = candidates;
  for (const Synonym& one : all_synonyms)
    if (const std::string other(one.other); !read_as(other, candidates).empty()) all.push_back(other);
  const std::string near = nearest(word, all), meant = read_as(near, candidates);
  return meant.empty() ? near : meant;
}

std::string current_key(const std::string& table, const std::string& other) {
  for (const Synonym& one : all_synonyms) {
    if (one.use != Use::read || one.other != other) continue;
    const std::string key = (table.empty() ? "" : table + ".") + std::string(one.word);
    const auto is_it = [&](const DeclaredKey& declared) { return declared.name == one.word && declared.is(key); };
    if (std::any_of(declared_keys().begin(), declared_keys().end(), is_it)) return std::string(one.word);
  }
  return other;
}

void use_current_keys(Value& value, const std::string& key) {
  const bool is_table = value.kind == Value::Kind::table;
  if (!is_table && value.kind != Value::Kind::array) return;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    Value& item = value.items[i];
    if (is_table)
      if (std::string current = current_key(key, item.key); current != item.key && find(value, current) == nullptr)
        item.key = std::move(current);
    const std::string& name = is_table ? item.key : std::to_string(i);
    if (!item.items.empty()) use_current_keys(item, (key.empty() ? "" : key + ".") + name);
  }
}

}  // namespace arcwall::deck
