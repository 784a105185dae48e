// middleware/world/window_scratch.h: what questions about windows keep from one to the next, per
// world and per thread. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "middleware/query/first_failure.h"
#include "middleware/scratch.h"
#include "middleware/world/bodies_apart.h"
#include "middleware/world/body_sweep.h"
#include "middleware/world/box_sweep.h"
#include "middleware/world/system_query.h"
#include "middleware/world/work_shares.h"
#include "middleware/world/world_contacts.h"

namespace foretouch::internal {

/// Two bodies whose work was spent before they were answered, and what was found until then.
struct UndonePair {
  std::size_t pair = 0;  ///< Place among those that meet.
  std::vector<WorldContact> found;
};

/// What one thread keeps between windows, and its part of the answer to one.
struct alignas(128) WindowWorker {
  SystemScratch system;
  BodiesApart apart;
  std::vector<WorldContact> contacts;
  std::vector<UndonePair> undone;
  std::uint64_t spent = 0;  // work done on pairs
  WorldCounters counters;
  FirstFailure failure{"window"};
};

/// Where a contact comes among all: sorted in its place, as it is four times as large.
struct ContactPlace {
  WorldTime time;
  BodyId bodyOfA;
  LinkId linkOfA;
  BodyId bodyOfB;
  LinkId linkOfB;
  const WorldContact* contact;
};

/// Two links of different bodies, a's number the lower one.
struct KnownLinks {
  BodyId a = 0, b = 0;
  LinkId linkOfA = 0, linkOfB = 0;
  /// Motions that begin there or later are not known: those of a body that has changed its carrier.
  std::int64_t sinceUs = 0;
};

/// What a caller that asks window after window knows already. Of what a body met by itself (own
/// links, the static scene) before the window, in a motion that it is part of, it needs to hear
/// that they may meet from its begin on, and nothing else.
struct FollowedLinks {
  std::vector<KnownLinks> pairs;  ///< All are known in the window. By bodies.
};

struct WorldMemory : ScratchPart {
  static constexpr ScratchKind kKind = ScratchKind::World;

  std::uint64_t world = 0;    // the identity of the world that this is about
  std::uint64_t windows = 0;  // how many were asked so far
  SystemPlans plans;
  std::vector<BodySweep> sweeps;  // per body
  std::vector<BodyBox> boxes;     // per body, of the whole window
  BoxSweep broad;
  std::vector<MeetingBodies> meeting;
  std::vector<std::uint32_t> numNear;  // per body, how many it may meet
  std::vector<bool> isCrowded;         // per body; empty: none is
  WorkShares shares;
  std::vector<std::size_t> undone;  // places of pairs, in order
  std::vector<BodyId> near;         // known roughly so far, though something may be near
  std::vector<std::unique_ptr<WindowWorker>> workers;  // one per thread
  std::vector<ContactPlace> atBegin, later, merged;
};

}  // namespace foretouch::internal
