#include "tools/settings/serve_settings.h"

#include <utility>

#include "assets/text_file.h"
#include "tools/settings/stream_settings.h"

namespace foretouch::tools {
namespace {

/// No address at all, or one that `parse` accepts.
Setting& addAddress(Settings& settings, const char* option, const char* value, std::string& place,
                    Result<HttpAddress> (*parse)(const std::string&, const std::string&),
                    const char* help) {
  return settings.parsed(
      option, value,
      [&place, parse](const std::string& text) -> Result<Done> {
        const auto address = text.empty() ? Result<HttpAddress>(HttpAddress()) : parse("", text);
        if (!address.ok()) return address.error();
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
    return Error{ErrorCode::OutOfRange, "--avatar", -1, -1,
                 "expected at most " + std::to_string(kMaxServeAvatars) + " avatars, found " +
                     inQuotes(std::to_string(texts.size()))};
  }
  place = std::move(avatars).value();
  return Done{};
}

void addNetworkSettings(Settings& settings, ServeConfig& config) {
  settings
      .text("--url", "URL", config.url,
            "Where from and to; LCM_DEFAULT_URL, else this machine alone, if not given")
      .notEmpty()
      .inConfig("service", "url")
      .inReport("address");
  addSuffixSetting(settings, config.service.suffix);
  settings
      .word<ReceiverKind>("--receiver", "own|liblcm", config.receiver,
                          {{"own", ReceiverKind::Own}, {"liblcm", ReceiverKind::Liblcm}},
                          "Whose reader takes datagrams in; liblcm only for networks that are "
                          "trusted")
      .inConfig("service", "receiver");
}

void addServiceSettings(Settings& settings, ServeConfig& config) {
  settings
      .whole("--workers", "N", config.service.workers, 1, kMaxServeWorkers, "Threads that answer")
      .inConfig("service", "workers")
      .inReport("workers");
  settings
      .whole("--queue", "N", config.service.queue, 1, kMaxServiceQueue,
             "Poses that an avatar may have waiting; the oldest then makes way")
      .inConfig("service", "queue");
  settings
      .path("--log", "FILE|DIR", config.log,
            "Record what is taken and answered: a new event log, or a folder for one a run")
      .inConfig("service", "log");
  addAddress(settings, "--http", "ADDRESS:PORT", config.http, parseHttpAddress,
             "Serve /metrics and /healthz there")
      .inConfig("service", "http");
  addAddress(settings, "--view", "[ADDRESS:PORT]", config.view, parseViewAddress,
             "Let a browser on this machine watch the stream there")
      .inConfig("service", "view")
      .valueIfNone = kDefaultView;
}

}  // namespace

void addServeSettings(Settings& settings, ServeConfig& config) {
  addSceneSettings(settings, config.world);
  Setting& avatars = settings.parsed(
      "--avatar", "[ID=]FILE", {}, [] { return std::string(); },
      "Avatar file, and what messages call the avatar (1 if not given); may be repeated");
  avatars.kind = ValueKind::List;
  avatars.take = [&config](const GivenValue& given) {
    return takeAvatars(given.texts, config.avatars);
  };
  addNetworkSettings(settings, config);
  addServiceSettings(settings, config);
  addQuerySettings(settings, config.world);
  Setting& fidelity = settings.of("--fidelity").only({"link", "exact"});
  fidelity.value = "link|exact";
  fidelity.help = "What touches: the links' LSS (link) or their meshes (exact)";
  addStreamSettings(settings, config.stream);
}

}  // namespace foretouch::tools
