// assets/json_writer.h: JSON text, piece by piece: what is written as JSON, beside large documents
// that are built as a whole (glTF), is written by this.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

namespace foretouch {

/// The shortest text that reads back as the same double. `value` is finite (asserted).
[[nodiscard]] std::string numberText(double value);

/// Where the text goes: in a page no "<" is written as it is, so that nothing in it can end the
/// element that holds the text.
enum class JsonPlace : std::uint8_t { File, Page };

/// `text` as a JSON string with its quotes; what is not UTF-8 becomes U+FFFD.
[[nodiscard]] std::string jsonString(std::string_view text, JsonPlace place = JsonPlace::File);

/// Puts the commas. Everything is appended to the text that was given, which its owner may take
/// away between two calls. Without braces around them, fields are a list to be put into an object
/// with rawItems(). Whoever writes keeps brackets in pairs: nothing is checked.
class JsonWriter {
 public:
  /// `text` outlives it.
  explicit JsonWriter(std::string& text, JsonPlace place = JsonPlace::File)
      : text_(text), place_(place) {}

  void beginObject() { open('{'); }
  void endObject() { close('}'); }
  void beginArray() { open('['); }
  void endArray() { close(']'); }
  void key(std::string_view name);

  void value(bool value) { raw(value ? "true" : "false"); }
  void value(double value);
  template <typename Integer, typename = std::enable_if_t<std::is_integral_v<Integer> &&
                                                          !std::is_same_v<Integer, bool>>>
  void value(Integer value) {
    raw(std::to_string(value));
  }
  void value(std::string_view text);
  void value(const std::string& text) { value(std::string_view(text)); }
  void value(const char* text) { value(std::string_view(text)); }
  /// [x,y,z]
  void value(const Eigen::Vector3d& vector);
  void value(const std::vector<std::string>& texts);
  void null() { raw("null"); }
  /// With so many digits behind the point.
  void fixed(double value, int digits);

  /// JSON already: one value.
  void raw(std::string_view json);
  /// JSON already: values of an array, or fields of an object, with commas between them; none where
  /// it is empty.
  void rawItems(std::string_view json) {
    if (!json.empty()) raw(json);
  }

  template <typename Value>
  void field(std::string_view name, const Value& given) {
    key(name);
    value(given);
  }
  void rawField(std::string_view name, std::string_view json) {
    key(name);
    raw(json);
  }
  /// An array of what `write` writes for each.
  template <typename List, typename Write>
  void list(std::string_view name, const List& items, const Write& write) {
    key(name);
    beginArray();
    for (const auto& item : items) write(item);
    endArray();
  }

 private:
  void open(char bracket);
  void close(char bracket);
  void separate();

  std::string& text_;
  JsonPlace place_;
  bool isFirst_ = true;  // in its array or object, or right behind its key
};

}  // namespace foretouch
