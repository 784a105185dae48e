// bench/slow_clients.h: clients of a service's HTTP that are slow on purpose, and how long others
// wait beside them.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace foretouch::tools {

class SlowClients {
 public:
  enum class Kind : std::uint8_t {
    OneByte,  ///< Sends one byte of a request, waits until it is put out, and comes again.
    NoRead,   ///< Asks for the largest document, and reads nothing of it.
  };
  /// `count` of them against this machine's `port`, each in a thread of its own.
  SlowClients(Kind kind, int count, std::uint16_t port);
  SlowClients(const SlowClients&) = delete;
  SlowClients& operator=(const SlowClients&) = delete;
  ~SlowClients();

 private:
  void run(Kind kind, std::uint16_t port);
  std::atomic<bool> stop_{false};
  std::vector<std::thread> threads_;
};

/// Seconds until the whole answer to "GET `path`" has come; -1 if none comes, or one that is not
/// 200.
[[nodiscard]] double secondsToGet(const std::string& path, std::uint16_t port);

}  // namespace foretouch::tools
