// tests/network/faulty_network.h: the faults of messages in transit.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/network/simulated_sender.h"

namespace foretouch::test {

/// Probabilities per message.
struct NetworkFaults {
  double loss = 0.0;
  double burst = 0.0;  ///< That many in a row are lost.
  double duplicate = 0.0;
  double delay = 0.0;  ///< Up to longestDelayUs; otherwise a millisecond at most.
  std::int64_t longestDelayUs = 0;
  double corrupt = 0.0;   ///< Some bytes.
  double truncate = 0.0;  ///< Or made longer.
  double foreign = 0.0;   ///< A foreign message comes as well.
};

struct Delivery {
  std::int64_t timeUs = 0;
  bool isSkeleton = false;  ///< On the skeleton channel.
  Bytes payload;
  PoseId id;               ///< Of a sent pose; otherwise of none.
  bool isAltered = false;  ///< Differs from the sent message.
};

/// In the order of arrival.
[[nodiscard]] std::vector<Delivery> deliveries(Random& random,
                                               const std::vector<SimulatedSender>& senders,
                                               const NetworkFaults& faults);

}  // namespace foretouch::test
