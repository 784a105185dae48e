#include "tools/stream/touch_lines.h"

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "assets/json_writer.h"
#include "tools/json_line.h"
#include "tools/microseconds.h"
#include "tools/touches/touch_json.h"

namespace foretouch::tools {
namespace {

std::string touchLine(const char* name, const StreamTouch& told) {
  const std::string link = jsonString(told.linkName);
  const std::string object = jsonString(told.touch.object);
  TouchWords words;
  words.link = link;
  words.object = object;
  words.isOfStream = true;
  return objectLine(name, [&](JsonWriter& out) {
    out.field("avatar", told.avatar);
    out.field("session", told.session);
    writeTouch(told.touch, words, out);
  });
}

std::string textOf(const StreamTouch& begun, const ContactsMessage& message) {
  constexpr double kUsPerMs = 1e3, kPercent = 100.0;
  const Touch& touch = begun.touch;
  const std::string object = inQuotes(touch.object);
  if (touch.beginsInside) return fmt::format("{} is in {}", inQuotes(begun.linkName), object);
  const auto span = static_cast<double>(message.utimeToUs - message.utimeFromUs);
  const auto at = static_cast<double>(touch.beginUs - message.utimeFromUs);
  return fmt::format("{} touches {} at {:.0f} % of {:.1f} ms", inQuotes(begun.linkName), object,
                     kPercent * at / span, span / kUsPerMs);
}

std::string textOf(const StreamTouch& ended) {
  const Touch& touch = ended.touch;
  const double lastedS = static_cast<double>(touch.endUs - touch.beginUs) / kUsPerS;
  // For a tap only one instant is known.
  const std::string after = lastedS > 0.0 ? fmt::format(" after {:.3f} s", lastedS) : "";
  const std::string link = inQuotes(ended.linkName), object = inQuotes(touch.object);
  if (!touch.isOpen) return fmt::format("{} leaves {}{}", link, object, after);
  return fmt::format("whether {} still touches {} is not known{}", link, object, after);
}

}  // namespace

std::string endedTouchLine(const StreamTouch& ended) {
  return touchLine("touch", ended);
}

std::string begunTouchLine(const StreamTouch& begun) {
  return touchLine("touch_begins", begun);
}

std::string touchesText(const ContactsMessage& message, const TouchEvents& events) {
  const std::string who = fmt::format("avatar {}, pose {}: ", message.avatar, message.sequenceTo);
  std::string text;
  if (message.kind == StepKind::AcrossGap) {
    text += who + fmt::format("{} lost before it\n", message.lost);
  }
  for (const StreamTouch& ended : events.ended) text += who + textOf(ended) + "\n";
  if (message.kind == StepKind::First) text += who + "the first\n";
  for (const StreamTouch& begun : events.begun) text += who + textOf(begun, message) + "\n";
  return text;
}

}  // namespace foretouch::tools
