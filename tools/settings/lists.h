// tools/settings/lists.h: settings whose value is a list, separated by commas.
#pragma once

#include <string>
#include <vector>

#include "assets/file_frame.h"
#include "lss/simd.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

/// At least one number, all within the range.
Setting& addNumbers(Settings& settings, const char* option, const char* value,
                    std::vector<double>& place, NumberRange range, const char* help);
/// At least one whole number from 1 to `most`.
Setting& addCounts(Settings& settings, const char* option, const char* value,
                   std::vector<int>& place, int most, const char* help);
/// Words: those of `legal`, or any if it is empty.
Setting& addWords(Settings& settings, const char* option, const char* value,
                  std::vector<std::string>& place, const std::vector<std::string>& legal,
                  const char* help);
/// Up axes: y or z.
Setting& addUpAxes(Settings& settings, const char* option, const char* value,
                   std::vector<UpAxis>& place, const char* help);
/// Names of lss/simd.h, "all" (widest first; also if nothing is given) or "widest". Refuses those
/// that this processor lacks.
Setting& addSimds(Settings& settings, const char* option, std::vector<Simd>& place,
                  const char* help);

/// "none" empties the list.
template <typename Value>
void orNone(Setting& setting, std::vector<Value>& place) {
  setting.take = [take = setting.take, &place](const GivenValue& given) -> Result<Done> {
    if (given.texts.front() != "none") return take(given);
    place.clear();
    return Done{};
  };
}

}  // namespace foretouch::tools
