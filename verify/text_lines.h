// verify/text_lines.h: lines of words and numbers.
#pragma once

#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

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

 private:
  void split(std::string_view line) {
    constexpr std::string_view kBlanks = " \t\r";
    for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
      words_.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(kBlanks, end);
    }
  }

  std::string_view rest_;
  std::vector<std::string_view> words_;
  long long line_ = 0;
};

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
