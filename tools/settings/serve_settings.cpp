#include "tools/settings/serve_settings.h"

#include <charconv>
#include <system_error>
#include <utility>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/settings/stream_settings.h"

namespace foretouch::tools {
namespace {

constexpr std::int64_t kMostLogBytes = std::int64_t{1} << 50;
constexpr int kMostLogFiles = 10'000;

/// No address at all, or one that `parse` accepts.
Setting& addAddress(Settings& settings, const char* option, const char* value, std::string& place,
                    Result<HttpAddress> (*parse)(const std::string&, const std::string&),
                    const char* help) {
  return settings.parsed(
      option, value,
      [&place, parse](const std::string& text) -> Result<Done> {
        FORETOUCH_CHECK(text.empty() ? Result<HttpAddress>(HttpAddress()) : parse("", text));
        place = text;
        return Done{};
      },
      [&place] { return place; }, help);
}

Result<Done> takeAvatars(const std::vector<std::string>& texts,
                         std::vector<NumberedAvatar>& place) {
  auto avatars = parseNumberedAvatars("--avatar", texts);
  if (!avatars.ok()) return avatars.error();
  if (avatars.value().size() > kMaxServeAvatars) {
    return Error::in("--avatar", ErrorCode::OutOfRange,
                     "expected at most " + std::to_string(kMaxServeAvatars) + " avatars, found " +
                         inQuotes(std::to_string(texts.size())));
  }
  place = std::move(avatars).value();
  return Done{};
}

Result<Done> takeSenders(const std::vector<std::string>& texts, ServeConfig& config) {
  std::vector<Network> networks;
  for (const std::string& text : texts) {
    FORETOUCH_TRY(const auto network, parseNetwork(text));
    networks.push_back(network);
  }
  config.senders = std::move(networks);
  config.senderTexts = texts;
  return Done{};
}

Result<Done> takeVmc(const std::vector<std::string>& texts, ServeConfig& config) {
  constexpr int kMostPort = 65535;
  FORETOUCH_TRY(const auto numbered, parseNumberedAvatars("--vmc", texts));
  std::vector<NumberedPort> ports;
  for (const NumberedAvatar& each : numbered) {
    int port = 0;
    const char* const end = each.path.data() + each.path.size();
    const auto [rest, problem] = std::from_chars(each.path.data(), end, port);
    if (problem != std::errc() || rest != end || port < 1 || port > kMostPort) {
      return Error::in("--vmc", ErrorCode::OutOfRange,
                       "expected a UDP port of 1 to 65535, found " + inQuotes(each.path));
    }
    ports.push_back({each.id, static_cast<std::uint16_t>(port)});
  }
  config.vmc = std::move(ports);
  config.vmcTexts = texts;
  return Done{};
}

void addVmcSettings(Settings& settings, ServeConfig& config) {
  Setting& vmc = settings.list("--vmc", "[ID=]PORT", config.vmcTexts,
                               "UDP port at which a performer of VMC moves the avatar ID (1 if not "
                               "given), whose joints are a "
                               "humanoid's; may be repeated");
  vmc.take = [&config](const GivenValue& given) { return takeVmc(given.texts, config); };
  vmc.in(kNetworkGroup).inConfig("service", "vmc");
  settings
      .word<VmcBones>(
          "--vmc-bones", "original|normalized", config.vmcBones,
          {{"original", VmcBones::Original}, {"normalized", VmcBones::Normalized}},
          "What VMC's rotations are relative to: the bones as the avatar's own model has "
          "them, or bones that a T-pose does not turn")
      .in(kNetworkGroup)
      .inConfig("service", "vmc_bones");
}

void addNetworkSettings(Settings& settings, ServeConfig& config) {
  settings
      .text(
          "--url", "URL", config.url,
          "Network to receive from and send to; by default LCM_DEFAULT_URL, else this machine only")
      .notEmpty()
      .in(kNetworkGroup)
      .inConfig("service", "url")
      .inReport("address");
  addSuffixSetting(settings, config.service.suffix);
  settings
      .word<ReceiverKind>(
          "--receiver", "own|liblcm", config.receiver,
          {{"own", ReceiverKind::Own}, {"liblcm", ReceiverKind::Liblcm}},
          "Whose receiver reads datagrams; use liblcm only on networks that you trust")
      .in(kNetworkGroup)
      .inConfig("service", "receiver");
  Setting& senders = settings.list(
      "--senders", "NETWORK", config.senderTexts,
      "Take messages only of this machine and of these networks, as 10.0.0.0/24; may be repeated. "
      "By default this machine at a ttl of 0, else everybody");
  senders.take = [&config](const GivenValue& given) { return takeSenders(given.texts, config); };
  senders.in(kNetworkGroup).inConfig("service", "senders");
  addVmcSettings(settings, config);
  addKeySetting(
      settings, config.keyPath,
      "Key of 32 hexadecimal digits: refuse messages that are not signed with it, and sign "
      "the answers")
      .inConfig("service", "key");
  addTakeoverSetting(settings, config.service.speaker.takeoverUs)
      .in(kNetworkGroup)
      .inConfig("service", "takeover_s");
}

void addServiceSettings(Settings& settings, ServeConfig& config) {
  settings
      .whole("--workers", "N", config.service.workers, 1, kMaxServiceWorkers,
             "Threads that answer poses")
      .in(kEffortGroup)
      .inConfig("service", "workers")
      .inReport("workers");
  settings
      .whole("--queue", "N", config.service.queue, 1, kMaxServiceQueue,
             "Poses per avatar that may wait; beyond that the service drops the oldest")
      .in(kEffortGroup)
      .inConfig("service", "queue");
  settings
      .path("--log", "FILE|DIR", config.log,
            "Record accepted poses and their answers: a new event log, or a folder that gets one "
            "per run")
      .in(kOutputGroup)
      .inConfig("service", "log");
  settings
      .whole("--log-bytes", "N", config.logLimits.bytes, 0, kMostLogBytes,
             "Begin another log file after so many bytes, NAME.2.lcmlog and so on; 0: never")
      .in(kOutputGroup)
      .inConfig("service", "log_bytes");
  settings
      .whole("--log-files", "N", config.logLimits.files, 1, kMostLogFiles,
             "With --log-bytes: keep so many files, and remove the oldest")
      .in(kOutputGroup)
      .inConfig("service", "log_files");
  addAddress(settings, "--http", "ADDRESS:PORT", config.http, parseHttpAddress,
             "Address at which to serve /metrics and /healthz")
      .in(kOutputGroup)
      .inConfig("service", "http");
  addAddress(settings, "--view", "[ADDRESS:PORT]", config.view, parseViewAddress,
             "Address at which a browser on this machine can watch the stream")
      .in(kOutputGroup)
      .inConfig("service", "view")
      .valueIfNone = kDefaultView;
}

}  // namespace

void addServeSettings(Settings& settings, ServeConfig& config) {
  addSceneSettings(settings, config.world);
  Setting& avatars = settings.parsed(
      "--avatar", "[ID=]FILE", {}, [] { return std::string(); },
      "Avatar file, and its ID in messages (1 if not given); may be repeated");
  avatars.kind = ValueKind::List;
  avatars.in(kInputGroup).files("json");
  avatars.take = [&config](const GivenValue& given) {
    return takeAvatars(given.texts, config.avatars);
  };
  settings
      .path("--world", "FILE", config.worldPath,
            "A world file: its bodies with an avatar are the avatars, by their places from 1; the "
            "others are shapes of bodies that move. What happens between them is told")
      .in(kInputGroup)
      .files("toml")
      .inConfig("service", "world");
  addNetworkSettings(settings, config);
  addServiceSettings(settings, config);
  addQuerySettings(settings, config.world);
  Setting& fidelity = settings.of("--fidelity").only({"link", "exact"});
  refuseGoneFidelities(fidelity);
  fidelity.value = "link|exact";
  fidelity.help = "What touches: the links' LSS (link) or their meshes (exact)";
  addStreamSettings(settings, config.stream);
  addWorldStreamSettings(settings, config.worldPolicy);
  addStreamSolidSettings(settings, config.solid);
  addWorldSolidSetting(settings, config.solid);
  addPersonSettings(settings, config.person);
  settings.of("--between").needing("--bounds");
}

}  // namespace foretouch::tools
