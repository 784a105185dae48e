#include "bench/garbage.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <chrono>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include "network/wire/udpm_datagram.h"

namespace foretouch::tools {
namespace {

constexpr std::size_t kKinds = 1024;  // of a flood's datagrams: none is made while it runs
constexpr std::size_t kMostAtOnce = 64;

std::uint8_t byteOf(PortableRandom& random) {
  return static_cast<std::uint8_t>(random.uniform(0.0, 256.0));
}

}  // namespace

GroupSocket::GroupSocket(const UdpmUrl& url)
    : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  group_.sin_family = AF_INET;
  group_.sin_port = htons(url.port);
  ::inet_pton(AF_INET, url.group.c_str(), &group_.sin_addr);
}
GroupSocket::~GroupSocket() {
  ::close(socket_);
}
bool GroupSocket::send(const Bytes& datagram) const {
  return ::sendto(socket_, datagram.data(), datagram.size(), MSG_DONTWAIT,
                  reinterpret_cast<const sockaddr*>(&group_), sizeof group_) >= 0;
}

std::size_t GroupSocket::send(std::vector<Bytes>& datagrams, std::size_t first, std::size_t count) {
  std::array<iovec, kMostAtOnce> parts{};
  std::array<mmsghdr, kMostAtOnce> messages{};
  count = std::min({count, kMostAtOnce, datagrams.size() - first});
  for (std::size_t i = 0; i < count; ++i) {
    parts[i] = {datagrams[first + i].data(), datagrams[first + i].size()};
    messages[i].msg_hdr.msg_name = &group_;
    messages[i].msg_hdr.msg_namelen = sizeof group_;
    messages[i].msg_hdr.msg_iov = &parts[i];
    messages[i].msg_hdr.msg_iovlen = 1;
  }
  const int sent = ::sendmmsg(socket_, messages.data(), static_cast<unsigned>(count), MSG_DONTWAIT);
  return sent > 0 ? static_cast<std::size_t>(sent) : 0;
}

Garbage::Garbage(const UdpmUrl& url, const Bytes& validPayload, std::uint64_t seed)
    : socket_(url), random_(seed), valid_(datagramsOf(kPoseChannel, validPayload, 0).front()) {}

std::size_t Garbage::below(std::size_t n) {
  return static_cast<std::size_t>(random_.uniform(0.0, static_cast<double>(n)));
}

Bytes Garbage::make() {
  constexpr std::size_t kMostNoise = 1200;
  Bytes bytes = valid_;
  switch (below(4)) {
    case 0:  // noise
      bytes.resize(1 + below(kMostNoise));
      for (std::uint8_t& byte : bytes) byte = byteOf(random_);
      return bytes;
    case 1:  // cut
      bytes.resize(1 + below(bytes.size() - 1));
      return bytes;
    case 2: {  // false counts and lengths; stamps and quaternions unchanged
      const std::size_t place = 8 + below(60);
      bytes[std::min(place, bytes.size() - 1)] ^= static_cast<std::uint8_t>(0x80 | below(128));
      bytes.pop_back();  // so that it can never be a valid pose
      return bytes;
    }
    default: {  // a fragment of a message that never comes
      Bytes fragment = {'L', 'C', '0', '3'};
      for (int i = 0; i < 16; ++i) fragment.push_back(byteOf(random_));
      fragment.insert(fragment.end(), bytes.begin(), bytes.end());
      return fragment;
    }
  }
}

std::vector<Bytes> noiseDatagrams(std::uint64_t seed) {
  PortableRandom random(seed);
  std::vector<Bytes> datagrams(kKinds);
  for (Bytes& datagram : datagrams) {
    datagram.resize(static_cast<std::size_t>(random.uniform(20.0, 120.0)));
    for (std::uint8_t& byte : datagram) byte = byteOf(random);
  }
  return datagrams;
}

Flood::Flood(const UdpmUrl& url, std::vector<Bytes> datagrams, double perSecond, double seconds)
    : socket_(url),
      datagrams_(std::move(datagrams)),
      thread_([this, perSecond, seconds] { run(perSecond, seconds); }) {}

Flood::~Flood() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

std::int64_t Flood::wait() {
  if (thread_.joinable()) thread_.join();
  return sent_;
}

void Flood::run(double perSecond, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto since = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  std::size_t next = 0;
  for (double now = 0.0; (now = since()) < seconds && !stop_;) {
    const auto due = static_cast<std::int64_t>(now * perSecond);
    if (sent_ >= due) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      continue;
    }
    const auto owed = static_cast<std::size_t>(due - sent_);
    const std::size_t sent = socket_.send(datagrams_, next, owed);
    sent_ += static_cast<std::int64_t>(sent);
    next = (next + sent) % datagrams_.size();
  }
}

}  // namespace foretouch::tools
