// assets/bounds/bound_presets.h: bounds of persons that need no file, by class of tracker. Where
// each number is from, and what it leaves out: docs/person.md. Not installed.
#pragma once

#include <string>
#include <string_view>

#include "articulated/result.h"
#include "assets/bounds/bounds_file.h"

namespace foretouch {

/// Stands before a preset's name where a file of bounds could be named.
inline constexpr std::string_view kBoundPresetPrefix = "preset:";

/// The bounds of a file or of a preset. The error for an unknown preset names those that there are.
[[nodiscard]] Result<BoundsFile> readBounds(const std::string& pathOrPreset);

}  // namespace foretouch
