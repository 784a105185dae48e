// middleware/fidelity.h: how closely a query follows the avatar's surface.
#pragma once

#include <cstdint>
#include <string>

namespace foretouch {

/// What counts as a link's surface. Clear at Link implies no contact at Exact, and Link never
/// reports a contact later than Exact does.
enum class Fidelity : std::uint8_t {
  Link,     ///< Its LSS.
  Exact,    ///< The triangles of its mesh, and LSS that contain no triangle. A subset of Link's
            ///< contacts, never earlier.
  Skinned,  ///< The triangles of a skin, whose vertices follow a blend of several links; a link
            ///< without triangles keeps its LSS.
};

/// "link", "exact", "skinned".
[[nodiscard]] const char* toString(Fidelity fidelity);

/// Of "limb", "avatar" and "ellipsoid", volumes around several links that older versions had: that
/// they are gone, why, and what to use instead. Empty for any other name.
[[nodiscard]] std::string whyFidelityIsGone(const std::string& name);

}  // namespace foretouch
