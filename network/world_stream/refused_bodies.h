// network/world_stream/refused_bodies.h: bodies of which poses come, and none is accepted: a sender
// whose clock is wrong, or that is told apart from another one, should learn of it. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "network/wire/messages.h"
#include "network/wire/world_messages.h"

namespace foretouch {

struct RefusedBody {
  BodyNumber body = 0;
  Reject reason = Reject::None;  ///< Why the last pose was refused.
  std::int64_t sinceUs = 0;      ///< Receipt of the first since one was accepted, or a pause.
  std::int64_t lastUs = 0;       ///< Receipt of the last one.
  std::uint64_t poses = 0;       ///< Since then.
};

/// "body 10: none of its 35 poses was accepted for 0.9 s: late"
[[nodiscard]] std::string describe(const RefusedBody& body);

/// One thread. Memory is bounded, whatever numbers strangers give.
class RefusedBodies {
 public:
  void refused(BodyNumber body, Reject reason, std::int64_t receiveUtimeUs);
  void accepted(BodyNumber body);
  /// Those that are refused for kRefusedAfterUs or longer, and of which poses still come: the
  /// longest first, at most kMostRefusedListed of them; `all`: how many there are.
  [[nodiscard]] std::vector<RefusedBody> list(std::size_t& all) const;

 private:
  std::map<BodyNumber, RefusedBody> bodies_;
  std::int64_t nowUs_ = 0;
};

inline constexpr std::int64_t kRefusedAfterUs = 500'000;
inline constexpr std::size_t kMostRefusedListed = 8;

}  // namespace foretouch
