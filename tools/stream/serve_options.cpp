#include "tools/stream/serve_options.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include <CLI/CLI.hpp>

#include "assets/text_file.h"
#include "tools/arguments.h"
#include "tools/console.h"
#include "tools/inputs/numbered_avatars.h"
#include "tools/settling.h"
#include "tools/stream/channel_names.h"
#include "tools/stream/stream_arguments.h"

namespace foretouch::tools {
namespace {

Error refusal(const char* option, const std::string& expected, const std::string& found) {
  return {ErrorCode::OutOfRange, option, -1, -1,
          "expected " + expected + ", found " + inQuotes(found)};
}

Result<ReceiverKind> parseReceiver(const std::string& text) {
  if (text == "own") return ReceiverKind::Own;
  if (text == "liblcm") return ReceiverKind::Liblcm;
  return refusal("--receiver", "own or liblcm", text);
}

Result<Fidelity> parseServedFidelity(const std::string& text) {
  auto fidelity = parseFidelity("--fidelity", text);
  if (fidelity.ok() && fidelity.value() != Fidelity::Link && fidelity.value() != Fidelity::Exact) {
    return refusal("--fidelity", "link or exact", text);
  }
  return fidelity;
}

Result<std::string> parseSuffix(const std::string& text) {
  const auto names = channelNames(text);
  if (!names.ok()) return names.error();
  return text;
}

Result<std::vector<ServedAvatar>> parseAvatars(const std::vector<std::string>& texts) {
  const auto numbered = parseNumberedAvatars("--avatar", texts);
  if (!numbered.ok()) return numbered.error();
  if (numbered.value().size() > kMaxServeAvatars) {
    return refusal("--avatar", "at most " + std::to_string(kMaxServeAvatars) + " avatars",
                   std::to_string(numbered.value().size()));
  }
  std::vector<ServedAvatar> avatars;
  for (const NumberedAvatar& avatar : numbered.value()) avatars.push_back({avatar.id, avatar.path});
  return avatars;
}

/// As it was given, once it is seen to be an address.
Result<std::string> parseHttp(const std::string& text) {
  const auto address = parseHttpAddress("--http", text);
  if (!address.ok()) return address.error();
  return text;
}
Result<std::string> parseView(const std::string& text) {
  const auto address = parseViewAddress("--view", text);
  if (!address.ok()) return address.error();
  return text;
}

void settleService(const ServeTexts& texts, ServeConfig& config, Settling& settle) {
  const auto given = [&](auto& place, const std::string& text, const auto& parse) {
    if (!text.empty()) settle.into(place, parse(text));
  };
  given(config.suffix, texts.suffix, parseSuffix);
  given(config.receiver, texts.receiver, parseReceiver);
  given(config.workers, texts.workers,
        [](const std::string& text) { return parseCount("--workers", text, kMaxServeWorkers); });
  given(config.queue, texts.queue,
        [](const std::string& text) { return parseCount("--queue", text, kMaxServeQueue); });
  given(config.budgetUs, texts.budgetUs,
        [](const std::string& text) { return parseBudgetUs("--budget-us", text); });
  given(config.http, texts.http, parseHttp);
  given(config.view, texts.view, parseView);
  if (!texts.log.empty()) config.log = texts.log;
}

void settleQuery(const ServeTexts& texts, ServeConfig& config, Settling& settle) {
  const auto given = [&](auto& place, const std::string& text, const auto& parse) {
    if (!text.empty()) settle.into(place, parse(text));
  };
  if (!texts.scene.empty()) config.scene = texts.scene;
  given(config.sceneUp, texts.up,
        [](const std::string& text) { return parseUpAxis("--up", text); });
  given(config.sceneScale, texts.sceneScale,
        [](const std::string& text) { return parsePositive("--scene-scale", text); });
  given(config.tolerance, texts.tolerance,
        [](const std::string& text) { return parseTolerance("--tolerance", text); });
  given(config.fidelity, texts.fidelity, parseServedFidelity);
  given(config.stream.maxStepUs, texts.maxStep,
        [](const std::string& text) { return parseMaxStepUs("--max-step", text); });
  given(config.stream.confirmations, texts.confirmations, [](const std::string& text) {
    return parseCount("--confirmations", text, kMaxServeConfirmations);
  });
  if (texts.unmatchedAtRest) config.stream.unmatchedAtRest = true;
  if (!texts.ignore.empty()) config.ignore = texts.ignore;
  if (!texts.avatars.empty()) settle.into(config.avatars, parseAvatars(texts.avatars));
}

}  // namespace

void addServeOptions(CLI::App& command, const std::shared_ptr<ServeTexts>& texts) {
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command.add_option(name, text, help)->type_name(type);
  };
  const auto list = [&](const char* name, std::vector<std::string>& values, const char* type,
                        const char* help) {
    command.add_option(name, values, help)->type_name(type)->allow_extra_args(false);
  };
  option("--config", texts->config, "FILE",
         "TOML file that says all of this; options below replace what it says");
  option("--scene", texts->scene, "FILE", "Scene: any mesh format that assimp reads");
  list("--avatar", texts->avatars, "[ID=]FILE",
       "Avatar file, and what messages call the avatar (1 if not given); may be repeated");
  option("--up", texts->up, "y|z", "Which axis of the scene points up [y]");
  option("--scene-scale", texts->sceneScale, "S", "Metres per unit of the scene [1]");
  option("--url", texts->url, "URL",
         "Where from and to; LCM_DEFAULT_URL, else this machine, if not given");
  option("--suffix", texts->suffix, "TEXT", "Ending of the channels' names");
  option("--receiver", texts->receiver, "own|liblcm",
         "Whose reader takes datagrams in; liblcm only for networks that are trusted [own]");
  option("--workers", texts->workers, "N", "Threads that answer [1]");
  option("--queue", texts->queue, "N",
         ("Poses that an avatar may have waiting; the oldest then makes way [" +
          std::to_string(ServeConfig{}.queue) + "]")
             .c_str());
  option("--budget-us", texts->budgetUs, "US",
         "What a pose may cost, as an amount of work; links beyond it are undecided");
  option("--log", texts->log, "FILE|DIR",
         "Record what is taken and answered: a new event log, or a folder for one a run");
  option("--http", texts->http, "ADDRESS:PORT", "Serve /metrics and /healthz there");
  command
      .add_option("--view", texts->view,
                  std::string("Let a browser on this machine watch the stream there [") +
                      kDefaultView + "]")
      ->type_name("[ADDRESS:PORT]")
      ->expected(0, 1)
      ->default_str(kDefaultView);
  option("--tolerance", texts->tolerance, "M",
         "Largest separation (m) of a reported contact [0.001]");
  option("--fidelity", texts->fidelity, "link|exact",
         "What touches: the links' LSS (link) or their meshes (exact) [link]");
  list("--ignore", texts->ignore, "PAIRS", "Contacts not asked for; may be repeated");
  option("--max-step", texts->maxStep, "S", "A pose this long after the last one is refused [10]");
  option("--confirmations", texts->confirmations, "N",
         "Poses in a row that make a timeline that was not expected [3]");
  command.add_flag("--unmatched-at-rest", texts->unmatchedAtRest,
                   "Joints that the sender does not have keep their rest values and are known");
}

Result<ServeConfig> settledServeConfig(const ServeTexts& texts) {
  ServeConfig config;
  if (!texts.config.empty()) {
    auto read = readServeConfig(texts.config);
    if (!read.ok()) return read.error();
    config = std::move(read).value();
  }
  Settling settle;
  settleService(texts, config, settle);
  settleQuery(texts, config, settle);
  if (settle.error()) return *settle.error();
  // LCM's usual address is what no file needs to say.
  config.url =
      urlOrDefault(texts.url.empty() && config.url != kDefaultUrl ? config.url : texts.url);
  if (config.scene.empty()) {
    return Error{ErrorCode::Empty, "--scene", -1, -1, "expected a scene, here or by --config"};
  }
  if (config.avatars.empty()) {
    return Error{ErrorCode::Empty, "--avatar", -1, -1,
                 "expected at least one avatar, here or by --config"};
  }
  return config;
}

}  // namespace foretouch::tools
