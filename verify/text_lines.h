// verify/text_lines.h: lines of words and numbers.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "verify/fault.h"

namespace verify {

/// Lines in turn, as words between blanks; empty ones are skipped.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  /// False at the end.
  bool next() {
    words_.clear();
    while (words_.empty() && !rest_.empty()) {
      ++line_;
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      split(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
    }
    return !words_.empty();
  }
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  [[nodiscard]] long long line() const { return line_; }
  /// Blanks come before the first word.
  [[nodiscard]] bool isIndented() const { return isIndented_; }

 private:
  void split(std::string_view line) {
    constexpr std::string_view kBlanks = " \t\r";
    isIndented_ = line.find_first_not_of(kBlanks) != 0;
    for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
      words_.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(kBlanks, end);
    }
  }

  std::string_view rest_;
  std::vector<std::string_view> words_;
  long long line_ = 0;
  bool isIndented_ = false;
};

/// Where readers may see other lines than these: a byte that is not printable ASCII, tab or end of
/// line (some take a lone carriage return, or a line separator of Unicode, for the end of a line),
/// a backslash at a line's end (some go on with the next one), or an end without an end of line
/// (some drop the last one).
inline Fault otherLinesIn(std::string_view text) {
  long long line = 1;
  char last = '\n';  // but for blanks
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool isEnd = c == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if ((c < ' ' || c > '~') && c != '\n' && c != '\t' && !isEnd) {
      return {line,
              "expected printable ASCII, tabs and ends of lines: readers differ in what byte " +
                  std::to_string(static_cast<unsigned char>(c)) + " means"};
    }
    if (c == '\n' && last == '\\') {
      return {line, "expected no backslash at the end: some readers go on with the next line"};
    }
    if (c == '\n') ++line;
    if (c != ' ' && c != '\t' && c != '\r') last = c;
  }
  if (!text.empty() && text.back() != '\n') return {line, "expected an end of line at the end"};
  return {};
}

/// The whole word, a finite number of at most 1e9.
inline bool isNumber(std::string_view word, double& number) {
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
  return failure == std::errc() && end == word.data() + word.size() && std::abs(number) <= 1e9;
}
template <typename Whole>
bool isWhole(std::string_view word, Whole least, Whole most, Whole& number) {
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
  return failure == std::errc() && end == word.data() + word.size() && number >= least &&
         number <= most;
}
/// As many numbers, from word `first` on.
template <typename Numbers>
bool areNumbers(const std::vector<std::string_view>& words, std::size_t first, Numbers& numbers) {
  if (words.size() < first + numbers.size()) return false;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!isNumber(words[first + i], numbers[i])) return false;
  }
  return true;
}

}  // namespace verify
