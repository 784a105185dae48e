#include "tools/settings/project_file.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/config_reading.h"
#include "tools/settings/config_table.h"
#include "tools/settings/file_mark.h"
#include "tools/settings/frame_settings.h"
#include "tools/settings/numbered_avatars.h"
#include "tools/settings/serve_settings.h"

namespace foretouch::tools {
namespace {

/// Every setting that a project may hold: those of commands that play a clip, and those that only
/// services have.
struct AllSettings {
  ServeConfig serve;
  ClipRequest clip;
  WorldRequest world;
  Settings played, served;

  AllSettings() {
    addSceneSettings(played, world);
    addQuerySettings(played, world);
    addReplayQuerySettings(played, world);
    addMotionSetting(played, clip, "--motion", "CLIP");
    addRateSetting(played, clip);
    addClipSettings(played, clip);
    addCutSettings(played, clip);
    addServeSettings(served, serve);
  }
};

/// A project, parsed.
struct ParsedProject {
  std::string path;
  toml::table tables;
};

struct NamedAvatar {
  NumberedAvatar avatar;  ///< Its path ready to open.
  std::int64_t line = -1;
};

class ProjectReading {
 public:
  ProjectReading(const ParsedProject& project, Settings& settings,
                 const std::function<bool(const Setting&)>& isTyped)
      : reading_{project.path, std::nullopt},
        root_(reading_, project.tables, "the file"),
        settings_(settings),
        isTyped_(isTyped) {}

  [[nodiscard]] Result<std::vector<std::string>> take();

 private:
  void checkAll();
  [[nodiscard]] bool isAbout(const std::string& table) const;
  void takeTable(const char* table);
  void takeAvatars(Setting& setting);
  void takePolicies();
  void checkFile(const char* table, const toml::node& node);
  [[nodiscard]] std::vector<NamedAvatar> avatars();

  TomlReading reading_;
  TomlSection root_;
  Settings& settings_;
  const std::function<bool(const Setting&)>& isTyped_;
  std::vector<std::string> notes_;
};

/// Everything but [[avatar]] and [[policy]], whose readers check them.
void ProjectReading::checkAll() {
  root_.allowOnly({"scene", "avatar", "clip", "query", "policy", "service", "stream", "solid",
                   "person", "made"});
  AllSettings all;
  for (const char* const table : {"scene", "clip", "query"}) {
    readWholeTable(root_, table, reading_, all.played);
  }
  for (const char* const table : {"service", "stream", "solid", "person"}) {
    readWholeTable(root_, table, reading_, all.served);
  }
  root_.table("made").allowOnly({"scene", "avatar", "clip"});
}

/// False if the command line names another file for this table.
bool ProjectReading::isAbout(const std::string& table) const {
  return std::none_of(settings_.begin(), settings_.end(), [&](const Setting& setting) {
    return setting.table == table && setting.key == "file" && isTyped_(setting);
  });
}

void ProjectReading::checkFile(const char* table, const toml::node& node) {
  if (reading_.error || !node.is_string()) return;
  const std::string& written = node.as_string()->get();
  const std::string path = besideFile(written, reading_.file);
  const auto mark = markOfFile(path);
  if (!mark.ok()) {
    return reading_.fail(ErrorCode::FileNotFound, lineOf(node),
                         fmt::format("[{}] file: expected a readable file, found none at {}; "
                                     "`foretouch setup` writes a new project",
                                     table, inQuotes(path)));
  }
  std::string made;
  root_.table("made").text(table, made);
  if (made.empty() || made == mark.value()) return;
  notes_.push_back(fmt::format(
      "{}: {} has changed since this project was made; `foretouch setup` checks unit, axis and "
      "place again",
      reading_.file, inQuotes(written)));
}

void ProjectReading::takeTable(const char* table) {
  if (!isAbout(table)) {
    const toml::node* const node = root_.find(table);
    if (node != nullptr && node->is_table() && node->as_table()->size() > 1) {
      notes_.push_back(
          fmt::format("{}: nothing of [{}] was taken, because the command line names another file",
                      reading_.file, table));
    }
    return;
  }
  bool isAsked = false;
  readTable(root_, table, reading_, settings_, [&](const Setting& setting) {
    isAsked = isAsked || setting.key == "file";
    return !isTyped_(setting);
  });
  if (!isAsked) return;
  TomlSection section = root_.table(table);
  const toml::node* const file = section.find("file");
  if (file != nullptr) checkFile(table, *file);
}

std::vector<NamedAvatar> ProjectReading::avatars() {
  std::vector<NamedAvatar> named;
  const toml::node* const node = root_.find("avatar");
  if (node == nullptr) return named;
  if (!node->is_array_of_tables()) {
    reading_.fail(ErrorCode::Syntax, lineOf(*node),
                  "avatar: expected tables, each under a line [[avatar]]");
    return named;
  }
  for (const toml::node& element : *node->as_array()) {
    TomlSection section(reading_, *element.as_table(), "[[avatar]]");
    section.allowOnly({"id", "file"});
    NumberedAvatar avatar;
    section.integer("id", 0, std::numeric_limits<std::int32_t>::max(), avatar.id);
    section.text("file", avatar.path, false);
    if (avatar.path.empty()) {
      reading_.fail(ErrorCode::Empty, section.line(), "[[avatar]]: expected a file");
      return named;
    }
    checkFile("avatar", *section.find("file"));
    avatar.path = besideFile(avatar.path, reading_.file);
    named.push_back({std::move(avatar), section.line()});
  }
  return named;
}

void ProjectReading::takeAvatars(Setting& setting) {
  if (isTyped_(setting)) return;
  const std::vector<NamedAvatar> named = avatars();
  if (reading_.error || named.empty()) return;
  GivenValue given;
  for (const auto& [avatar, line] : named) {
    // A list needs the avatars' numbers; a single avatar needs none.
    const bool isNumbered = named.size() > 1;
    given.texts.push_back((isNumbered ? std::to_string(avatar.id) + "=" : "") + avatar.path);
  }
  if (named.size() > 1 && setting.kind != ValueKind::List) {
    return reading_.fail(ErrorCode::Mismatch, named[1].line,
                         "[[avatar]]: expected one, found " + std::to_string(named.size()) +
                             "; name one on the command line (--avatar)");
  }
  const auto taken = setting.take(given);
  if (!taken.ok()) reading_.fail(taken.error().code, named.front().line, taken.error().message);
}

/// A project that holds policies is its own policy file.
void ProjectReading::takePolicies() {
  if (root_.find("policy") == nullptr) return;
  for (Setting& setting : settings_) {
    if (setting.option != "--policy" || isTyped_(setting)) continue;
    static_cast<void>(setting.take({0.0, 0, {reading_.file}, ""}));
  }
}

Result<std::vector<std::string>> ProjectReading::take() {
  checkAll();
  for (const char* const table :
       {"scene", "clip", "query", "service", "stream", "solid", "person"}) {
    takeTable(table);
  }
  for (Setting& setting : settings_) {
    if (setting.table == "avatar") takeAvatars(setting);
  }
  takePolicies();
  if (reading_.error) return *reading_.error;
  return notes_;
}

/// A text of TOML.
std::string tomlText(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string tomlList(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : ", ") + tomlText(text);
  return "[" + out + "]";
}

std::string frameLines(std::optional<double> scale, std::optional<UpAxis> up) {
  std::string text;
  if (scale) text += "scale = " + tidyNumber(*scale) + "  # metres per unit\n";
  if (up) text += std::string("up = \"") + wordOf(*up) + "\"\n";
  return text;
}

}  // namespace

Result<std::vector<std::string>> takeFromProject(
    const std::string& path, Settings& settings,
    const std::function<bool(const Setting&)>& isTyped) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxTomlBytes));
  FORETOUCH_TRY(auto parsed, parseToml(text, path));
  const ParsedProject project{path, std::move(parsed)};
  return ProjectReading(project, settings, isTyped).take();
}

Setting& addProjectSetting(Settings& settings, std::string& path) {
  return settings
      .path("--project", "FILE", path,
            "Project file: what this command line does not say; foretouch.toml of the current "
            "folder if the command line names no files")
      .files("toml")
      .in(kInputGroup);
}

Result<std::string> projectText(const Project& project, const std::string& folder) {
  std::string text =
      "# Made by foretouch setup; change it as you like (docs/formats.md, \"Project files\").\n"
      "# Paths count from this file's folder. What a command line says comes first.\n";
  std::string marks;
  const auto add = [&](const char* table, const char* title,
                       const std::string& file) -> Result<Done> {
    text += fmt::format("\n{}\n", title);
    if (file.empty()) return Done{};
    if (std::any_of(file.begin(), file.end(), [](unsigned char c) { return c < 0x20; })) {
      return Error::in(file, ErrorCode::OutOfRange,
                       "expected a name without control characters: a project cannot hold it");
    }
    FORETOUCH_TRY(const auto mark, markOfFile((std::filesystem::path(folder) / file).string()));
    text += "file = " + tomlText(file) + "\n";
    marks += fmt::format("{} = \"{}\"\n", table, mark);
    return Done{};
  };
  FORETOUCH_CHECK(add("scene", "[scene]", project.scene));
  text += frameLines(project.sceneScale, project.sceneUp);
  if (!project.avatar.empty()) FORETOUCH_CHECK(add("avatar", "[[avatar]]", project.avatar));
  FORETOUCH_CHECK(add("clip", "[clip]", project.clip));
  text += frameLines(project.clipScale, project.clipUp);
  text += project.clipLines;
  if (!project.jointMap.empty()) text += "map = " + tomlText(project.jointMap) + "\n";
  if (!project.robot.empty()) text += "robot = " + tomlText(project.robot) + "\n";
  if (!project.packages.empty()) text += "packages = " + tomlList(project.packages) + "\n";
  text += "place = " + tomlText(project.place) + "  # X,Y,Z,YAW: metres, degrees\n";
  return text + "\n# The files as they were: commands say when one has changed since.\n[made]\n" +
         marks;
}

std::string projectTable() {
  const AllSettings all;
  return configRows(all.played, {"clip", "query"}, [&](const Setting& setting) {
    return std::none_of(all.served.begin(), all.served.end(), [&](const Setting& served) {
      return served.table == setting.table && served.key == setting.key;
    });
  });
}

}  // namespace foretouch::tools
