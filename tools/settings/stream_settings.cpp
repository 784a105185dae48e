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
  setting.inConfig("stream", "max_step_s").inHeader("max_step");
}

}  // namespace

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
      .inConfig("service", "suffix")
      .inHeader("suffix")
      .inReport("suffix");
}

void addStreamSettings(Settings& settings, StreamPolicy& policy) {
  addMaxStep(settings, policy.maxStepUs);
  settings
      .whole("--confirmations", "N", policy.confirmations, 1, kMostConfirmations,
             "Poses in a row that confirm an unexpected new timeline")
      .inConfig("stream", "confirmations")
      .inHeader("confirmations");
  settings
      .flag("--unmatched-at-rest", policy.unmatchedAtRest,
            "Joints that the sender does not have count as known, at their rest values",
            {"undecided", "rest"})
      .inConfig("stream", "unmatched")
      .inHeader("unmatched_at_rest");
}

}  // namespace foretouch::tools
