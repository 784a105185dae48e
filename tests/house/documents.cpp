#include "tests/house/documents.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <regex>
#include <set>
#include <sstream>

namespace foretouch::house {
namespace {

namespace fs = std::filesystem;

std::string printedBy(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> block{};
  for (std::size_t size = 1; pipe != nullptr && size > 0;) {
    size = std::fread(block.data(), 1, block.size(), pipe.get());
    text.append(block.data(), size);
  }
  return text;
}

struct Mark {
  const char* what;
  std::regex pattern;
};

const std::vector<Mark>& marks() {
  static const std::vector<Mark> kMarks = {
      {"a heading without a blank after #", std::regex("^ *#{1,6}[^# !]")},
      {"a sentence that begins without a blank", std::regex("(^|[^A-Za-z])[a-z]+\\.[A-Z][a-z]")},
      {"a power written apart", std::regex("[0-9a-z)] \\^ -?[0-9a-z(]")},
      {"a bar of an absolute value apart", std::regex("\\w\\(?\\w* \\+ \\| \\w+ \\|")}};
  return kMarks;
}

bool isListItem(const std::string& line) {
  static const std::regex kItem("^ *([-*+]|[0-9]+[.)]) .*");
  return std::regex_match(line, kItem);
}

/// Text that is indented as code is, right below text that is not.
class Indentation {
 public:
  [[nodiscard]] bool isOff(const std::string& line) {
    const bool isText = line.find_first_not_of(' ') != std::string::npos;
    const bool isDeep = isText && line.rfind("    ", 0) == 0;
    if (isListItem(line)) {
      isInList_ = true;
    } else if (isText && line.front() != ' ') {
      isInList_ = false;
    }
    const bool isOff = isDeep && isBelowText_ && !isInList_;
    isBelowText_ = isText && !isDeep;
    return isOff;
  }

 private:
  bool isBelowText_ = false, isInList_ = false;
};

}  // namespace

std::vector<fs::path> documentsOnDisk(const fs::path& root) {
  const std::set<std::string> others = {"build", "out", "node_modules"};
  std::vector<fs::path> found;
  for (auto at = fs::recursive_directory_iterator(root); at != fs::recursive_directory_iterator();
       ++at) {
    const std::string name = at->path().filename().string();
    if (at->is_directory() && (name.front() == '.' || others.count(name) != 0)) {
      at.disable_recursion_pending();
    } else if (at->path().extension() == ".md") {
      found.push_back(at->path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<fs::path> documentsBelow(const fs::path& root) {
  std::istringstream lines(
      printedBy("git -C \"" + root.string() + "\" ls-files -- '*.md' 2>/dev/null"));
  std::vector<fs::path> found;
  for (std::string line; std::getline(lines, line);) {
    if (fs::exists(root / line)) found.push_back(root / line);
  }
  if (found.empty()) return documentsOnDisk(root);
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> mangledLines(const std::string& markdown) {
  static const std::regex kSpan("`[^`]*`");
  std::vector<std::string> found;
  std::istringstream lines(markdown);
  std::string line;
  bool isCode = false;
  Indentation indentation;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t text = line.find_first_not_of(' ');
    const bool isFence = text != std::string::npos && line.compare(text, 3, "```") == 0;
    if (isFence) isCode = !isCode;
    if (isFence || isCode) continue;
    const std::string place = "line " + std::to_string(number) + ": ";
    if (indentation.isOff(line)) found.push_back(place + "text indented like code");
    const std::string prose = std::regex_replace(line, kSpan, "code");
    for (const Mark& mark : marks()) {
      if (std::regex_search(prose, mark.pattern)) found.push_back(place + mark.what);
    }
  }
  if (isCode) found.push_back("a fence of code that nothing closes");
  return found;
}

}  // namespace foretouch::house
