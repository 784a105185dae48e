// network/world_stream/world_counts.h: what a live world has taken, refused and reported since it
// began, as plain values. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "network/wire/messages.h"
#include "network/wire/world_messages.h"
#include "network/world_stream/refused_bodies.h"

namespace foretouch {

struct WorldCounts {
  std::uint64_t states = 0;       ///< body_t received.
  std::uint64_t rigidPoses = 0;   ///< Poses in rigid_pose_t received, one per body.
  std::uint64_t avatarPoses = 0;  ///< Accepted by their avatar's stream, and so answered there.
  std::uint64_t taken = 0;        ///< Poses of both kinds that are in the world.
  RejectCounts rejects{};         ///< Refused states, and poses of both kinds.
  std::uint64_t lateChanges = 0;  ///< Took effect later than their sender says.
  std::uint64_t gaps = 0;         ///< Poses after which something before them is not known.
  std::uint64_t silences = 0;     ///< How often the watermark went on without a body.
  std::uint64_t forgotten = 0;    ///< Bodies that no sender spoke of any more.
  std::uint64_t failures = 0;     ///< What the world itself refused, or could not answer.
  std::uint64_t timelines = 0;    ///< Begun.
  std::uint64_t advances = 0;     ///< Those of the watermark.
  std::array<std::uint64_t, kNumEventKinds> events{};
  std::uint64_t marked = 0;  ///< Events that rest on something that is not known.
  // Now.
  std::size_t bodies = 0, silent = 0, waiting = 0;  ///< `waiting`: poses ahead of the watermark.
  std::int64_t answeredUntilUs = -1;
  BodyNumber waitsFor = kNoBody;            ///< The body whose next pose the watermark waits for.
  std::size_t refusedBodies = 0;            ///< Those of which poses come, and none is accepted.
  std::vector<RefusedBody> refusedLongest;  ///< As RefusedBodies::list().

  [[nodiscard]] std::uint64_t rejected() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t count : rejects) sum += count;
    return sum;
  }
};

}  // namespace foretouch
