// tools/settings/setting.h: the one description of a setting, from which the command line,
// configuration files, the first line of results, reports and the tables of docs/ are made. Only it
// has the legal values and texts; the default is the initial value of the setting's place.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

/// Titles in help. Options without a group are under "Options".
inline constexpr char kInputGroup[] = "Input";
inline constexpr char kUnitsGroup[] = "Units, axes and place";
inline constexpr char kTouchGroup[] = "What touches";
inline constexpr char kOutputGroup[] = "Output";
inline constexpr char kEffortGroup[] = "Effort";
inline constexpr char kStreamGroup[] = "Stream";
inline constexpr char kNetworkGroup[] = "Network";

/// The kind of a value, before the check that it is legal.
enum class ValueKind : std::uint8_t {
  Number,  ///< Any finite one.
  Whole,
  Text,
  List,  ///< A list of texts; an option that may be repeated.
  Flag,  ///< An option without a value; elsewhere one of two words.
};

/// A given value, in the field of its kind.
struct GivenValue {
  double number = 0.0;
  std::int64_t whole = 0;
  std::vector<std::string> texts;  ///< One, except for lists.
  std::string found;               ///< The value as errors show it.
};

struct Setting {
  /// "--tolerance" or "-o,--output"; without a dash: a positional argument.
  std::string option;
  std::string value;  ///< The placeholder in help: "M" for metres.
  std::string help;
  ValueKind kind = ValueKind::Text;
  std::string legal;               ///< The legal values, in words.
  std::vector<std::string> words;  ///< All legal words, if only a few words are legal.

  /// Stores a legal value in its place; otherwise the error says what was expected, and its `file`
  /// is empty unless the error is about a file.
  std::function<Result<Done>(const GivenValue&)> take;
  /// The current value as one would type it; empty if there is none.
  std::function<std::string()> shown;
  /// The same as JSON.
  std::function<std::string()> json;
  /// The same for a report, with its unit; empty if there is nothing to say.
  std::function<std::string()> told;
  /// Whether the first line of results names it; unset: always.
  std::function<bool()> isNamed;

  std::string table, key;  ///< In a configuration: [table] key. Empty: not there.
  std::string field;       ///< In the first line of results. Empty: not there.
  std::string row;         ///< In a report. Empty: not there.

  std::string group;  ///< In help. Empty: "Options".
  bool isRequired = false;
  std::string noun;                ///< What a required argument is, for its error: "a scene file".
  bool standsForRequired = false;  ///< Where it is given, nothing else is required.
  std::string needs;               ///< Another option that this one requires.
  bool fillsOthers = false;        ///< Its values become those of other settings, ...
  bool isFilledByFiles = false;    ///< ... such as this one: then help demands no option.
  bool isPath = false;             ///< In a configuration, relative to that file's folder.
  bool takesFiles = false;         ///< Paths, for a shell that completes them.
  std::string endings;             ///< The endings of these files: "bvh glb"; empty: any.
  bool mayBeEmpty = true;          ///< For a text in a configuration.
  std::string valueIfNone;  ///< Not empty: the option's value is optional, and defaults to this.
  bool isOfClips = false, isOfLogs = false;  ///< In a replay: valid only for these.
  std::string isGone;  ///< Not empty: there is no such option; its error tells users why.
  std::vector<std::string> formerNames;  ///< Still taken; help does not list them.

  bool isGiven = false;  ///< On this command line.

  /// "--output" of "-o,--output".
  [[nodiscard]] std::string name() const { return option.substr(option.rfind(',') + 1); }

  // Chainable attributes of a setting.
  Setting& inConfig(const char* ofTable, const char* ofKey);
  Setting& inHeader(const char* name);
  Setting& inReport(const char* name);
  Setting& namedIf(std::function<bool()> condition);
  /// `what`: what the argument is, for the error of a user who gives none.
  Setting& required(const char* what = "");
  Setting& standingForRequired();
  Setting& in(const char* helpGroup);
  Setting& needing(const char* other);
  Setting& notEmpty();
  Setting& ofClips();
  Setting& ofLogs();
  /// A name that the option had: a user who still types it gets the same.
  Setting& formerly(const char* name);
  /// A shell offers files with these endings, separated by blanks; none: with any.
  Setting& files(const char* ofEndings = "");
  /// For words: only these are legal. Precondition: each is one of them.
  Setting& only(std::vector<std::string> some);
};

/// A finite decimal number, or a whole one, and nothing else: no "nan", "inf", hexadecimal, unit or
/// space.
[[nodiscard]] bool readNumber(const std::string& text, double& number);
[[nodiscard]] bool readNumber(const std::string& text, std::int64_t& whole);
/// "a,,b" has three parts, the second of them empty.
[[nodiscard]] std::vector<std::string> splitAtCommas(const std::string& text);

/// Reads the command line's texts. Errors name the option.
[[nodiscard]] Result<Done> takeTyped(Setting& setting, const std::vector<std::string>& texts);

/// "expected ..., found ...": the error of an illegal value.
[[nodiscard]] Error notLegal(const std::string& legal, const GivenValue& given);

/// A number as one would write it: "1e-9".
[[nodiscard]] std::string tidyNumber(double number);

/// "a, b or c".
[[nodiscard]] std::string wordList(const std::vector<std::string>& words, const char* last = "or");

}  // namespace foretouch::tools
