// bench/garbage.h: datagrams that a service must survive, one by one and as a flood.
#pragma once

#include <atomic>
#include <cstdint>
#include <netinet/in.h>
#include <thread>
#include <vector>

#include "network/wire/codec.h"
#include "network/wire/wire.h"
#include "tools/portable_random.h"

namespace foretouch::tools {

/// Sends datagrams to a group, from its own port.
class GroupSocket {
 public:
  explicit GroupSocket(const UdpmUrl& url);
  GroupSocket(const GroupSocket&) = delete;
  GroupSocket& operator=(const GroupSocket&) = delete;
  ~GroupSocket();
  /// False if the system did not take it.
  bool send(const Bytes& datagram) const;
  /// Sends `count` datagrams from `first` on, in one call; returns how many the system took.
  std::size_t send(std::vector<Bytes>& datagrams, std::size_t first, std::size_t count);

 private:
  int socket_ = -1;
  sockaddr_in group_{};
};

/// Noise, and cut or false copies of a valid pose.
class Garbage {
 public:
  Garbage(const UdpmUrl& url, const Bytes& validPayload, std::uint64_t seed);
  void send() { socket_.send(make()); }

 private:
  [[nodiscard]] std::size_t below(std::size_t n);
  [[nodiscard]] Bytes make();

  GroupSocket socket_;
  PortableRandom random_;
  Bytes valid_;
};

/// Short noise.
[[nodiscard]] std::vector<Bytes> noiseDatagrams(std::uint64_t seed);

/// Sends datagrams, again and again in order, from its own thread.
class Flood {
 public:
  /// `perSecond`: the number of datagrams; fewer if the system takes no more.
  Flood(const UdpmUrl& url, std::vector<Bytes> datagrams, double perSecond, double seconds);
  Flood(const Flood&) = delete;
  Flood& operator=(const Flood&) = delete;
  ~Flood();  ///< Stops it.

  /// Waits for its end; returns how many went out.
  [[nodiscard]] std::int64_t wait();

 private:
  void run(double perSecond, double seconds);

  GroupSocket socket_;
  std::vector<Bytes> datagrams_;
  std::int64_t sent_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace foretouch::tools
