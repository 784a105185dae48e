#include "assets/import/model_files.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <assimp/DefaultIOStream.h>
#include <assimp/MemoryIOWrapper.h>

#include "assets/import/memory_budget.h"
#include "assets/import/side_files.h"
#include "assets/import/text.h"

namespace foretouch::internal {
namespace {

/// assimp's own stream, for a file that is open already.
class OpenedFile : public Assimp::DefaultIOStream {
 public:
  OpenedFile(std::FILE* file, const std::string& path) : DefaultIOStream(file, path) {}
};

/// Null if it is not a regular file, whatever it was a moment ago.
Assimp::IOStream* openedRegularFile(const std::string& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return nullptr;
  struct stat status {};
  if (fstat(fd, &status) == 0 && S_ISREG(status.st_mode)) {
    grantMemoryFor(static_cast<std::uint64_t>(status.st_size));
    if (std::FILE* const file = fdopen(fd, "rb")) return new OpenedFile(file, path);
  }
  close(fd);
  return nullptr;
}

/// A copy that the stream owns, as it wants it.
Assimp::IOStream* streamOf(const std::string& bytes) {
  auto* const copy = new std::uint8_t[bytes.size()];
  std::memcpy(copy, bytes.data(), bytes.size());
  return new Assimp::MemoryIOStream(copy, bytes.size(), true);
}

bool isSameInLowerCase(std::string_view text, std::string_view word) {
  return text.size() >= word.size() &&
         std::equal(word.begin(), word.end(), text.begin(), [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

/// An STL in text whose keywords are in capitals, as some programs write it: assimp knows them only
/// in lower case. The name of the solid stays as it is. Nothing for any other file.
std::optional<std::string> withKeywordsOfStlInLowerCase(const std::string& path) {
  constexpr std::string_view kSolid = "solid", kEndSolid = "endsolid";
  if (lowerExtensionOf(path) != ".stl") return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::string head(kSolid.size(), '\0');
  if (!file.read(head.data(), static_cast<std::streamsize>(head.size())) || head == kSolid ||
      !isSameInLowerCase(head, kSolid)) {
    return std::nullopt;
  }
  std::error_code unknown;
  grantMemoryFor(std::filesystem::file_size(path, unknown));
  file.seekg(0);
  std::string text, line;
  while (std::getline(file, line)) {
    const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
    const std::string_view said = std::string_view(line).substr(begin);
    std::size_t end = line.size();
    for (const std::string_view word : {kSolid, kEndSolid}) {
      if (isSameInLowerCase(said, word)) end = begin + word.size();
    }
    std::transform(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(end), line.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    text += line + "\n";
  }
  return text;
}

}  // namespace

bool ModelFiles::isModel(const std::string& path) const {
  std::error_code unknown;
  return path == model_ || std::filesystem::equivalent(path, model_, unknown);
}

bool ModelFiles::Exists(const char* path) const {
  std::error_code unknown;
  return isModel(path) ? std::filesystem::is_regular_file(path, unknown) : isSideFile(model_, path);
}

Assimp::IOStream* ModelFiles::Open(const char* path, const char* mode) {
  if (std::strchr(mode, 'w') != nullptr || std::strchr(mode, 'a') != nullptr) return nullptr;
  if (!isModel(path)) return isSideFile(model_, path) ? openedRegularFile(path) : nullptr;
  if (const auto lowered = withKeywordsOfStlInLowerCase(path)) return streamOf(*lowered);
  return openedRegularFile(path);
}

}  // namespace foretouch::internal
