#include "assets/bvh/bvh_text.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "articulated/clip.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/decimal.h"
#include "assets/text_file.h"

namespace foretouch::internal {
namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

bool isBrace(char c) {
  return c == '{' || c == '}';
}

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// Is a well-formed decimal number that from_chars() found out of range above the largest double
/// (else below the smallest)? The sign of the decimal exponent of its first non-zero digit decides,
/// because the range ends near 1e308 and 1e-324.
bool isAboveRange(std::string_view number) {
  constexpr int kCap = 1000000;  // more than any word of kMaxBvhToken bytes can balance
  const std::size_t e = number.find_first_of("eE");
  int exponent = 0;
  if (e != number.npos) {
    const bool negative = number[e + 1] == '-';
    for (const char c : number.substr(e + 1)) {
      if (isDigit(c)) exponent = std::min(kCap, exponent * 10 + (c - '0'));
    }
    if (negative) exponent = -exponent;
  }
  const std::string_view mantissa = number.substr(0, e);
  const auto point = static_cast<int>(std::min(mantissa.find('.'), mantissa.size()));
  const auto first = static_cast<int>(mantissa.find_first_of("123456789"));
  return exponent + (first < point ? point - first - 1 : point - first) > 0;
}

}  // namespace

bool isKeyword(std::string_view word, std::string_view lowerCaseKeyword) {
  const auto same = [](char c, char lower) {
    return (c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) == lower;
  };
  return std::equal(word.begin(), word.end(), lowerCaseKeyword.begin(), lowerCaseKeyword.end(),
                    same);
}

Error bvhError(ErrorCode code, std::int64_t line, std::string message) {
  Error error;
  error.code = code;
  error.line = line;
  error.message = std::move(message);
  return error;
}

Error bvhExpected(const std::string& what, const BvhWord& found) {
  const std::string word = found.text.empty() ? "the end of the file" : inQuotes(found.text);
  return bvhError(ErrorCode::Syntax, found.line, "expected " + what + ", found " + word);
}

std::optional<Error> binaryContent(std::string_view text) {
  std::int64_t line = 1;
  std::size_t wordLength = 0;
  char before = '\0';
  for (const char c : text) {
    wordLength = isBlank(c) || isBrace(c) ? 0 : wordLength + 1;
    line += c == '\n' ? (before == '\r' ? 0 : 1) : (c == '\r' ? 1 : 0);
    before = c;
    if (wordLength == 0) continue;
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      return bvhError(ErrorCode::Syntax, line,
                      "expected text, found the control byte " + inQuotes({&c, 1}) +
                          "; is this a binary or UTF-16 file?");
    }
    if (wordLength > kMaxBvhToken) {
      return bvhError(ErrorCode::LimitExceeded, line,
                      "expected words of at most " + std::to_string(kMaxBvhToken) + " bytes");
    }
  }
  return std::nullopt;
}

BvhScanner::BvhScanner(std::string_view text) : rest_(text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (rest_.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    rest_.remove_prefix(kByteOrderMark.size());
  }
}

void BvhScanner::skipBlanks() {
  std::size_t i = 0;
  for (; i < rest_.size() && isBlank(rest_[i]); ++i) {
    const bool endsLine =
        rest_[i] == '\n' || (rest_[i] == '\r' && (i + 1 == rest_.size() || rest_[i + 1] != '\n'));
    line_ += endsLine ? 1 : 0;
  }
  rest_.remove_prefix(i);
}

BvhWord BvhScanner::next(Colon colon) {
  skipBlanks();
  const auto isAlone = [colon](char c) {
    return isBrace(c) || (c == ':' && colon == Colon::Separate);
  };
  std::size_t length = 0;
  while (length < rest_.size() && !isBlank(rest_[length]) && !isAlone(rest_[length])) ++length;
  if (length == 0 && !rest_.empty()) length = 1;  // stands alone
  const BvhWord word{rest_.substr(0, length), line_};
  rest_.remove_prefix(length);
  return word;
}

BvhWord BvhScanner::peek(Colon colon) const {
  BvhScanner ahead = *this;
  return ahead.next(colon);
}

BvhWord BvhScanner::nextName() {
  skipBlanks();
  const auto ends = [](char c) { return c == '\n' || c == '\r' || isBrace(c); };
  const auto end = std::find_if(rest_.begin(), rest_.end(), ends);
  BvhWord name{rest_.substr(0, static_cast<std::size_t>(end - rest_.begin())), line_};
  rest_.remove_prefix(name.text.size());
  while (!name.text.empty() && isBlank(name.text.back())) name.text.remove_suffix(1);
  return name;
}

BvhNumber readBvhNumber(std::string_view word) {
  std::string_view digits = word;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  BvhNumber number;
  const char* end = digits.data() + digits.size();
  const auto [stop, status] = readDecimal(digits.data(), end, number.value);
  // Microsoft's runtime writes 1.#QNAN, -1.#IND and 1.#INF.
  const bool isMicrosoftNan = stop != end && digits.find(".#") != digits.npos;
  if (status == std::errc::invalid_argument || (stop != end && !isMicrosoftNan) ||
      (digits.size() != word.size() && digits.front() == '-')) {
    number.problem = "is not a number";
    return number;
  }
  if (status == std::errc::result_out_of_range) {
    number.value = isAboveRange(digits) ? HUGE_VAL : 0.0;
  }
  if (isMicrosoftNan || !std::isfinite(number.value)) {
    number.problem = "is not finite";
    number.code = ErrorCode::NonFinite;
  }
  return number;
}

Result<double> nextNumber(BvhScanner& scanner, const char* what) {
  const BvhWord word = scanner.next();
  const BvhNumber number = readBvhNumber(word.text);
  if (number.problem == nullptr) return number.value;
  if (number.code == ErrorCode::Syntax) return bvhExpected(what, word);
  return bvhError(number.code, word.line,
                  std::string("expected ") + what + ", found " + inQuotes(word.text) + ", which " +
                      number.problem);
}

void ClipNotes::add(std::string note) {
  if (notes_.size() + 1 < kMaxClipNotes) {
    notes_.push_back(std::move(note));
  } else {
    ++left_;  // one place is reserved for the sentence that says so
  }
}

std::vector<std::string> ClipNotes::take() {
  if (left_ > 0) notes_.push_back(std::to_string(left_) + " more notes were left out");
  left_ = 0;
  return std::exchange(notes_, {});
}

}  // namespace foretouch::internal
