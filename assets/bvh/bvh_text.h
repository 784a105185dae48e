// assets/bvh/bvh_text.h: the words of a BVH file. Internal to the reader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"

namespace foretouch::internal {

struct BvhWord {
  std::string_view text;  ///< Empty at the end of the file.
  std::int64_t line = 0;
};

/// Ignores the case of ASCII letters: files differ in how they write keywords.
[[nodiscard]] bool isKeyword(std::string_view word, std::string_view lowerCaseKeyword);

/// An Error at a word, without the file; the parser's caller adds it.
[[nodiscard]] Error bvhError(ErrorCode code, std::int64_t line, std::string message);
/// "expected <what>, found <word>", also at the end of the file.
[[nodiscard]] Error bvhExpected(const std::string& what, const BvhWord& found);

/// Finds content that no BVH file has: control characters (a binary file, UTF-16), words above
/// kMaxBvhToken.
[[nodiscard]] std::optional<Error> binaryContent(std::string_view text);

/// Cuts text into words. Lines end with LF, CR LF or CR alone; a brace is always a word of its own.
class BvhScanner {
 public:
  enum class Colon { PartOfWord, Separate };

  explicit BvhScanner(std::string_view text);

  [[nodiscard]] BvhWord next(Colon colon = Colon::PartOfWord);
  [[nodiscard]] BvhWord peek(Colon colon = Colon::PartOfWord) const;
  /// Everything from the next word to the end of its line or a brace, without blanks around: names
  /// may hold spaces and colons.
  [[nodiscard]] BvhWord nextName();

 private:
  void skipBlanks();

  std::string_view rest_;
  std::int64_t line_ = 1;
};

/// A decimal number as files write it: "1", "+.5", "1e-3". Independent of the locale. `problem` is
/// null if it is one, else says what it is instead.
struct BvhNumber {
  double value = 0.0;
  const char* problem = nullptr;
  ErrorCode code = ErrorCode::Syntax;  ///< The problem's.
};
[[nodiscard]] BvhNumber readBvhNumber(std::string_view word);

/// The next word as a finite number; errors say that they expected `what`.
[[nodiscard]] Result<double> nextNumber(BvhScanner& scanner, const char* what);

/// Notes for the user, at most kMaxClipNotes of them.
class ClipNotes {
 public:
  void add(std::string note);
  /// The notes; the last one says how many were left out, if any were.
  [[nodiscard]] std::vector<std::string> take();

 private:
  std::vector<std::string> notes_;
  std::size_t left_ = 0;
};

}  // namespace foretouch::internal
