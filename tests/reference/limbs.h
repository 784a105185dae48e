// tests/reference/limbs.h: how an avatar's links are grouped for the rungs above its links. A
// limb is a maximal chain of links between branchings; a tree is a root and all links below it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "lss/index.h"

namespace foretouch::internal {

/// An end of an LSS's axis in its link's frame, with the LSS's radius: a ball. Metres.
struct AxisPoint {
  LinkId link;
  double p_L[3];
  double rho;  ///< |p_L|, rounded up.
  double radius;
};

/// Links whose LSS one volume covers. The volume is fixed in the frame of the carrier, the limb's
/// first link, which may have no LSS of its own.
struct Limb {
  LinkId carrier = 0;
  std::int32_t tree = 0;
  std::vector<LinkId> links;      ///< Those with LSS, ascending.
  std::vector<AxisPoint> points;  ///< Both ends of all their LSS.
};

/// All limbs below one root.
struct LimbTree {
  LinkId root = 0;
  std::vector<std::int32_t> limbs;  ///< Ascending.
  std::vector<LinkId> links;        ///< Those with LSS, ascending.
};

/// An avatar's links by limb and by tree. A link counts if it or a link below it has LSS; a
/// branching is a link with two or more children that count. Immutable.
class Limbs {
 public:
  Limbs() = default;
  explicit Limbs(const Avatar& avatar);

  [[nodiscard]] const std::vector<Limb>& limbs() const { return limbs_; }
  [[nodiscard]] const std::vector<LimbTree>& trees() const { return trees_; }
  /// True for a limb's first link and for roots.
  [[nodiscard]] bool isCarrier(LinkId link) const { return isCarrier_[slotOf(link)] != 0; }

 private:
  std::vector<Limb> limbs_;
  std::vector<LimbTree> trees_;
  std::vector<std::uint8_t> isCarrier_;  // per link
};

}  // namespace foretouch::internal
