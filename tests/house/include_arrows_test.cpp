// The arrows of the house: which folder may include which. One direction, no exceptions.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

/// Folder -> the folders it may include, itself left out.
const std::map<std::string, std::set<std::string>> kArrows = {
    {"lss", {}},
    {"articulated", {"lss"}},
    {"tessellation", {"articulated", "lss"}},
    {"middleware", {"tessellation", "articulated", "lss"}},
    {"bindings", {"middleware", "tessellation", "articulated", "lss"}},
    {"network", {"middleware", "tessellation", "articulated", "lss"}},
    {"tools", {"network", "middleware", "tessellation", "articulated", "lss"}},
    {"examples", {"articulated", "lss"}},
};

/// Libraries that only these files' folders may include, by the include's first word.
const std::map<std::string, std::set<std::string>> kLibraries = {
    {"embree3", {"middleware"}},
    {"assimp", {"middleware"}},
    {"hwy", {"lss", "articulated", "tessellation", "middleware"}},
    {"nlohmann", {"articulated", "middleware", "tools"}},
    {"urdf_model", {"middleware"}},
    {"urdf_parser", {"middleware"}},
    {"tinyxml.h", {"middleware"}},
    {"console_bridge", {"middleware"}},
    {"lcm", {"network"}},
    {"foretouch", {"network"}},  // generated from network/lcm
    {"xxhash.h", {"network"}},
    {"toml++", {"tools"}},
    {"httplib.h", {"network"}},
    {"CLI", {"tools"}},
    {"meshoptimizer.h", {"tools"}},
    {"pybind11", {"bindings"}},
    {"fcl", {"tools"}},
    {"ccd", {"tools"}},
    {"BulletCollision", {"tools"}},
    {"LinearMath", {"tools"}},
    {"btBulletCollisionCommon.h", {"tools"}},
};

struct Include {
  fs::path file;
  std::string target;
  bool quoted;
};

/// The included path of a line such as `#include "lss/lss.h"`, with its quote or bracket before it;
/// empty for any other line.
std::string includedIn(std::string line) {
  line.erase(std::remove_if(line.begin(), line.end(), [](char c) { return c == ' ' || c == '\t'; }),
             line.end());
  const std::string directive = "#include";
  if (line.rfind(directive, 0) != 0) return "";
  const std::size_t end = line.find_first_of("\">", directive.size() + 1);
  if (end == std::string::npos) return "";
  return line.substr(directive.size(), end - directive.size());
}

std::vector<Include> includesOf(const fs::path& folder) {
  std::vector<Include> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      const std::string included = includedIn(line);
      if (!included.empty()) {
        found.push_back({entry.path(), included.substr(1), included.front() == '"'});
      }
    }
  }
  return found;
}

std::string firstWord(const std::string& path) {
  return path.substr(0, path.find('/'));
}

TEST(IncludeArrows, PointOneWay) {
  const fs::path root(FORETOUCH_SOURCE_DIR);
  int seen = 0;
  for (const auto& [folder, allowed] : kArrows) {
    for (const Include& include : includesOf(root / folder)) {
      if (!include.quoted) continue;
      ++seen;
      const std::string target = firstWord(include.target);
      EXPECT_TRUE(target == folder || allowed.count(target) != 0)
          << include.file << " includes " << include.target;
    }
  }
  EXPECT_GT(seen, 50);
}

TEST(IncludeArrows, EveryFolderWithSourcesIsListed) {
  const std::set<std::string> others = {"tests", "docs", "cmake", "viewer", "build", "out"};
  for (const auto& entry : fs::directory_iterator(fs::path(FORETOUCH_SOURCE_DIR))) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || name.front() == '.' || others.count(name) != 0) continue;
    EXPECT_EQ(kArrows.count(name), 1u) << name << " has no arrows";
  }
}

TEST(IncludeArrows, LibrariesStayInTheirRooms) {
  const fs::path root(FORETOUCH_SOURCE_DIR);
  for (const auto& [folder, unused] : kArrows) {
    for (const Include& include : includesOf(root / folder)) {
      const auto library = kLibraries.find(firstWord(include.target));
      if (library == kLibraries.end()) continue;
      EXPECT_EQ(library->second.count(folder), 1u)
          << include.file << " includes " << include.target;
    }
  }
}

/// The rooms of tools/. What lies in tools/ itself is for all of them, but for the program's own
/// two files, which know all.
const std::map<std::string, std::set<std::string>> kToolsRooms = {
    {"inputs", {}},
    {"audit", {"inputs"}},
    {"replay", {"inputs"}},
    {"stream", {"inputs"}},
    {"glb", {"replay", "inputs"}},
    {"sweep", {"glb", "inputs"}},
    {"log", {"stream", "replay", "inputs"}},
    {"report", {"log", "audit", "replay", "inputs"}},
    {"view", {"report", "stream"}},
    {"bench", {"stream", "replay", "inputs"}},
    {"commands", {"view", "report", "log", "sweep", "glb", "stream", "replay", "audit", "inputs"}},
};

TEST(IncludeArrows, PointOneWayBetweenTheRoomsOfTools) {
  const fs::path tools = fs::path(FORETOUCH_SOURCE_DIR) / "tools";
  const std::set<std::string> knowAll = {"main.cpp", "program.cpp"};
  int seen = 0;
  for (const Include& include : includesOf(tools)) {
    if (!include.quoted || firstWord(include.target) != "tools") continue;
    const fs::path from = include.file.lexically_relative(tools);
    const fs::path to = fs::path(include.target).lexically_relative("tools");
    if (!to.has_parent_path() || knowAll.count(from.string()) != 0) continue;
    const std::string room = from.has_parent_path() ? from.begin()->string() : "";
    const std::string target = to.begin()->string();
    const auto allowed = kToolsRooms.find(room);
    ++seen;
    EXPECT_TRUE(allowed != kToolsRooms.end() &&
                (target == room || allowed->second.count(target) != 0))
        << include.file << " includes " << include.target;
  }
  EXPECT_GT(seen, 300);
}

// Inside tools/, the peers of `bench peers` are known to their own sources alone.
TEST(IncludeArrows, PeersStayBehindTheirDoor) {
  const std::map<std::string, std::string> rooms = {
      {"fcl", "fcl_solvers.cpp"},
      {"BulletCollision", "bullet_solvers.cpp"},
      {"btBulletCollisionCommon.h", "bullet_solvers.cpp"}};
  std::set<std::string> seen;
  for (const Include& include : includesOf(fs::path(FORETOUCH_SOURCE_DIR) / "tools")) {
    const auto room = rooms.find(firstWord(include.target));
    if (include.quoted || room == rooms.end()) continue;
    EXPECT_EQ(include.file.filename().string(), room->second) << include.target;
    seen.insert(room->first);
  }
  EXPECT_EQ(seen.size(), rooms.size());
}

std::string contentOf(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Readme, ShowsTheExampleThatIsBuiltAndRun) {
  const fs::path root(FORETOUCH_SOURCE_DIR);
  const std::string example = contentOf(root / "tests" / "consumer" / "consumer.cpp");
  ASSERT_FALSE(example.empty());
  EXPECT_NE(contentOf(root / "README.md").find("```cpp\n" + example + "```"), std::string::npos);
}

// The oracle may not share code with what it judges.
TEST(IncludeArrows, OracleSharesNoCodeWithTheProduct) {
  int files = 0;
  for (const Include& include : includesOf(fs::path(FORETOUCH_SOURCE_DIR) / "tests" / "support")) {
    const std::string name = include.file.filename().string();
    const bool isOracle = name.rfind("oracle", 0) == 0 || name.rfind("precise", 0) == 0 ||
                          name.rfind("rational", 0) == 0;
    if (!isOracle) continue;
    ++files;
    EXPECT_EQ(kArrows.count(firstWord(include.target)), 0u)
        << include.file << " includes " << include.target;
  }
  EXPECT_GT(files, 5);
}

// Nor may that of `bench extremes`.
TEST(IncludeArrows, OracleOfTheExtremesSharesNoCodeWithTheProduct) {
  int files = 0;
  const fs::path folder = fs::path(FORETOUCH_SOURCE_DIR) / "tools" / "bench" / "extremes";
  for (const Include& include : includesOf(folder)) {
    const std::string name = include.file.filename().string();
    if (name.rfind("oracle", 0) != 0 && name.rfind("precise", 0) != 0) continue;
    ++files;
    const bool isOwn = include.target.rfind("tools/bench/extremes/oracle", 0) == 0 ||
                       include.target.rfind("tools/bench/extremes/precise", 0) == 0;
    EXPECT_TRUE(!include.quoted || isOwn) << include.file << " includes " << include.target;
  }
  EXPECT_GT(files, 5);
}

}  // namespace
