#include "tests/house/cpp_tokens.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace foretouch::house {
namespace {

bool isOfWord(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

class Tokenizer {
 public:
  explicit Tokenizer(const std::string& source) : source_(source) {}

  std::vector<Token> run() {
    while (at_ < source_.size()) step();
    return std::move(tokens_);
  }

 private:
  void step() {
    const char c = source_[at_];
    if (c == '\n') {
      isLineBegin_ = true;
      skip(1);
    } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      skip(1);
    } else if (c == '#' && isLineBegin_) {
      skipDirective();
    } else if (startsWith("//")) {
      skipTo("\n", 0);
    } else if (startsWith("/*")) {
      skip(2);
      skipTo("*/", 2);
    } else if (c == '"' || startsWith("R\"")) {
      takeString();
    } else if (c == '\'') {
      takeQuoted('\'');
    } else {
      takeWordOrSign();
    }
  }

  [[nodiscard]] bool startsWith(const char* text) const {
    return source_.compare(at_, std::char_traits<char>::length(text), text) == 0;
  }
  void skip(std::size_t count) {
    const std::size_t end = std::min(source_.size(), at_ + count);
    for (; at_ < end; ++at_) line_ += source_[at_] == '\n' ? 1 : 0;
  }
  void skipTo(const std::string& mark, std::size_t beyond) {
    const std::size_t found = source_.find(mark, at_);
    skip((found == std::string::npos ? source_.size() : found + beyond) - at_);
  }
  /// With the lines that a backslash appends.
  void skipDirective() {
    std::size_t end = source_.find('\n', at_);
    while (end != std::string::npos && source_[end - 1] == '\\') end = source_.find('\n', end + 1);
    skip((end == std::string::npos ? source_.size() : end) - at_);
  }

  void take(std::size_t count) {
    isLineBegin_ = false;
    tokens_.push_back({source_.substr(at_, count), line_});
    skip(count);
  }
  void takeString() {
    isLineBegin_ = false;
    if (source_[at_] == '"') return takeQuoted('"');
    const std::size_t open = source_.find('(', at_);
    tokens_.push_back({"\"\"", line_});
    const std::string close = ")" + source_.substr(at_ + 2, open - at_ - 2) + "\"";
    skipTo(close, close.size());
  }
  void takeQuoted(char quote) {
    isLineBegin_ = false;
    tokens_.push_back({"\"\"", line_});
    skip(1);
    while (at_ < source_.size() && source_[at_] != quote) skip(source_[at_] == '\\' ? 2 : 1);
    skip(1);
  }
  void takeWordOrSign() {
    std::size_t count = 0;
    while (at_ + count < source_.size() && isOfWord(source_[at_ + count])) ++count;
    // Digits may be grouped by ', and a floating number has a point and signs; what they are is of
    // no matter here.
    if (count > 0 && std::isdigit(static_cast<unsigned char>(source_[at_])) != 0) {
      while (at_ + count < source_.size() &&
             (isOfWord(source_[at_ + count]) || source_[at_ + count] == '\'' ||
              source_[at_ + count] == '.')) {
        ++count;
      }
    }
    if (count == 0 && startsWith("::")) count = 2;
    take(std::max<std::size_t>(count, 1));
  }

  const std::string& source_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool isLineBegin_ = true;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> cppTokens(const std::string& source) {
  return Tokenizer(source).run();
}

}  // namespace foretouch::house
