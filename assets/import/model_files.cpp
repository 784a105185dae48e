#include "assets/import/model_files.h"

#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <assimp/DefaultIOStream.h>
#include <assimp/MemoryIOWrapper.h>

#include "assets/import/gltf_skins.h"
#include "assets/import/memory_budget.h"
#include "assets/import/side_files.h"

namespace foretouch::internal {
namespace {

/// assimp's own stream, of a file that is open already.
class OpenedFile : public Assimp::DefaultIOStream {
 public:
  OpenedFile(std::FILE* file, const std::string& path) : DefaultIOStream(file, path) {}
};

/// Null if it is no regular file, whatever it was a moment ago.
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
  if (const auto completed = withBindMatrices(path)) {
    grantMemoryFor(completed->size());
    return streamOf(*completed);
  }
  return openedRegularFile(path);
}

}  // namespace foretouch::internal
