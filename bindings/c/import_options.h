// bindings/c/import_options.h: options of the child process that reads models, and its place.
#pragma once

#include <optional>

#include "assets/import/scene_import.h"
#include "bindings/c/sized_struct.h"

namespace foretouch::c {

[[nodiscard]] ft_import_options defaultImportOptions();

/// NULL: the defaults.
[[nodiscard]] ft_status readImportOptions(const ft_import_options* given,
                                          SceneImportOptions& options);

/// FT_UP_Y or FT_UP_Z.
[[nodiscard]] ft_status readUpAxis(std::int32_t given, std::optional<UpAxis>& up);

}  // namespace foretouch::c
