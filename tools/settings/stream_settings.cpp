#include "tools/settings/stream_settings.h"

#include <cmath>

#include "assets/json_writer.h"
#include "tools/microseconds.h"
#include "tools/settings/channel_names.h"

namespace foretouch::tools {
namespace {

constexpr NumberRange kStepRange{1.0 / kUsPerS, static_cast<double>(kMostStepUs) / kUsPerS,
                                 "seconds", "s"};

/// Microseconds in the policy; seconds for people.
void addMaxStep(Settings& settings, std::int64_t& maxStepUs) {
  Setting& setting = settings.parsed("--max-step", "S", {}, {},
                                     "Refuse a pose captured later than this after the last one");
  setting.kind = ValueKind::Number;
  setting.legal = kStepRange.inWords();
  setting.take = [&maxStepUs](const GivenValue& given) -> Result<Done> {
    if (!kStepRange.contains(given.number)) return notLegal(kStepRange.inWords(), given);
    maxStepUs = std::llround(given.number * kUsPerS);
    return Done{};
  };
  setting.shown =
      setting.json = [&maxStepUs] { return numberText(static_cast<double>(maxStepUs) / kUsPerS); };
  setting.in(kStreamGroup).inConfig("stream", "max_step_s").inHeader("max_step");
}

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

void addStreamSettings(Settings& settings, StreamPolicy& policy) {
  addMaxStep(settings, policy.maxStepUs);
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

}  // namespace foretouch::tools
