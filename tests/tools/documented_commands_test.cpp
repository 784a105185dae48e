// tests/tools/documented_commands_test.cpp: what the documents tell people to type exists: every
// subcommand and option of `foretouch` and `foretouch-bench`, every task of `./run`.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Names that options had when figures were measured whose commands stand in a document.
const std::map<std::string, std::string> kFormerNames = {{"--scale", "--clip-scale"},
                                                         {"--motion-up", "--clip-up"},
                                                         {"--up", "--scene-up"},
                                                         {"--scales", "--clip-scales"},
                                                         {"--ups", "--clip-ups"}};

bool isOfMeasurements(const std::string& document) {
  return document == "memory.md" || document == "trade.md";
}

/// What a --help lists.
struct Help {
  std::set<std::string> options, subcommands;
};

bool isBlank(const std::string& line) {
  return line.find_first_not_of(' ') == std::string::npos;
}

Help helpFrom(const std::string& text) {
  Help help;
  std::istringstream lines(text);
  std::string line;
  bool listsSubcommands = false;
  while (std::getline(lines, line)) {
    if (isBlank(line) || line.front() != ' ') {
      // Commands come first, under any title; arguments and examples do not.
      listsSubcommands = line.rfind("Arguments:", 0) != 0 && line.rfind("Example", 0) != 0;
    } else if (line.rfind("  ", 0) == 0 && line.size() > 2 && line[2] != ' ') {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word.front() != '-') {
        if (listsSubcommands) help.subcommands.insert(word);
        continue;
      }
      std::istringstream names(word);
      for (std::string name; std::getline(names, name, ',');) help.options.insert(name);
    }
  }
  return help;
}

bool isProgram(const std::string& word) {
  return word == "foretouch" || word == "foretouch-bench";
}

/// The help of a program (the first word) or of a subcommand of it, asked for once.
const Help& helpOf(const Words& path) {
  static std::map<Words, Help> known;
  const auto found = known.find(path);
  if (found != known.end()) return found->second;
  Words arguments(path.begin() + 1, path.end());
  arguments.emplace_back("--help");
  const Ended ended = path.front() == "foretouch" ? runForetouch(arguments) : runBench(arguments);
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  return known[path] = helpFrom(ended.out);
}

/// Lines of code blocks, continued ones joined, and code spans.
std::vector<std::string> codeIn(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> code;
  std::string line, begun;
  bool isBlock = false;
  while (std::getline(lines, line)) {
    if (line.rfind("```", 0) == 0) {
      isBlock = !isBlock;
    } else if (isBlock || line.rfind("    ", 0) == 0) {
      begun += line;
      if (!begun.empty() && begun.back() == '\\') {
        begun.back() = ' ';
        continue;
      }
      code.push_back(std::exchange(begun, ""));
    } else {
      for (std::size_t from = line.find('`'); from != std::string::npos;) {
        const std::size_t to = line.find('`', from + 1);
        if (to == std::string::npos) break;
        code.push_back(line.substr(from + 1, to - from - 1));
        from = line.find('`', to + 1);
      }
    }
  }
  return code;
}

/// The words of a command, up to a comment, a pipe or a redirection.
Words wordsOf(const std::string& line) {
  std::istringstream stream(line);
  Words words;
  for (std::string word; stream >> word;) {
    if (word == "#" || word == "|" || word == ">" || word == "&&" || word == ";") break;
    words.push_back(word);
  }
  if (!words.empty() && words.front() == "$") words.erase(words.begin());
  return words;
}

bool isWord(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '-';
  });
}

/// The words from the program's name on. "..." and words in capitals stand for something.
/// `mayBeFormer`: options may have the names of then.
void expectCommand(const Words& words, bool mayBeFormer, const std::string& where) {
  Words path{words.front()};
  std::size_t at = 1;
  while (at < words.size() && isWord(words[at]) && words[at].front() != '-') {
    const Help& help = helpOf(path);
    if (help.subcommands.count(words[at]) == 0) {
      EXPECT_TRUE(help.subcommands.empty()) << where << ": no subcommand " << words[at];
      break;
    }
    path.push_back(words[at++]);
  }
  if (path.size() == 1) return;
  for (; at < words.size(); ++at) {
    std::string option = words[at].substr(0, words[at].find_first_of("=,.;:)]"));
    if (option.rfind("--", 0) != 0 && !(option.size() == 2 && option.front() == '-' &&
                                        std::isalpha(static_cast<unsigned char>(option[1])) != 0)) {
      continue;
    }
    const auto former = kFormerNames.find(option);
    if (mayBeFormer && former != kFormerNames.end()) option = former->second;
    EXPECT_EQ(helpOf(path).options.count(option), 1u) << where << ": no option " << option;
  }
}

std::vector<fs::path> documents() {
  const fs::path root(FORETOUCH_SOURCE_DIR);
  std::vector<fs::path> found{root / "examples" / "README.md", root / "README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  }
  return found;
}

TEST(Documents, TellOnlyOfCommandsAndOptionsThatExist) {
  const std::string root = FORETOUCH_SOURCE_DIR;
  const std::string tasks = contentOf(root + "/run") + contentOf(root + "/dev/tasks.txt");
  const auto isTask = [&](const std::string& name) {
    return tasks.find("\n  " + name + ")") != std::string::npos ||
           tasks.find("\n" + name + " ") != std::string::npos;
  };
  int commands = 0, runs = 0;
  for (const fs::path& document : documents()) {
    for (const std::string& line : codeIn(contentOf(document.string()))) {
      Words words = wordsOf(line);
      const std::string where = document.filename().string() + ": " + line;
      if (words.size() > 1 && words.front() == "./run" && isWord(words[1])) {
        ++runs;
        EXPECT_TRUE(isTask(words[1])) << where;
        words.erase(words.begin());
      }
      if (words.empty() || !isProgram(words.front())) continue;
      ++commands;
      expectCommand(words, isOfMeasurements(document.filename().string()), where);
    }
  }
  EXPECT_GT(commands, 50);
  EXPECT_GT(runs, 10);
}

TEST(Documents, OptionsAreReadFromHelpTexts) {
  const Help replay = helpOf({"foretouch", "replay"});
  EXPECT_EQ(replay.options.count("--scene"), 1u);
  EXPECT_EQ(replay.options.count("--tolerance"), 1u);
  EXPECT_EQ(replay.options.count("--sceen"), 0u);
  const Help avatar = helpOf({"foretouch", "avatar"});
  EXPECT_EQ(avatar.subcommands.count("check"), 1u);
}

}  // namespace
}  // namespace foretouch::test
