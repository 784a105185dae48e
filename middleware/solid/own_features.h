// middleware/solid/own_features.h: where own links of an avatar are near to each other, for those
// pairs that its rules ask about. Metres in W. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "middleware/query/query_plan.h"
#include "middleware/solid/contact_row.h"

namespace foretouch::internal {

/// An LSS where it is in W.
struct LssInWorld {
  Eigen::Vector3d a, b;
  double radius;
};
/// The row (its places, normal and gap) between two LSS whose radii count as `radii` together;
/// false if they are farther apart than `within` (of their axes), or their axes meet.
[[nodiscard]] bool findRow(const LssInWorld& one, const LssInWorld& other, double radii,
                           double within, ContactRow& row);

class OwnFeatures {
 public:
  OwnFeatures() = default;
  /// `plan` outlives it. O(links^2).
  explicit OwnFeatures(const QueryPlan& plan);

  /// Appends a row (without its bound) per pair of LSS that is nearer than the sum of its links'
  /// reaches, if one of the two is hot (not 0).
  void append(const QueryPlan& plan, const std::vector<LinkState>& states,
              const std::vector<double>& reach, const std::vector<std::uint8_t>& isHot,
              std::vector<ContactRow>& rows) const;

 private:
  struct Asked {
    LinkId a, b;
  };
  std::vector<Asked> pairs_;  // of links, a < b
};

}  // namespace foretouch::internal
