#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace arcwall {

/// One option of a command, by its long name.
struct OptionDescription {
  std::string name{};   ///< without dashes
  std::string value{};  ///< what stands for its value in the help; empty: a switch
  std::string help{};
  bool repeatable = false;
};

/// What a command takes; every command also takes --help and --version.
struct CommandDescription {
  std::string name{};
  std::string example{};  ///< a whole command line
  std::string usage{};    ///< what follows the name, as `DECK [options]`
  std::string summary{};  ///< one line for the list of commands
  std::vector<OptionDescription> options{};
  std::size_t least_words = 0, most_words = 0;  ///< arguments that are no options
  bool passes_on = false;                       ///< what stands behind `--` is for another program
};

/// A command line taken apart.
class Options {
 public:
  /// InputError for an option that is unknown, shortened, repeated or without its value, or a wrong number of words.
  /// The number of words is not looked at when help or version is asked for.
  Options(const CommandDescription& command, const std::vector<std::string>& arguments);

  bool has(const std::string& name) const { return values_.contains(name); }

  /// The value of an option, empty if it is not there.
  std::optional<std::string> text(const std::string& name) const;

  /// All values of a repeatable option.
  std::vector<std::string> texts(const std::string& name) const;

  /// A whole number of at least 1, or InputError.
  std::optional<int> count(const std::string& name) const;

  /// A finite number above 0, or InputError.
  std::optional<double> seconds(const std::string& name) const;

  /// A finite number of at least 0, or InputError.
  std::optional<double> pause(const std::string& name) const;

  /// A whole number of at least 0, or InputError.
  std::optional<int> number(const std::string& name) const;

  const std::vector<std::string>& words() const { return words_; }

  /// What stands behind `--` and is passed on.
  const std::vector<std::string>& passed_on() const { return passed_on_; }

 private:
  std::optional<int> whole_number(const std::string& name, int least) const;

  std::map<std::string, std::vector<std::string>> values_;
  std::vector<std::string> words_;
  std::vector<std::string> passed_on_;
};

/// The text of --help: an example first.
std::string help_text(const CommandDescription& command);

/// ` (did you mean --out?)` for an option that is not known, or nothing.
std::string suggestion(const std::string& unknown, const std::vector<std::string>& known);

}  // namespace arcwall
