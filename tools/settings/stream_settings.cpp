#include "tools/settings/stream_settings.h"

#include "network/stream/speaker_gate.h"
#include "tools/microseconds.h"
#include "tools/settings/channel_names.h"

namespace foretouch::tools {
namespace {

constexpr NumberRange kWaitRange{1.0 / kUsPerS, static_cast<double>(kMostWorldWaitUs) / kUsPerS,
                                 "seconds", "s"};
constexpr NumberRange kStepRange{1.0 / kUsPerS, static_cast<double>(kMostStepUs) / kUsPerS,
                                 "seconds", "s"};
constexpr NumberRange kTakeoverRange{0.0, static_cast<double>(kMostTakeoverUs) / kUsPerS, "seconds",
                                     "s", true};

/// Half a minute per pose: slower is not a stream.
constexpr std::int64_t kMostSolidBudgetUs = 30'000'000;

}  // namespace

void addStreamSolidSettings(Settings& settings, StreamSolidRequest& request) {
  addSolidSettings(settings, request.solid);
  settings
      .flag("--solid-self", request.stopsItself,
            "Own links stop each other, too, but those that touch when the avatar is at rest")
      .in(kSolidGroup)
      .inConfig("solid", "self")
      .inReport("own links stop each other")
      .needing("--solid")
      .told = [&request] { return request.solid.isAsked && request.stopsItself ? "yes" : ""; };
  settings
      .whole("--solid-budget-us", "US", request.budgetUs, 1, kMostSolidBudgetUs,
             "Work that one shown pose may cost, at 100 evaluations per us; the rest of its way "
             "waits for the next")
      .in(kSolidGroup)
      .inConfig("solid", "budget_us")
      .needing("--solid");
}

void addWorldSolidSetting(Settings& settings, StreamSolidRequest& request) {
  settings
      .list("--world-solid", "NAME", request.worldBodies,
            "Avatars of the world file, as 'anna' or '*', that are solid among all that moves, not "
            "in the still scene alone; may be repeated. They carry nothing")
      .in(kSolidGroup)
      .inConfig("solid", "world")
      .needing("--solid");
}

Setting& addSuffixSetting(Settings& settings, std::string& suffix) {
  return settings
      .parsed(
          "--suffix", "TEXT",
          [&suffix](const std::string& text) -> Result<Done> {
            const auto names = channelNames(text);
            if (!names.ok()) {
              Error error = names.error();
              error.file.clear();
              return error;
            }
            suffix = text;
            return Done{};
          },
          [&suffix] { return suffix; }, "Suffix of the channel names")
      .in(kStreamGroup)
      .inConfig("service", "suffix")
      .inHeader("suffix")
      .inReport("suffix");
}

Setting& addKeySetting(Settings& settings, std::string& path, const char* help) {
  return settings.path("--key", "FILE", path, help).in(kNetworkGroup);
}

Setting& addTakeoverSetting(Settings& settings, std::int64_t& takeoverUs) {
  return settings
      .seconds("--takeover", takeoverUs, kTakeoverRange,
               "An avatar's sender that has been silent for so long may be replaced by another "
               "address or port")
      .in(kStreamGroup);
}

void addStreamSettings(Settings& settings, StreamPolicy& policy) {
  settings
      .seconds("--max-step", policy.maxStepUs, kStepRange,
               "Refuse a pose captured later than this after the last one")
      .in(kStreamGroup)
      .inConfig("stream", "max_step_s")
      .inHeader("max_step");
  settings
      .whole("--confirmations", "N", policy.confirmations, 1, kMostConfirmations,
             "Poses in a row that confirm an unexpected new timeline")
      .in(kStreamGroup)
      .inConfig("stream", "confirmations")
      .inHeader("confirmations");
  settings
      .flag("--unmatched-at-rest", policy.unmatchedAtRest,
            "Joints that the sender does not have count as known, at their rest values",
            {"undecided", "rest"})
      .in(kStreamGroup)
      .inConfig("stream", "unmatched")
      .inHeader("unmatched_at_rest");
}

void addWorldStreamSettings(Settings& settings, WorldPolicy& policy) {
  settings
      .seconds("--world-wait", policy.waitUs, kWaitRange,
               "Of a moving world: go on without a body that has told nothing of so long ago")
      .in(kStreamGroup)
      .inConfig("stream", "world_wait_s");
  settings
      .word<WhenSilent>("--world-silent", "undecided|hold-still|wait", policy.whenSilent,
                        {{"undecided", WhenSilent::Undecided},
                         {"hold-still", WhenSilent::HoldStill},
                         {"wait", WhenSilent::Wait}},
                        "What is taken of a body that is silent: nothing is claimed of it, it "
                        "stays where it was, or all wait for it")
      .in(kStreamGroup)
      .inConfig("stream", "world_silent");
}

}  // namespace foretouch::tools
