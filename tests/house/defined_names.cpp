#include "tests/house/defined_names.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <set>
#include <utility>

#include "tests/house/cpp_tokens.h"

namespace foretouch::house {
namespace {

using Tokens = std::vector<Token>;

bool isWord(const std::string& text) {
  return std::isalpha(static_cast<unsigned char>(text.front())) != 0 || text.front() == '_';
}

bool has(const Tokens& tokens, const char* text) {
  return std::any_of(tokens.begin(), tokens.end(),
                     [text](const Token& token) { return token.text == text; });
}

std::string joined(Tokens::const_iterator begin, Tokens::const_iterator end) {
  std::string text;
  for (; begin != end; ++begin) {
    if (!text.empty() && isWord(text.substr(text.size() - 1)) && isWord(begin->text)) text += ' ';
    text += begin->text;
  }
  return text;
}

/// Past the bracket that closes the one at `at`.
std::size_t pastClosing(const Tokens& tokens, std::size_t at, const char* open, const char* close) {
  int depth = 0;
  for (; at < tokens.size(); ++at) {
    if (tokens[at].text == open) ++depth;
    if (tokens[at].text == close && --depth == 0) return at + 1;
  }
  return at;
}

/// Without `template <...>` and [[attributes]] before the rest.
Tokens withoutPrefixes(Tokens tokens) {
  for (;;) {
    std::size_t end = 0;
    if (!tokens.empty() && tokens[0].text == "template") {
      end = pastClosing(tokens, 1, "<", ">");
    } else if (!tokens.empty() && tokens[0].text == "[") {
      end = pastClosing(tokens, 0, "[", "]");
    }
    if (end == 0) return tokens;
    tokens.erase(tokens.begin(), tokens.begin() + static_cast<std::ptrdiff_t>(end));
  }
}

/// One parameter's type: without default, without its own name.
std::string typeOf(Tokens parameter) {
  const auto isAssignment = [](const Token& token) { return token.text == "="; };
  parameter.erase(std::find_if(parameter.begin(), parameter.end(), isAssignment), parameter.end());
  if (parameter.size() > 1 && isWord(parameter.back().text)) {
    const std::string& before = parameter[parameter.size() - 2].text;
    const std::set<std::string> leaves = {"::", "const", "unsigned", "struct"};
    if (leaves.count(before) == 0) parameter.pop_back();
  }
  return joined(parameter.begin(), parameter.end());
}

/// The types between the brackets that `open` begins.
std::string parametersAt(const Tokens& tokens, std::size_t open) {
  const std::size_t end = pastClosing(tokens, open, "(", ")") - 1;
  std::string types;
  Tokens parameter;
  int depth = 0;
  for (std::size_t i = open + 1; i < end; ++i) {
    const std::string& text = tokens[i].text;
    if (text == "(" || text == "<" || text == "{" || text == "[") ++depth;
    if (text == ")" || text == ">" || text == "}" || text == "]") --depth;
    if (text != "," || depth != 0) {
      parameter.push_back(tokens[i]);
      continue;
    }
    types += typeOf(std::exchange(parameter, {})) + ",";
  }
  return types + typeOf(parameter);
}

/// Where the first `sign` stands outside of < >; the number of tokens if nowhere.
std::size_t findOutsideAngles(const Tokens& tokens, const char* sign) {
  int depth = 0;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].text == sign && depth == 0) return i;
    if (tokens[i].text == "<") ++depth;
    if (tokens[i].text == ">") --depth;
  }
  return tokens.size();
}

/// The name, with qualifiers, that ends before token `end`.
std::string nameBefore(const Tokens& tokens, std::size_t end) {
  std::size_t begin = end;
  while (begin > 0 &&
         (tokens[begin - 1].text == "::" || tokens[begin - 1].text == "~" ||
          (isWord(tokens[begin - 1].text) &&
           (begin == end || tokens[begin].text == "::" || tokens[begin].text == "~")))) {
    --begin;
  }
  return joined(tokens.begin() + static_cast<std::ptrdiff_t>(begin),
                tokens.begin() + static_cast<std::ptrdiff_t>(end));
}

bool isOneOf(const Token& token, const std::set<std::string>& words) {
  return words.count(token.text) != 0;
}

/// Reads one file from top to bottom, statement by statement; enters namespaces and nothing else.
class Reader {
 public:
  explicit Reader(const std::string& source) : tokens_(cppTokens(source)) {}

  std::vector<DefinedName> run() {
    while (at_ < tokens_.size()) step();
    return std::move(names_);
  }

 private:
  void step() {
    const Token& token = tokens_[at_];
    if (token.text == "}") {
      if (!scopes_.empty()) scopes_.pop_back();
      ++at_;
    } else if (token.text == "{") {
      open();
    } else if (token.text == ";") {
      ++at_;
      end();
    } else if (token.text == "(") {
      append(pastClosing(tokens_, at_, "(", ")"));
    } else {
      append(at_ + 1);
    }
  }

  void append(std::size_t end) {
    for (; at_ < end; ++at_) statement_.push_back(tokens_[at_]);
  }

  void open() {
    const Tokens words = withoutPrefixes(statement_);
    const std::size_t past = pastClosing(tokens_, at_, "{", "}");
    const auto isNamespace = [](const Token& token) { return token.text == "namespace"; };
    const auto space = std::find_if(words.begin(), words.end(), isNamespace);
    if (space != words.end()) {
      scopes_.push_back(joined(space + 1, words.end()));
    } else if (words.size() == 2 && words[0].text == "extern") {
      scopes_.push_back("extern");
    } else if (isType(words)) {
      addType(words);
      at_ = past;
      statement_.assign(1, {"type", tokens_[at_ - 1].line});
      return;
    } else if (isFunction(words) && !isInitializer(words)) {
      addFunction(words, tokens_[past - 1].line);
      at_ = past;
      statement_.clear();
      return;
    } else {
      append(past);
      return;
    }
    statement_.clear();
    ++at_;
  }

  [[nodiscard]] static bool isType(const Tokens& words) {
    static const std::set<std::string> kKeys = {"class", "struct", "union", "enum"};
    return words.size() > 1 && isOneOf(words.front(), kKeys) &&
           (!has(words, "(") || words[1].text == "alignas");
  }
  [[nodiscard]] static bool isFunction(const Tokens& words) {
    const std::size_t bracket = findOutsideAngles(words, "(");
    if (bracket == words.size()) return has(words, "operator");
    return has(words, "operator") || findOutsideAngles(words, "=") > bracket;
  }
  /// A brace among a constructor's initializers is not yet its body.
  [[nodiscard]] static bool isInitializer(const Tokens& words) {
    const std::size_t colon = findOutsideAngles(words, ":");
    return colon != words.size() && (isWord(words.back().text) || words.back().text == ">");
  }

  void addType(const Tokens& words) {
    std::size_t begin = 1, end = findOutsideAngles(words, ":");
    if (words[begin].text == "class") ++begin;
    if (words[begin].text == "alignas") begin = pastClosing(words, begin, "(", ")");
    if (end > begin + 1 && words[end - 1].text == "final") --end;
    add(NameKind::Type,
        joined(words.begin() + static_cast<std::ptrdiff_t>(begin),
               words.begin() + static_cast<std::ptrdiff_t>(end)),
        words);
  }
  void addFunction(const Tokens& words, int lastLine) {
    std::size_t bracket = findOutsideAngles(words, "(");
    const auto isOperator = [](const Token& token) { return token.text == "operator"; };
    const auto named = std::find_if(words.begin(), words.end(), isOperator);
    std::string name;
    if (named != words.end()) {
      const auto begin = static_cast<std::size_t>(named - words.begin());
      bracket = begin + 1;
      while (bracket < words.size() && (words[bracket].text != "(" || bracket == begin + 1)) {
        ++bracket;
      }
      if (begin > 0 && words[begin - 1].text == "::") name = nameBefore(words, begin);
      name += joined(named, words.begin() + static_cast<std::ptrdiff_t>(bracket));
    } else {
      name = nameBefore(words, bracket);
    }
    if (bracket < words.size()) name += "(" + parametersAt(words, bracket) + ")";
    add(NameKind::Function, name, words, lastLine);
  }

  /// A statement without a body: a variable, or nothing that defines.
  void end() {
    const Tokens words = withoutPrefixes(std::exchange(statement_, {}));
    static const std::set<std::string> kOthers = {"using",     "typedef", "friend", "static_assert",
                                                  "namespace", "extern",  "type",   "class",
                                                  "struct",    "enum",    "union"};
    if (words.size() < 2 || isOneOf(words.front(), kOthers) || has(words, "operator")) return;
    if (isFunction(words)) return;
    addVariables(words);
  }
  void addVariables(const Tokens& words) {
    std::size_t nameEnd = 0;
    int depth = 0, angles = 0;
    bool isValue = false;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::string& text = words[i].text;
      if (text == ")" || text == "}" || text == "]") --depth;
      if (depth == 0 && !isValue && (text == "=" || text == "{" || text == "[") && angles == 0) {
        if (nameEnd == 0) nameEnd = i;
        if (text == "=") isValue = true;
      }
      if (text == "(" || text == "{" || text == "[") ++depth;
      if (!isValue && text == "<") ++angles;
      if (!isValue && text == ">") --angles;
      if (text == "," && depth == 0 && angles == 0) {
        add(NameKind::Variable, nameBefore(words, nameEnd == 0 ? i : nameEnd), words);
        nameEnd = 0;
        isValue = false;
      }
    }
    add(NameKind::Variable, nameBefore(words, nameEnd == 0 ? words.size() : nameEnd), words);
  }

  void add(NameKind kind, const std::string& name, const Tokens& words, int lastLine = 0) {
    if (name.empty()) return;
    DefinedName found;
    found.kind = kind;
    found.line = words.front().line;
    found.lastLine = std::max(found.line, lastLine);
    for (const std::string& scope : scopes_) {
      if (scope.empty()) found.isLocal = true;
      if (scope != "extern") found.name += scope + "::";
    }
    found.name += name;
    names_.push_back(found);
  }

  Tokens tokens_;
  std::size_t at_ = 0;
  Tokens statement_;
  std::vector<std::string> scopes_;  // empty: anonymous
  std::vector<DefinedName> names_;
};

}  // namespace

std::vector<DefinedName> definedNames(const std::string& source) {
  return Reader(source).run();
}

}  // namespace foretouch::house
