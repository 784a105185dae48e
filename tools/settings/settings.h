// tools/settings/settings.h: a table of settings, each tied to the place of its value.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets/json_writer.h"
#include "tools/settings/setting.h"

namespace foretouch::tools {

/// The numbers from `least` to `most`, both legal except a `least` of 0.
struct NumberRange {
  double least, most;
  const char* unit = "";   ///< "metres"; empty: none.
  const char* sign = "";   ///< "m", behind a value in reports.
  bool takesZero = false;  ///< A `least` of 0 is legal too.

  [[nodiscard]] bool contains(double number) const {
    return number <= most && (number > least || (number == least && (least > 0.0 || takesZero)));
  }
  [[nodiscard]] std::string inWords() const;
};

/// Words and their values.
template <typename Value>
using Words = std::vector<std::pair<std::string, Value>>;

/// Most threads: a larger number is a typing error.
inline constexpr int kMaxThreads = 256;

/// Where "-" leads: PendingFile writes there what goes into a file otherwise.
inline constexpr char kStandardOutput[] = "/dev/stdout";

/// Settings in the order of help. References to them stay valid.
class Settings {
 public:
  Settings() = default;
  Settings(const Settings&) = delete;
  Settings& operator=(const Settings&) = delete;
  Settings(Settings&&) = default;
  Settings& operator=(Settings&&) = default;

  Setting& number(const char* option, const char* value, double& place, NumberRange range,
                  const char* help);
  /// `none`: the word for no number; empty: there is no such word, and no number means that the
  /// option is not given.
  Setting& number(const char* option, const char* value, std::optional<double>& place,
                  NumberRange range, const char* none, const char* help);
  /// Seconds, kept as the nearest whole microsecond (tools/microseconds.h).
  Setting& seconds(const char* option, std::int64_t& placeUs, NumberRange range, const char* help);
  /// An instant, if it is given.
  Setting& seconds(const char* option, std::optional<std::int64_t>& placeUs, const char* help);
  template <typename Whole>
  Setting& whole(const char* option, const char* value, Whole& place, std::int64_t least,
                 std::int64_t most, const char* help) {
    Setting& setting = wholeAt(
        option, value, least, most, [&place](std::int64_t w) { place = static_cast<Whole>(w); },
        help);
    setting.shown = setting.json = setting.told = [&place] { return std::to_string(place); };
    return setting;
  }
  /// The same, from 1, with a word for 0.
  template <typename Whole>
  Setting& wholeOr(const char* word, const char* option, const char* value, Whole& place,
                   std::int64_t most, const char* help) {
    return orWord(word, whole(option, value, place, 1, most, help), [&place] { place = 0; });
  }
  template <typename Value>
  Setting& word(const char* option, const char* value, Value& place, Words<Value> words,
                const char* help) {
    std::vector<std::string> names;
    for (const auto& [name, unused] : words) names.push_back(name);
    return wordAt(
        option, value, std::move(names),
        [&place, words](std::size_t i) { place = words[i].second; },
        [&place, words] {
          std::size_t i = 0;
          while (words[i].second != place) ++i;
          return words[i].first;
        },
        help);
  }
  /// A flag, and its words in a configuration for off and on.
  Setting& flag(const char* option, bool& place, const char* help,
                std::vector<std::string> words = {});
  Setting& text(const char* option, const char* value, std::string& place, const char* help);
  Setting& path(const char* option, const char* value, std::string& place, const char* help);
  /// A file to write; "-" is standard output.
  Setting& output(const char* option, const char* value, std::string& place, const char* help);
  /// A folder to write files into: "-" is refused, as standard output holds one file.
  Setting& outputFolder(const char* option, std::string& place, const char* help);
  Setting& list(const char* option, const char* value, std::vector<std::string>& place,
                const char* help);
  /// A text with a rule of its own: `take` fills the place, `shown` returns its content.
  Setting& parsed(const char* option, const char* value,
                  std::function<Result<Done>(const std::string&)> take,
                  std::function<std::string()> shown, const char* help);

  /// --json: the one meaning that it has in this program.
  Setting& asJson(bool& place);

  /// An option that is gone, or not there yet: help omits it, and `text` is the error of a user
  /// who types it.
  Setting& gone(const char* option, const char* text);

  /// The setting of an option, a header's field, a report's row. Precondition: it exists.
  [[nodiscard]] Setting& of(const std::string& option);
  /// Whether the command line has it.
  [[nodiscard]] bool isGiven(const std::string& option) const;
  [[nodiscard]] const Setting& ofField(const std::string& field) const;
  [[nodiscard]] const Setting& ofRow(const std::string& row) const;

  [[nodiscard]] auto begin() { return all_.begin(); }
  [[nodiscard]] auto end() { return all_.end(); }
  [[nodiscard]] auto begin() const { return all_.begin(); }
  [[nodiscard]] auto end() const { return all_.end(); }

 private:
  Setting& add(const char* option, const char* value, ValueKind kind, const char* help);
  Setting& wholeAt(const char* option, const char* value, std::int64_t least, std::int64_t most,
                   std::function<void(std::int64_t)> put, const char* help);
  static Setting& orWord(std::string word, Setting& setting, std::function<void()> putNone);
  Setting& wordAt(const char* option, const char* value, std::vector<std::string> words,
                  std::function<void(std::size_t)> put, std::function<std::string()> shown,
                  const char* help);

  std::deque<Setting> all_;
};

/// For a first line: each field with its value, in this order, without those not named.
void writeHeaderFields(const Settings& settings, std::initializer_list<const char*> fields,
                       JsonWriter& out);
/// The same for one, named or not.
void writeHeaderField(const Settings& settings, const char* field, JsonWriter& out);

}  // namespace foretouch::tools
