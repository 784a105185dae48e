// tools/world/loaded_world.h: the world of a world file, with all that its bodies do.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "articulated/pair_rules.h"
#include "lss/index.h"
#include "middleware/triggers/triggers.h"
#include "middleware/world/world.h"
#include "tools/microseconds.h"
#include "tools/world/body_knots.h"
#include "tools/world/body_shapes.h"
#include "tools/world/body_stretches.h"
#include "tools/world/world_file.h"

namespace foretouch::tools {

struct LoadedBody {
  BodyShape shape;
  BodyStretches stretches;        ///< At least one.
  std::optional<PairRules> self;  ///< Where own links are asked.
  BodyGroup group = 0;
  std::size_t numPoses = 0;                                    ///< In its files; 0: it stands.
  std::int64_t firstPoseUs = 0, lastPoseUs = 0;                ///< Those of these poses.
  std::map<std::int64_t, std::vector<LinkId>> lostLinks = {};  ///< As BodyKnots has them.
  std::vector<BodyKnot> leftOut = {};                          ///< The same.

  [[nodiscard]] bool isMesh() const { return shape.mesh.has_value(); }
};

struct LoadedWorld {
  WorldFile file;  ///< With the unit and axis that the scene was read with.
  std::optional<Scene> scene;
  FileFrame sceneFrame;
  std::vector<LoadedBody> bodies;   ///< As in the file, by their BodyId.
  std::vector<std::string> groups;  ///< Names, by their BodyGroup; "" for bodies that name none.
  World world;
  std::int64_t beginUs = 0;  ///< The first pose of all.
  std::int64_t endUs = 0;    ///< Known until here, and later than `beginUs`.
  /// A body whose poses end there, though others go on; nothing if all end there.
  std::optional<BodyId> waitsFor;
  std::vector<std::string> remarks;  ///< What a user should know, a sentence each.
  Triggers triggers;                 ///< Those of the file, in its order.

  [[nodiscard]] const std::string& nameOf(BodyId body) const {
    return file.bodies[slotOf(body)].name;
  }
  /// True if it is a volume that reports what is in it, and touches nothing.
  [[nodiscard]] bool isTrigger(BodyId body) const { return triggers.triggerOf(body) >= 0; }
  /// The number of bodies without triggers, which come behind them.
  [[nodiscard]] std::size_t numBodies() const {
    return bodies.size() - countOf(triggers.numTriggers());
  }
  /// For BodyPlaces: valid until the bodies change.
  [[nodiscard]] std::vector<const BodyStretches*> stretches() const;
  /// Seconds on the file's clock.
  [[nodiscard]] static double secondsOf(std::int64_t utimeUs) { return inSeconds(utimeUs); }
  [[nodiscard]] static double secondsOf(const WorldTime& time) {
    return (static_cast<double>(time.us) + time.fraction) / kUsPerS;
  }
  /// "LeftHand" for an avatar, "" for a body that has only one link.
  [[nodiscard]] std::string linkNameOf(BodyId body, LinkId link) const;
  /// "anna: LeftHand"; the body's name if it has one link.
  [[nodiscard]] std::string labelOf(BodyId body, LinkId link) const;
};

}  // namespace foretouch::tools
