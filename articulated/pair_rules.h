// articulated/pair_rules.h: for which pairs of an avatar's own links a query asks if they touch.
// Every pair that is left out is a hole in the proof, so each has a reason that tools can show.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"

namespace foretouch {

class Robot;

/// Why a pair of links is asked, or left out. The numbers are those of the C API.
enum class PairReason : std::uint8_t {
  Asked = 0,
  Adjacent = 1,     ///< One moves the other, with no other link with LSS between them.
  RestOverlap = 2,  ///< Their LSS overlap at rest, and in a usual pose if any are known.
  Always = 3,       ///< They touch in nearly all usual poses.
  User = 4,         ///< The user left the pair out.
};
inline constexpr std::uint8_t kNumPairReasons = 5;

/// "asked", "adjacent", "rest-overlap", "always", "user".
[[nodiscard]] const char* toString(PairReason reason);

struct LinkPair {
  LinkId a = 0, b = 0;
};

/// A pair that is left out, a < b.
struct LeftOutPair {
  LinkId a = 0, b = 0;
  PairReason reason = PairReason::User;
};

/// In how many of the usual poses two links touch, a < b.
struct PairTouches {
  LinkId a = 0, b = 0;
  std::int64_t touches = 0;
};

/// Two LSS whose sum of radii counts as `radius` (m), so that they do not touch at rest but do
/// when they come nearer to each other than at rest.
struct PairRadius {
  LinkId a = 0;
  std::int32_t lssA = 0;
  LinkId b = 0;
  std::int32_t lssB = 0;
  double radius = 0.0;
};

struct PairRuleOptions {
  /// Two LSS that overlap at rest count with a smaller sum of radii, so that they are `restSkin`
  /// apart there, where their axes are farther apart than that. Only at link fidelity: a smaller
  /// LSS no longer holds its link's mesh. If false, or where the axes are too near, the pair of
  /// links is left out.
  bool usePairRadii = false;
  double restSkin = 2e-3;  ///< Metres, > 0.
  /// Poses that the avatar usually takes, for PairReason::Always. Validated for its skeleton.
  const std::vector<Pose>* usualPoses = nullptr;
  double alwaysShare = 0.95;      ///< Share of the usual poses, in (0,1].
  std::vector<LinkPair> leftOut;  ///< Pairs that the user leaves out, in either order.
  /// False: the avatar does not take its rest pose, so overlapping there is not a reason.
  bool isRestTaken = true;
};

/// For a robot: its usual poses are configurations drawn within its limits.
struct RobotPairOptions {
  std::int32_t samples = 10000;  ///< At least 1. Each costs all pairs of LSS.
  std::uint64_t seed = 1;        ///< The same configurations on every machine.
  double alwaysShare = 0.95;     ///< As PairRuleOptions::alwaysShare.
  std::vector<LinkPair> leftOut;
};

/// Immutable; belongs to one avatar and its copies.
class PairRules {
 public:
  /// Leaves out what PairReason names. Errors: options out of range, unknown links, a pair of one
  /// link with itself (Error::index is the link), and rules that leave no pair to ask. O(LSS^2),
  /// times poses where there are any.
  static Result<PairRules> derive(const Avatar& avatar, const PairRuleOptions& options = {});
  /// For robot.avatar(), from Robot::sampledPoses(). Leaves out adjacent links, links that touch in
  /// nearly all of these poses, and the user's. Zeros may lie outside a robot's limits, so touching
  /// there is not a reason. Pairs that touch in no sample are asked, as that proves nothing.
  /// touches() has the counts. Errors as above, and those of sampledPoses().
  static Result<PairRules> derive(const Robot& robot, const RobotPairOptions& options = {});
  /// All pairs are asked but these, and only these LSS count with radii of their own. Errors as
  /// above; radii of unknown LSS, of a pair that is left out or listed before, or not between 0 and
  /// the sum of the two (Error::index is the place in `radii`).
  static Result<PairRules> leavingOut(const Avatar& avatar, std::vector<LeftOutPair> leftOut,
                                      std::vector<PairRadius> radii = {});
  /// Only these pairs are asked, adjacent ones too; all others are left out (PairReason::User).
  /// Errors: no pair, an unknown link, one without LSS, a pair of one link with itself
  /// (Error::index is the link).
  static Result<PairRules> asking(const Avatar& avatar, const std::vector<LinkPair>& asked);

  [[nodiscard]] std::int32_t numLinks() const { return numLinks_; }
  /// Pairs of different links that both have LSS, and those of them that are asked.
  [[nodiscard]] std::int64_t numPairs() const { return numPairs_; }
  [[nodiscard]] std::int64_t numAsked() const { return numAsked_; }
  /// Sorted by a, then by b; every pair once.
  [[nodiscard]] const std::vector<LeftOutPair>& leftOut() const { return leftOut_; }
  /// a < b; sorted by a, then by b, then by the LSS.
  [[nodiscard]] const std::vector<PairRadius>& radii() const { return radii_; }
  /// The touches of every pair of different links that both have LSS, sorted by a, then by b, and
  /// the number of poses. Empty and 0 unless the rules were derived from usual poses.
  [[nodiscard]] const std::vector<PairTouches>& touches() const { return touches_; }
  [[nodiscard]] std::int64_t numUsualPoses() const { return numUsualPoses_; }
  /// Two different links, in either order. O(log pairs).
  [[nodiscard]] PairReason reasonOf(LinkId a, LinkId b) const;
  /// Avatar::identity() of the avatar.
  [[nodiscard]] std::uint64_t avatarIdentity() const { return avatarIdentity_; }

 private:
  PairRules() = default;
  Result<Done> settle(const Avatar& avatar);
  Result<Done> settleRadii(const Avatar& avatar);

  std::int32_t numLinks_ = 0;
  std::int64_t numPairs_ = 0, numAsked_ = 0, numUsualPoses_ = 0;
  std::uint64_t avatarIdentity_ = 0;
  std::vector<LeftOutPair> leftOut_;
  std::vector<PairRadius> radii_;
  std::vector<PairTouches> touches_;
};

/// Whether an avatar is what a reason says: its links adjacent, its LSS overlapping at rest. Always
/// true for other reasons, which are not about the avatar alone. Precondition: its links.
class PairReasonCheck {
 public:
  /// Keeps a copy of the avatar. O(links).
  explicit PairReasonCheck(const Avatar& avatar);
  /// O(links + LSS^2 of the two).
  [[nodiscard]] bool isTrue(const LeftOutPair& pair) const;

 private:
  Avatar avatar_;
  std::vector<LinkState> atRest_;
};

}  // namespace foretouch
