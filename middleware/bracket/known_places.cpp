#include "middleware/bracket/known_places.h"

#include <algorithm>
#include <cstring>

#include "articulated/link_places.h"

namespace foretouch::internal {
namespace {

template <typename T>
bool areSameBits(const std::vector<T>& x, const std::vector<T>& y) {
  const std::size_t bytes = x.size() * sizeof(T);
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), bytes) == 0;
}

bool isSame(const Pose& x, const Pose& y) {
  return areSameBits(x.rotations, y.rotations) && areSameBits(x.translations, y.translations);
}

}  // namespace

const std::vector<LinkState>& KnownPlaces::at(const Avatar& avatar, const Pose& pose) {
  ++asked_;
  for (Known& known : known_) {
    if (known.avatar != avatar.identity() || !isSame(known.pose, pose)) continue;
    known.asked = asked_;
    return known.places;
  }
  Known& oldest =
      *std::min_element(known_.begin(), known_.end(),
                        [](const Known& x, const Known& y) { return x.asked < y.asked; });
  oldest.avatar = avatar.identity();
  oldest.asked = asked_;
  oldest.pose = pose;
  placesAt(avatar.skeleton(), pose, oldest.places);
  return oldest.places;
}

}  // namespace foretouch::internal
