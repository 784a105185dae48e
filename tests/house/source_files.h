// tests/house/source_files.h: reads the project's own files, for the house tests.
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
