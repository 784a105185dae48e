// middleware/solid/own_features.h: where own links of an avatar are near to each other, for those
// pairs that its rules ask about. Metres in W. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "middleware/pair/query_plan.h"
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

/// The gap of a row that is not of a face or a joint's range, with the links there; a lower
/// bound.
[[nodiscard]] double gapOf(const QueryPlan& plan, const ContactRow& row,
                           const std::vector<LinkState>& states);

class OwnFeatures {
 public:
  OwnFeatures() = default;
  /// Takes the pairs that the plan asks about; where it asks about none, all but neighbours: they
  /// are kept apart as far as the target has them. O(links^2 + LSS^2).
  explicit OwnFeatures(const QueryPlan& plan);

  /// Where the links are, and where the target has them.
  struct Places {
    const std::vector<LinkState>&here, &target;
  };
  /// Appends a row (without its bound) per pair of LSS that is nearer than the sum of its links'
  /// reaches, if one of the two is active (not 0).
  void append(const QueryPlan& plan, const Places& places, double skin,
              const std::vector<double>& reach, const std::vector<std::uint8_t>& isHot,
              std::vector<ContactRow>& rows) const;
  /// Two links not asked about, of which one place has LSS deeper in each other by `by` (m)
  /// than the target and another place have them; kNoParent: there are none.
  struct Deeper {
    LinkId one = kNoParent, other = kNoParent;
  };
  [[nodiscard]] Deeper findDeeper(const QueryPlan& plan, const std::vector<LinkState>& there,
                                  const Places& places, double by) const;

 private:
  struct Asked {
    LinkId a, b;
  };
  std::vector<Asked> pairs_;  // pairs of links, a < b
  bool isSoft_ = false;       // they are not asked about
};

}  // namespace foretouch::internal
