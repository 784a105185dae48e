#include "tools/stream/serve_config.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "assets/text_file.h"
#include "network/wire/loopback.h"
#include "network/wire/messages.h"
#include "tools/inputs/policy_section.h"
#include "tools/inputs/toml_section.h"

namespace foretouch::tools {
namespace {

/// What is left of a channel's name (the longest is kSkeletonChannel) for its suffix.
constexpr std::size_t kMaxSuffixBytes = kMaxChannelBytes - (sizeof kSkeletonChannel - 1);
constexpr double kUsPerS = 1e6;
static_assert(kMaxServeConfigBytes == kMaxTomlBytes);

/// A path of the file `from`, which counts from that file's folder.
std::string resolved(const std::string& path, const std::string& from) {
  if (path.empty()) return path;
  return (std::filesystem::path(from).parent_path() / path).string();
}

void readSuffix(TomlSection& section, std::string& suffix) {
  section.text("suffix", suffix);
  const bool visible =
      std::all_of(suffix.begin(), suffix.end(), [](char c) { return c > 0x20 && c < 0x7f; });
  if (visible && suffix.size() <= kMaxSuffixBytes) return;
  section.outOfRange("suffix",
                     "at most " + std::to_string(kMaxSuffixBytes) +
                         " letters, digits and signs of ASCII, without spaces",
                     inQuotes(suffix), *section.find("suffix"));
}

/// Empty, or what `parse` takes.
void readAddress(TomlSection& section, const char* key, TomlReading& reading, std::string& address,
                 Result<HttpAddress> (*parse)(const std::string&, const std::string&)) {
  section.text(key, address);
  if (address.empty()) return;
  const auto parsed = parse(std::string("[service] ") + key, address);
  if (parsed.ok()) return;
  reading.fail(parsed.error().code, lineOf(*section.find(key)),
               parsed.error().file + ": " + parsed.error().message);
}

void readService(TomlSection section, TomlReading& reading, ServeConfig& config) {
  section.allowOnly(
      {"url", "suffix", "receiver", "workers", "queue", "budget_us", "log", "http", "view"});
  section.text("url", config.url, false);
  readSuffix(section, config.suffix);
  section.word<ReceiverKind>("receiver", {"own", "liblcm"},
                             {ReceiverKind::Own, ReceiverKind::Liblcm}, config.receiver);
  section.integer("workers", 1, kMaxServeWorkers, config.workers);
  section.integer("queue", 1, kMaxServeQueue, config.queue);
  section.integer("budget_us", 0, kMaxServeBudgetUs, config.budgetUs);
  section.text("log", config.log);
  config.log = resolved(config.log, reading.file);
  readAddress(section, "http", reading, config.http, parseHttpAddress);
  readAddress(section, "view", reading, config.view, parseViewAddress);
}

void readScene(TomlSection section, TomlReading& reading, ServeConfig& config) {
  section.allowOnly({"file", "scale", "up"});
  section.text("file", config.scene, false);
  config.scene = resolved(config.scene, reading.file);
  section.number(
      "scale", "a finite number greater than 0", [](double v) { return v > 0.0; },
      config.sceneScale);
  section.word<UpAxis>("up", {"y", "z"}, {UpAxis::Y, UpAxis::Z}, config.sceneUp);
}

void readQuery(TomlSection section, ServeConfig& config) {
  section.allowOnly({"tolerance", "fidelity", "ignore"});
  section.number(
      "tolerance", "a finite number of metres, at least 1e-9",
      [](double v) { return v >= kMinTolerance; }, config.tolerance);
  section.word<Fidelity>("fidelity", {"link", "exact"}, {Fidelity::Link, Fidelity::Exact},
                         config.fidelity);
  section.texts("ignore", config.ignore);
}

void readStream(TomlSection section, ServeConfig& config) {
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

void readAvatars(TomlSection root, TomlReading& reading, ServeConfig& config) {
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
    TomlSection section(reading, *element.as_table(), "[[avatar]]");
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

}  // namespace

Result<ServeConfig> parseServeConfig(std::string_view text, const std::string& file) {
  const auto parsed = parseToml(text, file);
  if (!parsed.ok()) return parsed.error();
  TomlReading reading{file, std::nullopt};
  ServeConfig config;
  TomlSection root(reading, parsed.value(), "the file");
  root.allowOnly({"service", "scene", "query", "policy", "stream", "avatar"});
  readService(root.table("service"), reading, config);
  readScene(root.table("scene"), reading, config);
  readQuery(root.table("query"), config);
  readPolicies(root, reading, config.policies);
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

Result<HttpAddress> parseViewAddress(const std::string& option, const std::string& text) {
  auto address = parseHttpAddress(option, text);
  if (!address.ok() || isLoopback(address.value().host)) return address;
  return Error{
      ErrorCode::OutOfRange, option, -1, -1,
      "expected localhost or an address of this machine alone (from others: ssh -L), found " +
          inQuotes(text)};
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
