// value() of a Result that failed stops the program. So whoever takes one has asked before, in the
// same function: what a file or a stranger can reach refuses instead.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/house/cpp_tokens.h"
#include "tests/house/source_files.h"

namespace foretouch::house {
namespace {

namespace fs = std::filesystem;

/// What may be taken unasked, and why it never fails.
const std::map<std::string, std::string>& allowed() {
  static const std::string oneJoint = "a skeleton of one joint that the source itself spells";
  static const std::map<std::string, std::string> all = {
      {"bindings/c/world.cpp: a call", oneJoint},
      {"bindings/python/poses.cpp: a call", oneJoint},
      {"tools/stream/told_events.cpp: a call", oneJoint},
      {"assets/import/gltf_compression.cpp: corner", "no Result: an index of Draco's"},
      {"assets/import/gltf_compression.cpp: value", "no Result: an index of Draco's"},
      {"tools/solid/solid_check.cpp: first", "both are asked in a loop over the two"},
      {"tools/solid/solid_check.cpp: last", "both are asked in a loop over the two"},
  };
  return all;
}

bool isName(const Token& token) {
  return std::isalpha(static_cast<unsigned char>(token.text[0])) != 0 || token.text[0] == '_';
}

/// The function that a token is in: the outermost braces that are no namespace and no class.
/// Returns where its head begins.
std::size_t functionOf(const std::vector<Token>& tokens, std::size_t place) {
  static const std::set<std::string> scopes = {"namespace", "class", "struct",
                                               "union",     "enum",  "extern"};
  static const std::set<std::string> ends = {")", "const", "override", "noexcept", "final"};
  std::vector<std::size_t> heads;  // of the braces around
  std::vector<bool> areFunctions;
  std::size_t head = 0;
  for (std::size_t i = 0; i < place; ++i) {
    const std::string& text = tokens[i].text;
    if (text == "{") {
      const bool isScope =
          (i == head || ends.count(tokens[i - 1].text) == 0) &&
          std::any_of(tokens.begin() + static_cast<std::ptrdiff_t>(head),
                      tokens.begin() + static_cast<std::ptrdiff_t>(i),
                      [](const Token& token) { return scopes.count(token.text) != 0; });
      heads.push_back(head);
      areFunctions.push_back(!isScope);
    }
    if (text == "}" && !heads.empty()) {
      heads.pop_back();
      areFunctions.pop_back();
    }
    if (text == "{" || text == "}" || text == ";") head = i + 1;
  }
  for (std::size_t i = 0; i < heads.size(); ++i) {
    if (areFunctions[i]) return heads[i];
  }
  return head;
}

/// The name whose value() is taken at the place of `value`; empty if it is no name.
std::string subjectOf(const std::vector<Token>& tokens, std::size_t place) {
  if (place < 2) return "";
  std::size_t at = place - 2;
  if (isName(tokens[at])) return tokens[at].text;
  // move(NAME)
  const bool isMoved = at >= 3 && tokens[at].text == ")" && isName(tokens[at - 1]) &&
                       tokens[at - 2].text == "(" && tokens[at - 3].text == "move";
  return isMoved ? tokens[at - 1].text : "";
}

bool isAsked(const std::vector<Token>& tokens, std::size_t from, std::size_t to,
             const std::string& name) {
  static const std::set<std::string> before = {"!", "if", "&&", "||", "FORETOUCH_CHECK", "while"};
  static const std::set<std::string> after = {"?", "&&", "||"};
  for (std::size_t i = from + 1; i + 2 < to; ++i) {
    if (tokens[i].text != name) continue;
    const std::string &next = tokens[i + 1].text, &then = tokens[i + 2].text;
    if ((next == "." || next == "->") && (then == "ok" || then == "has_value")) return true;
    std::size_t last = i - 1;
    if (tokens[last].text == "(" && last > 0) --last;
    const bool isWhole = next == ")" || after.count(next) != 0;
    // FORETOUCH_CHECK_OR(how, NAME)
    const bool isOfMacro = i >= 4 && tokens[i - 4].text == "FORETOUCH_CHECK_OR" && next == ")";
    if (isOfMacro || after.count(next) != 0 || (isWhole && before.count(tokens[last].text) != 0))
      return true;
  }
  return false;
}

/// "NAME, line N" of all that are taken unasked; of what is no name, "a call".
std::vector<std::pair<std::string, int>> uncheckedIn(const std::string& source) {
  const std::vector<Token> tokens = cppTokens(source);
  std::vector<std::pair<std::string, int>> found;
  for (std::size_t i = 2; i + 2 < tokens.size(); ++i) {
    const bool isTaken = tokens[i].text == "value" && tokens[i + 1].text == "(" &&
                         tokens[i + 2].text == ")" &&
                         (tokens[i - 1].text == "." || tokens[i - 1].text == "->");
    if (!isTaken) continue;
    const std::string subject = subjectOf(tokens, i);
    if (subject.empty() || !isAsked(tokens, functionOf(tokens, i), i, subject)) {
      found.emplace_back(subject.empty() ? "a call" : subject, tokens[i].line);
    }
  }
  return found;
}

TEST(CheckedValues, FindsWhatNobodyAsked) {
  const std::string source = R"(
    namespace n {
    int asked() { auto a = f(); if (!a.ok()) return 0; return a.value(); }
    int unasked() { auto b = f(); return b.value(); }
    int moved() { auto c = f(); return std::move(c).value(); }
    int called() { return f().value(); }
    int known() { auto d = f(); return d ? d.value() : 0; }
    struct S { int g() { if (!e.ok()) return 1; return 0; }
               int h() { return e.value(); } };
    }
  )";
  std::vector<std::string> names;
  for (const auto& [name, line] : uncheckedIn(source)) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"b", "c", "a call", "e"}));
}

TEST(CheckedValues, AreAllThereAre) {
  std::set<std::string> used;
  std::size_t files = 0;
  for (const char* folder : {"lss", "articulated", "tessellation", "middleware", "assets",
                             "network", "tools", "planning", "bindings"}) {
    const fs::path root = fs::path(FORETOUCH_SOURCE_DIR);
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      ++files;
      for (const auto& [name, line] : uncheckedIn(contentOf(entry.path()))) {
        const std::string path = fs::relative(entry.path(), root).generic_string();
        const std::string known = path + ": " + name;
        if (allowed().count(known) != 0) {
          used.insert(known);
        } else {
          ADD_FAILURE() << path << ":" << line << ": value() of " << name
                        << ", which this function has not asked whether it is ok";
        }
      }
    }
  }
  EXPECT_GT(files, 500u);
  for (const auto& [known, why] : allowed()) {
    EXPECT_EQ(used.count(known), 1u) << known << " is not needed any more: " << why;
  }
}

}  // namespace
}  // namespace foretouch::house
