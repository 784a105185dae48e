#include "assets/import/xml_damage.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "articulated/quoted.h"

namespace foretouch::internal {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

bool isNameCharacter(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
         (byte >= '0' && byte <= '9') || byte >= 0x80 || c == '_' || c == ':' || c == '-' ||
         c == '.';
}

bool isNameStart(char c) {
  return isNameCharacter(c) && c != '-' && c != '.' && !(c >= '0' && c <= '9');
}

/// Reads from front to back and stops at the first fault.
class XmlCheck {
 public:
  explicit XmlCheck(std::string_view text) : text_(text) {}

  std::string run() {
    const std::size_t zero = text_.find('\0');
    if (zero != std::string_view::npos) fail(zero, "expected text, found a zero byte");
    while (damage_.empty() && at_ < text_.size()) {
      text_[at_] == '<' ? markup() : characters();
    }
    if (!damage_.empty()) return damage_;
    if (!open_.empty()) {
      fail(text_.size(), "expected </" + shown(open_.back().name) + ">, which closes line " +
                             std::to_string(lineOf(open_.back().offset)) + ", found the end");
    } else if (!hasRoot_) {
      fail(text_.size(), "expected an element, found the end");
    }
    return damage_;
  }

 private:
  struct Tag {
    std::string_view name;
    std::size_t offset;
  };

  [[nodiscard]] std::size_t lineOf(std::size_t offset) const {
    const std::string_view before = text_.substr(0, offset);
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  }

  /// Names are part of what is shown, not the whole of it: without quotes around them.
  static std::string shown(std::string_view name) {
    const std::string quoted = inQuotes(name);
    return quoted.substr(1, quoted.size() - 2);
  }

  void fail(std::size_t offset, const std::string& what) {
    damage_ = "line " + std::to_string(lineOf(offset)) + ": " + what;
  }

  /// The text at `offset`, in words.
  [[nodiscard]] std::string found(std::size_t offset) const {
    return offset < text_.size() ? inQuotes(text_.substr(offset, 1)) : "the end";
  }

  [[nodiscard]] bool startsWith(std::string_view word) const {
    return text_.substr(at_, word.size()) == word;
  }

  void skipBlanks() { at_ = std::min(text_.find_first_not_of(kBlanks, at_), text_.size()); }

  std::string_view name() {
    const std::size_t begin = at_;
    if (at_ < text_.size() && isNameStart(text_[at_])) {
      while (at_ < text_.size() && isNameCharacter(text_[at_])) ++at_;
    }
    return text_.substr(begin, at_ - begin);
  }

  void characters() {
    const std::size_t begin = at_;
    at_ = std::min(text_.find('<', at_), text_.size());
    const std::string_view between = text_.substr(begin, at_ - begin);
    const std::size_t visible = between.find_first_not_of(kBlanks);
    if (open_.empty() && visible != std::string_view::npos) {
      fail(begin + visible,
           "expected an element, found text outside of all: " + inQuotes(between.substr(visible)));
    }
  }

  void markup() {
    if (startsWith("<!--")) return passOver(4, "-->", "comment");
    if (startsWith("<![CDATA[")) return passOver(9, "]]>", "CDATA section");
    if (startsWith("<?")) return passOver(2, "?>", "processing instruction");
    if (startsWith("<!")) return documentType();
    return startsWith("</") ? endTag() : startTag();
  }

  void passOver(std::size_t lead, std::string_view end, const char* what) {
    const std::size_t begin = at_;
    const std::size_t found = text_.find(end, begin + lead);
    if (found == std::string_view::npos) {
      fail(begin,
           std::string("expected ") + std::string(end) + " after this " + what + ", found none");
    } else {
      at_ = found + end.size();
    }
  }

  /// Up to the > that closes it; its declarations are in brackets.
  void documentType() {
    int depth = 0;
    for (std::size_t i = at_; i < text_.size(); ++i) {
      if (text_[i] == '[') ++depth;
      if (text_[i] == ']') --depth;
      if (text_[i] == '>' && depth <= 0) {
        at_ = i + 1;
        return;
      }
    }
    fail(at_, "expected > after this declaration, found none");
  }

  void endTag() {
    const std::size_t begin = at_;
    at_ += 2;
    const std::string_view closed = name();
    skipBlanks();
    if (open_.empty()) {
      fail(begin, "expected no closing tag, as nothing is open, found </" + shown(closed) + ">");
    } else if (closed != open_.back().name) {
      fail(begin, "expected </" + shown(open_.back().name) + ">, which closes line " +
                      std::to_string(lineOf(open_.back().offset)) + ", found </" + shown(closed) +
                      ">");
    } else if (at_ == text_.size() || text_[at_] != '>') {
      fail(begin, "expected > after </" + shown(closed) + ", found " + found(at_));
    } else {
      ++at_;
      open_.pop_back();
    }
  }

  void startTag() {
    const std::size_t begin = at_++;
    const std::string_view opened = name();
    if (opened.empty()) return fail(begin, "expected a name after <, found " + found(at_));
    if (open_.empty() && hasRoot_) {
      return fail(begin, "expected nothing after the first element, found <" + shown(opened) + ">");
    }
    hasRoot_ = true;
    while (damage_.empty()) {
      const std::size_t before = at_;
      skipBlanks();
      if (at_ < text_.size() && text_[at_] == '>') {
        ++at_;
        open_.push_back({opened, begin});
        return;
      }
      if (startsWith("/>")) {
        at_ += 2;
        return;
      }
      attribute(opened, at_ > before);
    }
  }

  void attribute(std::string_view element, bool isApart) {
    const std::string in = " in <" + shown(element) + ">";
    const std::size_t begin = at_;
    const std::string_view key = name();
    if (key.empty() || !isApart) {
      const bool isNone = isApart || begin == text_.size();
      return fail(begin, std::string("expected ") + (isNone ? "an attribute, /> or >" : "a blank") +
                             in + ", found " + found(begin));
    }
    skipBlanks();
    const std::size_t sign = at_;
    if (at_ == text_.size() || text_[at_++] != '=') {
      return fail(sign, "expected = after " + inQuotes(key) + in + ", found " + found(sign));
    }
    skipBlanks();
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    if (quote != '"' && quote != '\'') {
      return fail(at_,
                  "expected a value in quotes for " + inQuotes(key) + in + ", found " + found(at_));
    }
    const std::size_t end = text_.find_first_of(quote == '"' ? "\"<" : "'<", at_ + 1);
    if (end == std::string_view::npos || text_[end] == '<') {
      return fail(at_, "expected a closing quote after the value of " + inQuotes(key) + in +
                           ", found " + (end == std::string_view::npos ? "the end" : "'<'"));
    }
    at_ = end + 1;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<Tag> open_;
  bool hasRoot_ = false;
  std::string damage_;
};

}  // namespace

std::string damageOfXml(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.substr(0, 2) == "\xFF\xFE" || text.substr(0, 2) == "\xFE\xFF") return "";
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    text.remove_prefix(kByteOrderMark.size());
  }
  return XmlCheck(text).run();
}

}  // namespace foretouch::internal
