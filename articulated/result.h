// articulated/result.h: errors of bad input. An Error names the file, the place in it and the
// expectation. The outcome of geometry is never an Error but a Verdict (middleware/contact.h).
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace foretouch {

enum class ErrorCode : std::uint8_t {
  FileNotFound,    ///< The path does not exist or cannot be opened.
  FileUnreadable,  ///< It opened, but reading failed (a directory, an I/O error).
  FileUnwritable,  ///< Results could not be written or renamed into place.
  Syntax,          ///< The text breaks the format's grammar.
  LimitExceeded,   ///< Larger, deeper or longer than the stated limit.
  NonFinite,       ///< NaN or infinity instead of a number.
  OutOfRange,      ///< A finite number outside its legal range.
  UnknownName,     ///< A name that matches nothing.
  DuplicateName,   ///< A name that must be unique is not.
  BadHierarchy,    ///< A cycle, a parent after its child, no root.
  Empty,           ///< Something required is missing: no joints, no frames, no triangles.
  Mismatch,        ///< Two inputs do not fit each other.
  ImportFailed,    ///< The importer refused the file.
  ImportCrashed,   ///< The importer process died or ran into its limits.
  DeviceFailed,    ///< Embree refused to work (out of memory, unsupported CPU).
};

/// What was wrong, where, and what was expected instead.
struct Error {
  ErrorCode code = ErrorCode::Syntax;
  std::string file;  ///< The file's path, or the option or argument; empty for values in memory.
  std::int64_t line = -1;  ///< 1-based line of a text file; -1 if there is none.
  std::int64_t index =
      -1;  ///< 0-based index of the joint, link, frame or triangle; -1 if there is none.
  std::string message;  ///< What was found and what was expected, one sentence, no trailing dot.

  [[nodiscard]] static Error of(ErrorCode code, std::string message) {
    return {code, "", -1, -1, std::move(message)};
  }
  /// `place`: a file's path, or the option or argument that is wrong.
  [[nodiscard]] static Error in(std::string place, ErrorCode code, std::string message) {
    return {code, std::move(place), -1, -1, std::move(message)};
  }
  [[nodiscard]] static Error inLine(std::string file, std::int64_t line, ErrorCode code,
                                    std::string message) {
    return {code, std::move(file), line, -1, std::move(message)};
  }
  [[nodiscard]] static Error at(std::int64_t index, ErrorCode code, std::string message) {
    return {code, "", -1, index, std::move(message)};
  }
};

/// The code as a stable word, e.g. "file-not-found".
[[nodiscard]] const char* toString(ErrorCode code);

/// One line for a person: "clip.bvh:12: expected CHANNELS, found 'OFFSET'".
[[nodiscard]] std::string describe(const Error& error);

namespace internal {
/// Say on stderr what was taken without asking ok(), and stop the program.
[[noreturn]] void stopForValueOf(const Error& error);
[[noreturn]] void stopForErrorOfSuccess();
}  // namespace internal

/// A value, or the Error that prevented it. Ask ok() first: `value()` of a failed Result says the
/// error on stderr and stops the program, in every build. So does `error()` of one that is ok.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value)
      : content_(std::in_place_index<0>, std::move(value)) {}  // NOLINT: implicit by intent
  Result(Error error)
      : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit by intent

  [[nodiscard]] bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  [[nodiscard]] const T& value() const& {
    if (!ok()) internal::stopForValueOf(*std::get_if<1>(&content_));
    return *std::get_if<0>(&content_);
  }
  [[nodiscard]] T& value() & {
    if (!ok()) internal::stopForValueOf(*std::get_if<1>(&content_));
    return *std::get_if<0>(&content_);
  }
  [[nodiscard]] T&& value() && {
    if (!ok()) internal::stopForValueOf(*std::get_if<1>(&content_));
    return std::move(*std::get_if<0>(&content_));
  }
  [[nodiscard]] const Error& error() const {
    if (ok()) internal::stopForErrorOfSuccess();
    return *std::get_if<1>(&content_);
  }

 private:
  std::variant<T, Error> content_;
};

/// Success without a value.
struct Done {};

/// The error, with `place` for its file if it names none.
[[nodiscard]] Error inFile(Error error, const std::string& place);
template <typename T>
[[nodiscard]] Result<T> inFile(Result<T> result, const std::string& place) {
  if (result.ok()) return result;
  return inFile(result.error(), place);
}

}  // namespace foretouch
