// middleware/bracket/known_places.h: where the last few poses had the links: a pose around one step
// is around the next one, too. Metres in W. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/skeleton.h"

namespace foretouch::internal {

/// For one thread; keeps its memory.
class KnownPlaces {
 public:
  static constexpr std::size_t kKept = 6;

  /// As placesAt(). Until as many other poses as are kept, less one, are asked.
  [[nodiscard]] const std::vector<LinkState>& at(const Avatar& avatar, const Pose& pose);

 private:
  struct Known {
    std::uint64_t avatar = 0, asked = 0;  // asked: when last
    Pose pose;
    std::vector<LinkState> places;
  };
  std::array<Known, kKept> known_;
  std::uint64_t asked_ = 0;
};

}  // namespace foretouch::internal
