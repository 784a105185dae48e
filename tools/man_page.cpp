#include "tools/man_page.h"

#include <algorithm>
#include <cctype>

namespace foretouch::tools {
namespace {

/// No character of it is a request or an escape.
std::string roff(const std::string& text) {
  std::string told;
  for (const char c : text) {
    if (c == '\\') {
      told += "\\e";
    } else if (c == '-') {
      told += "\\-";  // one that can be copied into a shell
    } else if (c == '\'') {
      told += "\\(aq";
    } else if (c == '`') {
      told += "\\(ga";
    } else {
      told += c;
    }
  }
  return !told.empty() && told.front() == '.' ? "\\&" + told : told;
}

std::string inCapitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string entryRoff(const HelpOption& entry) {
  const bool showsValue = entry.isArgument && !entry.value.empty();
  std::string text = ".TP\n\\fB" + roff(showsValue ? entry.value : entry.names) + "\\fR";
  if (!entry.isArgument && !entry.value.empty()) text += " \\fI" + roff(entry.value) + "\\fR";
  text += "\n" + roff(entry.text);
  if (entry.isRequired) text += " (required)";
  if (!entry.defaultText.empty()) text += " [" + roff(entry.defaultText) + "]";
  return text + "\n";
}

std::string notesRoff(const std::vector<HelpBlock>& footer) {
  std::string text;
  for (const HelpBlock& block : footer) {
    if (block.isCommand) {
      text += ".RS\n.nf\n" + roff(block.text) + "\n.fi\n.RE\n";
    } else {
      text += (text.empty() ? "" : ".PP\n") + roff(block.text) + "\n";
    }
  }
  return text.empty() ? text : ".SH NOTES\n" + text;
}

std::string referencesTo(const std::vector<std::string>& others) {
  std::string text;
  for (const std::string& other : others) {
    text += (text.empty() ? ".SH SEE ALSO\n.BR " : ",\n.BR ") + roff(manName(other)) + " (1)";
  }
  return text.empty() ? text : text + "\n";
}

}  // namespace

std::string manName(const std::string& command) {
  std::string name = command;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string manPage(const HelpPage& page, const std::string& version,
                    const std::vector<std::string>& others) {
  const std::string name = manName(page.command);
  std::string purpose = page.purpose;
  if (!purpose.empty() && purpose.back() == '.') purpose.pop_back();
  std::string text = ".TH " + roff(inCapitals(name)) + " 1 \"\" \"" + roff(version) + "\"\n";
  text += ".SH NAME\n" + roff(name) + " \\- " + roff(purpose) + "\n";
  text += ".SH SYNOPSIS\n.B " + roff(page.usage) + "\n";
  for (const HelpGroup& group : page.groups) {
    text += ".SH " + inCapitals(roff(group.title)) + "\n";
    for (const HelpOption& entry : group.entries) text += entryRoff(entry);
  }
  return text + notesRoff(page.footer) + referencesTo(others);
}

}  // namespace foretouch::tools
