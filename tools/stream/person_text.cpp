#include "tools/stream/person_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "lss/index.h"
#include "network/wire/message_fields.h"
#include "tools/fields_json.h"
#include "tools/json_line.h"
#include "tools/microseconds.h"

namespace foretouch::tools {
namespace {

/// Beyond this many avatars, forgets the known ones.
constexpr std::size_t kMostToldAvatars = 4096;
constexpr double kMmInM = 1e3;

double milliseconds(double us) {
  constexpr double kUsPerMs = 1e3;
  return us / kUsPerMs;
}

void writeTold(const ToldBracket& told, JsonWriter& out) {
  const LinkBracket& bracket = told.bracket;
  writeFields(told, out, wire::kBracketSides);
  if (bracket.other != kNoParent) {
    out.field("other", told.otherName);
  } else if (bracket.triangle >= 0) {
    out.field("object", told.otherName);
  }
  writeFields(told, out, wire::kBracketPossible);
  if (bracket.verdict == BracketVerdict::Certain) writeFields(told, out, wire::kBracketCertain);
  writeFields(told, out, wire::kBracketGrowth);
}

std::string touchText(const ToldBracket& told, double stepUs) {
  const LinkBracket& bracket = told.bracket;
  std::string text = inQuotes(told.linkName);
  if (!told.otherName.empty()) text += " on " + inQuotes(told.otherName);
  const auto ms = [stepUs](double t) { return milliseconds(t * stepUs); };
  if (bracket.verdict == BracketVerdict::Certain && bracket.possibleFrom > 0.0) {
    return text + fmt::format(", from {:.1f} to {:.1f} ms on", ms(bracket.possibleFrom),
                              ms(bracket.certainFrom));
  }
  return text;
}

/// The touches with one verdict, after these words.
std::string touchesText(const PersonMessage& message, BracketVerdict verdict, const char* words) {
  constexpr int kShown = 4;
  const auto stepUs = static_cast<double>(message.utimeToUs - message.utimeFromUs);
  std::string text;
  int count = 0;
  for (const ToldBracket& told : message.brackets) {
    if (told.bracket.verdict != verdict || ++count > kShown) continue;
    text += (count == 1 ? words : "; ") + touchText(told, stepUs);
  }
  if (count > kShown) text += fmt::format("; and {} more", count - kShown);
  return text;
}

std::string aheadText(const PersonMessage& message) {
  std::int64_t least = message.utimeUs + message.aheadUs;
  bool isClaimed = false;
  for (const std::int64_t notBefore : message.notBeforeUs) {
    if (notBefore < 0) continue;
    isClaimed = true;
    least = std::min(least, notBefore);
  }
  if (!isClaimed) return "";
  return fmt::format(
      ", nothing for {:.1f} ms",
      milliseconds(static_cast<double>(std::max<std::int64_t>(0, least - message.utimeUs))));
}

std::string brokenText(const BrokenBound& broken) {
  return fmt::format(", link {} breaks its bound ({}) by {:.1f} mm", broken.link,
                     toString(broken.claim), kMmInM * broken.beyond);
}

}  // namespace

void writePerson(const PersonMessage& message, Stamps stamps, JsonWriter& out) {
  writeFields(message, out, wire::kPersonKey, wire::kPersonOptions, wire::kPersonStep);
  out.list("verdicts", message.verdicts,
           [&](BracketVerdict verdict) { out.value(toString(verdict)); });
  writeFields(message, out, wire::kPersonAhead);
  if (message.aheadUs > 0) {
    out.list("not_before", message.notBeforeUs, [&](std::int64_t notBefore) {
      notBefore < 0 ? out.raw("null") : out.value(notBefore);
    });
  }
  writeObjects("brackets", message.brackets, out,
               [&](const ToldBracket& told) { writeTold(told, out); });
  writeFields(message, out, wire::kPersonLeftOut);
  writeRows("broken", message.broken, out, wire::kBroken);
  if (stamps == Stamps::With) writeFields(message, out, wire::kPersonStamps);
}

std::string personStepLine(const PersonMessage& message, Stamps stamps) {
  return objectLine("person_step", [&](JsonWriter& out) { writePerson(message, stamps, out); });
}

std::string personStepText(const PersonMessage& message) {
  const bool isOfFound = message.isOfFoundLinks();
  std::string text =
      isOfFound ? fmt::format("avatar {}, poses {} to {}: the person, with links that were lost,",
                              message.avatar, message.sequenceFrom, message.sequenceTo)
                : fmt::format("avatar {}, pose {}: the person", message.avatar, message.sequenceTo);
  const std::string surely = touchesText(message, BracketVerdict::Certain, " surely touched "),
                    perhaps = touchesText(message, BracketVerdict::Possible, " perhaps touched ");
  text += surely + (surely.empty() || perhaps.empty() ? "" : ",") + perhaps;
  if (surely.empty() && perhaps.empty()) {
    const bool isKnown =
        std::any_of(message.verdicts.begin(), message.verdicts.end(),
                    [](BracketVerdict v) { return v != BracketVerdict::Unclaimed; });
    text += isKnown ? " touched nothing of the scene" : ": nothing is claimed";
  }
  text += aheadText(message);
  for (const BrokenBound& broken : message.broken) text += brokenText(broken);
  return text + "\n";
}

bool PersonNews::isNews(const PersonMessage& message) {
  if (message.isOfFoundLinks()) return !message.brackets.empty();
  if (last_.size() >= kMostToldAvatars && last_.count(message.avatar) == 0) last_.clear();
  Touching now;
  for (const ToldBracket& told : message.brackets) {
    now.emplace_back(told.bracket.link, told.bracket.other, told.bracket.verdict);
  }
  Touching& before = last_[message.avatar];
  const bool isOther = now != before;
  before = std::move(now);
  return isOther || !message.broken.empty();
}

}  // namespace foretouch::tools
