#include "tools/settings/setting.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "assets/near_names.h"
#include "assets/text_file.h"
#include "lss/assert.h"

namespace foretouch::tools {
namespace {

/// True if `text` as a whole is a number that fits and is finite.
template <typename Number>
bool isNumber(const std::string& text, Number& number) {
  const char* const end = text.data() + text.size();
  const auto [rest, problem] = std::from_chars(text.data(), end, number);
  return problem == std::errc() && rest == end && std::isfinite(static_cast<double>(number));
}

/// Whether the text is of the setting's kind; `given` then holds it.
bool readTyped(const Setting& setting, GivenValue& given) {
  const auto& words = setting.words;
  const std::string& text = given.texts.front();
  if (std::find(words.begin(), words.end(), text) != words.end()) return true;
  if (setting.kind == ValueKind::Number) return readNumber(text, given.number);
  if (setting.kind == ValueKind::Whole) return readNumber(text, given.whole);
  return true;
}

}  // namespace

Setting& Setting::inConfig(const char* ofTable, const char* ofKey) {
  table = ofTable;
  key = ofKey;
  return *this;
}

Setting& Setting::inHeader(const char* name) {
  field = name;
  return *this;
}

Setting& Setting::inReport(const char* name) {
  row = name;
  return *this;
}

Setting& Setting::namedIf(std::function<bool()> condition) {
  isNamed = std::move(condition);
  return *this;
}

Setting& Setting::in(const char* helpGroup) {
  group = helpGroup;
  return *this;
}

Setting& Setting::required(const char* what) {
  isRequired = true;
  noun = what;
  return *this;
}

Setting& Setting::standingForRequired() {
  standsForRequired = true;
  return *this;
}

Setting& Setting::needing(const char* other) {
  needs = other;
  return *this;
}

Setting& Setting::notEmpty() {
  mayBeEmpty = false;
  return *this;
}

Setting& Setting::ofClips() {
  isOfClips = true;
  return *this;
}

Setting& Setting::ofLogs() {
  isOfLogs = true;
  return *this;
}

Setting& Setting::files(const char* ofEndings) {
  takesFiles = true;
  endings = ofEndings;
  return *this;
}

Setting& Setting::formerly(const char* name) {
  formerNames.emplace_back(name);
  return *this;
}

Setting& Setting::only(std::vector<std::string> some) {
  for (const std::string& word : some) {
    FORETOUCH_ASSERT(std::find(words.begin(), words.end(), word) != words.end());
  }
  words = some;
  legal = wordList(words);
  const auto takeAny = take;
  take = [takeAny, some](const GivenValue& given) -> Result<Done> {
    if (std::find(some.begin(), some.end(), given.texts.front()) != some.end()) {
      return takeAny(given);
    }
    Error error = notLegal(wordList(some), given);
    error.message += didYouMean(given.texts.front(), some);
    return error;
  };
  return *this;
}

bool readNumber(const std::string& text, double& number) {
  return isNumber(text, number);
}

bool readNumber(const std::string& text, std::int64_t& whole) {
  return isNumber(text, whole);
}

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

Result<Done> takeTyped(Setting& setting, const std::vector<std::string>& texts) {
  GivenValue given;
  given.texts = texts;
  if (!texts.empty()) given.found = inQuotes(texts.front());
  const bool isRead = texts.empty() || readTyped(setting, given);
  auto taken = isRead ? setting.take(given) : Result<Done>(notLegal(setting.legal, given));
  setting.isGiven = true;
  return inFile(std::move(taken), setting.name());
}

Error notLegal(const std::string& legal, const GivenValue& given) {
  return {ErrorCode::OutOfRange, "", -1, -1, "expected " + legal + ", found " + given.found};
}

std::string tidyNumber(double number) {
  char digitsOf[32];
  const auto end = std::to_chars(digitsOf, digitsOf + sizeof digitsOf, number).ptr;
  const std::string text(digitsOf, end);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  const bool isSmall = text[e + 1] == '-';
  const std::size_t digits = text.find_first_not_of("+-0", e + 1);
  return text.substr(0, e + 1) + (isSmall ? "-" : "") + text.substr(digits);
}

std::string wordList(const std::vector<std::string>& words, const char* last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? std::string(" ") + last + " " : ", ";
    text += words[i];
  }
  return text;
}

}  // namespace foretouch::tools
