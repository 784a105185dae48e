// middleware/fidelity.h: how closely a query takes the avatar's surface.
#pragma once

#include <cstdint>

namespace foretouch {

/// What a link's surface is: the rungs of the ladder, coarsest first Ellipsoid, Avatar, Limb, Link,
/// Exact; Skinned is none of them. Above Link one volume stands for several links, which all get
/// its verdict (middleware/ladder/rungs.h): each contains what stands for them one rung below, at
/// every t, so what is clear at a rung is free of contact at those below, where nothing is touched
/// before the time that a higher one reports. A link without LSS has no surface there.
enum class Fidelity : std::uint8_t {
  Link,   ///< Its LSS.
  Exact,  ///< The triangles of its mesh, and LSS that bound none. A subset of Link's contacts, and
          ///< never earlier.
  Skinned,  ///< The triangles of a skin, whose vertices follow the blend of several links; of a
            ///< link without any, its LSS.
  Limb,     ///< One LSS for all links of a chain between branchings (a finger, an arm to the hand).
  Avatar,   ///< One LSS for all links; one for those below each root where there are several.
  Ellipsoid,  ///< An ellipsoid of revolution around that LSS, which moves on a straight line.
};

/// "link", "exact", "skinned", "limb", "avatar", "ellipsoid".
[[nodiscard]] const char* toString(Fidelity fidelity);

}  // namespace foretouch
