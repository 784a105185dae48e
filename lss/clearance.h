// lss/clearance.h: what one given plane proves about the distance of two hulls. Proof:
// docs/guarantees.md 3. Metres.
#pragma once

#include <Eigen/Core>

#include "lss/hull.h"

namespace foretouch {

/// A lower bound on the distance, rounding included, for any `direction` from `other` towards `one`,
/// of any length; zero, less rounding, where it proves no more. All coordinates finite, below 1e100.
[[nodiscard]] double clearanceAlong(const Hull& one, const Hull& other,
                                    const Eigen::Vector3d& direction);

}  // namespace foretouch
