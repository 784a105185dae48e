#include "tools/help_text.h"

#include <algorithm>
#include <sstream>
#include <sys/ioctl.h>
#include <unistd.h>

namespace foretouch::tools {
namespace {

/// Where the sentences begin: behind "--unmatched-at-rest" and most options with their values.
constexpr std::size_t kTextColumn = 26;
constexpr std::size_t kLeastColumns = 60, kMostColumns = 100, kColumnsOfNoTerminal = 80;

std::string entryText(const HelpOption& entry, std::size_t columns) {
  std::string line = "  " + entry.names;
  if (entry.isArgument && !entry.value.empty()) line = "  " + entry.value;
  if (!entry.isArgument && !entry.value.empty()) line += " " + entry.value;
  std::string text = entry.text;
  if (entry.isRequired) text += " (required)";
  if (!entry.defaultText.empty()) text += " [" + entry.defaultText + "]";
  if (line.size() + 2 > kTextColumn) {
    line += "\n" + std::string(kTextColumn, ' ');
  } else {
    line.resize(kTextColumn, ' ');
  }
  return line + wrapped(text, columns, kTextColumn, kTextColumn) + "\n";
}

/// An option stays with its value.
std::string wrappedCommand(std::string line, std::size_t columns) {
  constexpr std::size_t kBegin = 2, kGoesOn = 6;
  constexpr char kNoBreak = '\x01';
  for (std::size_t at = line.find(" -"); at != std::string::npos; at = line.find(" -", at + 1)) {
    const std::size_t blank = line.find(' ', at + 1);
    if (blank != std::string::npos && line[blank + 1] != '-') line[blank] = kNoBreak;
  }
  const std::string text = wrapped(line, columns - 2, kGoesOn, kBegin);
  std::string told = std::string(kBegin, ' ');
  for (const char c : text) {
    told += c == '\n' ? std::string(" \\\n") : std::string(1, c == kNoBreak ? ' ' : c);
  }
  return told + "\n";
}

std::string footerText(const std::vector<HelpBlock>& footer, std::size_t columns) {
  std::string text;
  bool wasTitle = true;  // nothing stands between a title and its content
  for (const HelpBlock& block : footer) {
    if (!block.isCommand && !wasTitle) text += "\n";
    text += block.isCommand ? wrappedCommand(block.text, columns)
                            : wrapped(block.text, columns, 0, 0) + "\n";
    wasTitle = !block.isCommand && block.text.back() == ':';
  }
  return text;
}

}  // namespace

std::size_t textColumns() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) {
    return kColumnsOfNoTerminal;
  }
  return std::clamp<std::size_t>(size.ws_col, kLeastColumns, kMostColumns);
}

std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent,
                    std::size_t used) {
  std::istringstream words(text);
  std::string lines;
  std::size_t at = used;
  bool isFirst = true;
  for (std::string word; words >> word; isFirst = false) {
    if (!isFirst && at + 1 + word.size() > columns) {
      lines += "\n" + std::string(indent, ' ');
      at = indent;
    } else if (!isFirst) {
      lines += " ";
      ++at;
    }
    lines += word;
    at += word.size();
  }
  return lines;
}

std::string helpText(const HelpPage& page, std::size_t columns) {
  std::string text = wrapped(page.purpose, columns, 0, 0) + "\n\n";
  text += "Usage: " + wrapped(page.usage, columns, 11, 7) + "\n";
  for (const HelpGroup& group : page.groups) {
    text += "\n" + group.title + ":\n";
    for (const HelpOption& entry : group.entries) text += entryText(entry, columns);
  }
  if (!page.footer.empty()) text += "\n" + footerText(page.footer, columns);
  return text;
}

}  // namespace foretouch::tools
