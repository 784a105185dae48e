// tests/network/sent_events.h: events with numbers for contacts, and a viewer's text of them,
// parsed without the product's code.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "network/watch/view_event.h"

namespace foretouch::test {

inline ViewEvent eventOf(std::int64_t avatar, std::int64_t sequence,
                         const std::vector<int>& contacts = {}, std::size_t padding = 0) {
  ViewEvent event;
  event.topic = static_cast<std::size_t>(avatar);
  event.name = "step";
  std::string fields =
      "\"avatar\":" + std::to_string(avatar) + ",\"sequence\":" + std::to_string(sequence);
  if (padding > 0) fields += ",\"from\":\"" + std::string(padding, 'x') + "\"";
  event.fields = std::make_shared<const std::string>(fields);
  event.steps = 1;
  std::string text;
  for (const int contact : contacts) text += (text.empty() ? "" : ",") + std::to_string(contact);
  event.contacts.count = contacts.size();
  if (!contacts.empty()) event.contacts.text = std::make_shared<const std::string>(text);
  return event;
}

struct SentEvent {
  std::int64_t avatar = 0, sequence = 0, skipped = 0, leftOut = 0;
  std::vector<int> contacts;
};

inline std::int64_t numberAfter(const std::string& text, const std::string& name) {
  const std::size_t at = text.find(name);
  return at == std::string::npos ? 0 : std::atoll(text.c_str() + at + name.size());
}

/// The steps among whole events; ignores a cut-off one at the end.
inline std::vector<SentEvent> sentEvents(const std::string& text) {
  std::vector<SentEvent> events;
  const std::string begin = "event: step\ndata: ";
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::size_t end = text.find("\n\n", at);
    if (end == std::string::npos) break;
    const std::string data = text.substr(at + begin.size(), end - at - begin.size());
    SentEvent event;
    event.avatar = numberAfter(data, "\"avatar\":");
    event.sequence = numberAfter(data, "\"sequence\":");
    event.skipped = numberAfter(data, "\"skipped\":");
    event.leftOut = numberAfter(data, "\"contacts_left_out\":");
    const std::string list = "\"contacts\":[";
    const std::size_t from = data.find(list);
    EXPECT_NE(from, std::string::npos) << data;
    if (from == std::string::npos) continue;
    for (std::size_t i = from + list.size(); i < data.size() && data[i] != ']';) {
      event.contacts.push_back(std::atoi(data.c_str() + i));
      i = data.find_first_of(",]", i);
      if (i < data.size() && data[i] == ',') ++i;
    }
    events.push_back(std::move(event));
  }
  return events;
}

}  // namespace foretouch::test
