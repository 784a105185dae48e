#include "network/wire/udpm_senders.h"

#include <algorithm>
#include <arpa/inet.h>
#include <ifaddrs.h>
#include <memory>
#include <netinet/in.h>
#include <utility>

#include "network/wire/udpm_socket.h"

namespace foretouch {
namespace {

constexpr Network kLoopback{0x7f000000, 8};  // 127.0.0.0/8
constexpr Network kLinkLocalGroups{0xe0000000,
                                   24};  // 224.0.0.0/24: Linux takes 0.0.0.0 from outside
/// A flood of strangers costs one look at the interfaces per second.
constexpr std::chrono::seconds kReadEvery{1};
/// An address that was ours may be another machine's by now.
constexpr std::chrono::seconds kReadAnywayEvery{10};

bool contains(const Network& network, std::uint32_t address) {
  return ((address ^ network.address) & network.mask()) == 0;
}

}  // namespace

SenderFilter::SenderFilter(const UdpmUrl& url, std::vector<Network> networks)
    : takesAll_(url.ttl > 0 && networks.empty()),
      takesUnnamed_(!contains(kLinkLocalGroups, ntohl(addressOf(url).sin_addr.s_addr))),
      networks_(std::move(networks)) {}

SenderFilter SenderFilter::ofUnicast(const UdpmUrl& url, std::vector<Network> networks) {
  SenderFilter filter(url, std::move(networks));
  filter.takesUnnamed_ = false;
  return filter;
}

bool SenderFilter::isOwn(std::uint32_t address) const {
  return contains(kLoopback, address) || (address == INADDR_ANY && takesUnnamed_) ||
         std::binary_search(own_.begin(), own_.end(), address);
}

bool SenderFilter::takes(std::uint32_t address, Time now) {
  if (takesAll_) return true;
  if (!hasRead_ || now - readAt_ > kReadAnywayEvery) readOwn(now);
  const auto isListed = [&] {
    return std::any_of(networks_.begin(), networks_.end(),
                       [&](const Network& network) { return contains(network, address); });
  };
  if (isOwn(address) || isListed()) return true;
  if (now - readAt_ < kReadEvery) return false;
  readOwn(now);
  return isOwn(address);
}

void SenderFilter::readOwn(Time now) {
  hasRead_ = true;
  readAt_ = now;
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return;  // keeps what it knew
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> all(first, ::freeifaddrs);
  own_.clear();
  for (const ifaddrs* each = first; each != nullptr; each = each->ifa_next) {
    if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET) continue;
    const auto* const address = reinterpret_cast<const sockaddr_in*>(each->ifa_addr);
    own_.push_back(ntohl(address->sin_addr.s_addr));
  }
  std::sort(own_.begin(), own_.end());
}

}  // namespace foretouch
