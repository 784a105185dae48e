// bindings/c/link_bounds.h: bounds of persons, for C.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "articulated/result.h"
#include "assets/bounds/bounds_file.h"
#include "bindings/c/include/foretouch/person.h"

namespace foretouch::c {

/// As ft_bounds_read() has it; `name`: the file's, for errors.
[[nodiscard]] ft_status writeBounds(const Result<BoundsFile>& file, const std::string& name,
                                    const ft_avatar* avatar, std::int32_t between, double rateHz,
                                    ft_link_bound* bounds, std::size_t capacity,
                                    std::size_t* required);

}  // namespace foretouch::c
