// middleware/fidelity.h: how closely a query follows the avatar's surface.
#pragma once

#include <cstdint>

namespace foretouch {

/// What counts as a link's surface. The rungs of the ladder, coarsest first: Ellipsoid, Avatar,
/// Limb, Link, Exact; Skinned is not a rung. At the rungs above Link, one volume covers several
/// links, and they share its verdict (middleware/ladder/rungs.h). Each volume contains those of the
/// next finer rung at every t. So clear at one rung implies no contact at any finer rung, and a
/// coarser rung never reports a contact later than a finer one. A link without LSS has no surface
/// at those rungs.
enum class Fidelity : std::uint8_t {
  Link,     ///< Its LSS.
  Exact,    ///< The triangles of its mesh, and LSS that contain no triangle. A subset of Link's
            ///< contacts, never earlier.
  Skinned,  ///< The triangles of a skin, whose vertices follow a blend of several links; a link
            ///< without triangles keeps its LSS.
  Limb,     ///< One LSS for all links of a chain between branchings (a finger, an arm to the hand).
  Avatar,   ///< One LSS for all links; with several roots, one LSS per root.
  Ellipsoid,  ///< An ellipsoid of revolution around that LSS, which moves on a straight line.
};

/// "link", "exact", "skinned", "limb", "avatar", "ellipsoid".
[[nodiscard]] const char* toString(Fidelity fidelity);

}  // namespace foretouch
