#include "tests/house/figures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

#include <nlohmann/json.hpp>

namespace foretouch::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Cells = std::vector<std::string>;

/// A number as a document prints it: thousands apart by commas, so many decimals.
struct Printed {
  double value = 0.0;
  int decimals = 0;
};

std::optional<Printed> printedNumber(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ','), text.end());
  static const std::regex kNumber(R"re([0-9]+(\.[0-9]+)?)re");
  if (!std::regex_match(text, kNumber)) return std::nullopt;
  const std::size_t dot = text.find('.');
  return Printed{std::stod(text), dot == text.npos ? 0 : static_cast<int>(text.size() - dot) - 1};
}

/// Rounded to as many decimals as are printed. The slack is for halves, which may go either way.
bool agrees(const Printed& printed, double measured) {
  const double half = 0.5 * std::pow(10.0, -printed.decimals);
  return std::abs(printed.value - measured) <= half * (1.0 + 1e-9);
}

std::string withoutComments(const std::string& text) {
  return std::regex_replace(text, std::regex("<!--[^>]*-->"), "");
}

/// The last `count` numbers of a text, in order; fewer where there are not so many.
Cells lastNumbers(const std::string& text, std::size_t count) {
  static const std::regex kNumber(R"re([0-9][0-9,]*(\.[0-9]+)?)re");
  Cells numbers;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), kNumber);
       at != std::sregex_iterator(); ++at) {
    std::string number = at->str();
    if (number.back() == ',') number.pop_back();
    numbers.push_back(number);
  }
  if (numbers.size() > count) {
    numbers.erase(numbers.begin(), numbers.end() - static_cast<std::ptrdiff_t>(count));
  }
  return numbers;
}

Cells wordsOf(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

/// The cells of a table's row, without comments, code marks and blanks around them.
Cells cellsOf(const std::string& row) {
  const std::string text = withoutComments(row);
  Cells cells;
  for (std::size_t from = 1, to = 0; (to = text.find('|', from)) != text.npos; from = to + 1) {
    std::string cell = text.substr(from, to - from);
    cell.erase(std::remove(cell.begin(), cell.end(), '`'), cell.end());
    const std::size_t begin = cell.find_first_not_of(' ');
    const std::size_t end = cell.find_last_not_of(' ');
    cells.push_back(begin == cell.npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

/// The rows below the head of the table that `text` begins with, after blank lines.
std::vector<Cells> tableAt(const std::string& text) {
  std::istringstream lines(text);
  std::vector<Cells> rows;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.front() == '|') {
      rows.push_back(cellsOf(line));
    } else if (!line.empty() || !rows.empty()) {
      break;
    }
  }
  rows.erase(rows.begin(),
             rows.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(rows.size(), 2)));
  return rows;
}

/// Does a cell say what was measured? A cell may repeat the one above it by being empty, and is
/// empty or "-" where nothing was measured.
bool says(const std::string& cell, const std::string& above, const Json& measured) {
  if (measured.is_null()) return cell.empty() || cell == "-";
  if (measured.is_string()) return (cell.empty() ? above : cell) == measured.get<std::string>();
  const std::optional<Printed> printed = printedNumber(cell);
  return printed && agrees(*printed, measured.get<double>());
}

bool isAt(const Json& row, const Json& where) {
  for (const auto& [column, value] : where.items()) {
    if (!row.contains(column) || row.at(column) != value) return false;
  }
  return true;
}

}  // namespace

struct Measurements::Files {
  std::map<std::string, Json> byName;
  Json places;

  [[nodiscard]] const Json* table(const std::string& file, const std::string& name) const {
    const auto found = byName.find(file);
    if (found == byName.end()) return nullptr;
    for (const Json& table : found->second.at("tables")) {
      if (table.at("name") == name) return &table;
    }
    return nullptr;
  }

  /// The value that a name stands for; nothing unless exactly one row is meant.
  [[nodiscard]] std::optional<double> value(const std::string& name) const {
    if (!places.contains(name)) return std::nullopt;
    const Json& place = places.at(name);
    const Json* found = table(place.at("file"), place.at("table"));
    if (found == nullptr) return std::nullopt;
    std::vector<const Json*> rows;
    for (const Json& row : found->at("rows")) {
      if (isAt(row, place.value("where", Json::object()))) rows.push_back(&row);
    }
    const std::string column = place.at("column"), over = place.value("over", "");
    if (rows.size() != 1 || !rows.front()->contains(column)) return std::nullopt;
    const double value = rows.front()->at(column).get<double>() * place.value("factor", 1.0);
    return over.empty() ? value : value / rows.front()->at(over).get<double>();
  }

  /// What the numbers at the end of `text` say otherwise, one per name.
  [[nodiscard]] std::vector<std::string> complaintsAboutFigures(const Cells& names,
                                                                const std::string& text) const {
    std::vector<std::string> complaints;
    const Cells printed = lastNumbers(withoutComments(text), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::optional<double> measured = value(names[i]);
      const auto number = i < printed.size() ? printedNumber(printed[i]) : std::nullopt;
      if (!measured) {
        complaints.push_back("no measurement is called " + names[i]);
      } else if (!number || !agrees(*number, *measured)) {
        complaints.push_back(names[i] + ": the document says " + (number ? printed[i] : "nothing") +
                             ", measured is " + std::to_string(*measured));
      }
    }
    return complaints;
  }

  /// What a marked table says otherwise. `mark` is "FILE/TABLE COLUMNS...".
  [[nodiscard]] std::vector<std::string> complaintsAbout(const std::string& mark,
                                                         const std::vector<Cells>& rows) const {
    Cells columns = wordsOf(mark);
    if (columns.empty()) return {"a table's mark names no table"};
    const std::string address = columns.front();
    columns.erase(columns.begin());
    const std::size_t slash = std::min(address.find('/'), address.size());
    const Json* measured =
        table(address.substr(0, slash), address.substr(std::min(slash + 1, address.size())));
    if (measured == nullptr) return {"no measurement is called " + address};
    if (columns.empty()) {
      for (const Json& column : measured->at("columns")) columns.push_back(column.at("key"));
    }
    const Json& truth = measured->at("rows");
    if (rows.size() != truth.size()) {
      return {address + " has " + std::to_string(truth.size()) + " rows, the document " +
              std::to_string(rows.size())};
    }
    return complaintsAboutCells(address, columns, rows, truth);
  }

  [[nodiscard]] static std::vector<std::string> complaintsAboutCells(const std::string& address,
                                                                     const Cells& columns,
                                                                     const std::vector<Cells>& rows,
                                                                     const Json& truth) {
    std::vector<std::string> complaints;
    Cells above(columns.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].size() != columns.size()) {
        complaints.push_back(address + ": row " + std::to_string(i) + " has another width");
        continue;
      }
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const Json measured = truth[i].value(columns[k], Json());
        if (!says(rows[i][k], above[k], measured)) {
          complaints.push_back(address + ": row " + std::to_string(i) + " says '" + rows[i][k] +
                               "', measured " + columns[k] + " is " + measured.dump());
        }
        if (!rows[i][k].empty()) above[k] = rows[i][k];
      }
    }
    return complaints;
  }
};

Measurements::Measurements(const std::string& folder) : files_(std::make_unique<Files>()) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream file(entry.path());
    Json content = Json::parse(file);
    if (entry.path().stem() == "figures") {
      files_->places = std::move(content);
    } else {
      files_->byName[entry.path().stem().string()] = std::move(content);
    }
  }
}

Measurements::~Measurements() = default;

std::vector<std::string> Measurements::complaintsAbout(const std::string& text) {
  static const std::regex kMark("<!-- (figures?|table): ([^>]*) -->");
  constexpr std::size_t kLookBack = 400;  // far enough for three numbers, and quick
  std::vector<std::string> complaints;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), kMark);
       at != std::sregex_iterator(); ++at) {
    const auto begin = static_cast<std::size_t>(at->position());
    std::vector<std::string> more;
    if ((*at)[1] == "table") {
      ++tables_;
      more = files_->complaintsAbout(
          (*at)[2], tableAt(text.substr(begin + static_cast<std::size_t>(at->length()))));
    } else {
      const Cells names = wordsOf((*at)[2]);
      figures_ += static_cast<int>(names.size());
      used_.insert(names.begin(), names.end());
      const std::size_t from = begin - std::min(begin, kLookBack);
      more = files_->complaintsAboutFigures(names, text.substr(from, begin - from));
    }
    complaints.insert(complaints.end(), more.begin(), more.end());
  }
  return complaints;
}

std::vector<std::string> Measurements::complaintsAboutItself() const {
  std::vector<std::string> complaints;
  for (const auto& [file, content] : files_->byName) {
    for (const Json& table : content.at("tables")) {
      const std::string command = table.value("command", content.value("command", ""));
      if (command.empty()) {
        complaints.push_back(file + "/" + table.at("name").get<std::string>() + " has no command");
      }
    }
  }
  for (const auto& [name, place] : files_->places.items()) {
    if (used_.count(name) == 0) complaints.push_back("no document has the figure " + name);
  }
  return complaints;
}

}  // namespace foretouch::test
