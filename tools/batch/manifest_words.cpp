#include "tools/batch/manifest_words.h"

#include <algorithm>
#include <filesystem>
#include <glob.h>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

bool isBlankChar(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

/// One word, which begins at `at` and leaves it behind itself.
Result<std::string> nextWord(std::string_view line, std::size_t& at) {
  std::string word;
  char quote = '\0';
  for (; at < line.size(); ++at) {
    const char c = line[at];
    if (quote == '\0' && isBlankChar(c)) break;
    if (quote == '\0' && (c == '\'' || c == '"')) {
      quote = c;
    } else if (quote != '\0' && c == quote) {
      quote = '\0';
    } else if (quote == '"' && c == '\\' && at + 1 < line.size()) {
      word += line[++at];
    } else {
      word += c;
    }
  }
  if (quote == '\0') return word;
  return Error::of(ErrorCode::Syntax,
                   std::string("expected a second ") + quote + " before the line's end");
}

/// Escapes the folder's own name, so that it is not a pattern.
std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : path) {
    if (c == '*' || c == '?' || c == '[' || c == '\\') text += '\\';
    text += c;
  }
  return text;
}

/// What glob() found; frees it.
class FoundPaths {
 public:
  explicit FoundPaths(const std::string& pattern)
      : failure_(::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found_)) {}
  FoundPaths(const FoundPaths&) = delete;
  FoundPaths& operator=(const FoundPaths&) = delete;
  ~FoundPaths() { ::globfree(&found_); }

  [[nodiscard]] bool ranOut() const { return failure_ == GLOB_NOSPACE; }
  [[nodiscard]] std::size_t size() const { return failure_ == 0 ? found_.gl_pathc : 0; }
  [[nodiscard]] std::string operator[](std::size_t i) const { return found_.gl_pathv[i]; }

 private:
  glob_t found_{};
  int failure_ = 0;
};

}  // namespace

Result<std::vector<std::string>> wordsOfLine(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < line.size();) {
    if (isBlankChar(line[at])) {
      ++at;
      continue;
    }
    if (line[at] == '#') break;
    auto word = nextWord(line, at);
    if (!word.ok()) return word.error();
    words.push_back(std::move(word).value());
  }
  return words;
}

bool isPattern(std::string_view word) {
  return word.find_first_of("*?[") != std::string_view::npos;
}

Result<std::vector<std::string>> filesLike(const std::string& pattern, const std::string& folder,
                                           std::size_t most) {
  const bool isAbsolute = !pattern.empty() && pattern.front() == '/';
  const std::size_t lead = isAbsolute ? 0 : folder.size() + 1;
  const FoundPaths found(isAbsolute ? pattern : escaped(folder) + "/" + pattern);
  if (found.ranOut() || found.size() > most) {
    return Error::of(ErrorCode::LimitExceeded, "expected a pattern of at most " +
                                                   std::to_string(most) + " files, found more");
  }
  std::vector<std::string> files;
  std::error_code absent;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::string path = found[i];
    if (!std::filesystem::is_directory(path, absent)) files.push_back(path.substr(lead));
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace foretouch::tools
