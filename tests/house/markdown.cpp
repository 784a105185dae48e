#include "tests/house/markdown.h"

#include <algorithm>
#include <regex>
#include <sstream>

namespace foretouch::test {
namespace {

std::string_view withoutIndentation(std::string_view line) {
  return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

bool startsWith(std::string_view line, std::string_view start) {
  return line.substr(0, start.size()) == start;
}

/// Which lines may be as wide as they like: what the reader of lines has to remember.
class Exemptions {
 public:
  bool isExempt(std::string_view line) {
    const std::string_view text = withoutIndentation(line);
    if (startsWith(text, "```")) {
      isOutput_ = !isFence_ && (text == "```text" || text == "```jsonl");
      isFence_ = !isFence_;
      return false;
    }
    if (isFence_) return isOutput_;
    if (isMark(line, ":begin -->")) isWritten_ = true;
    if (isMark(line, ":end -->")) isWritten_ = false;
    return isWritten_ || startsWith(text, "|") || isOneTag(line) || isOneLink(line);
  }

 private:
  static bool isMark(std::string_view line, std::string_view end) {
    return startsWith(line, "<!-- ") && line.size() > end.size() &&
           line.substr(line.size() - end.size()) == end;
  }
  static bool isOneTag(std::string_view line) {
    return !line.empty() && line.front() == '<' && line.find('>') == line.size() - 1;
  }
  static bool isOneLink(std::string_view line) {
    static const std::regex kLink(R"re( *(- |\* )?!?\[[^\]]*\]\([^()\s]*\)[.,;]?)re");
    return std::regex_match(line.begin(), line.end(), kLink);
  }

  bool isFence_ = false, isOutput_ = false, isWritten_ = false;
};

}  // namespace

std::size_t columnsOf(std::string_view line) {
  return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

std::vector<WideLine> wideLines(std::string_view text, std::size_t most) {
  std::vector<WideLine> wide;
  Exemptions exemptions;
  std::istringstream lines{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const bool isExempt = exemptions.isExempt(line);
    const std::size_t columns = columnsOf(line);
    if (!isExempt && columns > most) wide.push_back({number, columns});
  }
  return wide;
}

}  // namespace foretouch::test
