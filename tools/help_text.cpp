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

/// A command that goes on behind backslashes, as one line of words.
std::string wrappedCommand(const std::string& line, std::size_t columns) {
  constexpr std::size_t kBegin = 2, kGoesOn = 6;
  const std::string text = wrapped(line, columns - 2, kGoesOn, kBegin);
  std::string told = std::string(kBegin, ' ');
  for (const char c : text) told += c == '\n' ? std::string(" \\\n") : std::string(1, c);
  return told + "\n";
}

/// Paragraphs wrapped anew, commands by themselves.
std::string footerText(const std::string& footer, std::size_t columns) {
  std::istringstream lines(footer);
  std::string text, paragraph, command;
  const auto endParagraph = [&] {
    if (!paragraph.empty()) text += wrapped(paragraph, columns, 0, 0) + "\n";
    paragraph.clear();
  };
  for (std::string line; std::getline(lines, line);) {
    const bool goesOn = !line.empty() && line.back() == '\\';
    if (!command.empty() || line.rfind("  ", 0) == 0) {
      endParagraph();
      command += " " + (goesOn ? line.substr(0, line.size() - 1) : line);
      if (goesOn) continue;
      text += wrappedCommand(command, columns);
      command.clear();
    } else if (line.empty()) {
      endParagraph();
      text += "\n";
    } else {
      if (line.back() == ':') endParagraph();  // a title
      paragraph += (paragraph.empty() ? "" : " ") + line;
    }
  }
  endParagraph();
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
