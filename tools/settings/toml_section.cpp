#include "tools/settings/toml_section.h"

#include <charconv>

#include "assets/near_names.h"
#include "network/wire/messages.h"

namespace foretouch::tools {
namespace {

// toml++ does not limit a.b.c.d..., each a table inside the last, and destroys tables recursively:
// kMaxDotsALine x TOML_MAX_NESTED_VALUES of them fit on any stack.
constexpr std::size_t kMaxDotsALine = 256;

/// No control characters, in the widest sense: the text goes to terminals and the system.
bool isPlain(std::string_view text) {
  const auto isControl = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  return isUtf8(text) && std::none_of(text.begin(), text.end(), isControl);
}

/// The message of toml++, without terminal control characters.
std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text) result += c >= 0x20 && c < 0x7f ? c : '?';
  return result;
}

const char* nameOf(toml::node_type type) {
  switch (type) {
    case toml::node_type::table: return "a table";
    case toml::node_type::array: return "an array";
    case toml::node_type::string: return "a text";
    case toml::node_type::integer: return "a whole number";
    case toml::node_type::floating_point: return "a number";
    case toml::node_type::boolean: return "true or false";
    default: return "a date or time";
  }
}

/// The bound that toml++ lacks: see kMaxDotsALine.
std::optional<Error> dotsError(std::string_view text, const std::string& file) {
  std::int64_t line = 1;
  std::size_t dots = 0;
  for (const char c : text) {
    if (c == '.' && ++dots > kMaxDotsALine) {
      return Error::inLine(file, line, ErrorCode::LimitExceeded,
                           "expected at most " + std::to_string(kMaxDotsALine) + " dots in a line");
    }
    if (c != '\n') continue;
    ++line;
    dots = 0;
  }
  return std::nullopt;
}

}  // namespace

Result<toml::table> parseToml(std::string_view text, const std::string& file) {
  if (text.size() > kMaxTomlBytes) {
    return Error::in(file, ErrorCode::LimitExceeded, "is larger than 1 MiB");
  }
  if (const auto error = dotsError(text, file)) return *error;
  toml::parse_result parsed = toml::parse(text);
  if (!parsed) {
    return Error::inLine(file, static_cast<std::int64_t>(parsed.error().source().begin.line),
                         ErrorCode::Syntax, "broken TOML: " + plain(parsed.error().description()));
  }
  return std::move(parsed).table();
}

std::int64_t lineOf(const toml::node& node) {
  return static_cast<std::int64_t>(node.source().begin.line);
}

std::string shownNumber(double number) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, number).ptr;
  return {text, end};
}

std::string orList(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += '"' + words[i] + '"';
  }
  return text;
}

void TomlSection::allowOnly(const std::vector<std::string>& keys) {
  const toml::key* first = nullptr;
  for (const auto& [key, node] : table_) {
    if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
    if (first == nullptr || key.source().begin < first->source().begin) first = &key;
  }
  if (first == nullptr) return;
  reading_.fail(
      ErrorCode::UnknownName, static_cast<std::int64_t>(first->source().begin.line),
      "unknown key " + inQuotes(first->str()) + " in " + title_ + didYouMean(first->str(), keys));
}

TomlSection TomlSection::table(const char* key) {
  static const toml::table nothing;
  const toml::node* const node = find(key);
  const std::string title = std::string("[") + key + "]";
  if (node == nullptr) return {reading_, nothing, title};
  if (node->is_table()) return {reading_, *node->as_table(), title};
  wrongType(key, "a table", *node);
  return {reading_, nothing, title};
}

std::vector<TomlSection> TomlSection::tables(const char* key, const std::string& title,
                                             std::size_t most) {
  std::vector<TomlSection> sections;
  const toml::node* const node = find(key);
  if (node == nullptr || (node->is_array() && node->as_array()->empty())) return sections;
  if (!node->is_array_of_tables()) {
    wrongType(key, "tables, each under a line " + title, *node);
    return sections;
  }
  if (node->as_array()->size() > most) {
    reading_.fail(ErrorCode::LimitExceeded, lineOf(*node),
                  "expected at most " + std::to_string(most) + " tables " + title + ", found " +
                      std::to_string(node->as_array()->size()));
    return sections;
  }
  for (const toml::node& element : *node->as_array()) {
    sections.emplace_back(reading_, *element.as_table(), title);
  }
  return sections;
}

bool TomlSection::readKind(const Setting& setting, const toml::node& node, GivenValue& given) {
  const char* const key = setting.key.c_str();
  switch (setting.kind) {
    case ValueKind::Number:
      if (!node.is_number()) return wrongType(key, setting.legal, node), false;
      given.number = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                                       : node.as_floating_point()->get();
      given.found = shownNumber(given.number);
      given.texts = {given.found};
      if (std::isfinite(given.number)) return true;
      return outOfRange(key, setting.legal, given.found, node), false;
    case ValueKind::Whole:
      if (!node.is_integer()) return wrongType(key, setting.legal, node), false;
      given.whole = node.as_integer()->get();
      given.found = std::to_string(given.whole);
      given.texts = {given.found};
      return true;
    case ValueKind::List: texts(key, given.texts); return !reading_.error;
    case ValueKind::Flag:
      if (!setting.words.empty()) break;
      if (!node.is_boolean()) return wrongType(key, "true or false", node), false;
      return node.as_boolean()->get();  // the option is given, or it is not
    case ValueKind::Text: break;
  }
  if (!setting.words.empty()) return readWord(setting, node, given);
  const auto found = textOf(key, node, setting.mayBeEmpty);
  if (found) given = {0.0, 0, {*found}, inQuotes(*found)};
  return found.has_value();
}

bool TomlSection::readWord(const Setting& setting, const toml::node& node, GivenValue& given) {
  const char* const key = setting.key.c_str();
  const auto& words = setting.words;
  if (!node.is_string()) return wrongType(key, orList(words), node), false;
  const std::string& found = node.as_string()->get();
  given = {0.0, 0, {found}, inQuotes(found)};
  if (std::find(words.begin(), words.end(), found) != words.end()) return true;
  return outOfRange(key, orList(words), given.found + didYouMean(found, words), node), false;
}

void TomlSection::read(Setting& setting,
                       const std::function<std::string(const std::string&)>& pathOf) {
  const toml::node* const node = find(setting.key.c_str());
  GivenValue given;
  if (node == nullptr || !readKind(setting, *node, given)) return;
  if (setting.isPath) {
    std::transform(given.texts.begin(), given.texts.end(), given.texts.begin(), pathOf);
  }
  const auto taken = setting.take(given);
  if (taken.ok()) return;
  reading_.fail(taken.error().code, lineOf(*node),
                spelt(setting.key.c_str()) + ": " + taken.error().message);
}

void TomlSection::text(const char* key, std::string& value, bool mayBeEmpty) {
  const toml::node* const node = find(key);
  if (node == nullptr) return;
  if (const auto found = textOf(key, *node, mayBeEmpty)) value = *found;
}

void TomlSection::texts(const char* key, std::vector<std::string>& values) {
  const toml::node* const node = find(key);
  if (node == nullptr) return;
  if (!node->is_array()) return wrongType(key, "an array of texts", *node);
  for (const toml::node& element : *node->as_array()) {
    const auto found = textOf(key, element, false);
    if (!found) return;
    values.push_back(*found);
  }
}

void TomlSection::outOfRange(const char* key, const std::string& expected, const std::string& found,
                             const toml::node& node) {
  reading_.fail(ErrorCode::OutOfRange, lineOf(node),
                spelt(key) + ": expected " + expected + ", found " + found);
}

std::string TomlSection::spelt(const char* key) const {
  return title_.front() == '[' ? title_ + " " + key : key;
}

void TomlSection::wrongType(const char* key, const std::string& expected, const toml::node& node) {
  reading_.fail(ErrorCode::Syntax, lineOf(node),
                spelt(key) + ": expected " + expected + ", found " + nameOf(node.type()));
}

std::optional<std::string> TomlSection::textOf(const char* key, const toml::node& node,
                                               bool mayBeEmpty) {
  const std::string expected = std::string(mayBeEmpty ? "a text" : "a text that is not empty") +
                               " of at most " + std::to_string(kMaxTextBytes) +
                               " bytes without control characters";
  if (!node.is_string()) {
    wrongType(key, expected, node);
    return std::nullopt;
  }
  const std::string& found = node.as_string()->get();
  if (found.size() <= kMaxTextBytes && isPlain(found) && (mayBeEmpty || !found.empty())) {
    return found;
  }
  outOfRange(key, expected, inQuotes(found), node);
  return std::nullopt;
}

bool TomlSection::numbers(const char* key, std::size_t count, double most,
                          std::vector<double>& values) {
  const toml::node* const node = find(key);
  if (node == nullptr) return false;
  const std::string expected =
      std::to_string(count) + " numbers from " + tidyNumber(-most) + " to " + tidyNumber(most);
  if (!node->is_array()) return wrongType(key, expected, *node), false;
  const toml::array& elements = *node->as_array();
  if (elements.size() != count) {
    return outOfRange(key, expected, std::to_string(elements.size()) + " values", *node), false;
  }
  values.clear();
  for (const toml::node& element : elements) {
    if (!element.is_number()) return wrongType(key, expected, element), false;
    const double found = element.is_integer() ? static_cast<double>(element.as_integer()->get())
                                              : element.as_floating_point()->get();
    if (!(found >= -most && found <= most)) {
      return outOfRange(key, expected, shownNumber(found), element), false;
    }
    values.push_back(found);
  }
  return true;
}

void TomlSection::truth(const char* key, std::optional<bool>& value) {
  const toml::node* const node = find(key);
  if (node == nullptr) return;
  if (!node->is_boolean()) return wrongType(key, "true or false", *node);
  value = node->as_boolean()->get();
}

}  // namespace foretouch::tools
