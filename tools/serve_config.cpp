#include "tools/serve_config.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "articulated/text_file.h"
#include "network/messages.h"
#include "tools/near_names.h"

// An exception per broken file is one too many, and what the format needs is two values deep.
#define TOML_EXCEPTIONS 0
#define TOML_MAX_NESTED_VALUES 8
#define TOML_ENABLE_FORMATTERS 0
// toml++ 3.3 asserts, or promises to the optimiser, what broken files do not keep ("[[!" is one),
// just before it tests the same and reports it.
#include <toml++/impl/preprocessor.h>
#undef TOML_ASSERT_ASSUME
#define TOML_ASSERT_ASSUME(condition) static_assert(true)
#include <toml++/toml.h>

namespace foretouch::tools {
namespace {

// toml++ sets no limit to a.b.c.d..., each of which is a table inside the last, and takes tables
// apart by recursion: kMaxDotsALine x TOML_MAX_NESTED_VALUES of them fit on any stack.
constexpr std::size_t kMaxDotsALine = 256;
/// What is left of a channel's name (the longest is kSkeletonChannel) for its suffix.
constexpr std::size_t kMaxSuffixBytes = kMaxChannelBytes - (sizeof kSkeletonChannel - 1);
constexpr double kUsPerS = 1e6;

/// No control characters, in the widest sense: the text goes to terminals and the system.
bool isPlain(std::string_view text) {
  const auto isControl = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  return isUtf8(text) && std::none_of(text.begin(), text.end(), isControl);
}

/// What toml++ says, without what a terminal could take for an instruction.
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

/// A number as a person would write it.
std::string shown(double number) {
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

/// What is common to all sections of one file: the first error ends the reading.
struct Reading {
  std::string file;
  std::optional<Error> error;

  void fail(ErrorCode code, std::int64_t line, std::string message) {
    if (!error) error = Error{code, file, line, -1, std::move(message)};
  }
};

std::int64_t lineOf(const toml::node& node) {
  return static_cast<std::int64_t>(node.source().begin.line);
}

/// One table and its keys. Each reader leaves its value alone where the key is not there.
class Section {
 public:
  Section(Reading& reading, const toml::table& table, std::string title)
      : reading_(reading), table_(table), title_(std::move(title)) {}

  [[nodiscard]] std::int64_t line() const { return lineOf(table_); }
  [[nodiscard]] const toml::node* find(const char* key) const { return table_.get(key); }

  /// Refuses the first key of the file that is none of these.
  void allowOnly(const std::vector<std::string>& keys) {
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

  /// The table `key` in this one, or an empty one.
  Section table(const char* key) {
    static const toml::table nothing;
    const toml::node* const node = find(key);
    const std::string title = std::string("[") + key + "]";
    if (node == nullptr) return {reading_, nothing, title};
    if (node->is_table()) return {reading_, *node->as_table(), title};
    wrongType(key, "a table", *node);
    return {reading_, nothing, title};
  }

  void text(const char* key, std::string& value, bool mayBeEmpty = true) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    if (const auto found = textOf(key, *node, mayBeEmpty)) value = *found;
  }

  void texts(const char* key, std::vector<std::string>& values) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    if (!node->is_array()) return wrongType(key, "an array of texts", *node);
    for (const toml::node& element : *node->as_array()) {
      const auto found = textOf(key, element, false);
      if (!found) return;
      values.push_back(*found);
    }
  }

  /// One of `words`, each standing for one of `values`.
  template <typename Value>
  void word(const char* key, const std::vector<std::string>& words,
            const std::vector<Value>& values, Value& value) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    if (!node->is_string()) return wrongType(key, orList(words), *node);
    const std::string& found = node->as_string()->get();
    const auto place = std::find(words.begin(), words.end(), found);
    if (place == words.end()) return outOfRange(key, orList(words), inQuotes(found), *node);
    value = values[static_cast<std::size_t>(place - words.begin())];
  }

  template <typename Integer>
  void integer(const char* key, std::int64_t least, std::int64_t most, Integer& value) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    const std::string expected =
        "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
    if (!node->is_integer()) return wrongType(key, expected, *node);
    const std::int64_t found = node->as_integer()->get();
    if (found < least || found > most) {
      return outOfRange(key, expected, std::to_string(found), *node);
    }
    value = static_cast<Integer>(found);
  }

  /// `legal` says whether a finite number is; `expected` says it to people.
  template <typename Legal>
  void number(const char* key, const char* expected, Legal legal, double& value) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    if (!node->is_number()) return wrongType(key, expected, *node);
    const double found = node->is_integer() ? static_cast<double>(node->as_integer()->get())
                                            : node->as_floating_point()->get();
    if (!std::isfinite(found) || !legal(found)) {
      return outOfRange(key, expected, shown(found), *node);
    }
    value = found;
  }

  void outOfRange(const char* key, const std::string& expected, const std::string& found,
                  const toml::node& node) {
    reading_.fail(ErrorCode::OutOfRange, lineOf(node),
                  spelt(key) + ": expected " + expected + ", found " + found);
  }

 private:
  [[nodiscard]] std::string spelt(const char* key) const {
    return title_.front() == '[' ? title_ + " " + key : key;
  }

  void wrongType(const char* key, const std::string& expected, const toml::node& node) {
    reading_.fail(ErrorCode::Syntax, lineOf(node),
                  spelt(key) + ": expected " + expected + ", found " + nameOf(node.type()));
  }

  std::optional<std::string> textOf(const char* key, const toml::node& node, bool mayBeEmpty) {
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

  Reading& reading_;
  const toml::table& table_;
  std::string title_;
};

/// A path of the file `from`, which counts from that file's folder.
std::string resolved(const std::string& path, const std::string& from) {
  if (path.empty()) return path;
  return (std::filesystem::path(from).parent_path() / path).string();
}

void readSuffix(Section& section, std::string& suffix) {
  section.text("suffix", suffix);
  const bool visible =
      std::all_of(suffix.begin(), suffix.end(), [](char c) { return c > 0x20 && c < 0x7f; });
  if (visible && suffix.size() <= kMaxSuffixBytes) return;
  section.outOfRange("suffix",
                     "at most " + std::to_string(kMaxSuffixBytes) +
                         " letters, digits and signs of ASCII, without spaces",
                     inQuotes(suffix), *section.find("suffix"));
}

void readService(Section section, Reading& reading, ServeConfig& config) {
  section.allowOnly({"url", "suffix", "receiver", "workers", "queue", "budget_us", "log", "http"});
  section.text("url", config.url, false);
  readSuffix(section, config.suffix);
  section.word<ReceiverKind>("receiver", {"own", "liblcm"},
                             {ReceiverKind::Own, ReceiverKind::Liblcm}, config.receiver);
  section.integer("workers", 1, kMaxServeWorkers, config.workers);
  section.integer("queue", 1, kMaxServeQueue, config.queue);
  section.integer("budget_us", 0, kMaxServeBudgetUs, config.budgetUs);
  section.text("log", config.log);
  config.log = resolved(config.log, reading.file);
  section.text("http", config.http);
  if (config.http.empty()) return;
  const auto address = parseHttpAddress("[service] http", config.http);
  if (address.ok()) return;
  reading.fail(address.error().code, lineOf(*section.find("http")),
               address.error().file + ": " + address.error().message);
}

void readScene(Section section, Reading& reading, ServeConfig& config) {
  section.allowOnly({"file", "scale", "up"});
  section.text("file", config.scene, false);
  config.scene = resolved(config.scene, reading.file);
  section.number(
      "scale", "a finite number greater than 0", [](double v) { return v > 0.0; },
      config.sceneScale);
  section.word<UpAxis>("up", {"y", "z"}, {UpAxis::Y, UpAxis::Z}, config.sceneUp);
}

void readQuery(Section section, ServeConfig& config) {
  section.allowOnly({"tolerance", "fidelity", "ignore"});
  section.number(
      "tolerance", "a finite number of metres, at least 1e-9",
      [](double v) { return v >= kMinTolerance; }, config.tolerance);
  section.word<Fidelity>("fidelity", {"link", "exact"}, {Fidelity::Link, Fidelity::Exact},
                         config.fidelity);
  section.texts("ignore", config.ignore);
}

void readStream(Section section, ServeConfig& config) {
  section.allowOnly({"max_step_s", "confirmations", "unmatched"});
  double maxStepS = static_cast<double>(config.stream.maxStepUs) / kUsPerS;
  section.number(
      "max_step_s", "a number of seconds from 0.000001 to 86400",
      [](double v) { return v >= 1.0 / kUsPerS && v <= kMaxServeStepS; }, maxStepS);
  config.stream.maxStepUs = std::llround(maxStepS * kUsPerS);
  section.integer("confirmations", 1, kMaxServeConfirmations, config.stream.confirmations);
  section.word<bool>("unmatched", {"undecided", "rest"}, {false, true},
                     config.stream.unmatchedAtRest);
}

void readAvatars(Section root, Reading& reading, ServeConfig& config) {
  const toml::node* const node = root.find("avatar");
  if (node == nullptr || (node->is_array() && node->as_array()->empty())) {
    return reading.fail(ErrorCode::Empty, -1, "expected at least one [[avatar]]");
  }
  if (!node->is_array_of_tables()) {
    return reading.fail(ErrorCode::Syntax, lineOf(*node),
                        "avatar: expected tables, each below a line [[avatar]]");
  }
  if (node->as_array()->size() > kMaxServeAvatars) {
    return reading.fail(ErrorCode::LimitExceeded, lineOf(*node),
                        "expected at most " + std::to_string(kMaxServeAvatars) + " avatars");
  }
  std::set<std::int32_t> ids;
  for (const toml::node& element : *node->as_array()) {
    Section section(reading, *element.as_table(), "[[avatar]]");
    ServedAvatar avatar;
    avatar.id = 1;
    section.allowOnly({"id", "file"});
    section.integer("id", 0, std::numeric_limits<std::int32_t>::max(), avatar.id);
    section.text("file", avatar.file, false);
    avatar.file = resolved(avatar.file, reading.file);
    if (avatar.file.empty()) {
      reading.fail(ErrorCode::Empty, section.line(), "[[avatar]]: expected a file");
    }
    if (!ids.insert(avatar.id).second) {
      reading.fail(ErrorCode::DuplicateName, section.line(),
                   "[[avatar]]: the id " + std::to_string(avatar.id) +
                       " stands twice (it is 1 where none is given)");
    }
    config.avatars.push_back(std::move(avatar));
  }
}

/// The bound that toml++ does not keep: see kMaxDotsALine.
std::optional<Error> dotsError(std::string_view text, const std::string& file) {
  std::int64_t line = 1;
  std::size_t dots = 0;
  for (const char c : text) {
    if (c == '.' && ++dots > kMaxDotsALine) {
      return Error{ErrorCode::LimitExceeded, file, line, -1,
                   "expected at most " + std::to_string(kMaxDotsALine) + " dots in a line"};
    }
    if (c != '\n') continue;
    ++line;
    dots = 0;
  }
  return std::nullopt;
}

}  // namespace

Result<ServeConfig> parseServeConfig(std::string_view text, const std::string& file) {
  if (text.size() > kMaxServeConfigBytes) {
    return Error{ErrorCode::LimitExceeded, file, -1, -1, "is larger than 1 MiB"};
  }
  if (const auto error = dotsError(text, file)) return *error;
  const toml::parse_result parsed = toml::parse(text);
  if (!parsed) {
    return Error{ErrorCode::Syntax, file,
                 static_cast<std::int64_t>(parsed.error().source().begin.line), -1,
                 "broken TOML: " + plain(parsed.error().description())};
  }
  Reading reading{file, std::nullopt};
  ServeConfig config;
  Section root(reading, parsed.table(), "the file");
  root.allowOnly({"service", "scene", "query", "stream", "avatar"});
  readService(root.table("service"), reading, config);
  readScene(root.table("scene"), reading, config);
  readQuery(root.table("query"), config);
  readStream(root.table("stream"), config);
  readAvatars(root, reading, config);
  if (config.scene.empty()) reading.fail(ErrorCode::Empty, -1, "expected a file in [scene]");
  if (reading.error) return *reading.error;
  return config;
}

Result<ServeConfig> readServeConfig(const std::string& path) {
  const auto text = readWholeFile(path, kMaxServeConfigBytes);
  if (!text.ok()) return text.error();
  return parseServeConfig(text.value(), path);
}

Result<HttpAddress> parseHttpAddress(const std::string& option, const std::string& text) {
  const std::size_t colon = text.rfind(':');
  HttpAddress address;
  if (colon != std::string::npos && colon > 0) {
    address.host = text.substr(0, colon);
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, address.port);
    const bool bracketed = address.host.front() == '[' && address.host.back() == ']';
    if (bracketed) address.host = address.host.substr(1, address.host.size() - 2);
    const bool colonsFit = bracketed == (address.host.find(':') != std::string::npos);
    const bool visible = std::all_of(address.host.begin(), address.host.end(),
                                     [](char c) { return c > 0x20 && c < 0x7f; });
    if (error == std::errc() && rest == end && address.port > 0 && colonsFit && visible &&
        !address.host.empty()) {
      return address;
    }
  }
  return Error{ErrorCode::OutOfRange, option, -1, -1,
               "expected a host and a port, such as 127.0.0.1:9464, found " + inQuotes(text)};
}

}  // namespace foretouch::tools
