// lss/vertex_order.h: an order of points that depends on their coordinates alone. Not installed.
#pragma once

#include <algorithm>

namespace foretouch {

/// By x, then y, then z; of vectors of three, in float or double. Without NaN.
template <typename Vector>
[[nodiscard]] bool isBeforeByCoordinates(const Vector& p, const Vector& q) {
  return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
}

}  // namespace foretouch
