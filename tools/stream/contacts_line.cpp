#include "tools/stream/contacts_line.h"

#include <cmath>

#include <fmt/format.h>

#include "assets/text_file.h"
#include "tools/contact_json.h"
#include "tools/json_text.h"

namespace foretouch::tools {
namespace {

void appendAnswered(const AnsweredContact& answered, const ContactsMessage& message,
                    std::string& text) {
  const std::string link = jsonString(answered.linkName);
  const std::string object = jsonString(answered.objectName);
  const std::string instant = fmt::format(R"("utime":{})", utimeOf(message, answered.contact.toi));
  appendContact(answered.contact, {link, object, toString(answered.reason), instant}, text);
}

double milliseconds(std::int64_t us) {
  constexpr double kUsPerMs = 1e3;
  return static_cast<double>(us) / kUsPerMs;
}

std::string contactText(const AnsweredContact& answered, const ContactsMessage& message) {
  constexpr double kPercent = 100.0;
  const LinkContact& contact = answered.contact;
  const std::string link = inQuotes(answered.linkName);
  switch (contact.verdict) {
    case Verdict::Clear: break;
    case Verdict::Contact:
      return fmt::format("{} touches {} at {:.0f} % of {:.1f} ms", link,
                         inQuotes(answered.objectName), kPercent * contact.toi,
                         milliseconds(message.utimeToUs - message.utimeFromUs));
    case Verdict::StartsInContact:
      return fmt::format("{} is in {}", link, inQuotes(answered.objectName));
    case Verdict::Undecided:
      return fmt::format("{} undecided ({})", link, toString(answered.reason));
  }
  return link + " clear";
}

}  // namespace

std::int64_t utimeOf(const ContactsMessage& message, double toi) {
  return utimeOf(message.utimeFromUs, message.utimeToUs, toi);
}

std::int64_t utimeOf(std::int64_t fromUs, std::int64_t toUs, double toi) {
  const auto span = static_cast<double>(toUs - fromUs);
  const double product = toi * span;
  // The product may have been rounded up to a whole number; what it lacks is known exactly.
  const double whole = std::floor(product);
  const bool isRoundedUp = whole == product && std::fma(toi, span, -product) < 0.0;
  return fromUs + static_cast<std::int64_t>(whole) - (isRoundedUp ? 1 : 0);
}

std::string contactsLine(const ContactsMessage& message, Stamps stamps) {
  std::string text = fmt::format(
      R"({{"avatar":{},"session":{},"sequence":[{},{}],"utime":[{},{}],"kind":"{}","lost":{},"contacts":[)",
      message.avatar, message.session, message.sequenceFrom, message.sequenceTo,
      message.utimeFromUs, message.utimeToUs, toString(message.kind), message.lost);
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    if (i > 0) text += ',';
    appendAnswered(message.contacts[i], message, text);
  }
  text += ']';
  if (stamps == Stamps::With) {
    text += fmt::format(R"(,"receive_utime":{},"send_utime":{},"query_us":{})",
                        message.receiveUtimeUs, message.sendUtimeUs, numberText(message.queryUs));
  }
  return text + "}\n";
}

std::string contactsText(const ContactsMessage& message) {
  constexpr std::size_t kShown = 4;
  std::string text = fmt::format("avatar {}, pose {}", message.avatar, message.sequenceTo);
  if (message.kind == StepKind::First) text += " (first)";
  if (message.kind == StepKind::AcrossGap) text += fmt::format(" (after {} lost)", message.lost);
  text += message.contacts.empty() ? ": clear" : ": ";
  for (std::size_t i = 0; i < message.contacts.size() && i < kShown; ++i) {
    text += (i > 0 ? "; " : "") + contactText(message.contacts[i], message);
  }
  if (message.contacts.size() > kShown) {
    text += fmt::format("; and {} more", message.contacts.size() - kShown);
  }
  return text + "\n";
}

std::string statusLine(const StatusMessage& message) {
  std::string text = fmt::format(
      R"({{"status":{{"utime":{},"start_utime":{},"build":{},"scene":{},"avatars":{},"workers":{})",
      message.utimeUs, message.startUtimeUs, jsonString(message.build), jsonString(message.scene),
      message.numAvatars, message.numWorkers);
  text += fmt::format(
      R"(,"received":{},"answered":{},"rejected":{},"lost":{},"gaps":{},"waiting":{},"reasons":{{)",
      message.received, message.answered, message.rejected, message.lost, message.gaps,
      message.waiting);
  for (std::size_t i = 0; i < message.counts.size(); ++i) {
    text += fmt::format("{}{}:{}", i > 0 ? "," : "", jsonString(message.counts[i].reason),
                        message.counts[i].count);
  }
  text += fmt::format(R"(}},"publish_failures":{},"journal_failures":{},"kernel_drops":{})",
                      message.publishFailures, message.journalFailures, message.kernelDrops);
  text += fmt::format(R"(,"latency_us":{{"p50":{},"p99":{},"max":{}}})",
                      numberText(message.latencyP50Us), numberText(message.latencyP99Us),
                      numberText(message.latencyMaxUs));
  text +=
      fmt::format(R"(,"query_us":{{"p50":{},"p99":{},"max":{}}})", numberText(message.queryP50Us),
                  numberText(message.queryP99Us), numberText(message.queryMaxUs));
  return text + "}}\n";
}

std::string statusText(const StatusMessage& message) {
  std::string text = fmt::format(
      "service on {}: {} received, {} answered, {} rejected, {} lost, {} waiting; latency us p50 "
      "{:.0f} p99 {:.0f} max {:.0f}",
      inQuotes(message.scene), message.received, message.answered, message.rejected, message.lost,
      message.waiting, message.latencyP50Us, message.latencyP99Us, message.latencyMaxUs);
  for (const StatusMessage::Count& count : message.counts) {
    if (count.count > 0) text += fmt::format("; {} {}", inQuotes(count.reason), count.count);
  }
  return text + "\n";
}

}  // namespace foretouch::tools
