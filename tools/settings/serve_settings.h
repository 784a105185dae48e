// tools/settings/serve_settings.h: all that a service can be asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "network/service/service.h"
#include "network/stream/stream_policy.h"
#include "network/wire/wire.h"
#include "tools/settings/numbered_avatars.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

inline constexpr int kMaxServeWorkers = 64;
inline constexpr std::size_t kMaxServeAvatars = 4096;

/// Where `--view` without a value serves.
inline constexpr char kDefaultView[] = "127.0.0.1:9465";

enum class ReceiverKind : std::uint8_t {
  Own,     ///< Our bounded reader: for any network.
  Liblcm,  ///< For networks that are trusted.
};

/// Each setting legal by itself. Paths can be opened as they are; an empty one is of nothing that
/// is asked for.
struct ServeConfig {
  std::string url = kDefaultUrl;  ///< Not empty; what else it must be, the wire says.
  ReceiverKind receiver = ReceiverKind::Own;
  ServiceOptions service;  ///< Workers (to kMaxServeWorkers), queue and suffix.
  std::string log;         ///< Where events are recorded.
  std::string http;        ///< "127.0.0.1:9464": where metrics are served.
  std::string view;        ///< kDefaultView: where the stream can be watched.
  WorldRequest world;      ///< Fidelity: link or exact.
  StreamPolicy stream;
  std::vector<NumberedAvatar> avatars;  ///< At least one; ids differ.
};

/// The table of `foretouch serve`, without its --config. `config` outlives the settings.
void addServeSettings(Settings& settings, ServeConfig& config);

/// The same for people: rows of a Markdown table of a configuration's keys, each with its default,
/// what is legal, and what it is for. docs/formats.md holds them.
[[nodiscard]] std::string configTable();

/// "127.0.0.1:9464" or "localhost:9464" or "[::1]:9464": a host and a port of 1 to 65535.
struct HttpAddress {
  std::string host;
  std::uint16_t port = 0;
};
/// `option` is what errors call it.
[[nodiscard]] Result<HttpAddress> parseHttpAddress(const std::string& option,
                                                   const std::string& text);
/// The same of this machine alone.
[[nodiscard]] Result<HttpAddress> parseViewAddress(const std::string& option,
                                                   const std::string& text);

}  // namespace foretouch::tools
