// tools/console.h: what the program tells the shell, and how it tells a person what went wrong.
#pragma once

#include <string>

#include "articulated/result.h"

namespace foretouch::tools {

enum class ExitCode : int {
  Done = 0,
  CheckSaysNo = 1,  ///< A check found its subject wanting, or part of a damaged input was lost.
  BadInput = 2,     ///< Bad use, bad input, or output that cannot be written.
};

/// One line on stderr, "foretouch: <file>:<line>: <what>"; control characters are replaced.
void printError(const std::string& text);
/// The same for an Error; returns what the program ends with.
ExitCode failed(const Error& error);

/// A line on stderr for what is worth knowing and keeps nothing from being done.
void printNote(const std::string& text);

/// Text on stderr as it is: what would go to stdout, where that is taken.
void printAside(const std::string& text);

/// Text on stdout. Whether it arrived is asked once, by outputArrived().
void printOut(const std::string& text);
[[nodiscard]] bool outputArrived();

/// The error with `file` as its place where it names none.
[[nodiscard]] Error inFile(Error error, const std::string& file);
template <typename T>
[[nodiscard]] Result<T> inFile(Result<T> result, const std::string& file) {
  if (result.ok()) return result;
  return inFile(result.error(), file);
}

}  // namespace foretouch::tools
