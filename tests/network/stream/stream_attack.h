// tests/network/stream/stream_attack.h: an adversary on the network of one true sender. It reads
// everything that the sender says, says what it likes, and wants that no true pose is answered. One
// seed decides everything.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace foretouch::test {

/// Where the adversary's datagrams come from.
enum class Standpoint : std::uint8_t {
  OtherSenders,  ///< Any number of datagrams at any time, from addresses and ports of its own.
  Before,        ///< The same, but only while the true sender is silent, and a few of them.
  SameSender,  ///< One datagram at a time, forged to come from the true sender's address and port.
};

struct AttackTally {
  std::uint64_t seeds = 0;
  std::uint64_t truePoses = 0;   ///< That arrived after their skeleton.
  std::uint64_t unanswered = 0;  ///< Of them.
  std::uint64_t longestRun = 0;  ///< Of unanswered ones, one after another.
  std::uint64_t hostile = 0;     ///< Datagrams of the adversary.
  std::uint64_t hostileAnswered = 0;
  std::uint64_t takeovers = 0;  ///< By the adversary.

  void add(const AttackTally& other);
};

struct AttackRun {
  Standpoint standpoint = Standpoint::OtherSenders;
  AttackTally tally;
  std::vector<std::string> violations;
};

/// What an attack may cost the true sender, in poses one after another.
[[nodiscard]] std::uint64_t mostStopped(Standpoint standpoint);

/// `isBound` false: nobody looks at who sent what. The adversary then wins.
[[nodiscard]] AttackRun attack(std::uint64_t seed, bool isBound = true);

}  // namespace foretouch::test
