// network/service/message_seal.h: signatures of a service's messages, where it has a key. Not
// installed.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "network/service/clock.h"
#include "network/wire/message_key.h"
#include "network/wire/wire.h"

namespace foretouch::internal {

class MessageSeal {
 public:
  MessageSeal(const std::optional<MessageKey>& key, const Clock& clock)
      : key_(key), clock_(clock) {}

  [[nodiscard]] bool isAsked() const { return key_.has_value(); }
  /// Checks the signature and takes it off: a log holds what was said, as ever. `sentUtimeUs`: 0
  /// without a key.
  [[nodiscard]] Reject open(WireMessage& message, std::int64_t& sentUtimeUs) const;
  /// Signs if there is a key. From any thread; the times of signatures grow.
  void sign(const std::string& channel, Bytes& payload);

 private:
  std::optional<MessageKey> key_;
  const Clock& clock_;
  std::atomic<std::int64_t> last_{0};
};

}  // namespace foretouch::internal
