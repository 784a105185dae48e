// bench/solid/hands_trial.h: the hands of a solid avatar beside those of a physics engine, at the
// same places: which go into things, and how far they are from the tracked ones. Metres.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bench/peers/hand_follower.h"
#include "bench/solid/engine_hands.h"
#include "bench/solid/stage.h"

namespace foretouch::tools {

/// One number per hand and tick.
struct HandsTally {
  std::string name;
  std::vector<double> deviation;        ///< The larger one of the capsule's ends.
  std::vector<double> depth;            ///< 0: it touches nothing.
  std::uint64_t ticks = 0, inside = 0;  ///< `inside`: by more than 0.1 mm.
};

/// What a solid avatar showed, tick by tick, and how far it had lifted the target along y.
struct ShownPoses {
  std::vector<Pose> poses;
  std::vector<double> lift;
};

class HandsTrial {
 public:
  explicit HandsTrial(const SolidStage& stage);

  /// `shown`: what the solid avatar showed, one per tracked pose. The first tracked pose is free.
  void add(const SolidActor& actor, const std::vector<Pose>& tracked, const ShownPoses& shown,
           double rateHz);
  /// The tracked hands, the solid avatar's, and one each for those of the engine, if it is built
  /// in; the engine's only at 90 Hz and above.
  [[nodiscard]] const std::vector<HandsTally>& tallies() const { return tallies_; }

 private:
  void addHand(const SolidActor& actor, LinkId link, const std::vector<Pose>& tracked,
               const ShownPoses& shown, double rateHz);
  HandsTally& tallyOf(const std::string& name);

  const SolidStage& stage_;
  EngineHands engine_;
  std::vector<HandsTally> tallies_;
};

}  // namespace foretouch::tools
