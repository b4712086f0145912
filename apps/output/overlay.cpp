#include "apps/output/overlay.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <optional>

#include "apps/output/path_lines.hpp"
#include "core/error.hpp"

namespace arcwall {

namespace {

[[noreturn]] void fail(const std::string& file, int line, const std::string& message, const std::string& cure) {
  throw InputError({Diagnostic{.file = file, .line = line, .message = message, .cure = cure}});
}

std::string trimmed(const std::string& text) {
  constexpr const char* blank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

// A line of a table, with its number.
struct Row {
  int line = 1;
  std::vector<std::string> cells{};
};

// The rows of a table after RFC 4180: in quotes commas and line breaks are part of a cell, and two quotes stand for
// one.
class RowReader {
 public:
  RowReader(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  std::optional<Row> next() {
    if (at_ == text_.size()) return std::nullopt;
    Row row;
    row.line = line_;
    while (true) {
      row.cells.push_back(cell());
      if (at_ == text_.size()) return row;
      if (text_[at_++] == ',') continue;
      ++line_;
      return row;
    }
  }

 private:
  // Up to the comma or the end of the line.
  std::string cell() {
    const std::size_t begin = text_.find_first_not_of(" \t", at_);
    if (begin != std::string::npos && text_[begin] == '"') return quoted(begin + 1);
    return trimmed(rest());
  }

  std::string rest() {
    const std::size_t begin = at_;
    at_ = std::min(text_.find_first_of(",\n", at_), text_.size());
    return text_.substr(begin, at_ - begin);
  }

  std::string quoted(std::size_t begin) {
    const int line = line_;
    std::string cell;
    for (at_ = begin; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] != '"') {
        cell += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        cell += text_[at_++];
      } else {
        ++at_;
        if (!trimmed(rest()).empty())
          fail(file_, line_, "has a quote within a cell", "write two quotes for one, and quotes around the cell");
        return trimmed(cell);
      }
    }
    fail(file_, line, "has a cell whose quotes are not closed", "close them");
  }

  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1;
};

bool is_blank(const Row& row) { return row.cells.size() == 1 && row.cells.front().empty(); }

// `mid [cm]` → `mid`, `λ` → `lambda`.
std::string name_in(const std::string& title) {
  const std::string name = trimmed(title.substr(0, title.find('[')));
  return name == "λ" ? "lambda" : name;
}

// NaN for an empty cell.
double number_in(const std::string& cell, const std::string& file, int line) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size())
    fail(file, line, "\"" + cell.substr(0, 60) + "\" is no number",
         "write numbers with a decimal point, and commas between them");
  return value;
}

std::string listed(const std::vector<RecordColumn>& columns) {
  std::string text = "lambda";
  for (const RecordColumn& column : columns) text += ", " + column.name;
  return text;
}

}  // namespace

Overlay overlay_of(const Record& record, const std::string& name) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Overlay overlay{.name = name};
  for (const RecordPoint& point : record.points) overlay.arc.push_back(point.arc);
  const auto add = [&](const std::string& column, auto value_of) {
    for (const RecordPoint& point : record.points) {
      const auto rate = [&](const std::optional<RecordRates>& rates) { return rates ? value_of(*rates) : unknown; };
      overlay.values[column].push_back(value_of(point));
      overlay.rates_before[column].push_back(rate(point.rates));
      overlay.rates_after[column].push_back(rate(leaving_rates(point)));
    }
  };
  add("lambda", [](const auto& of) { return of.lambda; });
  add("energy", [](const auto& of) { return of.energy; });
  for (std::size_t i = 0; i < record.columns.size(); ++i)
    add(record.columns[i].name, [i](const auto& of) { return of.monitors[i]; });
  overlay.firsts = first_points(record);
  if (!overlay.firsts.empty()) overlay.firsts.pop_back();  // the end of the last branch
  return overlay;
}

std::optional<CubicStep> cubic_step(const Overlay& overlay, std::size_t i, const std::string& across,
                                    const std::string& up) {
  const auto rates = [&](const std::map<std::string, std::vector<double>>& of, std::size_t point) {
    return Vec2(of.at(across)[point], of.at(up)[point]);
  };
  const double length = overlay.arc[i] - overlay.arc[i - 1];
  const CubicStep step{.begin = length * rates(overlay.rates_after, i - 1),
                       .end = length * rates(overlay.rates_before, i)};
  return step.begin.allFinite() && step.end.allFinite() ? std::optional(step) : std::nullopt;
}

Overlay measured_points(const std::string& text, const std::string& file, const std::vector<RecordColumn>& columns) {
  Overlay overlay{.name = std::filesystem::path(file).filename().string(), .measured = true, .firsts = {0}};
  RowReader rows(text, file);
  const auto titles = rows.next();
  if (!titles) fail(file, 0, "is empty", "give a line with names, then lines with numbers");
  std::vector<std::string> names;
  for (const std::string& title : titles->cells) names.push_back(name_in(title));
  const auto is_known = [&](const std::string& name) {
    const auto same = [&](const RecordColumn& column) { return column.name == name; };
    return name == "lambda" || std::any_of(columns.begin(), columns.end(), same);
  };
  if (std::count_if(names.begin(), names.end(), is_known) < 2)
    fail(file, 1, "names fewer than two columns of the run", "name columns of " + listed(columns));
  int last = titles->line;
  while (const auto row = rows.next()) {
    last = row->line;
    if (is_blank(*row)) continue;
    const std::vector<std::string>& cells = row->cells;
    if (cells.size() != names.size())
      fail(file, last, "has " + std::to_string(cells.size()) + " cells instead of " + std::to_string(names.size()),
           "give one a column");
    for (std::size_t i = 0; i < names.size(); ++i)
      if (is_known(names[i])) overlay.values[names[i]].push_back(number_in(cells[i], file, last));
  }
  if (overlay.values.empty()) fail(file, last, "has no line with numbers", "give some below the names");
  return overlay;
}

}  // namespace arcwall
