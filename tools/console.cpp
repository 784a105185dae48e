#include "tools/console.h"

#include <cstdio>

namespace foretouch::tools {
namespace {

// The process has one, as it has one of each stream: all that print ask for it, without settings.
bool isToldQuiet = false;

/// File names and foreign text may contain line breaks and terminal sequences: one error is one
/// line.
std::string onOneLine(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
  }
  return text;
}

void printLine(const char* lead, const std::string& text) {
  const std::string line = lead + onOneLine(text) + "\n";
  static_cast<void>(std::fwrite(line.data(), 1, line.size(), stderr));
}

}  // namespace

void keepQuiet() {
  isToldQuiet = true;
}

bool isQuiet() {
  return isToldQuiet;
}

void printError(const std::string& text) {
  printLine("foretouch: ", text);
}

ExitCode failed(const Error& error) {
  printError(describe(error));
  return ExitCode::BadInput;
}

void printNote(const std::string& text) {
  if (!isToldQuiet) printLine("note: ", text);
}

void printNotes(const std::string& file, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) printNote(file + ": " + note);
}

void printAside(const std::string& text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

void printOut(const std::string& text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stdout));
}

bool outputArrived() {
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

}  // namespace foretouch::tools
