#include "verify/json.h"

#include "verify/text_lines.h"

namespace verify {
namespace {

constexpr int kDeepest = 32;

class JsonReading {
 public:
  explicit JsonReading(std::string_view text) : text_(text) {}

  bool readAll(Json& value) {
    if (!read(value, 0)) return false;
    skipBlanks();
    return at_ == text_.size();
  }

 private:
  void skipBlanks() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != text_.npos) ++at_;
  }
  bool take(char wanted) {
    skipBlanks();
    if (at_ == text_.size() || text_[at_] != wanted) return false;
    ++at_;
    return true;
  }
  bool takeWord(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }

  bool read(Json& value, int depth) {
    skipBlanks();
    if (at_ == text_.size() || depth > kDeepest) return false;
    switch (text_[at_]) {
      case '{': value.kind = Json::Kind::Object; return readList('{', '}', value, depth);
      case '[': value.kind = Json::Kind::Array; return readList('[', ']', value, depth);
      case '"': value.kind = Json::Kind::Text; return readText(value.text, value.hasEscape);
      case 'n': return takeWord("null");
      case 't': value.kind = Json::Kind::Truth; return takeWord("true");
      case 'f': value.kind = Json::Kind::Truth; return takeWord("false");
      default: value.kind = Json::Kind::Number; return readNumber(value.number);
    }
  }

  bool readText(std::string& text, bool& hasEscape) {
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') return ++at_, true;
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) {
        hasEscape = true;
        text += text_[at_++];
      }
      text += text_[at_];
    }
    return false;
  }

  bool readNumber(double& number) {
    const std::size_t end = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
    const std::string_view word = text_.substr(at_, end - at_);
    at_ = end;
    return isNumber(word, number);
  }

  bool readList(char open, char close, Json& value, int depth) {
    static_cast<void>(take(open));
    if (take(close)) return true;
    do {
      if (value.kind == Json::Kind::Object) {
        skipBlanks();
        if (at_ == text_.size() || text_[at_] != '"') return false;
        bool hasEscape = false;
        if (!readText(value.keys.emplace_back(), hasEscape) || hasEscape || !take(':'))
          return false;
      }
      if (!read(value.items.emplace_back(), depth + 1)) return false;
    } while (take(','));
    return take(close);
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

const Json* Json::find(std::string_view key) const {
  const Json* found = nullptr;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] != key) continue;
    if (found != nullptr) return nullptr;
    found = &items[i];
  }
  return found;
}

bool parseJson(std::string_view text, Json& value) {
  return JsonReading(text).readAll(value);
}

}  // namespace verify
