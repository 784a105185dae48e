#include "tools/stream/contacts_line.h"

#include <cmath>

#include <fmt/format.h>

#include "assets/text_file.h"
#include "network/wire/message_fields.h"
#include "tools/contact_json.h"
#include "tools/fields_json.h"
#include "tools/json_line.h"

namespace foretouch::tools {
namespace {

void writeAnswered(const AnsweredContact& answered, const ContactsMessage& message,
                   JsonWriter& out) {
  const std::string link = jsonString(answered.linkName);
  const std::string object = jsonString(answered.objectName);
  ContactWords words;
  words.link = link;
  words.object = object;
  words.utimeUs = utimeOf(message, answered.contact.toi);
  writeContact(answered.contact, words, out);
}

void writePair(const char* name, std::int64_t from, std::int64_t to, JsonWriter& out) {
  out.key(name);
  out.beginArray();
  out.value(from);
  out.value(to);
  out.endArray();
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
      return fmt::format("{} undecided ({})", link, toString(contact.reason));
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
  // The product may have been rounded up to a whole number; the fused multiply-add gives the error
  // exactly.
  const double whole = std::floor(product);
  const bool isRoundedUp = whole == product && std::fma(toi, span, -product) < 0.0;
  return fromUs + static_cast<std::int64_t>(whole) - (isRoundedUp ? 1 : 0);
}

void writeContacts(const ContactsMessage& message, Stamps stamps, JsonWriter& out) {
  out.field("avatar", message.avatar);
  out.field("session", message.session);
  writePair("sequence", message.sequenceFrom, message.sequenceTo, out);
  writePair("utime", message.utimeFromUs, message.utimeToUs, out);
  out.field("kind", toString(message.kind));
  out.field("lost", message.lost);
  writeObjects("contacts", message.contacts, out,
               [&](const AnsweredContact& answered) { writeAnswered(answered, message, out); });
  if (stamps == Stamps::With) writeFields(message, out, wire::kContactsStamps);
}

std::string contactsLine(const ContactsMessage& message, Stamps stamps) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  writeContacts(message, stamps, out);
  out.endObject();
  return text + "\n";
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

void writeStatus(const StatusMessage& message, JsonWriter& out) {
  writeFields(message, out, wire::kStatus);
  writeObject("reasons", out, [&] {
    for (const StatusMessage::Count& count : message.counts) out.field(count.reason, count.count);
  });
  writeFields(message, out, wire::kStatusFailures);
  writeObject("latency_us", out, [&] { writeFields(message, out, wire::kStatusLatency); });
  writeObject("query_us", out, [&] { writeFields(message, out, wire::kStatusQuery); });
}

std::string statusLine(const StatusMessage& message) {
  return objectLine("status", [&](JsonWriter& out) { writeStatus(message, out); });
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
