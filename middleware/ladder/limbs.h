// middleware/ladder/limbs.h: how an avatar's links are grouped for the rungs above its links. A
// limb is a maximal chain of links between branchings; a tree is all that hangs on one root. Not
// installed.
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

/// Links whose LSS one volume stands for. The carrier is its first link, in whose frame the volume
/// is fixed; it need not have LSS of its own.
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

/// An avatar's links by limb and by tree. A link with nothing but bare links below it counts for
/// nothing; a branching is a link of which two children or more count. Immutable.
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
