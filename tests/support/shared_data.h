// tests/support/shared_data.h: the one way to files that the project may read but not ship.
#pragma once

#include <optional>
#include <string>

namespace foretouch::test {

/// The folder named by the environment variable FORETOUCH_DATA, else ../shared/data beside the
/// project's root; nothing if that is not a folder.
std::optional<std::string> sharedDataFolder();

/// A file in that folder; nothing if it is missing.
std::optional<std::string> sharedData(const std::string& relativePath);

}  // namespace foretouch::test

/// Skips the test, by name, if `variable` (a std::optional<std::string>) is empty.
#define FORETOUCH_REQUIRE_SHARED(variable, relativePath)             \
  const auto variable = ::foretouch::test::sharedData(relativePath); \
  if (!variable) GTEST_SKIP() << "shared data absent: " << (relativePath)
