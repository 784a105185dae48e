// tests/network/faulty_network.h: what becomes of messages on their way.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/network/simulated_sender.h"

namespace foretouch::test {

/// Chances, a message.
struct NetworkFaults {
  double loss = 0.0;
  double burst = 0.0;  ///< That many in a row are lost.
  double duplicate = 0.0;
  double delay = 0.0;  ///< By up to longestDelayUs; else by a millisecond at most.
  std::int64_t longestDelayUs = 0;
  double corrupt = 0.0;   ///< Some bytes.
  double truncate = 0.0;  ///< Or made longer.
  double foreign = 0.0;   ///< Something else comes as well.
};

struct Delivery {
  std::int64_t timeUs = 0;
  bool isSkeleton = false;  ///< On that channel.
  Bytes payload;
  PoseId id;               ///< Of a pose that was sent; of nobody's else.
  bool isAltered = false;  ///< Not what was sent.
};

/// In the order of arrival.
[[nodiscard]] std::vector<Delivery> deliveries(Random& random,
                                               const std::vector<SimulatedSender>& senders,
                                               const NetworkFaults& faults);

}  // namespace foretouch::test
