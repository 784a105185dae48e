// tools/fields_json.h: what messages hold as JSON, by their lists of fields
// (network/wire/message_fields.h).
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "network/wire/wire_fields.h"
#include "tools/json_line.h"

namespace foretouch::tools {

template <typename Record, typename Field>
bool isTold(const Record&, const Field& field) {
  return field.name[0] != '\0';
}
template <typename Record, typename Field>
bool isTold(const Record& record, const wire::Sparse<Field>& field) {
  static const Record kBare{};
  return wire::at(record, field.member) != wire::at(kBare, field.member);
}

template <typename Rule, typename Value>
void writeValue(const Rule&, const Value& value, JsonWriter& out) {
  if constexpr (std::is_same_v<Rule, wire::Hash>) {
    // As text: beyond the range of JSON numbers in some readers.
    out.value(fmt::format("{:016x}", static_cast<std::uint64_t>(value)));
  } else if constexpr (std::is_enum_v<Value>) {
    out.value(toString(value));
  } else if constexpr (std::is_same_v<Value, Quaternion>) {
    out.beginArray();
    for (const double x : {value.w(), value.x(), value.y(), value.z()}) out.value(x);
    out.endArray();
  } else {
    out.value(value);
  }
}

/// All that the lists have a name for, into an open object.
template <typename Record, typename... Lists>
void writeFields(const Record& record, JsonWriter& out, const Lists&... lists) {
  const auto write = [&](const auto& field) {
    if (!isTold(record, field)) return;
    out.key(field.name);
    writeValue(field.rule, wire::at(record, field.member), out);
  };
  (std::apply([&](const auto&... each) { (write(each), ...); }, lists), ...);
}

/// An array of objects.
template <typename Rows, typename... Lists>
void writeRows(std::string_view name, const Rows& rows, JsonWriter& out, const Lists&... lists) {
  writeObjects(name, rows, out, [&](const auto& row) { writeFields(row, out, lists...); });
}

}  // namespace foretouch::tools
