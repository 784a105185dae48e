// tools/json_line.h: objects of JSON by what is in them.
#pragma once

#include <string>
#include <string_view>

#include "assets/json_writer.h"

namespace foretouch::tools {

/// "name":{...} around what `write` writes.
template <typename Write>
void writeObject(std::string_view name, JsonWriter& out, const Write& write) {
  out.key(name);
  out.beginObject();
  write();
  out.endObject();
}

/// An array of objects, each with what `write` writes for an item.
template <typename List, typename Write>
void writeObjects(std::string_view name, const List& items, JsonWriter& out, const Write& write) {
  out.list(name, items, [&](const auto& item) {
    out.beginObject();
    write(item);
    out.endObject();
  });
}

/// {"name":{...}} around what `write` writes, and a line break.
template <typename Write>
[[nodiscard]] std::string objectLine(std::string_view name, const Write& write) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  writeObject(name, out, [&] { write(out); });
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
