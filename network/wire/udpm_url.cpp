#include <algorithm>
#include <arpa/inet.h>
#include <charconv>
#include <netinet/in.h>
#include <string>
#include <string_view>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "network/wire/wire.h"

namespace foretouch {
namespace {

constexpr std::string_view kScheme = "udpm://";
constexpr std::size_t kMaxReceiveBufferBytes = std::size_t{1} << 30;

/// Names the address as it was typed, unless that would do something to a terminal.
Error errorIn(const std::string& url, ErrorCode code, const std::string& message) {
  const bool isPlain =
      std::all_of(url.begin(), url.end(), [](char c) { return c >= ' ' && c <= '~'; });
  return {code, isPlain ? url : inQuotes(url), -1, -1, message};
}

template <typename T>
bool readNumber(std::string_view text, T least, T most, T& number) {
  T read{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), read);
  if (fault != std::errc() || end != text.data() + text.size()) return false;
  if (read < least || read > most) return false;
  number = read;
  return true;
}

/// Cuts off and returns the part before `separator`, all of it if there is none.
std::string_view upTo(char separator, std::string_view& rest) {
  const std::size_t at = rest.find(separator);
  const std::string_view head = rest.substr(0, at);
  rest = at == std::string_view::npos ? std::string_view() : rest.substr(at + 1);
  return head;
}

bool isMulticast(const std::string& group) {
  in_addr address{};
  return inet_pton(AF_INET, group.c_str(), &address) == 1 && IN_MULTICAST(ntohl(address.s_addr));
}

Result<Done> readOption(const std::string& url, std::string_view option, UdpmUrl& parsed) {
  std::string_view value = option;
  const std::string_view key = upTo('=', value);
  const std::string quoted = inQuotes(value);
  if (key == "ttl") {
    if (readNumber(value, 0, 255, parsed.ttl)) return Done{};
    return errorIn(url, ErrorCode::OutOfRange, "ttl: expected 0 to 255, found " + quoted);
  }
  if (key == "recv_buf_size") {
    if (readNumber(value, std::size_t{1}, kMaxReceiveBufferBytes, parsed.receiveBufferBytes)) {
      return Done{};
    }
    return errorIn(url, ErrorCode::OutOfRange,
                   "recv_buf_size: expected 1 to 1073741824 bytes, found " + quoted);
  }
  return errorIn(url, ErrorCode::UnknownName,
                 "expected the options ttl and recv_buf_size, found " + inQuotes(key));
}

}  // namespace

Result<UdpmUrl> parseUdpmUrl(const std::string& url) {
  std::string_view rest = url;
  if (rest.substr(0, kScheme.size()) != kScheme) {
    return errorIn(url, ErrorCode::Syntax, "expected udpm://GROUP:PORT?ttl=TTL");
  }
  rest.remove_prefix(kScheme.size());
  std::string_view place = upTo('?', rest);
  const bool hasPort = place.find(':') != std::string_view::npos;

  UdpmUrl parsed;
  const std::string group(upTo(':', place));
  if (!group.empty() && !isMulticast(group)) {
    return errorIn(
        url, ErrorCode::OutOfRange,
        "group: expected an address from 224.0.0.0 to 239.255.255.255, found " + inQuotes(group));
  }
  if (!group.empty()) parsed.group = group;
  if (hasPort && !readNumber<std::uint16_t>(place, 1, 65535, parsed.port)) {
    return errorIn(url, ErrorCode::OutOfRange,
                   "port: expected 1 to 65535, found " + inQuotes(place));
  }
  while (!rest.empty()) {
    FORETOUCH_CHECK(readOption(url, upTo('&', rest), parsed));
  }
  return parsed;
}

Result<Network> parseNetwork(const std::string& text) {
  const auto refused = [&] {
    return Error::of(
        ErrorCode::OutOfRange,
        "expected an IPv4 network as 10.0.0.0/24, or one address, found " + inQuotes(text));
  };
  const std::size_t slash = text.find('/');
  in_addr address{};
  if (::inet_pton(AF_INET, text.substr(0, slash).c_str(), &address) != 1) return refused();
  Network network{ntohl(address.s_addr), Network::kAddressBits};
  if (slash != std::string::npos) {
    const std::string_view bits = std::string_view(text).substr(slash + 1);
    const auto [end, fault] = std::from_chars(bits.data(), bits.data() + bits.size(), network.bits);
    if (fault != std::errc() || end != bits.data() + bits.size()) return refused();
    if (network.bits < 0 || network.bits > Network::kAddressBits) return refused();
  }
  // 10.0.0.7/24 is a slip: of the address, or of the number of bits.
  if ((network.address & ~network.mask()) != 0) {
    return Error::of(ErrorCode::OutOfRange, "expected a network whose bits after the first " +
                                                std::to_string(network.bits) + " are 0, found " +
                                                inQuotes(text));
  }
  return network;
}

}  // namespace foretouch
