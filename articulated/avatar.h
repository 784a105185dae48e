// articulated/avatar.h: an articulated body: a skeleton whose links are bounded by LSS; and a skin,
// whose vertices follow a blend of several links. Metres. A link is the rigid body that moves with
// a joint; both share one index and one frame L.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "lss/index.h"
#include "lss/lss.h"

namespace foretouch {

/// At most this many LSS on one link.
inline constexpr std::size_t kMaxLssPerLink = 4096;

/// The place of a link's triangles. Link fidelity does not load them.
struct MeshReference {
  std::string file;  ///< Relative to the avatar file, or absolute; empty: the link has no mesh.
  std::string node;  ///< The node of that file that holds the link's triangles.
};

/// A skeleton with, per link, its LSS (in L, metres) and optionally its mesh. A link without LSS is
/// legal (a joint that carries nothing, e.g. a root above the hips) and is never in contact.
class Avatar {
 public:
  /// Checks counts, finiteness, radii >= 0 and |coordinates| <= kMaxCoordinate; at least one link
  /// must have an LSS. Error::index is the offending link. `meshes` is empty (none) or has one per
  /// link.
  static Result<Avatar> build(Skeleton skeleton, std::vector<std::vector<Lss>> lssPerLink,
                              std::vector<MeshReference> meshes = {});

  [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }
  [[nodiscard]] std::int32_t numLinks() const { return skeleton_.numJoints(); }
  [[nodiscard]] const std::vector<Lss>& lss(LinkId link) const { return lss_[slotOf(link)]; }
  [[nodiscard]] const std::vector<std::vector<Lss>>& lss() const { return lss_; }  ///< Per link.
  [[nodiscard]] const MeshReference& mesh(LinkId link) const { return meshes_[slotOf(link)]; }
  [[nodiscard]] std::int32_t numLss() const;
  /// Another avatar, without meshes, whose LSS hold all within `growth` (m, >= 0) of these: no
  /// radius is below the exact sum. Errors: a radius beyond kMaxCoordinate (Error::index).
  [[nodiscard]] Result<Avatar> grownBy(double growth) const;
  /// Equal for this avatar and its copies, different for every other avatar of the process. Data
  /// derived from an avatar uses it to tell whether it still fits.
  [[nodiscard]] std::uint64_t identity() const { return identity_; }

 private:
  explicit Avatar(Skeleton skeleton) : skeleton_(std::move(skeleton)) {}
  Skeleton skeleton_;
  std::uint64_t identity_ = 0;
  std::vector<std::vector<Lss>> lss_;
  std::vector<MeshReference> meshes_;
};

/// One link's share of a vertex, which is at the sum of weight * (link's pose applied to p_L), the
/// weights summing to one.
struct SkinInfluence {
  LinkId link = 0;
  double weight = 0.0;                            ///< > 0
  Eigen::Vector3d p_L = Eigen::Vector3d::Zero();  ///< The vertex in the link's frame, at bind time.
};
struct Skin {
  std::vector<std::vector<SkinInfluence>> vertices;  ///< Never empty lists; largest weight first.
  std::vector<std::array<std::int32_t, 3>> triangles;
};

}  // namespace foretouch
