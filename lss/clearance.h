// lss/clearance.h: what one given plane proves about the distance of two hulls. Proof:
// docs/guarantees.md 3. Metres.
#pragma once

#include <Eigen/Core>

namespace foretouch {

struct Hull;

/// A lower bound on the distance, rounding included, for any `direction` from `other` towards
/// `one`, of any length; zero, less rounding, where it proves no more. All coordinates finite,
/// below 1e100.
[[nodiscard]] double clearanceAlong(const Hull& one, const Hull& other,
                                    const Eigen::Vector3d& direction);

/// How far all of `one` is beyond all of `other` along `nhat`, of a length of at most 1: a lower
/// bound, rounding included, and below zero where the plane cuts them. Moved by w, `one` is at
/// least gapAlong() + nhat.w away from `other`. All coordinates finite, below 1e100.
[[nodiscard]] double gapAlong(const Hull& one, const Hull& other, const Eigen::Vector3d& nhat);

}  // namespace foretouch
