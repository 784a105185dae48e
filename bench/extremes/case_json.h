// bench/extremes/case_json.h: complete cases, to examine elsewhere.
#pragma once

#include <string>
#include <vector>

#include "bench/extremes/extreme_case.h"

namespace foretouch::tools::extremes {

/// Format "foretouch-extremes" version 1: all numbers to the last digit, "nan", "inf" and "-inf" as
/// words. A scene of more than a thousand triangles keeps only distinct ones.
[[nodiscard]] std::string casesJson(const std::vector<ExtremeCase>& cases);

}  // namespace foretouch::tools::extremes
