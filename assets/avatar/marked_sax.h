// assets/avatar/marked_sax.h: what the readers of JSON files share: the line of the parser's place,
// and the errors of text that is not JSON. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "articulated/quoted.h"
#include "articulated/result.h"

namespace foretouch::internal {

/// Reads for the JSON parser and records its position, for line numbers.
struct MarkingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  const char** mark;

  reference operator*() const { return *at; }
  MarkingIterator& operator++() {
    *mark = ++at;
    return *this;
  }
  bool operator==(const MarkingIterator& other) const { return at == other.at; }
  bool operator!=(const MarkingIterator& other) const { return at != other.at; }
};

/// Takes the parser's events as they come, so that a format bounds the memory, not the text. A
/// format's own class ends the parse at the first event out of place.
class MarkedSax : public nlohmann::json_sax<nlohmann::json> {
 public:
  /// `file` names the text in errors; both outlive it.
  MarkedSax(std::string_view text, const std::string& file)
      : text_(text), file_(file), mark_(text.data()) {}

  /// Whether the whole text had what the format expects; if not, error() says why.
  [[nodiscard]] bool parse();
  [[nodiscard]] Error error() const { return *error_; }

  bool parse_error(std::size_t, const std::string& token, const nlohmann::json::exception& e) final;

 protected:
  /// The line of the event at hand, 1-based.
  [[nodiscard]] std::int64_t line() const;
  [[nodiscard]] const std::string& file() const { return file_; }
  /// Ends the parse with an error; returns false for the parser.
  bool stop(Error error);
  /// The same with what the format knows of the place.
  virtual bool fail(ErrorCode code, const std::string& message) = 0;

 private:
  std::string_view text_;
  const std::string& file_;
  const char* mark_;
  std::optional<Error> error_;
};

/// A key of an object of a format, and the value that may follow it.
template <typename Place, typename Kind>
struct JsonField {
  Place place;  ///< The object; Place{} is outside of all.
  const char* key;
  Kind kind;
  const char* expected;  ///< In words: "a name".
  bool isRequired = true;
};

/// Reads a format that is a table of fields. The parser is always in exactly one object or array.
template <typename Place, typename Kind>
class TableSax : public MarkedSax {
 public:
  using Field = JsonField<Place, Kind>;

  bool null() override { return unexpected("null"); }
  bool boolean(bool) final { return unexpected("true or false"); }
  bool number_integer(number_integer_t v) final { return number(static_cast<double>(v)); }
  bool number_unsigned(number_unsigned_t v) final { return number(static_cast<double>(v)); }
  bool number_float(number_float_t v, const string_t&) final { return number(v); }
  bool binary(binary_t&) final { return unexpected("binary data"); }  // not in JSON text

  bool key(string_t& key) final {
    std::string known;
    for (std::size_t i = 0; i < count_; ++i) {
      if (fields_[i].place != place()) continue;
      known += (known.empty() ? "" : ", ") + std::string(fields_[i].key);
      if (key != fields_[i].key) continue;
      const unsigned bit = 1u << i;
      if ((places_.back().seen & bit) != 0) {
        return fail(ErrorCode::DuplicateName, "the key " + inQuotes(key) + " appears twice");
      }
      places_.back().seen |= bit;
      field_ = &fields_[i];
      return true;
    }
    return fail(ErrorCode::UnknownName,
                "unknown key " + inQuotes(key) + "; expected one of " + known);
  }
  bool end_object() final {
    for (std::size_t i = 0; i < count_; ++i) {
      if (fields_[i].place != place() || !fields_[i].isRequired) continue;
      if ((places_.back().seen & (1u << i)) != 0) continue;
      return fail(ErrorCode::Syntax, "the key '" + std::string(fields_[i].key) + "' is missing");
    }
    return takeObject() && leave();
  }
  bool end_array() override { return leave(); }

 protected:
  /// `fields` outlives it.
  template <std::size_t kNum>
  TableSax(std::string_view text, const std::string& file, const std::array<Field, kNum>& fields)
      : MarkedSax(text, file), fields_(fields.data()), count_(kNum) {
    static_assert(kNum <= 32, "a bit for each");
  }

  virtual bool number(double value) = 0;
  /// The object at hand is complete: takes it, or fails.
  virtual bool takeObject() = 0;
  /// What stands in this array, or is the whole text: "one avatar object".
  [[nodiscard]] virtual const char* elementOf(Place place) const = 0;

  [[nodiscard]] Place place() const { return places_.empty() ? Place{} : places_.back().place; }
  [[nodiscard]] std::size_t depth() const { return places_.size(); }
  [[nodiscard]] bool expects(Kind kind) const { return field_ != nullptr && field_->kind == kind; }
  [[nodiscard]] std::string_view keyAtHand() const { return field_->key; }

  /// Into an object or array. The key before it is settled, unless `keepsKey`.
  bool enter(Place next, bool keepsKey = false) {
    places_.push_back({next});
    if (!keepsKey) field_ = nullptr;
    return true;
  }
  bool leave() {
    places_.pop_back();
    return valueDone();
  }
  bool valueDone() {
    field_ = nullptr;
    return true;
  }
  bool unexpected(const std::string& found) {
    const std::string expected =
        field_ == nullptr ? std::string(elementOf(place()))
                          : std::string(field_->expected) + " for \"" + field_->key + "\"";
    return fail(ErrorCode::Syntax, "expected " + expected + ", found " + found);
  }

 private:
  struct Open {
    Place place;
    unsigned seen = 0;  // which of the fields it has had
  };
  const Field* fields_;
  std::size_t count_;
  std::vector<Open> places_;
  const Field* field_ = nullptr;
};

}  // namespace foretouch::internal
