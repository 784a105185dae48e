// lss/index.h: ids as places in a list.
#pragma once

#include <cstddef>
#include <type_traits>

#include "lss/assert.h"

namespace foretouch {

/// The place of a joint, link, node or triangle in its list, or of an enumerator in its table. Ids
/// are signed, since -1 means none. Precondition: id >= 0 (asserted).
template <typename Id>
[[nodiscard]] constexpr std::size_t slotOf(Id id) {
  static_assert(std::is_integral_v<Id> || std::is_enum_v<Id>);
  if constexpr (std::is_signed_v<Id>) FORETOUCH_ASSERT(id >= 0);
  return static_cast<std::size_t>(id);
}

/// A number of things, which is kept signed, as a size. Precondition: count >= 0 (asserted).
template <typename Count>
[[nodiscard]] constexpr std::size_t countOf(Count count) {
  return slotOf(count);
}

}  // namespace foretouch
