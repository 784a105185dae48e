// assets/json_writer.h: JSON text, piece by piece. The project writes all its JSON with this,
// except large documents that it builds as a whole (glTF). Not installed.
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

/// The text's destination. In a page, every "<" is escaped, so that no text can end the element
/// that holds it.
enum class JsonPlace : std::uint8_t { File, Page };

/// `text` as a JSON string with its quotes; invalid UTF-8 becomes U+FFFD.
[[nodiscard]] std::string jsonString(std::string_view text, JsonPlace place = JsonPlace::File);

/// Adds the commas. Appends to the given text, which its owner may empty between two calls. Fields
/// without braces form a list for rawItems() of an object. The caller must balance brackets: there
/// is no check.
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
  /// With `digits` digits after the decimal point.
  void fixed(double value, int digits);

  /// One value that is already JSON.
  void raw(std::string_view json);
  /// Values of an array, or fields of an object, already JSON and separated by commas; may be
  /// empty.
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
  /// An array with the value that `write` writes for each item.
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
  bool isFirst_ = true;  // in its array or object, or right after its key
};

}  // namespace foretouch
