// middleware/events/pair_key.h: the two that an event, a contact or an open part is about. Not
// installed.
#pragma once

#include <tuple>

#include "middleware/events/world_event.h"

namespace foretouch::internal {

struct PairKey {
  BodyId bodyOfA = 0;
  LinkId linkOfA = 0;
  BodyId bodyOfB = 0;
  LinkId linkOfB = 0;
  ObjectId object = -1;

  [[nodiscard]] auto tied() const { return std::tie(bodyOfA, linkOfA, bodyOfB, linkOfB, object); }
  /// Without the object.
  [[nodiscard]] auto links() const { return std::tie(bodyOfA, linkOfA, bodyOfB, linkOfB); }
};
[[nodiscard]] inline bool operator<(const PairKey& x, const PairKey& y) {
  return x.tied() < y.tied();
}
[[nodiscard]] inline bool operator==(const PairKey& x, const PairKey& y) {
  return x.tied() == y.tied();
}

/// Whether it is about a whole body, or about two of which nothing is known.
[[nodiscard]] inline bool isOfEveryLink(const PairKey& key) {
  return key.linkOfA == kEveryLink || key.linkOfB == kEveryLink;
}

/// The key of anything that has two sides.
template <typename TwoSided>
[[nodiscard]] PairKey keyOf(const TwoSided& of, ObjectId object) {
  return {of.a.body, of.a.link, of.b.body, of.b.link, object};
}

}  // namespace foretouch::internal
