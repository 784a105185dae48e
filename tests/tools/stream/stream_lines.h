// tests/tools/stream/stream_lines.h: parses lines of results and of streams as texts.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace foretouch::test {

/// Is it about touches, and not about one step or answer?
inline bool isOfTouches(const std::string& line) {
  return line.rfind("{\"touch", 0) == 0 || line.rfind("{\"summary\":", 0) == 0;
}

/// The header, the steps and the answers.
inline std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!isOfTouches(line)) lines.push_back(line);
  }
  return lines;
}

/// The text of the list in the field "contacts", without each contact's time: "time" in results,
/// "utime" in streams.
inline std::string contactsIn(const std::string& line) {
  const std::string name = "\"contacts\":";
  const std::size_t begin = line.find(name);
  if (begin == std::string::npos) {
    ADD_FAILURE() << "no contacts in " << line;
    return "";
  }
  int depth = 0;
  std::string list;
  bool isInText = false;
  for (std::size_t i = begin + name.size(); i < line.size(); ++i) {
    const char c = line[i];
    list += c;
    if (c == '"' && line[i - 1] != '\\') isInText = !isInText;
    if (isInText) continue;
    if (c == '[') ++depth;
    if (c == ']' && --depth == 0) break;
  }
  for (const char* const field : {"\"time\":", "\"utime\":"}) {
    for (std::size_t at = list.find(field); at != std::string::npos; at = list.find(field)) {
      list.erase(at, list.find(',', at) + 1 - at);
    }
  }
  return list;
}

}  // namespace foretouch::test
