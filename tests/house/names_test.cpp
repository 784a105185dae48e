// Names that two sources define: what the compiler need not tell (it is undefined behaviour, no
// diagnostic required) and the linker settles by chance. Found in the text, where inlined functions
// and folded constants still are; and in the objects, where macros have been expanded.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/house/defined_names.h"
#include "tests/house/object_names.h"
#include "tests/house/source_files.h"

namespace foretouch::house {
namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::vector<DefinedName>>;  // what they define, by path

/// Compiled instead of other files where Embree, the importer or POSIX is not: they define the same
/// names.
const std::set<std::string>& standIns() {
  static const std::set<std::string> files = {"no_import.cpp", "no_importer_place.cpp",
                                              "point_query_plain.cpp", "system_files_windows.cpp"};
  return files;
}

Files sourcesIn(const fs::path& folder) {
  Files files;
  for (auto at = fs::recursive_directory_iterator(folder); at != fs::end(at); ++at) {
    const fs::directory_entry& entry = *at;
    if (entry.path().filename() == "node_modules") at.disable_recursion_pending();
    const fs::path extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    if (standIns().count(entry.path().filename().string()) != 0) continue;
    files[entry.path().string()] = definedNames(contentOf(entry.path()));
  }
  return files;
}

/// Everything but the tests.
Files productSources() {
  const std::set<std::string> others = {"tests", "docs", "cmake", "viewer", "build", "out"};
  Files files;
  for (const auto& entry : fs::directory_iterator(fs::path(FORETOUCH_SOURCE_DIR))) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || name.front() == '.' || others.count(name) != 0) continue;
    files.merge(sourcesIn(entry.path()));
  }
  return files;
}

/// "name: file:line, file:line" of each name that two of the files define.
std::vector<std::string> definedTwice(const Files& files) {
  // What every program and every fuzz target has to define.
  const std::set<std::string> entries = {"main()", "main(int,char**)",
                                         "LLVMFuzzerTestOneInput(const std::uint8_t*,std::size_t)"};
  std::map<std::string, std::map<std::string, int>> places;
  for (const auto& [path, defined] : files) {
    for (const DefinedName& found : defined) {
      if (!found.isLocal && entries.count(found.name) == 0) places[found.name][path] = found.line;
    }
  }
  std::vector<std::string> twice;
  for (const auto& [name, lines] : places) {
    if (lines.size() < 2) continue;
    twice.push_back(name + ":");
    for (const auto& [path, line] : lines) {
      twice.back() += " " + path + ":" + std::to_string(line);
    }
  }
  return twice;
}

TEST(DefinedNames, EachHasOneFile) {
  const Files product = productSources();
  EXPECT_GT(product.size(), 400U);
  for (const std::string& name : definedTwice(product)) ADD_FAILURE() << name;
}

// Each of these folders becomes programs of its own.
TEST(DefinedNames, TestsHaveThemOnceAPiece) {
  const fs::path tests = fs::path(FORETOUCH_SOURCE_DIR) / "tests";
  Files shared = productSources();
  shared.merge(sourcesIn(tests / "support"));
  int folders = 0;
  for (const auto& entry : fs::directory_iterator(tests)) {
    if (!entry.is_directory() || entry.path().filename() == "support") continue;
    Files all = shared;
    for (const auto& [path, defined] : sourcesIn(entry.path())) {
      if (path.find("/house/twins/") == std::string::npos) all[path] = defined;
    }
    for (const std::string& name : definedTwice(all)) ADD_FAILURE() << name;
    ++folders;
  }
  EXPECT_GT(folders, 8);
}

/// What a constant that rounding is counted with ends in.
bool isOfRounding(const std::string& name) {
  for (const char* const ending :
       {"Inflation", "Padding", "Rounding", "Roundoff", "Shrink", "Underflow"}) {
    const std::string end = ending;
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0) {
      return true;
    }
  }
  return false;
}

// Even where each is local to its file: a proof that names one must not be read with another's
// value.
TEST(DefinedNames, ConstantsOfProofsHaveOneValueEach) {
  std::map<std::string, std::set<std::string>> places;
  for (const char* const folder : {"lss", "articulated", "tessellation", "middleware"}) {
    for (const auto& [path, defined] : sourcesIn(fs::path(FORETOUCH_SOURCE_DIR) / folder)) {
      for (const DefinedName& found : defined) {
        const std::string name = found.name.substr(found.name.rfind(':') + 1);
        if (found.kind == NameKind::Variable && isOfRounding(name)) places[name].insert(path);
      }
    }
  }
  EXPECT_GT(places.size(), 20U);
  for (const auto& [name, files] : places) {
    EXPECT_EQ(files.size(), 1U) << name << ": " << *files.begin() << " " << *files.rbegin();
  }
}

std::vector<std::string> names(const std::string& source) {
  std::vector<std::string> found;
  for (const DefinedName& name : definedNames(source)) {
    found.push_back((name.isLocal ? "local " : "") + name.name);
  }
  return found;
}

using Names = std::vector<std::string>;

TEST(DefinedNames, AreReadFromText) {
  EXPECT_EQ(names("namespace a::b {\n[[nodiscard]] inline float above(double x) { return x; }\n}"),
            Names{"a::b::above(double)"});
  EXPECT_EQ(names("inline constexpr double kOne = 12.0 * 0x1p-24, kTwo = f(1, 2);"),
            (Names{"kOne", "kTwo"}));
  EXPECT_EQ(names("constexpr std::array<double, 2> kPair = {1, 2}; int table[3] = {};"),
            (Names{"kPair", "table"}));
  EXPECT_EQ(names("template <class T> struct Box final : Base<T> { void f() {} T t; };"),
            Names{"Box"});
  EXPECT_EQ(names("struct alignas(64) Row { int i; }; enum class Kind : int { A };"),
            (Names{"Row", "Kind"}));
  EXPECT_EQ(
      names("Pool::Pool(int n) : size_{n}, list_(n) { fill(); } bool operator==(A x, A y) {}"),
      (Names{"Pool::Pool(int)", "operator==(A,A)"}));
  EXPECT_EQ(names("void f(const std::vector<int>& v = {}, std::pair<A, B>) {}"),
            Names{"f(const std::vector<int>&,std::pair<A,B>)"});
  EXPECT_EQ(names("extern \"C\" { int c_one(void) { return 1; } }"), Names{"c_one(void)"});
  EXPECT_EQ(names("namespace a { namespace { int hidden = 1; } }"), Names{"local a::::hidden"});
}

TEST(DefinedNames, DeclarationsAndMembersAreNone) {
  EXPECT_EQ(names("float above(double x);\nclass Later;\nusing A = B<int>;\nextern int e;\n"
                  "static_assert(x == y);\nnamespace hn = hwy::N;\nTwo::~Two() = default;"),
            Names{});
  EXPECT_EQ(names("// int a = 1;\n/* int b = 2; */\n#define C int c = 3; \\\n  int d = 4;\n"),
            Names{});
  EXPECT_EQ(names("const char* text() { return \"int e = 5; }\"; }"), Names{"text()"});
}

/// As definedTwice(), of texts.
Names definedTwiceIn(const std::map<std::string, std::string>& texts) {
  Files files;
  for (const auto& [path, text] : texts) files[path] = definedNames(text);
  return definedTwice(files);
}

// As they stood: one function by two laws, and one constant with two values that are both folded.
TEST(DefinedNames, TwinsAreFound) {
  const std::string room = "namespace foretouch::internal {\n";
  const std::string tight = room + "float floatAbove(double x) {\n  return next(x);\n}\n}";
  const std::string padded =
      room + "[[nodiscard]] inline float floatAbove(double number) { return pad(number); }\n}";
  EXPECT_EQ(definedTwiceIn({{"culler.cpp", tight}, {"point_rounding.h", padded}}),
            Names{"foretouch::internal::floatAbove(double): culler.cpp:2 point_rounding.h:2"});

  const std::string fine = room + "inline constexpr double kPlane = 12.0 * kUnitRoundoff;\n}";
  const std::string coarse = room + "inline constexpr double kPlane = 12.0 * 0x1p-24;\n}";
  EXPECT_EQ(definedTwiceIn({{"filter.h", fine}, {"lanes.cpp", coarse}}),
            Names{"foretouch::internal::kPlane: filter.h:2 lanes.cpp:2"});

  const std::string type = room + "struct Later { int i; };\n}";
  EXPECT_EQ(definedTwiceIn({{"a.cpp", type}, {"b.cpp", type}}).size(), 1U);

  const fs::path twins = fs::path(FORETOUCH_SOURCE_DIR) / "tests" / "house" / "twins";
  EXPECT_EQ(definedTwice(sourcesIn(twins)).size(), 1U);
}

TEST(DefinedNames, OverloadsLocalsAndOtherNamespacesAreNoTwins) {
  const Names none;
  EXPECT_EQ(definedTwiceIn({{"a.cpp", "const char* text(Scope s) {}"},
                            {"b.cpp", "const char* text(Verdict v) {}"}}),
            none);
  EXPECT_EQ(definedTwiceIn({{"a.cpp", "namespace { int a = 1; }"}, {"b.cpp", "int a = 2;"}}), none);
  EXPECT_EQ(definedTwiceIn({{"a.cpp", "namespace x { int a = 1; }"}, {"b.cpp", "int a = 2;"}}),
            none);
}

/// What `nm` prints of the objects that the file lists.
std::string namesOfObjects(const std::string& list) {
  const std::string command =
      std::string("\"") + FORETOUCH_NM + "\" -A -g --defined-only \"@" + list + "\"";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 65536> block{};
  for (std::size_t size = 1; pipe != nullptr && size > 0;) {
    size = std::fread(block.data(), 1, block.size(), pipe.get());
    text.append(block.data(), size);
  }
  return text;
}

TEST(ObjectNames, AreDefinedByOneSourceEach) {
  const std::string list = std::string(FORETOUCH_HOUSE_BUILD_DIR) + "/product_objects.txt";
  std::ifstream objects(list);
  int count = 0;
  for (std::string object; std::getline(objects, object); ++count) {
    ASSERT_TRUE(fs::exists(object)) << "build everything first; there is no " << object;
  }
  EXPECT_GT(count, 60);
  for (const Clash& clash : clashesIn(namesOfObjects(list))) {
    ADD_FAILURE() << clash.name << ": " << *clash.objects.begin() << " and "
                  << *clash.objects.rbegin();
  }
}

// tests/house/twins/ defines a function in a source and, by another law, in a header.
TEST(ObjectNames, TwinsAreFound) {
  const auto clashes =
      clashesIn(namesOfObjects(std::string(FORETOUCH_HOUSE_BUILD_DIR) + "/twin_objects.txt"));
  ASSERT_EQ(clashes.size(), 1U);
  EXPECT_NE(clashes[0].name.find("roundedUp"), std::string::npos);
  EXPECT_EQ(clashes[0].objects.size(), 2U);
}

TEST(ObjectNames, HeadersAndSourcesOfTwoTargetsAreNoTwins) {
  EXPECT_TRUE(clashesIn("a/one.cpp.o:0 W inHeader\na/two.cpp.o:0 W inHeader\n").empty());
  EXPECT_TRUE(clashesIn("a/CMakeFiles/x.dir/one.cpp.o:0 T f\na/CMakeFiles/y.dir/one.cpp.o:0 T f\n")
                  .empty());
  EXPECT_TRUE(clashesIn("a/one.cpp.o:0 T main\nb/two.cpp.o:0 T main\n").empty());
  EXPECT_EQ(clashesIn("a/one.cpp.o:0 T f\nb/two.cpp.o:0 T f\n").size(), 1U);
  EXPECT_EQ(clashesIn("a/one.cpp.o:0 D k\nb/two.cpp.o:0 V k\n").size(), 1U);
}

}  // namespace
}  // namespace foretouch::house
