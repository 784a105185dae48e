#include "tools/settings/file_mark.h"

#define XXH_INLINE_ALL
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>
#include <xxhash.h>

#include <fmt/format.h>

namespace foretouch::tools {

std::string markOfText(std::string_view text, std::string_view before) {
  const auto seed = XXH64(before.data(), before.size(), 0);
  return fmt::format("{:016x}", XXH64(text.data(), text.size(), seed));
}

Result<std::string> markOfFile(const std::string& path) {
  // A pipe may have no end, nor a writer.
  std::error_code absent;
  if (std::filesystem::exists(path, absent) && !std::filesystem::is_regular_file(path, absent)) {
    return Error::in(path, ErrorCode::FileUnreadable, "expected a file");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error::in(path, ErrorCode::FileNotFound, "cannot be opened");
  XXH64_state_t state;
  XXH64_reset(&state, 0);
  std::vector<char> piece(std::size_t{1} << 16);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0) {
    XXH64_update(&state, piece.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) return Error::in(path, ErrorCode::FileUnreadable, "cannot be read");
  return fmt::format("{:016x}", XXH64_digest(&state));
}

}  // namespace foretouch::tools
