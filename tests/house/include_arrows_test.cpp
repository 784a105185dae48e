// The arrows of the house: which folder may include which. One direction, no exceptions.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/house/source_files.h"

namespace {

namespace fs = std::filesystem;
using foretouch::house::contentOf;

/// Folder -> the folders it may include, itself left out.
const std::map<std::string, std::set<std::string>> kArrows = {
    {"judge", {}},
    {"verify", {}},
    {"integrations", {}},
    {"lss", {}},
    {"articulated", {"lss"}},
    {"tessellation", {"articulated", "lss"}},
    {"middleware", {"tessellation", "articulated", "lss"}},
    {"planning", {"middleware", "articulated", "lss"}},
    {"assets", {"middleware", "articulated", "lss"}},
    {"bindings", {"assets", "middleware", "tessellation", "articulated", "lss"}},
    {"network", {"assets", "middleware", "tessellation", "articulated", "lss"}},
    {"tools", {"network", "assets", "middleware", "tessellation", "articulated", "lss"}},
    {"tests/reference", {"middleware", "tessellation", "articulated", "lss"}},
    {"bench",
     {"tests/reference", "judge", "tools", "network", "assets", "middleware", "tessellation",
      "articulated", "lss"}},
    {"examples", {"assets", "articulated", "lss"}},
};

/// The rooms of a folder -> the rooms of it that each may include. What lies in the folder itself
/// is the room "".
using Rooms = std::map<std::string, std::set<std::string>>;
const std::map<std::string, Rooms> kRooms = {
    {"middleware",
     {{"scene", {}},
      {"lanes", {"scene"}},
      {"surface", {"lanes"}},
      {"exact", {"scene"}},
      {"", {"scene", "surface", "exact"}},
      {"pair", {"", "exact", "surface", "lanes", "scene"}},
      {"near", {"pair", "", "exact", "lanes", "scene"}},
      {"query", {"pair", "", "exact", "surface", "scene"}},
      {"edges", {"query", "near", "", "scene"}},
      {"mechanics", {}},
      {"solid", {"query", "near", "pair", "mechanics", "", "scene"}},
      {"world", {"query", "pair", "", "lanes", "scene", "surface"}},
      {"depth", {"world", "exact", "", "scene", "surface"}},
      {"ask", {"depth", "world", "exact", "", "scene", "surface"}},
      {"triggers", {"events", "depth", "world", "exact", "", "scene", "surface"}},
      {"events", {"world", "query", "pair", "mechanics", "", "lanes", "scene", "surface"}},
      {"bracket", {"events", "pair", "", "exact", "lanes", "scene", "surface"}},
      {"solid_world",
       {"events", "world", "solid", "query", "near", "pair", "mechanics", "", "scene"}}}},
    {"assets",
     {{"", {}},
      {"bvh", {""}},
      {"bounds", {"bvh", ""}},
      {"avatar", {""}},
      {"model", {"bvh", ""}},
      {"import", {"model", ""}},
      {"mesh", {"import", "model", ""}},
      {"certificate", {"avatar", ""}},
      {"clip", {"bvh", "import", "model", ""}}}},
    {"network",
     {{"wire", {}},
      {"log", {"wire"}},
      {"vmc", {"wire"}},
      {"stream", {"wire"}},
      {"world_stream", {"stream", "wire"}},
      {"service", {"world_stream", "stream", "log", "wire"}},
      {"watch", {"service", "world_stream", "stream", "wire"}}}},
    // main.cpp and demo_main.cpp apart, which tie the commands to the program.
    {"tools",
     {{"", {}},
      {"settings", {""}},
      {"inputs", {"settings", ""}},
      {"audit", {"floor", "inputs", "settings", ""}},
      {"touches", {"settings", ""}},
      {"setup", {"audit", "inputs", "settings", ""}},
      {"replay", {"touches", "inputs", "settings", ""}},
      {"solid", {"replay", "touches", "inputs", "settings", ""}},
      {"world", {"person", "audit", "replay", "touches", "inputs", "settings", ""}},
      {"ask", {"world", "inputs", "settings", ""}},
      {"stream", {"world", "touches", "inputs", "settings", ""}},
      {"glb", {"world", "solid", "replay", "touches", "inputs", "settings", ""}},
      {"colliders", {"glb", "inputs", "settings", ""}},
      {"sweep", {"glb", "inputs", "settings", ""}},
      {"log", {"stream", "replay", "touches", "inputs", "settings", ""}},
      {"report",
       {"world", "person", "solid", "feet", "floor", "setup", "log", "audit", "replay", "touches",
        "inputs", "settings", ""}},
      {"view", {"report", "person", "stream", "settings", ""}},
      {"batch", {"settings", ""}},
      {"floor", {"inputs", "settings", ""}},
      {"feet", {"floor", "setup", "inputs", "settings", ""}},
      {"repair", {"feet", "floor", "inputs", "settings", ""}},
      {"person", {"inputs", "settings", ""}},
      {"certificate", {"inputs", "settings", ""}},
      {"commands",
       {"ask",    "batch",  "certificate", "colliders", "feet",   "floor",    "repair", "person",
        "view",   "report", "log",         "sweep",     "glb",    "world",    "solid",  "stream",
        "replay", "setup",  "touches",     "audit",     "inputs", "settings", ""}}}},
};

/// Libraries that only these folders may include, by the include's first word.
const std::map<std::string, std::set<std::string>> kLibraries = {
    {"embree3", {"middleware", "tests/reference"}},
    {"assimp", {"assets"}},
    {"hwy", {"lss", "articulated", "tessellation", "middleware", "tests/reference"}},
    {"nlohmann", {"assets", "tools", "bench"}},
    {"fmt", {"assets", "tools", "bench", "examples"}},
    {"urdf_model", {"assets"}},
    {"urdf_parser", {"assets"}},
    {"tinyxml.h", {"assets"}},
    {"console_bridge", {"assets"}},
    {"lcm", {"network"}},
    // Generated from network/wire/lcm; and what others include, in the example in C++, from one
    // header of C to the next, and where two builds of the C library are compared.
    {"foretouch", {"integrations", "network", "examples", "bindings", "bench"}},
    {"xxhash.h", {"assets", "network", "tools"}},
    {"boost", {"judge", "middleware", "tests/reference"}},
    {"quadmath.h", {"judge"}},
    {"toml++", {"tools"}},
    {"httplib.h", {"network"}},
    {"CLI", {"tools", "bench"}},
    {"meshoptimizer.h", {"assets", "tools"}},
    {"recastnavigation", {"tools"}},
    {"draco", {"assets"}},
    {"pybind11", {"bindings"}},
    {"ompl", {"planning", "examples"}},
    {"fcl", {"bench"}},
    {"ccd", {"bench"}},
    {"BulletCollision", {"bench"}},
    {"LinearMath", {"bench"}},
    {"btBulletCollisionCommon.h", {"bench"}},
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

/// The folder of kArrows that holds the file; of tests there is one alone, the reference room.
std::string folderOf(const std::string& path) {
  const std::string room = "tests/reference";
  return path.rfind(room + "/", 0) == 0 ? room : firstWord(path);
}

TEST(IncludeArrows, PointOneWay) {
  const fs::path root(FORETOUCH_SOURCE_DIR);
  int seen = 0;
  for (const auto& [folder, allowed] : kArrows) {
    for (const Include& include : includesOf(root / folder)) {
      if (!include.quoted) continue;
      ++seen;
      const std::string target = folderOf(include.target);
      // A program that a reader takes away takes what is beside it along; so does an add-on of a
      // host.
      const fs::path own = include.file.parent_path();
      const bool isTaken = own == root / "examples/cpp" || folder == "integrations";
      const bool isBeside = isTaken && fs::exists(own / include.target);
      EXPECT_TRUE(target == folder || allowed.count(target) != 0 || isBeside)
          << include.file << " includes " << include.target;
    }
  }
  EXPECT_GT(seen, 50);
}

TEST(IncludeArrows, EveryFolderWithSourcesIsListed) {
  const std::set<std::string> others = {"tests", "docs", "cmake", "dev", "viewer", "build", "out"};
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

/// The room of a file of `folder`, whose path begins with the folder.
std::string roomOf(const std::string& path) {
  const std::size_t folder = path.find('/'), room = path.find('/', folder + 1);
  return room == std::string::npos ? "" : path.substr(folder + 1, room - folder - 1);
}

TEST(IncludeArrows, PointOneWayBetweenRooms) {
  const fs::path root(FORETOUCH_SOURCE_DIR);
  for (const auto& [folder, rooms] : kRooms) {
    int seen = 0;
    for (const Include& include : includesOf(root / folder)) {
      const std::string from = include.file.lexically_relative(root).string();
      if (!include.quoted || firstWord(include.target) != folder) continue;
      if (from == "tools/main.cpp" || from == "tools/demo_main.cpp") continue;
      const std::string target = roomOf(include.target);
      const auto room = rooms.find(roomOf(from));
      ++seen;
      EXPECT_TRUE(room != rooms.end() && (target == room->first || room->second.count(target) != 0))
          << from << " includes " << include.target;
    }
    EXPECT_GT(seen, 20) << folder;
  }
}

// What only compares is in the reference room: no program of the product knows the way there.
TEST(IncludeArrows, OnlyBenchmarksEnterTheReferenceRoom) {
  const fs::path root(FORETOUCH_SOURCE_DIR);
  const std::string room = "tests/reference/";
  std::set<std::string> entered;
  for (const auto& [folder, unused] : kArrows) {
    for (const Include& include : includesOf(root / folder)) {
      const std::string from = include.file.lexically_relative(root).string();
      if (include.target.rfind(room, 0) == 0 && from.rfind(room, 0) != 0) entered.insert(folder);
    }
  }
  EXPECT_EQ(entered, std::set<std::string>{"bench"});
}

// What writes JSON has assets/json_writer.h: the library that parses it is slow to compile, and is
// for those who read, and for glTF, which is built as one large document.
TEST(IncludeArrows, JsonIsParsedInFewRooms) {
  const fs::path root(FORETOUCH_SOURCE_DIR);
  std::set<std::string> rooms;
  for (const char* folder : {"assets", "network", "tools", "bindings", "examples"}) {
    for (const Include& include : includesOf(root / folder)) {
      if (firstWord(include.target) != "nlohmann") continue;
      rooms.insert(folder + ("/" + roomOf(include.file.lexically_relative(root).string())));
    }
  }
  EXPECT_EQ(rooms,
            (std::set<std::string>{"assets/avatar", "assets/bounds", "assets/clip", "assets/import",
                                   "assets/mesh", "tools/batch", "tools/colliders", "tools/glb",
                                   "tools/inputs", "tools/solid", "tools/sweep"}));
}

/// A header and its source are one unit.
std::string unitOf(const std::string& path) {
  const std::string stem = path.substr(0, path.rfind('.'));
  const std::string inl = "-inl";
  const bool isInline =
      stem.size() > inl.size() && stem.compare(stem.size() - inl.size(), inl.size(), inl) == 0;
  return isInline ? stem.substr(0, stem.size() - inl.size()) : stem;
}

using Units = std::map<std::string, std::set<std::string>>;

/// A circle among the units that each unit includes, as a path back to where it began; empty where
/// there is none.
std::vector<std::string> circleIn(const Units& units) {
  enum class Mark { New, Open, Done };
  std::map<std::string, Mark> marks;
  std::vector<std::string> path, circle;
  const std::function<bool(const std::string&)> visit = [&](const std::string& unit) {
    if (marks[unit] == Mark::Done) return false;
    path.push_back(unit);
    if (marks[unit] == Mark::Open) {
      circle.assign(std::find(path.begin(), path.end(), unit), path.end());
      return true;
    }
    marks[unit] = Mark::Open;
    const auto included = units.find(unit);
    if (included != units.end()) {
      for (const std::string& next : included->second) {
        if (visit(next)) return true;
      }
    }
    marks[unit] = Mark::Done;
    path.pop_back();
    return false;
  };
  for (const auto& [unit, unused] : units) {
    if (visit(unit)) break;
  }
  return circle;
}

TEST(IncludeArrows, NoUnitsIncludeEachOtherInACircle) {
  const fs::path root(FORETOUCH_SOURCE_DIR);
  Units units;
  for (const auto& [folder, unused] : kArrows) {
    for (const Include& include : includesOf(root / folder)) {
      if (!include.quoted) continue;
      const std::string from = unitOf(include.file.lexically_relative(root).string());
      const std::string to = unitOf(include.target);
      if (from != to) units[from].insert(to);
    }
  }
  EXPECT_GT(units.size(), 300u);
  std::string circle;
  for (const std::string& unit : circleIn(units)) circle += "\n  " + unit;
  EXPECT_EQ(circle, "");
}

/// What the files of TypeScript below a folder import of each other.
void addImports(const fs::path& root, const fs::path& folder, Units& units) {
  const std::regex imported("from \"(\\.[^\"]+)\"");
  for (auto entry = fs::recursive_directory_iterator(folder);
       entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
    if (entry->path().extension() != ".ts") continue;
    const std::string content = contentOf(entry->path());
    const fs::path file = entry->path().lexically_relative(root);
    for (std::sregex_iterator found(content.begin(), content.end(), imported), end; found != end;
         ++found) {
      const fs::path target = (file.parent_path() / (*found)[1].str()).lexically_normal();
      units[unitOf(file.string())].insert(unitOf(target.string()));
    }
  }
}

TEST(IncludeArrows, NoFilesOfTypeScriptImportEachOtherInACircle) {
  const fs::path root(FORETOUCH_SOURCE_DIR);
  Units units;
  for (const char* const folder : {"bindings/wasm", "integrations", "viewer"}) {
    addImports(root, root / folder, units);
  }
  EXPECT_GT(units.size(), 100u);
  std::string circle;
  for (const std::string& unit : circleIn(units)) circle += "\n  " + unit;
  EXPECT_EQ(circle, "");
}

TEST(IncludeArrows, CirclesOfUnitsAreFound) {
  EXPECT_TRUE(circleIn({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {"d"}}}).empty());
  EXPECT_EQ(circleIn({{"a", {"b"}}, {"b", {"c"}}, {"c", {"d", "b"}}}),
            (std::vector<std::string>{"b", "c", "b"}));
  EXPECT_EQ(unitOf("middleware/lanes/lss_pairs-inl.h"), unitOf("middleware/lanes/lss_pairs.cpp"));
}

// Who checks a certificate for a stranger may not share code with who wrote it.
TEST(IncludeArrows, VerifierKnowsOnlyItself) {
  int seen = 0;
  for (const Include& include : includesOf(fs::path(FORETOUCH_SOURCE_DIR) / "verify")) {
    const std::string word = firstWord(include.target);
    const bool isStandard = word.find('.') == std::string::npos && word == include.target;
    EXPECT_TRUE(include.quoted ? word == "verify" : isStandard)
        << include.file << " includes " << include.target;
    ++seen;
  }
  EXPECT_GT(seen, 20);
}

// Inside bench/, the peers of `foretouch-bench peers` are known to their own sources alone.
TEST(IncludeArrows, PeersStayBehindTheirDoor) {
  // How the names of the files begin that may know them; bullet_mesh.h shows Bullet's types.
  const std::map<std::string, std::string> rooms = {{"fcl", "fcl_"},
                                                    {"BulletCollision", "bullet_"},
                                                    {"btBulletCollisionCommon.h", "bullet_"},
                                                    {"btBulletDynamicsCommon.h", "bullet_"},
                                                    {"bench/peers/bullet_mesh.h", "bullet_"}};
  std::set<std::string> seen;
  for (const Include& include : includesOf(fs::path(FORETOUCH_SOURCE_DIR) / "bench")) {
    const auto room = rooms.find(include.quoted ? include.target : firstWord(include.target));
    if (room == rooms.end()) continue;
    EXPECT_EQ(include.file.filename().string().rfind(room->second, 0), 0u)
        << include.file << " " << include.target;
    seen.insert(room->first);
  }
  EXPECT_EQ(seen.size(), rooms.size());
}

// The judge may not share code with what it judges: only its own, the language's, and numbers of
// many digits. These headers cost seconds in every source that sees them, so that few do.
TEST(IncludeArrows, OracleSharesNoCodeWithTheProduct) {
  std::set<std::string> files, ofNumbers;
  for (const Include& include : includesOf(fs::path(FORETOUCH_SOURCE_DIR) / "judge")) {
    const std::string word = firstWord(include.target);
    const bool isOfNumbers = word == "boost" || word == "quadmath.h";
    const bool isStandard = word.find('.') == std::string::npos && word == include.target;
    files.insert(include.file.filename().string());
    EXPECT_TRUE(include.quoted ? word == "judge" : isStandard || isOfNumbers)
        << include.file << " includes " << include.target;
    if (isOfNumbers) ofNumbers.insert(include.file.filename().string());
  }
  EXPECT_GT(files.size(), 20u);
  EXPECT_EQ(ofNumbers, (std::set<std::string>{"precise.cpp", "rational_polynomial.h", "wide.h"}));
}

}  // namespace
