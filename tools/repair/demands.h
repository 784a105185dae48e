// tools/repair/demands.h: what a repair has to see to, gathered from the faults of one round after
// the other: a demand that was made once stays.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "tools/repair/faults.h"

namespace foretouch::tools {

/// Steps in which a link has to keep to one side of an object, or of another link.
struct Side {
  LinkId link = 0, other = -1;  ///< `other`: for own links.
  ObjectId object = -1;
  std::int32_t first = 0, last = 0;                    ///< Steps.
  Eigen::Vector3d normal_W = Eigen::Vector3d::Zero();  ///< To that side; zero: not known.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();       ///< On the surface, where the link met it.
  bool isLost = false;  ///< It came through and does not come back: no way is known.
  bool isGivenUp = false;
};

/// A resting foot is lifted by no more than this (m) above the gap, or above where it was.
inline constexpr double kRestBand = 0.001;
/// A foot that moves this fast (m/s along the ground) is on its way to a step: what it drags is
/// lifted, not held.
inline constexpr double kSwingSpeed = 0.4;

class Demands {
 public:
  /// `stage` must outlive it.
  explicit Demands(const RepairStage& stage) : stage_(stage) {}

  /// Takes up the faults of the stage's poses. True if any demand is new.
  bool take(const Faults& faults);
  /// Drops what is still at fault after many rounds, so that it does not pull on the rest; once.
  void giveUp(const Faults& faults);

  [[nodiscard]] const std::vector<Side>& sides() const { return sides_; }
  /// By part and step: what must not move along the ground.
  using Holds = std::map<std::pair<std::size_t, std::int64_t>, RestLook>;
  [[nodiscard]] const Holds& holds() const { return holds_; }
  /// By part and pose: what must be above the ground.
  [[nodiscard]] const std::set<std::pair<std::size_t, std::int32_t>>& lifts() const {
    return lifts_;
  }
  /// Where the point went along the ground from its step to the next, before anything was changed.
  [[nodiscard]] Eigen::Vector3d wayBefore(const RestLook& look) const;
  /// By part and pose: how high the part may be, as it rested and is not to be lifted.
  [[nodiscard]] const std::map<std::pair<std::size_t, std::int32_t>, double>& keeps() const {
    return keeps_;
  }
  /// By part and pose: what must be off the ground, as it swings.
  [[nodiscard]] const std::set<std::pair<std::size_t, std::int32_t>>& clears() const {
    return clears_;
  }
  /// By knob and pose: what must be within its limits.
  [[nodiscard]] const std::set<std::pair<std::int32_t, std::int32_t>>& limits() const {
    return limits_;
  }
  /// The instants of each step at which contacts began.
  [[nodiscard]] const std::map<std::int32_t, std::set<double>>& instants() const {
    return instants_;
  }

 private:
  bool takeContact(const StepFault& fault);
  [[nodiscard]] bool isUnder(const StepFault& fault) const;
  [[nodiscard]] Side begun(const StepFault& fault) const;
  [[nodiscard]] bool endsBehind(const Side& side) const;
  void joinThroughs();
  void findRests(const FeetAnswer& feet);
  bool takeSlide(const BearingStance& stance);
  /// Whether, before anything was changed, the point moved faster than what slides.
  [[nodiscard]] bool swings(const RestLook& look) const;

  const RepairStage& stage_;
  std::vector<Side> sides_;
  Holds holds_;
  std::vector<Pose> before_;
  std::set<std::pair<std::size_t, std::int32_t>> lifts_, clears_;
  std::map<std::pair<std::size_t, std::int32_t>, double> keeps_;
  std::set<std::pair<std::int32_t, std::int32_t>> limits_;
  std::map<std::int32_t, std::set<double>> instants_;
  bool isFirst_ = true;
};

}  // namespace foretouch::tools
