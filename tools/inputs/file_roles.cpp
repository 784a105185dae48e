#include "tools/inputs/file_roles.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "articulated/try.h"
#include "assets/import/baked_scene.h"
#include "assets/import/model_import.h"
#include "assets/text_file.h"

namespace foretouch::tools {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kLogMagic = "\xED\xA1\xDA\x01"sv;

std::string lowerExtensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// The first bytes of a file; none of a pipe, whose first bytes its reader needs.
std::string beginningOf(const std::string& path) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) return "";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  std::array<char, 4096> bytes{};
  return file ? std::string(bytes.data(), std::fread(bytes.data(), 1, bytes.size(), file.get()))
              : "";
}

/// The role of a file whose readers do not go by the name.
FileRole roleByContent(const std::string& path) {
  const std::string text = beginningOf(path);
  if (text.rfind(kLogMagic, 0) == 0) return FileRole::Clip;
  if (internal::isBaked(path)) return FileRole::Scene;
  const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == std::string::npos) return FileRole::Unknown;
  if (text.compare(first, 9, "HIERARCHY") == 0) return FileRole::Clip;
  if (text[first] == '{') return FileRole::Avatar;
  const bool isRobot = text[first] == '<' && (text.find("<robot") != std::string::npos ||
                                              text.find("<mujoco") != std::string::npos);
  return isRobot ? FileRole::Robot : FileRole::Unknown;
}

/// A model with neither animation nor triangles is left to the reader of scenes, which says so.
Result<FileRole> roleOfModel(const std::string& path) {
  FORETOUCH_TRY(const auto model, importModel(path));
  if (!model.animations.empty()) return FileRole::Clip;
  return holdsBody(model) ? FileRole::Body : FileRole::Scene;
}

/// A setting that files without an option may fill.
struct Target {
  FileRole role;
  const char *table, *key, *noun;
};
constexpr std::array<Target, 4> kTargets{{{FileRole::Scene, "scene", "file", "a scene"},
                                          {FileRole::Avatar, "avatar", "file", "an avatar"},
                                          {FileRole::Clip, "clip", "file", "a motion"},
                                          {FileRole::Robot, "clip", "robot", "a robot"}}};

struct Place {
  Setting* setting = nullptr;
  const char* noun = "";
  std::vector<std::string> files;
};
using Places = std::map<FileRole, Place>;

Places placesIn(Settings& settings) {
  Places places;
  for (Setting& setting : settings) {
    for (const Target& target : kTargets) {
      if (setting.table == target.table && setting.key == target.key) {
        setting.isFilledByFiles = true;
        places[target.role] = {&setting, target.noun, {}};
      }
    }
  }
  return places;
}

/// "--scene, --avatar or --motion"
std::string optionsOf(const Places& places) {
  std::vector<std::string> names;
  for (const auto& [role, place] : places) names.push_back(place.setting->name());
  return wordList(names);
}

Error notOneOf(const std::string& file, const Places& places) {
  std::error_code problem;
  if (!std::filesystem::exists(file, problem)) {
    return Error::in(file, ErrorCode::FileNotFound, "cannot be opened: there is no such file");
  }
  return Error::in(file, ErrorCode::Mismatch,
                   "its name does not say what it is, nor does its content; expected " +
                       optionsOf(places) + " before it");
}

Result<Done> assign(const std::string& file, Places& places) {
  FORETOUCH_TRY(FileRole role, roleOfFile(file));
  if (role == FileRole::Unknown && places.count(FileRole::Scene) == 0) role = FileRole::Clip;
  if (role == FileRole::Body) {
    return Error::in(file, ErrorCode::Mismatch,
                     "is a body without an animation; expected " + optionsOf(places) +
                         " before it, or foretouch avatar mesh to make an avatar of it");
  }
  if (role == FileRole::Unknown) return notOneOf(file, places);
  const auto found = places.find(role);
  if (found == places.end()) {
    const auto target = std::find_if(kTargets.begin(), kTargets.end(),
                                     [&](const Target& t) { return t.role == role; });
    return Error::in(file, ErrorCode::Mismatch,
                     std::string("is ") + target->noun +
                         ", which this command does not take; "
                         "expected " +
                         optionsOf(places) + " before it if it is not");
  }
  Place& place = found->second;
  if (!place.files.empty() && place.setting->kind != ValueKind::List) {
    return Error::in(file, ErrorCode::Mismatch,
                     std::string("is ") + place.noun +
                         ", and a second one of its kind; expected "
                         "at most one, found " +
                         inQuotes(place.files.front()) + " as well");
  }
  place.files.push_back(file);
  return Done{};
}

/// A typed option is of the same kind as one of the files: neither is preferred.
Error alsoTyped(const Place& place) {
  return Error::in(place.files.front(), ErrorCode::Mismatch,
                   std::string("is ") + place.noun +
                       ", and a second one of its kind; expected at most one, found " +
                       place.setting->name() + " as well");
}

}  // namespace

bool holdsBody(const Model& model) {
  return std::any_of(model.meshes.begin(), model.meshes.end(),
                     [](const ModelMesh& mesh) { return !mesh.bones.empty(); }) ||
         std::any_of(model.nodes.begin(), model.nodes.end(),
                     [](const ModelNode& node) { return !node.lss.empty(); });
}

bool isEventLog(const std::string& path) {
  return lowerExtensionOf(path) == ".lcmlog" || beginningOf(path).rfind(kLogMagic, 0) == 0;
}

Result<FileRole> roleOfFile(const std::string& path) {
  constexpr std::array kScenes{".obj"sv, ".ply"sv, ".stl"sv,    ".off"sv,
                               ".3ds"sv, ".iqm"sv, ".ftscene"sv};
  constexpr std::array kModels{".glb"sv, ".gltf"sv, ".vrm"sv, ".fbx"sv, ".dae"sv, ".x"sv};
  constexpr std::array kMotions{".bvh"sv, ".amc"sv, ".mvnx"sv, ".csv"sv, ".npz"sv, ".lcmlog"sv};
  const std::string extension = lowerExtensionOf(path);
  const auto isOneOf = [&](const auto& extensions) {
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
  };
  if (isOneOf(kScenes)) return FileRole::Scene;
  if (isOneOf(kModels)) return roleOfModel(path);
  if (isOneOf(kMotions)) return FileRole::Clip;
  if (extension == ".json") return FileRole::Avatar;
  return extension == ".urdf" ? FileRole::Robot : roleByContent(path);
}

Setting& addFilesSetting(Settings& settings, std::vector<std::string>& files, const char* help) {
  const auto places = std::make_shared<Places>(placesIn(settings));
  Setting& setting = settings.list("files", "FILE...", files, help);
  setting.files().fillsOthers = true;
  setting.take = [places, &files](const GivenValue& given) -> Result<Done> {
    files = given.texts;
    Places own = *places;
    for (const std::string& file : files) FORETOUCH_CHECK(assign(file, own));
    for (auto& [role, place] : own) {
      if (place.files.empty()) continue;
      if (place.setting->isGiven) return alsoTyped(place);
      FORETOUCH_CHECK(place.setting->take({0.0, 0, place.files, inQuotes(place.files.front())}));
      place.setting->isGiven = true;
    }
    return Done{};
  };
  return setting;
}

}  // namespace foretouch::tools
