// middleware/triggers/body_breaks.h: where in a stretch of world time what is known of a body, and
// of all that carries it, breaks off: from there on what was known before says nothing. Not
// installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lss/index.h"
#include "middleware/depth/body_places.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// A stretch of world time.
struct Stretch {
  std::int64_t fromUs = 0, toUs = 0;
};

/// For one thread. Keeps what was known where a stretch ends.
class BodyBreaks {
 public:
  /// Finds those of every body. The stretch before must have been asked, unless it is the first.
  /// O(bodies times their carriers).
  void find(const WorldParts& world, const Stretch& stretch);

  /// Instants, in order: it or what carries it appears or changes its carrier, or turns out to be
  /// elsewhere than was told of it.
  [[nodiscard]] const std::vector<std::int64_t>& cuts(BodyId body) const {
    return ofBody_[slotOf(body)].cuts;
  }
  /// Parts of the stretch, in order: it or what carries it is silent, and undecided.
  [[nodiscard]] const std::vector<Stretch>& silences(BodyId body) const {
    return ofBody_[slotOf(body)].silences;
  }

 private:
  /// What a body's place at an instant rests on.
  struct Ground {
    PlaceKnown how = PlaceKnown::NotThere;
    std::int64_t episodeUs = 0, pieceUs = 0;
    [[nodiscard]] bool holdsFor(const Ground& later) const;
  };
  struct Breaks {
    std::vector<std::int64_t> cuts;
    std::vector<Stretch> silences;
    Ground atEnd;
    bool isElsewhere = false;  // where the stretch begins
  };
  static Ground groundOf(const WorldBody& body, std::int64_t us);
  void follow(const WorldParts& world, BodyId body, const Stretch& stretch);

  std::vector<Breaks> ofBody_;
  std::vector<BodyId> chain_;
};

}  // namespace foretouch::internal
