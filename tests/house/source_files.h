// tests/house/source_files.h: the project's own files, as the tests of the house read them.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace foretouch::house {

[[nodiscard]] inline std::string contentOf(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace foretouch::house
