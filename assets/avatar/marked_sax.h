// assets/avatar/marked_sax.h: what the readers of JSON files share: the line of the parser's place,
// and the errors of text that is no JSON. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

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
  /// Of the event at hand, 1-based.
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

}  // namespace foretouch::internal
