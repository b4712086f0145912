#include "apps/cli/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <charconv>
#include <climits>
#include <cmath>

#include "apps/output/text_table.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace arcwall {

namespace po = boost::program_options;

namespace {

std::vector<OptionDescription> all_options(const CommandDescription& command) {
  std::vector<OptionDescription> options = command.options;
  options.push_back({.name = "help", .help = "show this"});
  options.push_back({.name = "version", .help = "show the version"});
  return options;
}

[[noreturn]] void fail(const CommandDescription& command, const std::string& message) {
  throw InputError(fmt::format("{}; see trace-path {} --help", message, command.name));
}

po::options_description described(const std::vector<OptionDescription>& options) {
  po::options_description result;
  for (const OptionDescription& option : options) {
    if (option.value.empty()) {
      result.add_options()(option.name.c_str(), "");
    } else {
      result.add_options()(option.name.c_str(), po::value<std::string>(), "");
    }
  }
  return result;
}

// Boost reports what is wrong by exceptions of its own; here they become ours.
po::parsed_options parsed(const CommandDescription& command, const std::vector<OptionDescription>& options,
                          const std::vector<std::string>& arguments) {
  constexpr int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  try {
    const po::options_description known = described(options);
    return po::command_line_parser(arguments).options(known).style(style).run();
  } catch (const po::unknown_option& problem) {
    std::vector<std::string> names;
    for (const OptionDescription& option : options) names.push_back("--" + option.name);
    const std::string name = problem.get_option_name();
    fail(command, "unknown option " + name + suggestion(name, names));
  } catch (const po::error& problem) {
    fail(command, problem.what());
  }
}

}  // namespace

Options::Options(const CommandDescription& command, const std::vector<std::string>& arguments) {
  const std::vector<OptionDescription> known = all_options(command);
  auto own_end = arguments.end();
  if (command.passes_on) own_end = std::find(arguments.begin(), arguments.end(), "--");
  if (own_end != arguments.end()) passed_on_.assign(own_end + 1, arguments.end());
  for (const po::option& option : parsed(command, known, {arguments.begin(), own_end}).options) {
    if (option.position_key >= 0) {
      words_.insert(words_.end(), option.value.begin(), option.value.end());
      continue;
    }
    const auto same_name = [&](const OptionDescription& one) { return one.name == option.string_key; };
    const bool repeatable = std::find_if(known.begin(), known.end(), same_name)->repeatable;
    if (has(option.string_key) && !repeatable) fail(command, "--" + option.string_key + " is given twice");
    std::vector<std::string>& values = values_[option.string_key];
    values.insert(values.end(), option.value.begin(), option.value.end());
  }
  if (has("help") || has("version")) return;
  if (words_.size() < command.least_words)
    fail(command, fmt::format("usage: trace-path {} {}", command.name, command.usage));
  if (words_.size() > command.most_words) fail(command, "unexpected argument " + words_[command.most_words]);
}

std::optional<std::string> Options::text(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end() || found->second.empty()) return std::nullopt;
  if (found->second.front().empty()) throw InputError("--" + name + " has an empty value");
  return found->second.front();
}

std::vector<std::string> Options::texts(const std::string& name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? std::vector<std::string>{} : found->second;
}

std::optional<int> Options::count(const std::string& name) const { return whole_number(name, 1); }

std::optional<int> Options::number(const std::string& name) const { return whole_number(name, 0); }

std::optional<int> Options::whole_number(const std::string& name, int least) const {
  const auto value = text(name);
  if (!value) return std::nullopt;
  int number = 0;
  const auto [end, error] = std::from_chars(value->data(), value->data() + value->size(), number);
  if (error != std::errc{} || end != value->data() + value->size() || number < least)
    throw InputError(fmt::format("--{} is {}; it must be a whole number from {} to {}", name, *value, least, INT_MAX));
  return number;
}

std::optional<double> Options::pause(const std::string& name) const {
  const auto value = text(name);
  if (!value) return std::nullopt;
  double number = 0.0;
  const auto [end, error] = std::from_chars(value->data(), value->data() + value->size(), number);
  if (error != std::errc{} || end != value->data() + value->size() || !std::isfinite(number) || number < 0.0)
    throw InputError(fmt::format("--{} is {}; it must be a number of seconds, at least 0", name, *value));
  return number;
}

std::optional<double> Options::seconds(const std::string& name) const {
  const auto number = pause(name);
  if (number && *number == 0.0) throw InputError(fmt::format("--{} is {}; it must be above 0", name, *text(name)));
  return number;
}

std::string help_text(const CommandDescription& command) {
  std::string text = fmt::format("  {}\n\n{}\nusage: trace-path {} {}\n\noptions\n", command.example, command.summary,
                                 command.name, command.usage);
  std::size_t widest = 0;
  const auto title = [](const OptionDescription& option) {
    return "--" + option.name + (option.value.empty() ? "" : " " + option.value);
  };
  const std::vector<OptionDescription> options = all_options(command);
  for (const OptionDescription& option : options) widest = std::max(widest, display_width(title(option)));
  for (const OptionDescription& option : options)
    text += fmt::format("  {:<{}}  {}\n", title(option), widest, option.help);
  return text;
}

std::string suggestion(const std::string& unknown, const std::vector<std::string>& known) {
  // A shortened option is farther from the whole by edits than by meaning.
  std::string meant;
  for (const std::string& candidate : known) {
    if (unknown.size() > 2 && candidate.starts_with(unknown)) meant += (meant.empty() ? "" : " or ") + candidate;
  }
  if (meant.empty()) meant = nearest(unknown, known);
  return meant.empty() ? "" : " (did you mean " + meant + "?)";
}

}  // namespace arcwall
