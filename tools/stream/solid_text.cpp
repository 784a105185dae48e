#include "tools/stream/solid_text.h"

#include <vector>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "network/wire/message_fields.h"
#include "tools/fields_json.h"
#include "tools/json_line.h"
#include "tools/microseconds.h"
#include "tools/solid_json.h"

namespace foretouch::tools {
namespace {

/// Beyond this many avatars, forgets the known ones.
constexpr std::size_t kMostShownAvatars = 4096;

/// "'LeftHand' on 'table'", each pair once.
std::string surfacesOf(const SolidMessage& message) {
  constexpr std::size_t kShown = 4;
  std::vector<std::string> pairs;
  for (const ShownContact& shown : message.contacts) {
    const std::string pair = inQuotes(shown.linkName) + " on " + inQuotes(shown.otherName);
    if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);  // in the order of links
  }
  std::string text;
  for (std::size_t i = 0; i < pairs.size() && i < kShown; ++i) {
    text += (i == 0 ? ": " : "; ") + pairs[i];
  }
  if (pairs.size() > kShown) text += fmt::format("; and {} more", pairs.size() - kShown);
  return text;
}

}  // namespace

void writeSolid(const SolidMessage& message, Stamps stamps, JsonWriter& out) {
  writeFields(message, out, wire::kSolidKey, wire::kSolidOptions, wire::kSolidState,
              wire::kSolidLengths);
  out.key("way");
  out.beginArray();
  for (std::size_t i = 0; i < message.way.size(); ++i) {
    out.beginObject();
    out.field("t", message.times[i]);
    writePose(message.way[i], out);
    out.endObject();
  }
  out.endArray();
  out.list("deviations", message.linkDeviation, [&](double value) { out.value(value); });
  out.list("joints", message.joints, [&](SolidJointState state) { out.value(toString(state)); });
  writeObjects("contacts", message.contacts, out, [&](const ShownContact& shown) {
    writeSolidContact(shown.contact, jsonString(shown.linkName), jsonString(shown.otherName), out);
  });
  writeFields(message, out, wire::kSolidLeftOut);
  writeCounters(message.counters, out);
  if (stamps == Stamps::With) writeFields(message, out, wire::kSolidStamps);
}

std::string solidLine(const SolidMessage& message, Stamps stamps) {
  return objectLine("solid", [&](JsonWriter& out) { writeSolid(message, stamps, out); });
}

std::string solidText(const SolidMessage& message) {
  constexpr double kMmPerM = 1e3;
  std::string text = fmt::format("avatar {}, pose {}: shown {}", message.avatar, message.sequence,
                                 toString(message.state));
  if (message.state == SolidState::Equal) {
    text += " to the tracked pose";
  } else if (message.state == SolidState::Placing) {
    text += ", no free place is found yet";
  } else {
    text += fmt::format(", {:.1f} mm from the tracked pose", kMmPerM * message.deviation);
  }
  if (message.limit != SolidLimit::None) text += fmt::format(" ({})", toString(message.limit));
  if (!message.isCertified && message.state != SolidState::Placing) text += ", not certified";
  if (message.snapInUs >= 0) {
    text += fmt::format(", snaps in {:.2f} s", static_cast<double>(message.snapInUs) / kUsPerS);
  }
  return text + surfacesOf(message) + "\n";
}

bool SolidNews::isNews(const SolidMessage& message) {
  if (last_.size() >= kMostShownAvatars && last_.count(message.avatar) == 0) last_.clear();
  const auto [place, isNew] = last_.try_emplace(message.avatar);
  const Last before = place->second;
  place->second = {message.state, message.limit, message.snapInUs >= 0};
  return isNew || before.state != message.state || before.limit != message.limit ||
         (!before.snaps && message.snapInUs >= 0);
}

}  // namespace foretouch::tools
