// tools/console.h: exit codes for the shell, and messages for people.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

enum class ExitCode : int {
  Done = 0,
  CheckSaysNo = 1,  ///< A check failed, or part of a damaged input was lost.
  BadInput = 2,     ///< Bad use, bad input, or unwritable output.
};

struct ExitMeaning {
  ExitCode code;
  const char* text;
};
/// For help, manual pages and documents.
inline constexpr ExitMeaning kExitMeanings[] = {
    {ExitCode::Done, "Done, and every check says yes"},
    {ExitCode::CheckSaysNo, "A check says no, or part of a damaged input is lost"},
    {ExitCode::BadInput, "Bad use, bad input, or an output that cannot be written"},
};

/// From now on, no notes and no progress: --quiet.
void keepQuiet();
[[nodiscard]] bool isQuiet();

/// One line on stderr, "foretouch: <file>:<line>: <what>"; replaces control characters.
void printError(const std::string& text);
/// The same for an Error; returns the program's exit code.
ExitCode failed(const Error& error);

/// A line on stderr for remarks that stop nothing.
void printNote(const std::string& text);
/// A remark for each note, about a file.
void printNotes(const std::string& file, const std::vector<std::string>& notes);

/// Text on stderr, unchanged: for text that belongs on stdout when a file uses stdout.
void printAside(const std::string& text);

/// Text on stdout. Call outputArrived() once, to check that it arrived.
void printOut(const std::string& text);
[[nodiscard]] bool outputArrived();

}  // namespace foretouch::tools
