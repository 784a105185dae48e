#include "tools/settings/lists.h"

#include <algorithm>
#include <utility>

#include "assets/json_writer.h"
#include "assets/text_file.h"
#include "tools/settings/frame_settings.h"

namespace foretouch::tools {
namespace {

/// `read` says whether a part is legal, and reads it.
template <typename Value, typename Read, typename Show>
Setting& addEach(Settings& settings, const char* option, const char* value,
                 std::vector<Value>& place, const std::string& legal, Read read, Show show,
                 const char* help) {
  const auto take = [&place, legal, read](const std::string& text) -> Result<Done> {
    std::vector<Value> values;
    for (const std::string& part : splitAtCommas(text)) {
      Value one{};
      if (!read(part, one)) {
        return Error::of(ErrorCode::OutOfRange, "expected " + legal + ", found " + inQuotes(part));
      }
      values.push_back(std::move(one));
    }
    place = std::move(values);
    return Done{};
  };
  const auto shown = [&place, show] {
    std::string text;
    for (const Value& one : place) text += (text.empty() ? "" : ",") + show(one);
    return text;
  };
  Setting& setting = settings.parsed(option, value, take, shown, help);
  setting.legal = legal;
  return setting;
}

std::vector<Simd> everySimd() {
  std::vector<Simd> all = supportedSimd();
  std::reverse(all.begin(), all.end());
  return all;
}

}  // namespace

Setting& addNumbers(Settings& settings, const char* option, const char* value,
                    std::vector<double>& place, NumberRange range, const char* help) {
  const auto read = [range](const std::string& part, double& number) {
    return readNumber(part, number) && range.contains(number);
  };
  return addEach(settings, option, value, place, range.inWords(), read, numberText, help);
}

Setting& addCounts(Settings& settings, const char* option, const char* value,
                   std::vector<int>& place, int most, const char* help) {
  const auto read = [most](const std::string& part, int& count) {
    std::int64_t whole = 0;
    if (!readNumber(part, whole) || whole < 1 || whole > most) return false;
    count = static_cast<int>(whole);
    return true;
  };
  const auto show = [](int count) { return std::to_string(count); };
  return addEach(settings, option, value, place, "a whole number from 1 to " + std::to_string(most),
                 read, show, help);
}

Setting& addWords(Settings& settings, const char* option, const char* value,
                  std::vector<std::string>& place, const std::vector<std::string>& legal,
                  const char* help) {
  const auto read = [legal](const std::string& part, std::string& word) {
    word = part;
    return !part.empty() &&
           (legal.empty() || std::find(legal.begin(), legal.end(), part) != legal.end());
  };
  const auto show = [](const std::string& word) { return word; };
  return addEach(settings, option, value, place,
                 legal.empty() ? "a name between every two commas" : wordList(legal), read, show,
                 help);
}

Setting& addUpAxes(Settings& settings, const char* option, const char* value,
                   std::vector<UpAxis>& place, const char* help) {
  const auto read = [](const std::string& part, UpAxis& up) {
    up = part == "z" ? UpAxis::Z : UpAxis::Y;
    return part == "y" || part == "z";
  };
  const auto show = [](UpAxis up) { return std::string(wordOf(up)); };
  return addEach(settings, option, value, place, "y or z", read, show, help);
}

Setting& addSimds(Settings& settings, const char* option, std::vector<Simd>& place,
                  const char* help) {
  place = everySimd();
  std::vector<std::string> legal;
  for (const Simd simd : place) legal.emplace_back(toString(simd));
  legal.insert(legal.end(), {"all", "widest"});
  const auto read = [](const std::string& part, Simd& simd) {
    const std::vector<Simd> all = everySimd();
    const auto named = simdFromName(part);
    simd = named.value_or(Simd::Scalar);
    return named && std::find(all.begin(), all.end(), simd) != all.end();
  };
  const auto show = [](Simd simd) { return std::string(toString(simd)); };
  Setting& setting =
      addEach(settings, option, "NAME,...", place, wordList(legal), read, show, help);
  setting.take = [take = setting.take, &place](const GivenValue& given) -> Result<Done> {
    const std::string& text = given.texts.front();
    if (text != "all" && text != "widest") return take(given);
    place = everySimd();
    if (text == "widest") place.resize(1);
    return Done{};
  };
  setting.shown = [shown = setting.shown, &place] {
    return place == everySimd() ? "all" : shown();
  };
  return setting;
}

}  // namespace foretouch::tools
