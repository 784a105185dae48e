// tools/stream/service_manager.h: systemd's notifications (sd_notify(3), Type=notify,
// WatchdogSec=), without its library: a datagram to the socket in $NOTIFY_SOCKET.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace foretouch::tools {

class ServiceManager {
 public:
  /// Reads the environment. Sends nothing if systemd does not ask.
  ServiceManager();

  void ready(const std::string& status) const { tell("READY=1\nSTATUS=" + status); }
  void alive() const { tell("WATCHDOG=1"); }
  void stopping() const { tell("STOPPING=1"); }
  /// Longest time between calls of alive(): half of systemd's limit. Empty: none needed.
  [[nodiscard]] std::optional<std::chrono::milliseconds> aliveEvery() const { return aliveEvery_; }

 private:
  void tell(const std::string& text) const;
  std::string socket_;
  std::optional<std::chrono::milliseconds> aliveEvery_;
};

}  // namespace foretouch::tools
