// tools/settings/serve_settings.h: all settings of a service.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "network/service/service.h"
#include "network/stream/stream_policy.h"
#include "network/vmc/vmc_body.h"
#include "network/wire/wire.h"
#include "network/world_stream/world_setup.h"
#include "tools/settings/numbered_avatars.h"
#include "tools/settings/person_settings.h"
#include "tools/settings/stream_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxServeAvatars = 4096;

/// The address of `--view` without a value.
inline constexpr char kDefaultView[] = "127.0.0.1:9465";

/// The UDP port at which an avatar's poses come by VMC.
struct NumberedPort {
  std::int32_t avatar = 1;
  std::uint16_t port = 0;
};

enum class ReceiverKind : std::uint8_t {
  Own,     ///< Our bounded reader: for any network.
  Liblcm,  ///< For trusted networks.
};

/// Each setting is legal by itself. Paths are ready to open; an empty one means: not requested.
struct ServeConfig {
  std::string url = kDefaultUrl;  ///< Not empty; the wire checks the rest.
  ReceiverKind receiver = ReceiverKind::Own;
  /// The networks whose datagrams are taken; empty: see openUdpmReceiver().
  std::vector<Network> senders;
  std::vector<std::string> senderTexts;
  std::vector<NumberedPort> vmc;  ///< The ports at which avatars are moved by VMC.
  std::vector<std::string> vmcTexts;
  VmcBones vmcBones = VmcBones::Original;
  std::string keyPath;     ///< The file of the key that messages are signed with.
  ServiceOptions service;  ///< Workers, queue, suffix and takeover.
  std::string log;         ///< The file that records events.
  LogLimits logLimits;
  std::string http;    ///< "127.0.0.1:9464": the address of the metrics.
  std::string view;    ///< kDefaultView: the address of the live view.
  WorldRequest world;  ///< Fidelity: link or exact.
  StreamPolicy stream;
  StreamSolidRequest solid;
  PersonRequest person;
  std::string worldPath;  ///< A world file: then scene and avatars are its.
  WorldPolicy worldPolicy;
  std::vector<NumberedAvatar> avatars;  ///< At least one; ids differ.
};

/// The table of `foretouch serve`, without its --config. `config` outlives the settings.
void addServeSettings(Settings& settings, ServeConfig& config);

/// The same for people: rows of a Markdown table of a configuration's keys, each with default,
/// legal values and purpose. docs/formats.md holds them.
[[nodiscard]] std::string configTable();

/// "127.0.0.1:9464" or "localhost:9464" or "[::1]:9464": a host and a port of 1 to 65535.
struct HttpAddress {
  std::string host;
  std::uint16_t port = 0;
};
/// Errors name `option`.
[[nodiscard]] Result<HttpAddress> parseHttpAddress(const std::string& option,
                                                   const std::string& text);
/// The same, for addresses of this machine only.
[[nodiscard]] Result<HttpAddress> parseViewAddress(const std::string& option,
                                                   const std::string& text);

}  // namespace foretouch::tools
