// tests/assets/files_in_folder.h: what tests of files read, write and find again.
#pragma once

#include <fstream>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "assets/text_file.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {

class FilesInFolder : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::set<std::string> names() const { return folder_.names(); }
  TempFolder folder_;
};

inline std::string readBack(const std::string& path) {
  auto text = readWholeFile(path, 1u << 26);
  return text.ok() ? text.value() : "unreadable: " + describe(text.error());
}

inline void writeText(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace foretouch::test
