// tools/stream/serve_config.h: what `foretouch serve --config` reads: one TOML file that says all
// of what a service does. docs/formats.md, "Service configuration", has its keys.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"
#include "assets/import/scene_import.h"
#include "middleware/query/query.h"
#include "network/stream/avatar_stream.h"
#include "network/wire/wire.h"
#include "tools/inputs/policy_rules.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxServeConfigBytes = std::size_t{1} << 20;
inline constexpr int kMaxServeWorkers = 64;
/// Poses that one avatar may have waiting.
inline constexpr int kMaxServeQueue = 65536;
/// One minute a step: whoever waits longer has no stream.
inline constexpr std::int64_t kMaxServeBudgetUs = 60'000'000;
inline constexpr double kMaxServeStepS = 86'400.0;
inline constexpr int kMaxServeConfirmations = 1000;
inline constexpr std::size_t kMaxServeAvatars = 4096;

/// Where `--view` without a value serves.
inline constexpr char kDefaultView[] = "127.0.0.1:9465";

enum class ReceiverKind : std::uint8_t {
  Own,     ///< Our bounded reader: for any network.
  Liblcm,  ///< For networks that are trusted.
};

struct ServedAvatar {
  std::int32_t id = 0;  ///< What messages call it; >= 0.
  std::string file;
};

/// Paths are as they can be opened: those of a file count from its folder. Empty: not asked for.
struct ServeConfig {
  // [service]
  std::string url = kDefaultUrl;  ///< Not empty; what else it must be, the wire says.
  std::string suffix;             ///< Of all four channels; printable ASCII.
  ReceiverKind receiver = ReceiverKind::Own;
  int workers = 1;            ///< 1 to kMaxServeWorkers.
  int queue = 256;            ///< Poses that an avatar may have waiting; 1 to kMaxServeQueue.
  std::int64_t budgetUs = 0;  ///< What a step's query may take, made a work budget; 0: no limit.
  std::string log;            ///< Where events are recorded.
  std::string http;           ///< "127.0.0.1:9464": where metrics are served.
  std::string view;           ///< kDefaultView: where the stream can be watched.
  // [scene]
  std::string scene;  ///< Not empty.
  double sceneScale = 1.0;
  UpAxis sceneUp = UpAxis::Y;
  // [query]
  double tolerance = 1e-3;
  Fidelity fidelity = Fidelity::Link;  ///< Link or Exact.
  std::vector<std::string>
      ignore;  ///< Texts for parseIgnoredPairs() (tools/inputs/ignored_pairs.h).
  // [[policy]]
  std::vector<PolicyRule> policies;  ///< Later ones win.
  // [stream]
  StreamPolicy stream;
  // [[avatar]]
  std::vector<ServedAvatar> avatars;  ///< At least one; ids differ.
};

/// `file` is the path that `text` came from: for errors, and for relative paths. Errors name the
/// line: broken TOML, unknown or repeated keys (with the nearest legal one), wrong types, values
/// out of range, what is missing. Never throws; nesting is bounded.
[[nodiscard]] Result<ServeConfig> parseServeConfig(std::string_view text, const std::string& file);

/// The same of a file of at most kMaxServeConfigBytes.
[[nodiscard]] Result<ServeConfig> readServeConfig(const std::string& path);

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
