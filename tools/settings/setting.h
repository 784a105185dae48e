// tools/settings/setting.h: one description of one thing that can be asked for. The command line, a
// configuration file, the first line of results, a report and the tables of docs/ are all made of
// it. Legal values and texts stand there alone; the default is what the place holds at first.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

/// What a value is before it is known to be legal.
enum class ValueKind : std::uint8_t {
  Number,  ///< Any finite one.
  Whole,
  Text,
  List,  ///< Of texts; an option that may be repeated.
  Flag,  ///< An option without a value; elsewhere one of two words.
};

/// A value that somebody gave; of its fields, the one that its kind says.
struct GivenValue {
  double number = 0.0;
  std::int64_t whole = 0;
  std::vector<std::string> texts;  ///< One, but for lists.
  std::string found;               ///< As errors show it.
};

struct Setting {
  /// "--tolerance" or "-o,--output"; without a dash: what stands alone on the command line.
  std::string option;
  std::string value;  ///< What help shows in place of a value: "M" for metres.
  std::string help;
  ValueKind kind = ValueKind::Text;
  std::string legal;               ///< What is expected of a value, in words.
  std::vector<std::string> words;  ///< All that are legal, where only a few words are.

  /// Puts a legal value in its place; else the error says what was expected, and `file` is empty
  /// unless the error is of a file.
  std::function<Result<Done>(const GivenValue&)> take;
  /// The value now as one would type it; empty where there is none.
  std::function<std::string()> shown;
  /// The same as JSON.
  std::function<std::string()> json;
  /// The same for a report, with its unit; empty where there is nothing to say.
  std::function<std::string()> told;
  /// Whether the first line of results names it, where not always.
  std::function<bool()> isNamed;

  std::string table, key;  ///< In a configuration: [table] key. Empty: it is not there.
  std::string field;       ///< In the first line of results. Empty: it is not there.
  std::string row;         ///< In a report. Empty: it is not there.

  bool isRequired = false;
  std::string needs;        ///< Another option that makes sense of this one.
  bool isPath = false;      ///< In a configuration it counts from that file's folder.
  bool mayBeEmpty = true;   ///< Of a text in a configuration.
  std::string valueIfNone;  ///< Not empty: the option's value may be left out, and is this.
  bool isOfClips = false, isOfLogs = false;  ///< Of a replay: it makes sense with these alone.

  bool isGiven = false;  ///< On this command line.

  // What a table says of a setting beside its value, in a chain.
  Setting& inConfig(const char* ofTable, const char* ofKey);
  Setting& inHeader(const char* name);
  Setting& inReport(const char* name);
  Setting& namedIf(std::function<bool()> condition);
  Setting& required();
  Setting& needing(const char* other);
  Setting& notEmpty();
  Setting& ofClips();
  Setting& ofLogs();
  /// Of words: these alone are legal. Precondition: each is one of them.
  Setting& only(std::vector<std::string> some);
};

/// Reads what stands on the command line. Errors are named after the option.
[[nodiscard]] Result<Done> takeTyped(Setting& setting, const std::vector<std::string>& texts);

/// "expected ..., found ...": the error of a value that is not legal.
[[nodiscard]] Error notLegal(const std::string& legal, const GivenValue& given);

/// A number as one would write it: "1e-9".
[[nodiscard]] std::string tidyNumber(double number);

/// "a, b or c".
[[nodiscard]] std::string wordList(const std::vector<std::string>& words);

}  // namespace foretouch::tools
