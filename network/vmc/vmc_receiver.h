// network/vmc/vmc_receiver.h: streams of VMC (OSC over UDP) beside another receiver's: each pose
// comes out as if its sender had said it in Foretouch's own messages. Not installed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "network/vmc/vmc_body.h"
#include "network/wire/wire.h"

namespace foretouch {

/// Senders per port; one that has been silent for kVmcSilentUs makes way for another one.
inline constexpr std::size_t kMaxVmcSenders = 16;
inline constexpr std::int64_t kVmcSilentUs = 2'000'000;

struct VmcPort {
  std::uint16_t port = 0;  ///< UDP; 0: any free one.
  VmcBody body;
};

struct VmcOptions {
  /// Whose datagrams are taken is as with openUdpmReceiver(): by the ttl and `senders`.
  UdpmUrl url;
  std::vector<Network> senders;
  std::string suffix;  ///< Ends the names of the channels that poses come out on.
};

/// `other` may be none. Listens only on this machine's loopback where no other machine is heard.
/// Errors: a port that is taken.
[[nodiscard]] Result<std::unique_ptr<Receiver>> openVmcReceiver(std::unique_ptr<Receiver> other,
                                                                std::vector<VmcPort> ports,
                                                                const VmcOptions& options);

}  // namespace foretouch
