#include "tools/batch/manifest.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/near_names.h"
#include "assets/text_file.h"
#include "tools/batch/manifest_words.h"

namespace foretouch::tools {
namespace {

constexpr char kBatchFormat[] = "foretouch-batch";
constexpr char kBatchVersion[] = "1";
/// The options that the batch itself gives to each job, or replaces.
constexpr const char* kOfBatch[] = {"--output", "--report",        "--json",  "--glb",
                                    "--bvh",    "--glb-triangles", "--quiet", "--labels",
                                    "--plot",   "--threads"};

/// Each job needs these.
std::vector<const char*> neededBy(BatchKind kind) {
  if (kind == BatchKind::Feet) return {"--motion"};
  return {"--scene", "--avatar", "--motion"};
}

/// An option on a line: each choice makes jobs of its own.
struct GivenOption {
  std::size_t place = 0;  ///< In the order of help.
  std::vector<std::shared_ptr<const JobOption>> choices;
};

/// A log's avatars are a list; a clip has one, so that several are several jobs.
bool isListOption(const Setting& setting) {
  return setting.kind == ValueKind::List && setting.name() != "--avatar";
}

class ManifestReading {
 public:
  ManifestReading(const std::string& path, Settings& settings, BatchKind kind) {
    manifest_.path = path;
    manifest_.kind = kind;
    manifest_.folder = std::filesystem::path(path).parent_path().string();
    if (manifest_.folder.empty()) manifest_.folder = ".";
    for (Setting& setting : settings) addNames(setting);
  }

  Result<BatchManifest> read(std::string_view text);

 private:
  struct Known {
    Setting* setting;
    std::size_t place;
    std::string byDefault;
  };

  void addNames(Setting& setting);
  [[nodiscard]] Error wrong(ErrorCode code, std::string message) const {
    return Error::inLine(manifest_.path, line_, code, std::move(message));
  }
  [[nodiscard]] Error inThisLine(Error error) const;
  Result<Done> readLine(std::string_view line);
  Result<Done> readFormat(const std::vector<std::string>& words) const;
  Result<std::vector<GivenOption>> readOptions(const std::vector<std::string>& words);
  Result<const Known*> known(const std::string& option) const;
  Result<Done> take(const Known& option, std::vector<std::string> texts,
                    std::vector<GivenOption>& given);
  Result<Done> takeText(const Known& option, const std::string& text,
                        std::vector<GivenOption>& given);
  Result<std::vector<std::string>> pathsFor(const std::string& option, const std::string& text);
  Result<Done> addJobs(const std::vector<GivenOption>& own);

  std::map<std::string, std::size_t> byName_;
  std::vector<Known> known_;
  std::vector<std::string> names_;  // for misspelt ones
  BatchManifest manifest_;
  std::vector<GivenOption> ofAll_;
  std::int64_t line_ = 0;
  bool hasFormat_ = false;
};

void ManifestReading::addNames(Setting& setting) {
  if (setting.fillsOthers) return;  // a line names what is chosen for each job
  const std::string name = setting.name();
  known_.push_back({&setting, known_.size(), setting.shown ? setting.shown() : ""});
  byName_[name] = known_.size() - 1;
  if (setting.isGone.empty()) names_.push_back(name);
  const std::size_t comma = setting.option.find(',');
  if (comma != std::string::npos) byName_[setting.option.substr(0, comma)] = known_.size() - 1;
  for (const std::string& former : setting.formerNames) byName_[former] = known_.size() - 1;
}

/// An error about an option or about nothing becomes one about this line.
Error ManifestReading::inThisLine(Error error) const {
  const std::string about = error.file.empty() ? "" : error.file + ": ";
  return wrong(error.code, about + error.message);
}

Result<Done> ManifestReading::readFormat(const std::vector<std::string>& words) const {
  if (words.size() == 2 && words[0] == kBatchFormat && words[1] == kBatchVersion) return Done{};
  const std::string found = words.size() > 1 ? words[0] + " " + words[1] : words[0];
  return wrong(ErrorCode::Syntax, std::string("expected the line ") + kBatchFormat + " " +
                                      kBatchVersion + " first, found " + inQuotes(found));
}

Result<const ManifestReading::Known*> ManifestReading::known(const std::string& option) const {
  const auto found = byName_.find(option);
  if (found == byName_.end() || option.rfind('-', 0) != 0) {
    return wrong(ErrorCode::UnknownName, std::string("expected an option of foretouch ") +
                                             commandOf(manifest_.kind) + ", found " +
                                             inQuotes(option) + didYouMean(option, names_));
  }
  const Known& known = known_[found->second];
  const std::string name = known.setting->name();
  for (const char* const own : kOfBatch) {
    if (name != own) continue;
    return wrong(ErrorCode::Mismatch, name + ": expected none here: foretouch batch says it");
  }
  return &known;
}

/// One option with all of its texts, checked, as one more choice.
Result<Done> ManifestReading::take(const Known& option, std::vector<std::string> texts,
                                   std::vector<GivenOption>& given) {
  Setting& setting = *option.setting;
  const auto taken = takeTyped(setting, texts);
  if (!taken.ok()) return inThisLine(taken.error());
  auto one = std::make_shared<JobOption>();
  one->name = setting.name();
  one->isFile = setting.takesFiles;
  one->value = setting.kind == ValueKind::Flag ? "" : setting.shown();
  one->isDefault = setting.kind != ValueKind::Flag && one->value == option.byDefault;
  one->texts = std::move(texts);
  const auto found = std::find_if(given.begin(), given.end(), [&](const GivenOption& other) {
    return other.place == option.place;
  });
  if (found == given.end()) {
    given.push_back({option.place, {std::move(one)}});
  } else if (isListOption(setting)) {
    auto joined = found->choices.front()->texts;
    joined.insert(joined.end(), one->texts.begin(), one->texts.end());
    given.erase(found);
    return take(option, std::move(joined), given);
  } else {
    found->choices.push_back(std::move(one));
  }
  return Done{};
}

/// A file of this name is not a pattern.
Result<std::vector<std::string>> ManifestReading::pathsFor(const std::string& option,
                                                           const std::string& text) {
  std::error_code absent;
  const auto path = std::filesystem::path(manifest_.folder) / text;
  if (!isPattern(text) || std::filesystem::exists(path, absent)) {
    return std::vector<std::string>{text};
  }
  auto files = filesLike(text, manifest_.folder, kMaxBatchJobs);
  if (!files.ok()) return inThisLine(files.error());
  if (files.value().empty()) {
    return wrong(ErrorCode::FileNotFound,
                 option + ": expected a file like " + inQuotes(text) + ", found none");
  }
  return files;
}

Result<Done> ManifestReading::takeText(const Known& option, const std::string& text,
                                       std::vector<GivenOption>& given) {
  if (!option.setting->takesFiles) return take(option, {text}, given);
  FORETOUCH_TRY(const auto files, pathsFor(option.setting->name(), text));
  for (const std::string& file : files) FORETOUCH_CHECK(take(option, {file}, given));
  return Done{};
}

Result<std::vector<GivenOption>> ManifestReading::readOptions(
    const std::vector<std::string>& words) {
  std::vector<GivenOption> given;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::size_t sign = words[i].rfind("--", 0) == 0 ? words[i].find('=') : std::string::npos;
    const std::string name = words[i].substr(0, sign);
    FORETOUCH_TRY(const Known* const option, known(name));
    const bool isFlag = option->setting->kind == ValueKind::Flag;
    if (isFlag && sign != std::string::npos) {
      return wrong(ErrorCode::Syntax, name + ": expected no value");
    }
    if (isFlag) {
      FORETOUCH_CHECK(take(*option, {}, given));
      continue;
    }
    if (sign == std::string::npos && i + 1 == words.size()) {
      return wrong(ErrorCode::Empty, name + ": expected a value behind it");
    }
    FORETOUCH_CHECK(takeText(
        *option, sign == std::string::npos ? words[++i] : words[i].substr(sign + 1), given));
  }
  return given;
}

/// A job for every combination; the last option changes fastest.
Result<Done> ManifestReading::addJobs(const std::vector<GivenOption>& own) {
  std::vector<GivenOption> all;
  for (const GivenOption& option : ofAll_) {
    const bool isReplaced = std::any_of(own.begin(), own.end(), [&](const GivenOption& other) {
      return other.place == option.place;
    });
    if (!isReplaced) all.push_back(option);
  }
  all.insert(all.end(), own.begin(), own.end());
  std::size_t count = 1;
  for (const GivenOption& option : all) {
    count *= option.choices.size();
    if (count > kMaxBatchJobs - manifest_.jobs.size()) {
      return wrong(ErrorCode::LimitExceeded,
                   "expected at most " + std::to_string(kMaxBatchJobs) + " jobs, found more");
    }
  }
  for (std::size_t number = 0; number < count; ++number) {
    std::map<std::size_t, std::shared_ptr<const JobOption>> inOrder;
    std::size_t rest = number;
    for (auto option = all.rbegin(); option != all.rend(); ++option) {
      inOrder[option->place] = option->choices[rest % option->choices.size()];
      rest /= option->choices.size();
    }
    BatchJob job;
    job.line = line_;
    for (auto& [place, option] : inOrder) job.options.push_back(std::move(option));
    for (const char* const needed : neededBy(manifest_.kind)) {
      if (job.find(needed) != nullptr) continue;
      return wrong(ErrorCode::Empty, std::string("expected ") + needed + " in each job");
    }
    manifest_.jobs.push_back(std::move(job));
  }
  return Done{};
}

Result<Done> ManifestReading::readLine(std::string_view line) {
  if (line.size() > kMaxManifestLine) {
    return wrong(ErrorCode::LimitExceeded,
                 "expected at most " + std::to_string(kMaxManifestLine) + " bytes in a line");
  }
  for (const char c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\t' && c != '\r') || byte == 0x7f) {
      return wrong(ErrorCode::Syntax, "expected no control characters, found one");
    }
  }
  auto split = wordsOfLine(line);
  if (!split.ok()) return inThisLine(split.error());
  const std::vector<std::string>& words = split.value();
  if (words.empty()) return Done{};
  if (!hasFormat_) {
    hasFormat_ = true;
    return readFormat(words);
  }
  if (words[0] != "job" && words[0] != "all") {
    return wrong(ErrorCode::Syntax, "expected job or all, found " + inQuotes(words[0]));
  }
  FORETOUCH_TRY(auto given, readOptions(words));
  if (words[0] == "job") return addJobs(given);
  ofAll_ = std::move(given);
  return Done{};
}

Result<BatchManifest> ManifestReading::read(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    ++line_;
    FORETOUCH_CHECK(readLine(text.substr(at, end - at)));
    at = end + 1;
  }
  if (manifest_.jobs.empty()) {
    return Error::in(manifest_.path, ErrorCode::Empty,
                     hasFormat_ ? "expected at least one line that begins with job"
                                : std::string("expected the line ") + kBatchFormat + " " +
                                      kBatchVersion + " first, found nothing");
  }
  return std::move(manifest_);
}

}  // namespace

const JobOption* BatchJob::find(std::string_view name) const {
  for (const auto& option : options) {
    if (option->name == name) return option.get();
  }
  return nullptr;
}

std::vector<std::string> BatchJob::words() const {
  std::vector<std::string> all;
  for (const auto& option : options) {
    if (option->texts.empty()) all.push_back(option->name);
    for (const std::string& text : option->texts) {
      // In one word: a value may begin with a dash.
      all.push_back(option->name + "=" + text);
    }
  }
  return all;
}

const char* commandOf(BatchKind kind) {
  return kind == BatchKind::Feet ? "feet" : "replay";
}

const char* endingOf(BatchKind kind) {
  return kind == BatchKind::Feet ? ".csv" : ".jsonl";
}

Result<BatchManifest> parseManifest(std::string_view text, const std::string& path,
                                    Settings& settings, BatchKind kind) {
  return ManifestReading(path, settings, kind).read(text);
}

Result<BatchManifest> readManifest(const std::string& path, Settings& settings, BatchKind kind) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxManifestBytes));
  return parseManifest(text, path, settings, kind);
}

}  // namespace foretouch::tools
