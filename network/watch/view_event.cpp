#include "network/watch/view_event.h"

namespace foretouch {
namespace {

void appendList(const std::vector<ContactTexts>& earlier, const ContactTexts& own,
                std::string& text) {
  bool isFirst = true;
  const auto append = [&](const ContactTexts& contacts) {
    if (contacts.count == 0) return;
    if (!isFirst) text += ',';
    text += *contacts.text;
    isFirst = false;
  };
  for (const ContactTexts& contacts : earlier) append(contacts);
  append(own);
}

}  // namespace

std::string sentText(const ViewEvent& event, const std::vector<ContactTexts>& earlier) {
  std::size_t bytes = event.name.size() + event.head->size() + 128;
  for (const ContactTexts& contacts : earlier) bytes += contacts.text->size() + 1;
  if (event.contacts.text) bytes += event.contacts.text->size();
  std::string text;
  text.reserve(bytes);
  text += "event: " + event.name + "\ndata: ";
  text += *event.head;
  if (event.steps > 0) {
    text += ",\"contacts\":[";
    appendList(earlier, event.contacts, text);
    text += "],\"skipped\":" + std::to_string(event.steps - 1);
    if (event.numLeftOut > 0) {
      text += ",\"contacts_left_out\":" + std::to_string(event.numLeftOut);
    }
  }
  return text += "}\n\n";
}

}  // namespace foretouch
