#include "assets/json_writer.h"

#include <cmath>
#include <cstddef>
#include <iterator>

#include <fmt/format.h>

#include "lss/assert.h"

namespace foretouch {
namespace {

/// How many bytes at the start of `text` (not empty) are one character, or the remains of a damaged
/// one.
struct Sequence {
  std::size_t bytes = 1;
  bool isCharacter = false;
};

Sequence sequenceAt(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {1, true};
  if (lead < 0xc2 || lead > 0xf4) return {};
  const std::size_t bytes = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
  // No overlong forms, no surrogates, nothing above U+10FFFF: limits for the second byte only.
  unsigned char least = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
  unsigned char most = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
  for (std::size_t i = 1; i < bytes; ++i) {
    if (i == text.size() || byte(i) < least || byte(i) > most) return {i, false};
    least = 0x80;
    most = 0xbf;
  }
  return {bytes, true};
}

void appendCharacter(std::string_view character, JsonPlace place, std::string& out) {
  const char c = character[0];
  switch (c) {
    case '"': out += "\\\""; return;
    case '\\': out += "\\\\"; return;
    case '\b': out += "\\b"; return;
    case '\f': out += "\\f"; return;
    case '\n': out += "\\n"; return;
    case '\r': out += "\\r"; return;
    case '\t': out += "\\t"; return;
    default: break;
  }
  const bool isControl = static_cast<unsigned char>(c) < 0x20;
  if (isControl || (c == '<' && place == JsonPlace::Page)) {
    fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<unsigned>(c));
  } else {
    out += character;
  }
}

void appendString(std::string_view text, JsonPlace place, std::string& out) {
  out += '"';
  while (!text.empty()) {
    const Sequence sequence = sequenceAt(text);
    if (sequence.isCharacter) {
      appendCharacter(text.substr(0, sequence.bytes), place, out);
    } else {
      out += "\xef\xbf\xbd";
    }
    text.remove_prefix(sequence.bytes);
  }
  out += '"';
}

void appendNumber(double value, std::string& out) {
  FORETOUCH_ASSERT(std::isfinite(value));
  fmt::format_to(std::back_inserter(out), "{}", value);
}

}  // namespace

std::string numberText(double value) {
  std::string text;
  appendNumber(value, text);
  return text;
}

std::string jsonString(std::string_view text, JsonPlace place) {
  std::string json;
  appendString(text, place, json);
  return json;
}

void JsonWriter::separate() {
  if (!isFirst_) text_ += ',';
  isFirst_ = false;
}

void JsonWriter::open(char bracket) {
  separate();
  text_ += bracket;
  isFirst_ = true;
}

void JsonWriter::close(char bracket) {
  text_ += bracket;
  isFirst_ = false;
}

void JsonWriter::key(std::string_view name) {
  value(name);
  text_ += ':';
  isFirst_ = true;  // no comma between a key and its value
}

void JsonWriter::value(double value) {
  separate();
  appendNumber(value, text_);
}

void JsonWriter::value(std::string_view text) {
  separate();
  appendString(text, place_, text_);
}

void JsonWriter::value(const Eigen::Vector3d& vector) {
  beginArray();
  for (const double x : vector) value(x);
  endArray();
}

void JsonWriter::value(const std::vector<std::string>& texts) {
  beginArray();
  for (const std::string& text : texts) value(text);
  endArray();
}

void JsonWriter::fixed(double value, int digits) {
  separate();
  fmt::format_to(std::back_inserter(text_), "{:.{}f}", value, digits);
}

void JsonWriter::raw(std::string_view json) {
  separate();
  text_ += json;
}

}  // namespace foretouch
