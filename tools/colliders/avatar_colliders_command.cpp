#include "tools/colliders/avatar_colliders_command.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "tools/colliders/capsule_forms.h"
#include "tools/colliders/collider_writers.h"
#include "tools/console.h"
#include "tools/inputs/name_pattern.h"
#include "tools/results_output.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct AskedColliders {
  std::string avatar, output, vrm;
  std::vector<std::string> links;
  GodotVersion godot = GodotVersion::Four;
  UrdfCapsules urdf = UrdfCapsules::Capsules;
  bool urdfParts = false;
};

using Notes = std::vector<std::string>;

/// What is made for an ending, and what such a file cannot say.
struct ColliderFormat {
  const char* ending;
  HeldAs held;
  std::function<Result<std::string>(const AskedColliders&, const Avatar&, Notes&)> write;
  const char* cannot;
};

std::string nameOf(const AskedColliders& asked) {
  return std::filesystem::path(asked.output).stem().string();
}

const std::array<ColliderFormat, 6>& formats() {
  static const std::array<ColliderFormat, 6> all{{
      {".glb", HeldAs::Floats,
       [](const auto&, const Avatar& a, Notes&) { return gltfColliders(a); }, ""},
      {".vrm", HeldAs::Floats,
       [](const AskedColliders& asked, const Avatar& a, Notes& notes) {
         return vrmColliders(a, asked.vrm, notes);
       },
       ""},
      {".xml", HeldAs::Doubles,
       [](const AskedColliders& asked, const Avatar& a, Notes&) -> Result<std::string> {
         return mjcfColliders(a, nameOf(asked));
       },
       "an avatar knows neither limits nor masses of joints: every joint is a ball, the root is "
       "free, and MuJoCo takes masses from the volumes"},
      {".urdf", HeldAs::Doubles,
       [](const AskedColliders& asked, const Avatar& a, Notes&) -> Result<std::string> {
         return urdfColliders(a, nameOf(asked), asked.urdf);
       },
       "URDF has no ball joint: every joint is floating, and no link has a mass"},
      {".tscn", HeldAs::Floats,
       [](const AskedColliders& asked, const Avatar& a, Notes& notes) -> Result<std::string> {
         return godotColliders(a, nameOf(asked), asked.godot, notes);
       },
       ""},
      {".json", HeldAs::Floats,
       [](const auto&, const Avatar& a, Notes&) -> Result<std::string> {
         return unityColliders(a);
       },
       ""},
  }};
  return all;
}

Result<const ColliderFormat*> formatOf(const AskedColliders& asked) {
  std::string ending = std::filesystem::path(asked.output).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const ColliderFormat& format : formats()) {
    if (ending != format.ending) continue;
    const bool isVrm = ending == ".vrm";
    if (isVrm != asked.vrm.empty()) return &format;
    return Error::in("--into", ErrorCode::Mismatch,
                     isVrm
                         ? "expected the VRM avatar to which the colliders are added"
                         : "expected an output that ends in .vrm, found " + inQuotes(asked.output));
  }
  return Error::in("--output", ErrorCode::Mismatch,
                   "expected a file that ends in .glb, .vrm, .xml (MJCF), .urdf, .tscn (Godot) or "
                   ".json (Unity), found " +
                       inQuotes(asked.output));
}

/// The avatar with colliders as LSS, those of the links that `patterns` name (none: of all).
Result<Avatar> collidersOf(const Avatar& avatar, const std::vector<std::string>& patterns) {
  const Skeleton& skeleton = avatar.skeleton();
  std::vector<std::vector<Lss>> lss(countOf(avatar.numLinks()));
  std::vector<bool> isUsed(patterns.size(), false);
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    bool isChosen = patterns.empty();
    for (std::size_t p = 0; p < patterns.size(); ++p) {
      if (!matches(patterns[p], skeleton.name(link))) continue;
      isChosen = isUsed[p] = true;
    }
    if (!isChosen) continue;
    for (const Lss& one : avatar.lss(link)) lss[slotOf(link)].push_back(asCollider(one));
  }
  const auto unused = std::find(isUsed.begin(), isUsed.end(), false);
  if (unused != isUsed.end()) {
    return Error::in("--links", ErrorCode::Mismatch,
                     "expected names of links, found " +
                         inQuotes(patterns[static_cast<std::size_t>(unused - isUsed.begin())]) +
                         ", which names none");
  }
  return Avatar::build(skeleton, std::move(lss));
}

/// How much thicker than the avatar's LSS the thickest collider is, in metres.
double growthOf(const Avatar& avatar, HeldAs held) {
  double growth = 0.0;
  for (const auto& list : avatar.lss()) {
    for (const Lss& lss : list) {
      const double radius = standing(lss, Eigen::Vector3d::UnitY(), held).radius;
      growth = std::max(growth, radius - lss.radius);
    }
  }
  return growth;
}

/// What the avatar has and no collider can say.
void noteWhatIsLost(const Avatar& avatar, const Avatar& colliders, Notes& notes) {
  std::size_t meshes = 0, thin = 0, bare = 0;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    meshes += avatar.mesh(link).file.empty() ? 0 : 1;
    bare += colliders.lss(link).empty() ? 1 : 0;
    for (const Lss& lss : avatar.lss(link)) thin += lss.radius < kLeastRadius ? 1 : 0;
  }
  if (meshes > 0) {
    notes.push_back(
        fmt::format("{} links have meshes: their triangles are no colliders, the LSS "
                    "that hold them are",
                    meshes));
  }
  if (bare > 0) notes.push_back(fmt::format("{} links have no colliders", bare));
  if (thin > 0) {
    notes.push_back(
        fmt::format("{} LSS are thinner than {:g} m, which no tool takes, and become that "
                    "thick",
                    thin, kLeastRadius));
  }
}

std::string told(const AskedColliders& asked, const Avatar& colliders, HeldAs held) {
  std::size_t spheres = 0, capsules = 0, links = 0;
  for (const auto& list : colliders.lss()) {
    links += list.empty() ? 0 : 1;
    for (const Lss& lss : list) ++(lss.a == lss.b ? spheres : capsules);
  }
  return fmt::format(
      "{}\n  {} capsules and {} spheres on {} links, none smaller than its LSS\n"
      "  thicker by at most {:.2g} m, for what its numbers round\n",
      asked.output, capsules, spheres, links, growthOf(colliders, held));
}

Result<Done> writeFile(const std::string& path, const std::string& text) {
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(text);
  return file.commit();
}

ExitCode run(AskedColliders asked) {
  asked.urdf = asked.urdfParts ? UrdfCapsules::Parts : UrdfCapsules::Capsules;
  FORETOUCH_TRY_OR(failed, const ColliderFormat* const format, formatOf(asked));
  FORETOUCH_CHECK_OR(failed, checkIsNoInput(asked.output, {asked.avatar, asked.vrm}));
  FORETOUCH_TRY_OR(failed, const Avatar avatar, readAvatarFile(asked.avatar));
  FORETOUCH_TRY_OR(failed, const Avatar colliders, collidersOf(avatar, asked.links));
  Notes notes;
  FORETOUCH_TRY_OR(failed, const std::string text, format->write(asked, colliders, notes));
  FORETOUCH_CHECK_OR(failed, writeFile(asked.output, text));
  noteWhatIsLost(avatar, colliders, notes);
  if (*format->cannot != '\0') notes.emplace_back(format->cannot);
  printNotes(asked.output, notes);
  printOut(told(asked, colliders, format->held));
  return ExitCode::Done;
}

Settings collidersSettings(AskedColliders& asked) {
  Settings settings;
  settings.path("avatar", "AVATAR", asked.avatar, "Avatar file")
      .files("json")
      .required("an avatar file");
  settings
      .path("-o,--output", "FILE", asked.output,
            "Colliders to write: .glb (KHR_physics_rigid_bodies), .vrm, .xml (MJCF), .urdf, .tscn "
            "(Godot) or .json (Unity)")
      .required()
      .in(kOutputGroup);
  settings
      .path("--into", "BODY.vrm", asked.vrm,
            "For .vrm: the VRM avatar of which the output is a copy with more colliders")
      .files("vrm glb")
      .in(kInputGroup);
  settings.list("--links", "NAME", asked.links,
                "Colliders of these links alone; a * stands for any beginning or ending; may be "
                "repeated");
  settings.word<GodotVersion>("--godot", "VERSION", asked.godot,
                              {{"3", GodotVersion::Three}, {"4", GodotVersion::Four}},
                              "For .tscn: which Godot reads it");
  settings.flag(
      "--urdf-parts", asked.urdfParts,
      "For .urdf: a cylinder and two spheres for each capsule, for tools that do not know "
      "the <capsule> of URDF 1.1");
  return settings;
}

}  // namespace

Command avatarCollidersCommand() {
  const auto asked = std::make_shared<AskedColliders>();
  Command command{"colliders",
                  "Write an avatar's LSS as colliders of other tools, never smaller: glTF, VRM, "
                  "MJCF, URDF, Godot, Unity",
                  "Examples:\n"
                  "  foretouch avatar colliders man.avatar.json -o man.tscn\n"
                  "  foretouch avatar colliders body.avatar.json --into body.vrm -o more.vrm",
                  collidersSettings(*asked)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
