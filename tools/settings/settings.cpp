#include "tools/settings/settings.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "assets/near_names.h"
#include "lss/assert.h"
#include "tools/microseconds.h"

namespace foretouch::tools {
namespace {

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + text;
  return all;
}

std::string nameOfFile(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

std::string withSign(double number, const NumberRange& range) {
  return numberText(number) + (*range.sign == '\0' ? "" : " ") + range.sign;
}

}  // namespace

std::string NumberRange::inWords() const {
  std::string text = "a finite number";
  if (*unit != '\0') text += std::string(" of ") + unit;
  if (most < std::numeric_limits<double>::max()) {
    return text + " from " + tidyNumber(least) + " to " + tidyNumber(most);
  }
  return least == 0.0 ? text + (takesZero ? " of at least 0" : " greater than 0") : text;
}

Setting& Settings::number(const char* option, const char* value, double& place, NumberRange range,
                          const char* help) {
  Setting& setting = add(option, value, ValueKind::Number, help);
  setting.legal = range.inWords();
  setting.take = [&place, range](const GivenValue& given) -> Result<Done> {
    if (!range.contains(given.number)) return notLegal(range.inWords(), given);
    place = given.number;
    return Done{};
  };
  setting.shown = setting.json = [&place] { return numberText(place); };
  setting.told = [&place, range] { return withSign(place, range); };
  return setting;
}

Setting& Settings::number(const char* option, const char* value, std::optional<double>& place,
                          NumberRange range, const char* none, const char* help) {
  Setting& setting = add(option, value, ValueKind::Number, help);
  const std::string word = none;
  setting.legal = range.inWords();
  if (!word.empty()) {
    setting.words = {word};
    setting.legal += " or " + word;
  }
  const std::string legal = setting.legal;
  setting.take = [&place, range, word, legal](const GivenValue& given) -> Result<Done> {
    const bool isNone = !word.empty() && given.texts.front() == word;
    if (!isNone && !range.contains(given.number)) return notLegal(legal, given);
    place = isNone ? std::nullopt : std::optional<double>(given.number);
    return Done{};
  };
  setting.shown = [&place, word] { return place ? numberText(*place) : word; };
  setting.json = [&place] { return place ? numberText(*place) : "null"; };
  setting.told = [&place, range] { return place ? withSign(*place, range) : ""; };
  return setting;
}

Setting& Settings::seconds(const char* option, std::int64_t& placeUs, NumberRange range,
                           const char* help) {
  Setting& setting = add(option, "S", ValueKind::Number, help);
  setting.legal = range.inWords();
  setting.take = [&placeUs, range](const GivenValue& given) -> Result<Done> {
    if (!range.contains(given.number)) return notLegal(range.inWords(), given);
    placeUs = inMicroseconds(given.number);
    return Done{};
  };
  setting.shown = setting.json = [&placeUs] { return numberText(inSeconds(placeUs)); };
  return setting;
}

Setting& Settings::seconds(const char* option, std::optional<std::int64_t>& placeUs,
                           const char* help) {
  Setting& setting = add(option, "S", ValueKind::Number, help);
  setting.legal = kTimeInWords;
  setting.take = [&placeUs](const GivenValue& given) -> Result<Done> {
    if (!isTime(given.number)) return notLegal(kTimeInWords, given);
    placeUs = inMicroseconds(given.number);
    return Done{};
  };
  setting.shown = [&placeUs] { return placeUs ? numberText(inSeconds(*placeUs)) : ""; };
  setting.json = [&placeUs] { return placeUs ? numberText(inSeconds(*placeUs)) : "null"; };
  return setting;
}

Setting& Settings::wholeAt(const char* option, const char* value, std::int64_t least,
                           std::int64_t most, std::function<void(std::int64_t)> put,
                           const char* help) {
  Setting& setting = add(option, value, ValueKind::Whole, help);
  setting.legal = fmt::format("a whole number from {} to {}", least, most);
  setting.take = [least, most, put = std::move(put),
                  legal = setting.legal](const GivenValue& given) -> Result<Done> {
    if (given.whole < least || given.whole > most) return notLegal(legal, given);
    put(given.whole);
    return Done{};
  };
  return setting;
}

Setting& Settings::orWord(std::string word, Setting& setting, std::function<void()> putNone) {
  setting.words = {word};
  setting.legal += " or " + word;
  setting.take = [take = setting.take, word, putNone = std::move(putNone),
                  legal = setting.legal](const GivenValue& given) -> Result<Done> {
    if (given.texts.front() != word) {
      return take(given).ok() ? Result<Done>(Done{}) : notLegal(legal, given);
    }
    putNone();
    return Done{};
  };
  setting.shown = [shown = setting.shown, word] { return shown() == "0" ? word : shown(); };
  return setting;
}

Setting& Settings::wordAt(const char* option, const char* value, std::vector<std::string> words,
                          std::function<void(std::size_t)> put, std::function<std::string()> shown,
                          const char* help) {
  Setting& setting = add(option, value, ValueKind::Text, help);
  setting.words = words;
  setting.legal = wordList(words);
  setting.take = [words, put = std::move(put)](const GivenValue& given) -> Result<Done> {
    const std::string& word = given.texts.front();
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) {
      Error error = notLegal(wordList(words), given);
      error.message += didYouMean(word, words);
      return error;
    }
    put(static_cast<std::size_t>(found - words.begin()));
    return Done{};
  };
  setting.shown = setting.told = shown;
  setting.json = [shown] { return jsonString(shown()); };
  return setting;
}

Setting& Settings::flag(const char* option, bool& place, const char* help,
                        std::vector<std::string> words) {
  FORETOUCH_ASSERT(words.empty() || words.size() == 2);
  Setting& setting = add(option, "", ValueKind::Flag, help);
  setting.words = words;
  setting.legal = wordList(words);
  setting.take = [&place, words](const GivenValue& given) -> Result<Done> {
    place = given.texts.empty() || given.texts.front() == words[1];
    return Done{};
  };
  setting.shown = setting.told = [&place, words] {
    return words.empty() ? std::string() : words[place ? 1 : 0];
  };
  setting.json = [&place] { return place ? "true" : "false"; };
  return setting;
}

Setting& Settings::text(const char* option, const char* value, std::string& place,
                        const char* help) {
  Setting& setting = add(option, value, ValueKind::Text, help);
  setting.take = [&place](const GivenValue& given) -> Result<Done> {
    place = given.texts.front();
    return Done{};
  };
  setting.shown = setting.told = [&place] { return place; };
  setting.json = [&place] { return jsonString(place); };
  return setting;
}

Setting& Settings::path(const char* option, const char* value, std::string& place,
                        const char* help) {
  Setting& setting = text(option, value, place, help);
  setting.isPath = setting.takesFiles = true;
  setting.told = [&place] { return nameOfFile(place); };
  setting.json = [&place] { return jsonString(std::filesystem::path(place).filename().string()); };
  return setting;
}

Setting& Settings::output(const char* option, const char* value, std::string& place,
                          const char* help) {
  Setting& setting = path(option, value, place, help);
  setting.take = [&place](const GivenValue& given) -> Result<Done> {
    place = given.texts.front() == "-" ? kStandardOutput : given.texts.front();
    return Done{};
  };
  return setting.in(kOutputGroup);
}

Setting& Settings::outputFolder(const char* option, std::string& place, const char* help) {
  Setting& setting = path(option, "DIR", place, help);
  setting.take = [&place](const GivenValue& given) -> Result<Done> {
    place = given.texts.front();
    if (place != "-") return Done{};
    return Error::of(ErrorCode::OutOfRange,
                     "expected a folder for several files, found '-', which is standard output "
                     "(./- names a folder of that name)");
  };
  return setting.in(kOutputGroup);
}

Setting& Settings::list(const char* option, const char* value, std::vector<std::string>& place,
                        const char* help) {
  Setting& setting = add(option, value, ValueKind::List, help);
  setting.take = [&place](const GivenValue& given) -> Result<Done> {
    place = given.texts;
    return Done{};
  };
  setting.shown = setting.told = [&place] { return joined(place); };
  setting.json = [&place] {
    std::string text;
    JsonWriter(text).value(place);
    return text;
  };
  return setting;
}

Setting& Settings::parsed(const char* option, const char* value,
                          std::function<Result<Done>(const std::string&)> take,
                          std::function<std::string()> shown, const char* help) {
  Setting& setting = add(option, value, ValueKind::Text, help);
  setting.take = [take = std::move(take)](const GivenValue& given) {
    return take(given.texts.front());
  };
  setting.shown = setting.told = std::move(shown);
  setting.json = [shown = setting.shown] { return jsonString(shown()); };
  return setting;
}

Setting& Settings::asJson(bool& place) {
  return flag("--json", place, "Print what is found as one line of JSON (docs/formats.md)")
      .in(kOutputGroup);
}

Setting& Settings::gone(const char* option, const char* text) {
  Setting& setting = add(option, "", ValueKind::Text, "");
  setting.isGone = text;
  setting.valueIfNone = "none";  // no error of its own if nothing follows
  setting.shown = setting.told = [] { return std::string(); };
  setting.take = [text](const GivenValue&) -> Result<Done> {
    return Error::of(ErrorCode::Mismatch, text);
  };
  return setting;
}

Setting& Settings::of(const std::string& option) {
  const auto found =
      std::find_if(all_.begin(), all_.end(), [&](const Setting& s) { return s.name() == option; });
  FORETOUCH_ASSERT(found != all_.end());
  return *found;
}

bool Settings::isGiven(const std::string& option) const {
  return std::any_of(all_.begin(), all_.end(),
                     [&](const Setting& s) { return s.name() == option && s.isGiven; });
}

const Setting& Settings::ofField(const std::string& field) const {
  const auto found =
      std::find_if(all_.begin(), all_.end(), [&](const Setting& s) { return s.field == field; });
  FORETOUCH_ASSERT(found != all_.end());
  return *found;
}

const Setting& Settings::ofRow(const std::string& row) const {
  const auto found =
      std::find_if(all_.begin(), all_.end(), [&](const Setting& s) { return s.row == row; });
  FORETOUCH_ASSERT(found != all_.end());
  return *found;
}

Setting& Settings::add(const char* option, const char* value, ValueKind kind, const char* help) {
  Setting& setting = all_.emplace_back();
  setting.option = option;
  setting.value = value;
  setting.kind = kind;
  setting.help = help;
  return setting;
}

void writeHeaderField(const Settings& settings, const char* field, JsonWriter& out) {
  out.rawField(field, settings.ofField(field).json());
}

void writeHeaderFields(const Settings& settings, std::initializer_list<const char*> fields,
                       JsonWriter& out) {
  for (const char* const field : fields) {
    const Setting& setting = settings.ofField(field);
    if (!setting.isNamed || setting.isNamed()) writeHeaderField(settings, field, out);
  }
}

}  // namespace foretouch::tools
