// lss/index.h: ids as places in a list.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lss/assert.h"

namespace foretouch {

/// The place of a joint, link, node or triangle in its list. Ids are signed, since -1 means none.
/// Precondition: id >= 0 (asserted).
[[nodiscard]] constexpr std::size_t slotOf(std::int32_t id) {
  FORETOUCH_ASSERT(id >= 0);
  return static_cast<std::size_t>(id);
}

}  // namespace foretouch
