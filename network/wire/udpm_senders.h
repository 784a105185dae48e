// network/wire/udpm_senders.h: whose datagrams a receiver takes: by the address that they come
// from. Not installed.
//
// Linux drops datagrams that come from outside under one of the machine's own addresses (martians),
// and to most groups those from 0.0.0.0, which is what lo's own have (ip_mc_validate_source in
// net/ipv4/route.c). So such an address means this machine. An address proves no more than that:
// docs/streaming.md, "Who is believed".
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "network/wire/wire.h"

namespace foretouch {

/// Addresses in host byte order.
class SenderFilter {
 public:
  /// A ttl of 0 means only this machine; `networks` replace that, and this machine is always among
  /// them. A ttl above 0 without `networks`: every sender.
  SenderFilter(const UdpmUrl& url, std::vector<Network> networks);
  /// The same at a port that no group leads to: there 0.0.0.0 is not this machine.
  static SenderFilter ofUnicast(const UdpmUrl& url, std::vector<Network> networks);

  using Time = std::chrono::steady_clock::time_point;
  /// Whether to take a datagram from here. Asks the system for its own addresses every ten seconds,
  /// and when a stranger comes, then at most once a second.
  [[nodiscard]] bool takes(std::uint32_t address, Time now);

 private:
  [[nodiscard]] bool isOwn(std::uint32_t address) const;
  void readOwn(Time now);

  bool takesAll_, takesUnnamed_;
  std::vector<Network> networks_;
  std::vector<std::uint32_t> own_;  // sorted
  bool hasRead_ = false;
  Time readAt_;
};

}  // namespace foretouch
