// What the documents say of files: every relative link leads to a file, and to a heading of it. And
// that nothing but people has written them.
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
