// tools/settings/project_file.h: foretouch.toml, the project file: which scene, avatar and clip
// belong together, how to read them, and where the body stands. Commands take from it what their
// command line does not say; docs/formats.md, "Project files", has its keys.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/file_frame.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

inline constexpr char kProjectName[] = "foretouch.toml";

/// Fills the settings that the project has a key for. A setting that `isTyped` keeps its value, and
/// a table whose file is typed is about another file, so nothing in it is taken. Checks all of the
/// project, whether these settings need it or not: unknown keys, illegal values and files that are
/// gone are errors that name the line. Returns what a user should know, a sentence each: files that
/// have changed since, tables that were not taken.
[[nodiscard]] Result<std::vector<std::string>> takeFromProject(
    const std::string& path, Settings& settings,
    const std::function<bool(const Setting&)>& isTyped);

/// --project.
Setting& addProjectSetting(Settings& settings, std::string& path);

/// What `foretouch setup` writes. Paths as the project's folder sees them; empty: no such file.
struct Project {
  std::string scene, avatar, clip, jointMap, robot;
  std::vector<std::string> packages;            ///< The robot's.
  std::optional<double> sceneScale, clipScale;  ///< Metres per unit; nothing: as the file says.
  std::optional<UpAxis> sceneUp, clipUp;        ///< The same.
  std::string place;                            ///< "X,Y,Z,YAW".
  std::string clipLines;                        ///< More lines of [clip], as they stand there.
};

/// The text of a new project file beside these files. `folder`: its own, "" for the current one.
/// Errors: a file that cannot be read.
[[nodiscard]] Result<std::string> projectText(const Project& project, const std::string& folder);

/// Rows of a Markdown table of its keys, but those that a service's configuration has, too:
/// docs/formats.md holds them.
[[nodiscard]] std::string projectTable();

}  // namespace foretouch::tools
