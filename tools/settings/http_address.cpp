#include <algorithm>
#include <charconv>

#include "assets/text_file.h"
#include "network/wire/loopback.h"
#include "tools/settings/serve_settings.h"

namespace foretouch::tools {

Result<HttpAddress> parseViewAddress(const std::string& option, const std::string& text) {
  auto address = parseHttpAddress(option, text);
  if (!address.ok() || isLoopback(address.value().host)) return address;
  return Error::in(
      option, ErrorCode::OutOfRange,
      "expected localhost or an address of this machine alone (from others: ssh -L), found " +
          inQuotes(text));
}

Result<HttpAddress> parseHttpAddress(const std::string& option, const std::string& text) {
  const std::size_t colon = text.rfind(':');
  HttpAddress address;
  if (colon != std::string::npos && colon > 0) {
    address.host = text.substr(0, colon);
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, address.port);
    const bool bracketed = address.host.front() == '[' && address.host.back() == ']';
    if (bracketed) address.host = address.host.substr(1, address.host.size() - 2);
    const bool colonsFit = bracketed == (address.host.find(':') != std::string::npos);
    const bool visible = std::all_of(address.host.begin(), address.host.end(),
                                     [](char c) { return c > 0x20 && c < 0x7f; });
    if (error == std::errc() && rest == end && address.port > 0 && colonsFit && visible &&
        !address.host.empty()) {
      return address;
    }
  }
  return Error::in(option, ErrorCode::OutOfRange,
                   "expected a host and a port, such as 127.0.0.1:9464, found " + inQuotes(text));
}

}  // namespace foretouch::tools
