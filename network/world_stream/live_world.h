// network/world_stream/live_world.h: the World of a live stream: at an instant, tells it what its
// bodies have said until then, and follows what happens. Not installed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "articulated/result.h"
#include "middleware/events/world_event.h"
#include "middleware/events/world_follower.h"
#include "middleware/world/world.h"
#include "network/world_stream/live_body.h"
#include "network/world_stream/solid_bodies.h"
#include "network/world_stream/world_setup.h"

namespace foretouch::internal {

/// A body that was there in a window, and is gone.
struct GoneBody {
  BodyNumber number = 0;
  std::int64_t sinceUs = 0;
};

/// One thread.
class LiveWorld {
 public:
  /// No body is there yet. `holdsStill`: a body that says nothing stays where it was. Errors: those
  /// of World::build(), WorldSetup::ask and SolidBodies::make().
  static Result<LiveWorld> make(const WorldSetup& setup, bool holdsStill, std::int64_t fromUs);

  /// Whether so many more bodies may come before it must be made anew.
  [[nodiscard]] bool hasRoomFor(std::size_t bodies) const;
  /// Tells the world what all have said until `untilUs`, and of each the next pose after it.
  /// O(n log n) of what there is to tell.
  void tell(LiveBodies& bodies, std::int64_t untilUs);
  /// After tell(): solid bodies go until then, as SolidBodies::tick(). Where one has no place yet,
  /// nothing is known of it.
  Result<Done> show(LiveBodies& bodies, std::int64_t untilUs, std::int64_t timeline,
                    std::vector<ShownBody>& shown);
  /// What that took, as SolidOptions::workBudget.
  [[nodiscard]] std::uint64_t solidWork() const { return solids_ ? solids_->work() : 0; }
  /// As WorldFollower::follow().
  Result<Done> follow(std::int64_t untilUs, WorldEvents& events) {
    return follower_.follow(world(), untilUs, events);
  }
  void forgetBefore(std::int64_t utimeUs) { world().forgetBefore(utimeUs); }
  /// The latest pose that it was told.
  [[nodiscard]] std::optional<std::int64_t> knownUntilUs() { return world().knownUntilUs(); }

  /// The body whose place in the world this is, if it was there at that instant.
  [[nodiscard]] std::optional<BodyNumber> numberOf(BodyId slot, std::int64_t utimeUs) const;
  /// Bodies that tell() found gone; the caller empties it.
  std::vector<GoneBody>& gone() { return gone_; }
  /// Changes of carriers, poses and shapes that the world did not take.
  [[nodiscard]] std::uint64_t failures() const { return failures_; }

 private:
  struct Slot {
    BodyNumber number = 0;
    std::optional<std::int64_t> goneUs;
  };
  LiveWorld(const WorldSetup& setup, bool holdsStill, WorldFollower follower)
      : setup_(&setup), holdsStill_(holdsStill), follower_(std::move(follower)) {}
  [[nodiscard]] World& world() { return solids_ ? solids_->world() : *world_; }
  [[nodiscard]] bool isThere(const LiveBody& body) const {
    return body.slot && !slots_[slotOf(*body.slot)].goneUs;
  }
  [[nodiscard]] Result<BodyId> add(const LiveBody& body, const BodyOptions& options);
  /// What a body has to tell next. What all bodies tell comes in the order of time: so where one is
  /// to carry another, all that came before has been told.
  struct Due {
    std::int64_t us = 0;
    /// At one instant: poses, which are in the frame before it, then bodies let go of, then bodies
    /// carried, each after its carrier.
    int rank = 0;
    LiveBody* body = nullptr;
  };
  static bool comesLater(const Due& x, const Due& y);
  [[nodiscard]] static std::optional<Due> dueOf(LiveBody& body, std::int64_t untilUs);
  void offer(LiveBody& body, std::int64_t untilUs, std::int64_t notBeforeUs);
  void tellNext(LiveBodies& bodies, const Due& due, std::int64_t untilUs);
  [[nodiscard]] static bool waitsForCarrier(LiveBodies& bodies, const Due& due,
                                            std::int64_t untilUs);
  void wake(const LiveBody& carrier, std::int64_t utimeUs, std::int64_t untilUs);
  void tellDue(LiveBodies& bodies, std::int64_t untilUs);
  void tellWaiting(std::int64_t untilUs);
  void loseRiders(LiveBodies& bodies, std::int64_t untilUs);
  void holdShort(LiveBody& body, std::int64_t untilUs);
  static void markSince(LiveBody& body, const LiveChange& change, std::int64_t untilUs);
  static void giveUp(LiveBody& body);
  [[nodiscard]] bool addTo(LiveBody& body);
  void push(LiveBody& body, std::int64_t utimeUs, const Pose& pose, const LiveKnot* knot = nullptr);
  void takeKnot(LiveBody& body, const LiveKnot& knot);
  void holdUntil(LiveBody& body, std::int64_t utimeUs);
  /// False: its carrier is not there yet.
  bool takeChange(LiveBodies& bodies, LiveBody& body, LiveChange& change, std::int64_t untilUs);
  bool attach(LiveBodies& bodies, LiveBody& body, LiveChange& change, std::int64_t untilUs);
  static void changed(LiveBody& body, const LiveChange& change);
  void letGo(LiveBody& body, const LiveChange& change);
  void letGoUnheard(LiveBody& body, const LiveChange& change);
  void retire(LiveBody& body, std::int64_t utimeUs);
  void notTaken(LiveBody& body);

  const WorldSetup* setup_;
  bool holdsStill_;
  std::optional<World> world_;           // or, where a body is solid:
  std::unique_ptr<SolidBodies> solids_;  // which has the world
  WorldFollower follower_;
  std::vector<Slot> slots_;
  std::vector<GoneBody> gone_;
  std::vector<Due> due_;            // a heap
  std::vector<LiveBody*> waiting_;  // for a carrier that is not there yet
  std::uint64_t failures_ = 0;
};

}  // namespace foretouch::internal
