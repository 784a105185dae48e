// What the documents say of files: every relative link leads to a file, and to a heading of it;
// every path in code spans is one of the repository. And that nothing but people has written them.
#include "tests/house/documents.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/house/source_files.h"

namespace foretouch::house {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> documents() {
  return documentsBelow(FORETOUCH_SOURCE_DIR);
}

/// The text without code blocks and code spans: what looks like a link there is none.
std::string withoutCode(const std::string& text) {
  std::istringstream lines(text);
  std::string kept, line;
  bool isCode = false;
  while (std::getline(lines, line)) {
    const bool isFence = line.rfind("```", 0) == 0;
    if (isFence) isCode = !isCode;
    if (!isCode && !isFence) kept += line + "\n";
  }
  return std::regex_replace(kept, std::regex("`[^`\n]*`"), "code");
}

/// As the well-known hosts make anchors of headings: small letters, digits, - and _ stay, blanks
/// become -, all else goes.
std::string anchorOf(const std::string& heading) {
  std::string anchor;
  for (const unsigned char c : heading) {
    if (std::isalnum(c) != 0 || c == '-' || c == '_' || c >= 0x80) {
      anchor += static_cast<char>(std::tolower(c));
    } else if (c == ' ') {
      anchor += '-';
    }
  }
  return anchor;
}

std::set<std::string> anchorsIn(const fs::path& path) {
  std::set<std::string> anchors;
  std::map<std::string, int> seen;
  std::istringstream lines(contentOf(path));
  std::string line;
  bool isCode = false;
  while (std::getline(lines, line)) {
    if (line.rfind("```", 0) == 0) isCode = !isCode;
    const std::size_t text = line.find_first_not_of('#');
    if (isCode || text == 0 || text == std::string::npos || line[text] != ' ') continue;
    const std::string anchor = anchorOf(line.substr(text + 1));
    const int before = seen[anchor]++;
    anchors.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
  }
  return anchors;
}

std::vector<std::string> targetsIn(const std::string& text) {
  static const std::regex kLink(R"re(\]\(([^()\s]+)\)|(?:src|href|srcset)="([^"]+)")re");
  std::vector<std::string> targets;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), kLink);
       at != std::sregex_iterator(); ++at) {
    targets.push_back((*at)[1].matched ? (*at)[1].str() : (*at)[2].str());
  }
  return targets;
}

bool isElsewhere(const std::string& target) {
  return target.find("://") != std::string::npos || target.rfind("mailto:", 0) == 0;
}

TEST(Documents, EveryRelativeLinkLeadsSomewhere) {
  int links = 0, anchors = 0;
  for (const fs::path& document : documents()) {
    for (const std::string& target : targetsIn(withoutCode(contentOf(document)))) {
      if (isElsewhere(target)) continue;
      ++links;
      const std::size_t hash = target.find('#');
      const std::string path = target.substr(0, hash);
      const fs::path file = path.empty() ? document : document.parent_path() / path;
      EXPECT_TRUE(fs::exists(file)) << document << " links to " << target;
      if (hash == std::string::npos) continue;
      ++anchors;
      EXPECT_EQ(anchorsIn(file).count(target.substr(hash + 1)), 1u)
          << document << " links to " << target << ", and no heading is called so";
    }
  }
  EXPECT_GT(links, 20);
  EXPECT_GT(anchors, 5);
}

/// The words of all code spans outside code blocks: paths, and what else is set as code.
std::vector<std::string> wordsInCodeSpans(const std::string& text) {
  static const std::regex kSpan("`([^`\n]+)`");
  std::vector<std::string> words;
  std::istringstream lines(text);
  std::string line;
  bool isCode = false;
  while (std::getline(lines, line)) {
    const std::size_t first = line.find_first_not_of(' ');
    const bool isFence = first != std::string::npos && line.compare(first, 3, "```") == 0;
    if (isFence) isCode = !isCode;
    if (isFence || isCode) continue;
    for (auto at = std::sregex_iterator(line.begin(), line.end(), kSpan);
         at != std::sregex_iterator(); ++at) {
      std::istringstream span((*at)[1].str());
      for (std::string word; span >> word;) words.push_back(word);
    }
  }
  return words;
}

/// `{a,b}.h` as a.h and b.h.
std::vector<std::string> withoutBraces(const std::string& path) {
  const std::size_t open = path.find('{'), close = path.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return {path};
  std::vector<std::string> paths;
  std::istringstream choices(path.substr(open + 1, close - open - 1));
  for (std::string choice; std::getline(choices, choice, ',');) {
    for (std::string& one : withoutBraces(path.substr(0, open) + choice + path.substr(close + 1)))
      paths.push_back(std::move(one));
  }
  return paths;
}

/// Whether `name` is what `pattern` says, in which * stands for anything.
bool isLike(const std::string& name, const std::string& pattern) {
  const std::string dots = std::regex_replace(pattern, std::regex(R"(\.)"), R"(\.)");
  return std::regex_match(name, std::regex(std::regex_replace(dots, std::regex(R"(\*)"), ".*")));
}

/// Whether anything below `folder` has the path, whose parts may have a *.
bool isBelow(const fs::path& folder, const std::string& path) {
  const std::size_t slash = path.find('/');
  const std::string part = path.substr(0, slash);
  const bool isLast = slash == std::string::npos || slash + 1 == path.size();
  if (part.find('*') == std::string::npos) {
    if (!fs::exists(folder / part)) return false;
    return isLast || isBelow(folder / part, path.substr(slash + 1));
  }
  if (!fs::is_directory(folder)) return false;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!isLike(entry.path().filename().string(), part)) continue;
    if (isLast || isBelow(entry.path(), path.substr(slash + 1))) return true;
  }
  return false;
}

/// What the documents may speak of, and what the repository has.
class Repository {
 public:
  explicit Repository(const fs::path& root) : root_(root) {
    const std::set<std::string> made = {"build", "out", "node_modules"};
    for (auto at = fs::recursive_directory_iterator(root); at != fs::recursive_directory_iterator();
         ++at) {
      const std::string name = at->path().filename().string();
      if (at->is_directory() && (name.front() == '.' || made.count(name) != 0)) {
        at.disable_recursion_pending();
      } else if (at->is_directory() && at.depth() == 0) {
        folders_.insert(name);
      } else if (at->is_regular_file()) {
        names_.insert(name);
      }
    }
  }

  /// Whether a word is meant as a file or folder of the repository: it begins with a folder of the
  /// root, or is a path that ends as sources, documents and pictures do.
  [[nodiscard]] bool speaksOf(const std::string& word) const {
    static const std::regex kPath(R"([A-Za-z0-9_.*{},-]+(/[A-Za-z0-9_.*{},-]+)+/?)");
    if (!std::regex_match(word, kPath)) return false;
    return folders_.count(word.substr(0, word.find('/'))) != 0 || endsAsSourcesDo(word);
  }

  /// The same of a name without a folder, by its ending alone.
  [[nodiscard]] static bool speaksOfName(const std::string& word) {
    static const std::regex kName(R"([A-Za-z0-9_*{},-][A-Za-z0-9_.*{},-]*)");
    return std::regex_match(word, kName) && endsAsSourcesDo(word);
  }

  /// From the root, beside the document, among its sources, or as a program includes it.
  [[nodiscard]] bool has(const std::string& path, const fs::path& document) const {
    const std::vector<fs::path> from = {root_, document.parent_path(),
                                        document.parent_path() / "src",
                                        root_ / "bindings" / "c" / "include"};
    const std::vector<std::string> all = withoutBraces(path);
    return std::all_of(all.begin(), all.end(), [&](const std::string& one) {
      return std::any_of(from.begin(), from.end(),
                         [&](const fs::path& folder) { return isBelow(folder, one); });
    });
  }

  [[nodiscard]] bool hasName(const std::string& pattern) const {
    const std::vector<std::string> all = withoutBraces(pattern);
    return std::all_of(all.begin(), all.end(), [&](const std::string& one) {
      return one.find('*') == std::string::npos
                 ? names_.count(one) != 0
                 : std::any_of(names_.begin(), names_.end(),
                               [&](const std::string& name) { return isLike(name, one); });
    });
  }

 private:
  static bool endsAsSourcesDo(const std::string& word) {
    static const std::regex kEnd(R"(.*\.(h|hpp|cpp|c|cs|py|sh|ts|mjs|cmake|md|svg|png))");
    return std::regex_match(word, kEnd);
  }

  fs::path root_;
  std::set<std::string> folders_, names_;
};

/// Older versions had other files, and it tells of them.
bool tellsOfThePast(const fs::path& document) {
  return document.filename() == "CHANGELOG.md";
}

/// A bare name may be of any folder; it is checked where readers come from outside.
bool isGuide(const fs::path& document) {
  const fs::path root(FORETOUCH_SOURCE_DIR);
  return document.parent_path() == root || document.parent_path() == root / "docs";
}

TEST(Documents, EveryPathInCodeSpansIsOneOfTheRepository) {
  const Repository repository(FORETOUCH_SOURCE_DIR);
  int paths = 0, names = 0;
  for (const fs::path& document : documents()) {
    if (tellsOfThePast(document)) continue;
    for (const std::string& word : wordsInCodeSpans(contentOf(document))) {
      if (repository.speaksOf(word)) {
        ++paths;
        EXPECT_TRUE(repository.has(word, document)) << document << " names " << word;
      } else if (isGuide(document) && Repository::speaksOfName(word)) {
        ++names;
        EXPECT_TRUE(repository.hasName(word)) << document << " names " << word;
      }
    }
  }
  EXPECT_GT(paths, 150);
  EXPECT_GT(names, 20);
}

TEST(Documents, StalePathsAreFound) {
  const fs::path root(FORETOUCH_SOURCE_DIR), page = root / "docs" / "page.md";
  const Repository repository(root);
  for (const char* const one : {"docs/README.md", "tests/house/", "tests/house/documents*_test.cpp",
                                "tests/house/documents.{h,cpp}", "pictures/make_pictures.sh",
                                "foretouch/foretouch.h", "tests/*/documents_test.cpp"}) {
    EXPECT_TRUE(repository.speaksOf(one) && repository.has(one, page)) << one;
  }
  for (const char* const one :
       {"tests/house/no_such_test.cpp", "tests/no_such*_test.cpp", "docs/no/", "no/such.h",
        "tests/house/documents.{h,no}", "foretouch/no_such.h"}) {
    EXPECT_TRUE(repository.speaksOf(one) && !repository.has(one, page)) << one;
  }
  // Made by a build, of an installation, by a user, or no file at all.
  for (const char* const one : {"build/packages/", "libexec/foretouch", "walk.bvh", "and/or",
                                "results/table.csv", "--scene", "1/2"}) {
    EXPECT_FALSE(repository.speaksOf(one)) << one;
  }
  EXPECT_TRUE(repository.hasName("documents_test.cpp") && repository.hasName("documents_*.cpp"));
  EXPECT_FALSE(repository.hasName("no_such_test.cpp") || repository.hasName("no_such_*.cpp"));
  EXPECT_EQ(wordsInCodeSpans("a `b c` d\n```\n`no`\n```\n`e`\n"),
            (std::vector<std::string>{"b", "c", "e"}));
}

TEST(Documents, TheIndexLinksEveryOneOfThem) {
  const fs::path folder = fs::path(FORETOUCH_SOURCE_DIR) / "docs";
  const std::vector<std::string> linked = targetsIn(contentOf(folder / "README.md"));
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".md" || name == "README.md") continue;
    EXPECT_NE(std::find(linked.begin(), linked.end(), name), linked.end())
        << name << " is not in docs/README.md";
  }
}

TEST(Documents, TheReferenceHasEveryInstalledHeaderInItsOrderOnce) {
  std::string text = contentOf(fs::path(FORETOUCH_SOURCE_DIR) / "docs" / "api.md");
  text.erase(0, text.find("### The headers, in the order to read them"));
  text.erase(text.find("\n\n", text.find("|---|")));
  const fs::path build = fs::path(FORETOUCH_HOUSE_BUILD_DIR).parent_path().parent_path();
  std::istringstream headers(contentOf(build / "public_headers.txt"));
  std::string header;
  int read = 0;
  while (std::getline(headers, header)) {
    if (header.rfind("planning/", 0) == 0 || header == "assets/foretouch.hpp") continue;
    const std::size_t first = text.find("`" + header + "`");
    EXPECT_NE(first, std::string::npos) << header << " is not in the order of docs/api.md";
    EXPECT_EQ(text.find("`" + header + "`", first + 1), std::string::npos) << header;
    ++read;
  }
  EXPECT_GT(read, 40);
  EXPECT_EQ(std::count(text.begin(), text.end(), '`'), 2 * read);
}

TEST(Documents, AnchorsAreMadeAsHostsMakeThem) {
  EXPECT_EQ(anchorOf("Pairs to ignore"), "pairs-to-ignore");
  EXPECT_EQ(anchorOf("Joint positions (CSV)"), "joint-positions-csv");
  EXPECT_EQ(anchorOf("`foretouch log info --json`"), "foretouch-log-info---json");
  EXPECT_EQ(anchorOf("8. Exact fidelity"), "8-exact-fidelity");
}

TEST(Documents, AllOfThemAreRead) {
  const std::vector<fs::path> found = documents();
  const fs::path root(FORETOUCH_SOURCE_DIR);
  EXPECT_GT(found.size(), 30U);
  // At the root, in docs/, and beside the code.
  for (const char* const one : {"README.md", "guarantees.md", "lss_pairs.md", "flat_bvh.md"}) {
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const fs::path& document) {
      return document.filename() == one;
    })) << one;
  }
  // A source package has no git; what is there besides is what nobody has added yet.
  const std::vector<fs::path> onDisk = documentsOnDisk(root);
  EXPECT_TRUE(std::includes(onDisk.begin(), onDisk.end(), found.begin(), found.end()));
}

TEST(Documents, NoneIsMangled) {
  for (const fs::path& document : documents()) {
    for (const std::string& line : mangledLines(contentOf(document))) {
      ADD_FAILURE() << document << ": " << line;
    }
  }
}

// As clang-format once left three notes of the proof.
TEST(Documents, MangledOnesAreFound) {
  const auto count = [](const std::string& text) { return mangledLines(text).size(); };
  EXPECT_EQ(count("#Advancement of an LSS in float lanes\n"), 1U);
  EXPECT_EQ(count("text\n\n    ##1. What is proven,\n    and what only proposes\n"), 1U);
  EXPECT_EQ(count("Belongs to `lss_pairs.h`.u = 2 ^ -24,\n                       the roundoff.\n"),
            2U);
  EXPECT_EQ(count("the unit roundoff of float.All quantities are relative\n"), 1U);
  EXPECT_EQ(count("the difference by u(reach + | shift |), a component\n"), 1U);
  EXPECT_EQ(count("```cpp\nnever closed\n"), 1U);
  EXPECT_EQ(count("# Title\n\nText of `a.Bc` and 2^-24.\n\n    formula |a| + |b|\n\n"
                  "- item\n    goes on\n\n```sh\n#comment\n```\n"),
            0U);
}

}  // namespace
}  // namespace foretouch::house
