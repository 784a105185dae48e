// middleware/events/followed_list.h: every two bodies of which a follower knows something. Not
// installed.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "middleware/events/followed_bodies.h"
#include "middleware/events/world_event.h"
#include "middleware/world/window_query.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// Keeps its memory.
class FollowedList {
 public:
  /// Fills in the links of two bodies whose way through the window is known, or followed from its
  /// begin on.
  void tellKnown(const WorldParts& world, std::int64_t fromUs, std::int64_t toUs,
                 FollowedLinks& known) const;
  /// Fills in what there is to do in a window from there on: bodies that are listed, in order, and
  /// those of which something is still to be reported.
  void plan(std::int64_t fromUs, const std::vector<ListedPair>& listed,
            std::vector<TracedBodies>& tasks);
  /// Knows what is open, and nothing else.
  void assign(const std::vector<OpenPart>& open);

 private:
  void retire(std::int64_t fromUs);
  void addListed(const std::vector<ListedPair>& listed);
  FollowedBodies& add(const BodyPair& bodies);
  void sort();

  std::vector<std::unique_ptr<FollowedBodies>> bodies_;  // by bodies
  std::vector<std::unique_ptr<FollowedBodies>> unused_;
};

}  // namespace foretouch::internal
