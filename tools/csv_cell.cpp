#include "tools/csv_cell.h"

#include <charconv>
#include <system_error>

namespace foretouch::tools {
namespace {

/// To spreadsheets a cell that begins so is a formula, but for a number.
bool isFormula(std::string_view text) {
  if (text.empty() || std::string_view("=+-@\t\r").find(text.front()) == text.npos) return false;
  double number = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  return problem != std::errc() || end != text.data() + text.size();
}

}  // namespace

std::string csvCell(std::string_view given) {
  const std::string text = (isFormula(given) ? "'" : "") + std::string(given);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + '"';
}

}  // namespace foretouch::tools
