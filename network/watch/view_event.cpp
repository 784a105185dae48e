#include "network/watch/view_event.h"

#include "assets/json_writer.h"

namespace foretouch {
namespace {

void writeItems(const ContactTexts& contacts, JsonWriter& out) {
  if (contacts.count > 0) out.rawItems(*contacts.text);
}

}  // namespace

std::string sentText(const ViewEvent& event, const std::vector<ContactTexts>& earlier) {
  std::size_t bytes = event.name.size() + event.fields->size() + 128;
  for (const ContactTexts& contacts : earlier) bytes += contacts.text->size() + 1;
  if (event.contacts.text) bytes += event.contacts.text->size();
  std::string text;
  text.reserve(bytes);
  text += "event: " + event.name + "\ndata: ";
  JsonWriter out(text);
  out.beginObject();
  out.rawItems(*event.fields);
  if (event.steps > 0) {
    out.key("contacts");
    out.beginArray();
    for (const ContactTexts& contacts : earlier) writeItems(contacts, out);
    writeItems(event.contacts, out);
    out.endArray();
    out.field("skipped", event.steps - 1);
    if (event.numLeftOut > 0) out.field("contacts_left_out", event.numLeftOut);
  }
  out.endObject();
  return text += "\n\n";
}

}  // namespace foretouch
