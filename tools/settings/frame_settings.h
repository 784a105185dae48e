// tools/settings/frame_settings.h: the unit and the up axis of a file, which stand in place of what
// the file says about itself.
//
// If not given: as the file says. Headers and reports then name 1 and y, the meaning of a file that
// says nothing; code that has read the file first puts into the place what the file said.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "assets/file_frame.h"
#include "assets/json_writer.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

inline constexpr NumberRange kMetresPerUnit{0.0, std::numeric_limits<double>::max(), "", "m"};

/// In help, the word for a value that is not given.
inline constexpr char kAsFileSays[] = "as the file says";

/// The word for an axis as options and configurations spell it.
[[nodiscard]] inline const char* wordOf(UpAxis up) {
  return up == UpAxis::Z ? "z" : "y";
}

inline Setting& addUnit(Settings& settings, const char* option, std::optional<double>& place,
                        const char* help) {
  Setting& setting = settings.number(option, "S", place, kMetresPerUnit, "", help);
  setting.shown = [&place] { return place ? numberText(*place) : std::string(kAsFileSays); };
  setting.json = [&place] { return numberText(place.value_or(1.0)); };
  setting.told = [&place] { return numberText(place.value_or(1.0)) + " m"; };
  return setting;
}

inline Setting& addUpAxis(Settings& settings, const char* option, std::optional<UpAxis>& place,
                          const char* help) {
  const auto word = [&place]() -> std::string { return wordOf(place.value_or(UpAxis::Y)); };
  Setting& setting = settings.word<std::optional<UpAxis>>(
      option, "y|z", place, {{"y", UpAxis::Y}, {"z", UpAxis::Z}}, help);
  setting.shown = [&place, word] { return place ? word() : std::string(kAsFileSays); };
  setting.json = [word] { return jsonString(word()); };
  setting.told = word;
  return setting;
}

}  // namespace foretouch::tools
