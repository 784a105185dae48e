// How much there is of the product: numbers that may fall and never rise unseen. Whoever lets one
// rise changes tests/house/ratchet.txt, in a commit that says why.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/house/cpp_tokens.h"
#include "tests/house/defined_names.h"
#include "tests/house/source_files.h"

namespace foretouch::house {
namespace {

namespace fs = std::filesystem;

using Counts = std::map<std::string, std::size_t>;  // by what is counted
using Ratchet = std::map<std::string, Counts>;      // by folder; "product": all of kProduct

const std::vector<std::string> kProduct = {"lss",    "articulated", "tessellation", "middleware",
                                           "assets", "network",     "tools",        "bindings",
                                           "verify", "planning"};
const std::vector<std::string> kBeside = {"bench", "examples", "judge"};

/// What a program begins with that asks something of the kernel.
const std::set<std::string> kDoors = {
    "Query",     "NearQuery", "ClearanceQuery", "BracketQuery", "PairBracketQuery", "LinkDepths",
    "EdgeQuery", "World",     "WorldFollower",  "Triggers",     "SolidAvatar",      "SolidWorld"};

/// Lines of code that stand in so many one after the other that stand elsewhere as well are
/// repeated.
constexpr std::size_t kRun = 6;

struct Source {
  std::string folder;  ///< "lss", "middleware/query".
  std::string path;    ///< From the root.
  std::string text;
};

fs::path root() {
  return FORETOUCH_SOURCE_DIR;
}

bool isHeader(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  return extension == ".h" || extension == ".hpp";
}

std::vector<Source> sourcesOf(const std::string& top) {
  std::vector<Source> sources;
  for (const auto& entry : fs::recursive_directory_iterator(root() / top)) {
    const std::string path = entry.path().lexically_relative(root()).generic_string();
    if (!isHeader(path) && entry.path().extension() != ".cpp") continue;
    const std::string folder =
        top == "middleware" ? fs::path(path).parent_path().generic_string() : top;
    sources.push_back({folder, path, contentOf(entry.path())});
  }
  const auto byPath = [](const Source& a, const Source& b) { return a.path < b.path; };
  std::sort(sources.begin(), sources.end(), byPath);
  return sources;
}

/// As foretouch_library() is told them.
std::set<std::string> installedHeaders() {
  const std::regex list("HEADERS((\\s+[\\w/]+\\.hp*)+)"), one("\\S+");
  std::set<std::string> headers;
  for (const std::string& top : kProduct) {
    const std::string text = contentOf(root() / top / "CMakeLists.txt");
    std::smatch found;
    if (!std::regex_search(text, found, list)) continue;
    const std::string names = found[1];
    for (std::sregex_iterator name(names.begin(), names.end(), one), end; name != end; ++name) {
      headers.insert(top + "/" + name->str());
    }
  }
  return headers;
}

std::string lastWord(const std::string& name) {
  const std::string plain = name.substr(0, name.find('('));
  const std::size_t colon = plain.rfind(':');
  return colon == std::string::npos ? plain : plain.substr(colon + 1);
}

bool endsIn(const std::string& name, const std::string& end) {
  return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

void raise(std::size_t& count, std::size_t to) {
  count = std::max(count, to);
}

void countFile(const Source& source, bool isInstalled, Counts& counts) {
  counts["lines"] +=
      static_cast<std::size_t>(std::count(source.text.begin(), source.text.end(), '\n'));
  counts["installed"] += isInstalled ? 1 : 0;
  for (const DefinedName& found : definedNames(source.text)) {
    if (found.kind == NameKind::Type && isHeader(source.path)) ++counts["types"];
    if (found.kind != NameKind::Function) continue;
    raise(counts["longest"], static_cast<std::size_t>(found.lastLine - found.line + 1));
  }
}

/// Of the kernel's headers that are installed.
void countWordsOf(const Source& source, Counts& counts) {
  std::set<std::string> words;
  for (const Token& token : cppTokens(source.text)) words.insert(token.text);
  for (const DefinedName& found : definedNames(source.text)) {
    if (found.kind != NameKind::Type) continue;
    const std::string name = lastWord(found.name);
    counts["doors"] += kDoors.count(name);
    counts["pools"] += endsIn(name, "Pool") ? 1 : 0;
    counts["scratch"] += endsIn(name, "Scratch") ? 1 : 0;
  }
  counts["doors"] += words.count("depthIn");
}

/// The lines of a source as its tokens, without those that hold no word.
std::vector<std::string> codeLines(const std::string& text) {
  std::vector<std::string> lines;
  int last = 0;
  for (const Token& token : cppTokens(text)) {
    if (token.line != last) lines.emplace_back();
    last = token.line;
    lines.back() += token.text + " ";
  }
  const auto hasNoWord = [](const std::string& line) {
    return std::none_of(line.begin(), line.end(), [](char c) { return std::isalpha(c) != 0; });
  };
  lines.erase(std::remove_if(lines.begin(), lines.end(), hasNoWord), lines.end());
  return lines;
}

std::size_t repeatedLines(const std::vector<std::vector<std::string>>& files) {
  std::map<std::string, std::vector<std::pair<std::size_t, std::size_t>>> places;
  for (std::size_t file = 0; file < files.size(); ++file) {
    for (std::size_t line = 0; line + kRun <= files[file].size(); ++line) {
      std::string run;
      for (std::size_t i = 0; i < kRun; ++i) run += files[file][line + i] + "\n";
      places[run].emplace_back(file, line);
    }
  }
  std::set<std::pair<std::size_t, std::size_t>> repeated;
  for (const auto& [run, where] : places) {
    if (where.size() < 2) continue;
    for (const auto& [file, line] : where) {
      for (std::size_t i = 0; i < kRun; ++i) repeated.emplace(file, line + i);
    }
  }
  return repeated.size();
}

Ratchet counted() {
  const std::set<std::string> installed = installedHeaders();
  Ratchet ratchet;
  std::vector<std::vector<std::string>> lines;
  for (const auto* const tops : {&kProduct, &kBeside}) {
    for (const std::string& top : *tops) {
      for (const Source& source : sourcesOf(top)) {
        const bool isInstalled = installed.count(source.path) != 0;
        countFile(source, isInstalled, ratchet[source.folder]);
        if (tops == &kBeside) continue;
        countFile(source, isInstalled, ratchet["product"]);
        if (isInstalled && top == "middleware") countWordsOf(source, ratchet["kernel"]);
        if (top == "middleware") countFile(source, isInstalled, ratchet["kernel"]);
        lines.push_back(codeLines(source.text));
      }
    }
  }
  ratchet["product"]["repeated"] = repeatedLines(lines);
  return ratchet;
}

std::string written(const Ratchet& ratchet) {
  std::ostringstream out;
  for (const auto& [folder, counts] : ratchet) {
    out << folder;
    for (const auto& [what, count] : counts) out << "  " << what << ' ' << count;
    out << '\n';
  }
  return out.str();
}

Ratchet read(const std::string& text) {
  Ratchet ratchet;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string folder, what;
    words >> folder;
    for (std::size_t count = 0; words >> what >> count;) ratchet[folder][what] = count;
  }
  return ratchet;
}

/// One complaint per number that rose, one remark per number that fell.
struct Changes {
  std::vector<std::string> risen, fallen;
};
Changes changesOf(const Ratchet& was, const Ratchet& is) {
  Changes changes;
  Ratchet all = was;
  for (const auto& [folder, counts] : is) all[folder].insert(counts.begin(), counts.end());
  const auto of = [](const Ratchet& ratchet, const std::string& folder, const std::string& what) {
    const auto counts = ratchet.find(folder);
    if (counts == ratchet.end()) return std::size_t{0};
    const auto count = counts->second.find(what);
    return count == counts->second.end() ? std::size_t{0} : count->second;
  };
  for (const auto& [folder, counts] : all) {
    for (const auto& entry : counts) {
      const std::size_t before = of(was, folder, entry.first), now = of(is, folder, entry.first);
      if (before == now) continue;
      const std::string text =
          folder + ": " + entry.first + " " + std::to_string(before) + " -> " + std::to_string(now);
      (now > before ? changes.risen : changes.fallen).push_back(text);
    }
  }
  return changes;
}

TEST(Ratchet, NoNumberRises) {
  const fs::path committed = root() / "tests/house/ratchet.txt";
  const fs::path made = fs::path(FORETOUCH_HOUSE_BUILD_DIR) / "ratchet.txt";
  const Ratchet now = counted();
  std::ofstream(made) << written(now);
  const Changes changes = changesOf(read(contentOf(committed)), now);
  for (const std::string& text : changes.risen) ADD_FAILURE() << text;
  for (const std::string& text : changes.fallen) std::cout << text << '\n';
  if (!changes.risen.empty()) std::cout << "if it must be, in a commit that says why:\n";
  if (!changes.risen.empty() || !changes.fallen.empty()) {
    std::cout << "record with: cp " << made.string() << " tests/house/ratchet.txt\n";
  }
  EXPECT_GT(now.at("product").at("lines"), 50000U);
}

TEST(Ratchet, SaysWhatRoseAndWhatFell) {
  const Ratchet was = read("a  lines 10  types 2\nb  lines 5\n");
  EXPECT_EQ(written(was), "a  lines 10  types 2\nb  lines 5\n");
  const Changes changes = changesOf(was, read("a  lines 11  types 1\nc  lines 1\n"));
  EXPECT_EQ(changes.risen, (std::vector<std::string>{"a: lines 10 -> 11", "c: lines 0 -> 1"}));
  EXPECT_EQ(changes.fallen, (std::vector<std::string>{"a: types 2 -> 1", "b: lines 5 -> 0"}));
}

TEST(Ratchet, CountsWhatAFileHolds) {
  Counts counts;
  countFile(
      {"a", "a/b.h", "struct A {\n  int b;\n};\nenum class B { C };\nint f() {\n  return 1;\n}\n"},
      true, counts);
  EXPECT_EQ(written({{"a", counts}}), "a  installed 1  lines 7  longest 3  types 2\n");
}

TEST(Ratchet, CountsLinesThatAreRepeated) {
  std::string run;
  for (std::size_t i = 0; i < kRun; ++i) run += "f" + std::to_string(i) + "();\n}\n";
  const auto once = codeLines(run + "g();\n"), again = codeLines("h();\n" + run);
  EXPECT_EQ(repeatedLines({once}), 0U);
  EXPECT_EQ(repeatedLines({once, again}), 2 * kRun);
}

}  // namespace
}  // namespace foretouch::house
