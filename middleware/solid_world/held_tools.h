// middleware/solid_world/held_tools.h: what the hands of a solid avatar hold, as part of its body:
// more LSS on the links that carry it. Metres. Not installed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "middleware/solid/solid_options.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// A body that hangs on a link of a solid avatar, itself or by others that do, all held fast.
struct HeldTool {
  BodyId body = 0;
  LinkId link = 0;
  std::vector<Lss> lss;  // in the link's frame
  [[nodiscard]] bool operator==(const HeldTool& other) const;
};

/// What a body hangs on at an instant.
struct Holder {
  BodyId body = kStillScene;  ///< The solid avatar; kStillScene: none.
  LinkId link = 0;
  bool isHeldFast = true;  ///< All the way.
};
[[nodiscard]] Holder holderOf(const WorldParts& world, const std::vector<std::uint8_t>& isSolid,
                              BodyId body, std::int64_t us);

/// LSS that contain meshes, found when one is first held. Keeps them.
class MeshCovers {
 public:
  [[nodiscard]] const std::vector<Lss>& of(std::int32_t kind, const Scene& mesh);

 private:
  std::vector<std::vector<Lss>> ofKind_;
};

/// Precondition: holderOf() says that it is held fast by a solid avatar.
[[nodiscard]] HeldTool toolOf(const WorldParts& world, const std::vector<std::uint8_t>& isSolid,
                              BodyId body, std::int64_t us, MeshCovers& covers);

/// The avatar with its tools, and its options for that: own links keep their rules. Errors: more
/// LSS than a link may have.
struct Equipped {
  Avatar avatar;
  SolidOptions options;
};
[[nodiscard]] Result<Equipped> equipped(const Avatar& avatar, const SolidOptions& options,
                                        const std::vector<HeldTool>& tools);

}  // namespace foretouch::internal
