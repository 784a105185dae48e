#include "assets/import/mjcf_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <set>
#include <string_view>
#include <tinyxml.h>
#include <utility>

#include "assets/import/failure.h"
#include "assets/import/memory_budget.h"
#include "assets/import/mjcf_tree.h"
#include "assets/import/text.h"
#include "assets/import/xml_document.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

namespace fs = std::filesystem;

template <std::size_t n>
bool isAmong(const std::array<std::string_view, n>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr std::array<std::string_view, 9> kSectionsWithoutShape{
    "option", "size", "visual", "statistic", "custom", "sensor", "actuator", "tendon", "keyframe"};
constexpr std::array<std::string_view, 4> kAssetsWithoutShape{"texture", "material", "hfield",
                                                              "skin"};
constexpr std::array<std::string_view, 13> kDefaultsWithoutShape{
    "material", "site",     "camera",      "light",    "tendon", "general", "motor",
    "position", "velocity", "intvelocity", "cylinder", "muscle", "adhesion"};
constexpr std::array<std::string_view, 3> kMarksOfBodies{"site", "camera", "light"};
constexpr std::array<std::string_view, 4> kClosedLoops{"connect", "weld", "flex", "tendon"};
/// Attributes of dynamics or looks, some of them younger than libmujoco 2.2, which refuses what it
/// does not know.
constexpr std::array<std::string_view, 6> kAttributesWithoutShape{
    "user", "material", "gravcomp", "actuatorfrcrange", "actuatorfrclimited", "actuatorgravcomp"};
/// Where files are, and what libmujoco would do to the model: we say it ourselves.
constexpr std::array<std::string_view, 9> kCompilerSettings{
    "meshdir",    "assetdir",   "texturedir",    "strippath",   "usethread",
    "fusestatic", "convexhull", "discardvisual", "settotalmass"};

template <typename Names>
void dropAmong(const Names& names, std::vector<MjcfElement>& from) {
  from.erase(std::remove_if(from.begin(), from.end(),
                            [&](const MjcfElement& e) { return isAmong(names, e.name); }),
             from.end());
}

bool isTrue(const std::string* value) {
  return value != nullptr && *value == "true";
}

class Reducer {
 public:
  Reducer(const ModelQuestion& question, MjcfTree& tree, std::vector<std::string>& notes)
      : question_(question), tree_(tree), notes_(notes) {}

  void reduce() {
    std::vector<MjcfElement>& sections = tree_.root.children;
    dropAmong(kSectionsWithoutShape, sections);
    for (MjcfElement& section : sections) {
      checkAll(section);
      if (section.name == "compiler") reduceCompiler(section);
      if (section.name == "default") reduceDefault(section);
      if (section.name == "asset") dropAmong(kAssetsWithoutShape, section.children);
      if (section.name == "worldbody") reduceWorld(section);
      if (section.name == "equality") reduceEquality(section);
    }
    for (MjcfElement& section : sections) {
      if (section.name == "asset") reduceMeshes(section);
    }
    noteWorld();
  }

 private:
  [[nodiscard]] std::string placeOf(const MjcfElement& element) const {
    return placeIn(tree_.files, element.file, element.line);
  }
  [[noreturn]] void refuse(const MjcfElement& element, const std::string& what) const {
    throw Failure{ImportFailure::Refused, placeOf(element) + what};
  }

  void checkAll(MjcfElement& element) {
    if (element.name == "plugin" || element.name == "extension") {
      refuse(element, "<" + element.name + ">: plugins are programs, which no model makes us run");
    }
    for (const std::string_view dropped : kAttributesWithoutShape) element.drop(dropped);
    for (MjcfElement& child : element.children) checkAll(child);
  }

  void reduceCompiler(MjcfElement& compiler) {
    for (const char* folder : {"assetdir", "meshdir"}) {
      if (const std::string* named = compiler.find(folder)) meshFolder_ = *named;
    }
    if (compiler.find("strippath") != nullptr) stripsPaths_ = isTrue(compiler.find("strippath"));
    for (const std::string_view setting : kCompilerSettings) compiler.drop(setting);
    compiler.children.clear();
  }

  void reduceDefault(MjcfElement& section) {
    dropAmong(kDefaultsWithoutShape, section.children);
    for (MjcfElement& child : section.children) {
      if (child.name == "default") reduceDefault(child);
      if (child.name == "geom") reduceGeom(child);
    }
  }

  /// Floors, walls and lamps are a scene's, not the robot's.
  void reduceWorld(MjcfElement& world) {
    dropAmong(kMarksOfBodies, world.children);
    for (const MjcfElement& child : world.children) {
      if (child.name == "geom") worldGeoms_.push_back(nameOf(child));
    }
    dropAmong(std::array<std::string_view, 1>{"geom"}, world.children);
    for (MjcfElement& child : world.children) {
      if (child.name == "body") reduceBody(child, 1);
      if (child.name == "composite") refuseComposite(child);
    }
  }

  void reduceBody(MjcfElement& body, int depth) {
    countPart(body);
    if (depth > kMaxChainDepth) {
      throw Failure{
          ImportFailure::TooLarge,
          placeOf(body) + "more than " + std::to_string(kMaxChainDepth) + " bodies in one another"};
    }
    dropAmong(kMarksOfBodies, body.children);
    for (MjcfElement& child : body.children) {
      if (child.name == "body") reduceBody(child, depth + 1);
      if (child.name == "joint" || child.name == "freejoint") countPart(child);
      if (child.name == "geom") reduceGeom(child);
      if (child.name == "composite") refuseComposite(child);
    }
  }

  void countPart(const MjcfElement& part) {
    if (++parts_ <= kMaxJoints) return;
    throw Failure{ImportFailure::TooLarge,
                  placeOf(part) + "more than " + std::to_string(kMaxJoints) + " bodies and joints"};
  }

  void reduceGeom(MjcfElement& geom) {
    if (const std::string* mesh = geom.find("mesh")) usedMeshes_.insert(*mesh);
    const std::string* type = geom.find("type");
    if (geom.find("hfield") != nullptr || (type != nullptr && *type == "hfield")) {
      refuse(geom, "geom " + nameOf(geom) +
                       " is a height field, which is ground and no part of a robot; expected "
                       "meshes and solids on bodies");
    }
  }

  [[noreturn]] void refuseComposite(const MjcfElement& composite) const {
    refuse(composite, "<composite>: ropes, cloths and soft bodies have no joint coordinates");
  }

  void reduceEquality(MjcfElement& equality) {
    for (const MjcfElement& constraint : equality.children) {
      if (!isAmong(kClosedLoops, constraint.name)) continue;
      const std::string what = "equality <" + constraint.name + "> " + nameOf(constraint) +
                               " ties bodies beside their joints";
      if (question_.isRobot) {
        refuse(constraint, what + "; expected constraints of joints alone");
      }
      notes_.push_back(placeOf(constraint) + what + ": left out");
    }
    dropAmong(kClosedLoops, equality.children);
  }

  static std::string nameOf(const MjcfElement& element) {
    const std::string* name = element.find("name");
    return name == nullptr ? "without a name" : quotedName(*name);
  }

  /// What no geom of a body shows need not be there. A mesh without a name has its file's.
  void reduceMeshes(MjcfElement& assets) {
    std::vector<MjcfElement> used;
    for (MjcfElement& mesh : assets.children) {
      const std::string* file = mesh.find("file");
      if (mesh.name == "mesh" && mesh.find("name") == nullptr && file != nullptr) {
        mesh.set("name", fs::path(*file).stem().string());
      }
      const std::string* name = mesh.find("name");
      if (mesh.name == "mesh" && name != nullptr && usedMeshes_.count(*name) == 0) continue;
      if (mesh.name == "mesh" && mesh.find("file") != nullptr) placeMesh(mesh);
      used.push_back(std::move(mesh));
    }
    assets.children = std::move(used);
  }

  void placeMesh(MjcfElement& mesh) {
    const std::string reference = *mesh.find("file");
    constexpr std::array<std::string_view, 3> kFormats{".stl", ".obj", ".msh"};
    if (!isAmong(kFormats, lowerExtensionOf(reference))) {
      refuse(mesh, "mesh file " + quotedName(reference) + ": expected .stl, .obj or .msh");
    }
    const fs::path folder = fs::path(question_.path).parent_path() / meshFolder_;
    const std::string path =
        findMjcfFile(question_, tree_, mesh, folder.string(),
                     stripsPaths_ ? fs::path(reference).filename().string() : reference);
    std::error_code unknown;
    const auto bytes = fs::file_size(path, unknown);
    if (!unknown) grantMemoryFor(bytes);
    mesh.set("file", path);
  }

  void noteWorld() {
    if (worldGeoms_.empty()) return;
    constexpr std::size_t kShown = 5;
    std::string text = "geoms of the world itself (" + std::to_string(worldGeoms_.size()) +
                       ") are no part of a body and are left out: ";
    for (std::size_t i = 0; i < std::min(worldGeoms_.size(), kShown); ++i) {
      text += (i == 0 ? "" : ", ") + worldGeoms_[i];
    }
    if (worldGeoms_.size() > kShown) text += ", ...";
    notes_.push_back(text);
  }

  const ModelQuestion& question_;
  MjcfTree& tree_;
  std::vector<std::string>& notes_;
  std::string meshFolder_;
  bool stripsPaths_ = false;
  std::int32_t parts_ = 0;
  std::set<std::string> usedMeshes_;
  std::vector<std::string> worldGeoms_;
};

/// One element per line, so that a line of libmujoco's reports is an element's.
class Printer {
 public:
  Printer(const MjcfTree& tree, MjcfText& out) : tree_(tree), out_(out) {}

  void print() {
    line(tree_.root, "<mujoco>");
    // What MuJoCo does today where the file is silent; and masses play no part here.
    line(
        tree_.root,
        R"(<compiler autolimits="true" boundmass="1e-6" boundinertia="1e-6" balanceinertia="true"/>)");
    for (const MjcfElement& child : tree_.root.children) printElement(child);
    // The last word: no threads, which the cage has none of, and every geom on its own body.
    line(
        tree_.root,
        R"(<compiler usethread="false" convexhull="false" discardvisual="false" fusestatic="false"/>)");
    line(tree_.root, "</mujoco>");
  }

 private:
  void line(const MjcfElement& element, const std::string& text) {
    out_.xml += text + "\n";
    out_.placeOfLine.push_back({element.file, element.line});
  }

  void printElement(const MjcfElement& element) {
    std::string text = "<" + element.name;
    for (const auto& [key, value] : element.attributes) {
      TIXML_STRING encoded;
      TiXmlBase::EncodeString(value, &encoded);
      text += " " + key + "=\"" + encoded + "\"";
    }
    line(element, text + (element.children.empty() ? "/>" : ">"));
    if (element.children.empty()) return;
    for (const MjcfElement& child : element.children) printElement(child);
    line(element, "</" + element.name + ">");
  }

  const MjcfTree& tree_;
  MjcfText& out_;
};

/// The number behind `mark` in the text; 0 if there is none.
std::size_t numberAfter(const std::string& text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return 0;
  std::size_t number = 0;
  for (std::size_t i = at + mark.size(); i < text.size() && i < at + mark.size() + 9; ++i) {
    if (std::isdigit(static_cast<unsigned char>(text[i])) == 0) break;
    number = 10 * number + static_cast<std::size_t>(text[i] - '0');
  }
  return number;
}

}  // namespace

/// "Error: range[0] should ...\nObject name = j, id = 0, line = 5, column = -1", or
/// "XML Error: Schema violation: unrecognized element\n\nElement 'goem', line 6\n".
std::string MjcfText::placed(const std::string& report) const {
  std::size_t number = numberAfter(report, ", line = ");
  if (number == 0) number = numberAfter(report, "', line ");
  std::string reason = report.substr(0, report.find('\n'));
  for (const std::string_view lead : {"XML Error: ", "XML Read error:", "Error: "}) {
    if (reason.compare(0, lead.size(), lead) == 0) reason.erase(0, lead.size());
  }
  const std::size_t element = report.find("Element '");
  if (element != std::string::npos) {
    const std::size_t end = report.find('\'', element + 9);
    if (end != std::string::npos) {
      reason += " in <" + report.substr(element + 9, end - element - 9) + ">";
    }
  }
  if (reason.empty()) reason = "libmujoco gives no reason";
  if (number == 0 || number > placeOfLine.size()) return reason;
  const Place& place = placeOfLine[number - 1];
  return placeIn(files, place.file, place.line) + reason;
}

bool isMjcf(const std::string& path) {
  const std::string extension = lowerExtensionOf(path);
  if (extension == ".mjcf") return true;
  if (extension != ".xml") return false;
  constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
  const auto text = readWholeFile(path, kMaxBytes);
  if (!text.ok()) return false;
  // The first tag that is not a comment, declaration or instruction.
  std::string_view rest = text.value();
  for (std::size_t at = rest.find('<'); at != std::string_view::npos; at = rest.find('<')) {
    rest.remove_prefix(at);
    const bool isComment = rest.substr(0, 4) == "<!--";
    if (!isComment && rest.substr(0, 2) != "<?" && rest.substr(0, 2) != "<!") break;
    const std::string_view end = isComment ? "-->" : ">";
    const std::size_t closed = rest.find(end);
    rest.remove_prefix(closed == std::string_view::npos ? rest.size() : closed + end.size());
  }
  constexpr std::string_view kRoot = "<mujoco";
  return rest.substr(0, kRoot.size()) == kRoot && rest.size() > kRoot.size() &&
         std::isalnum(static_cast<unsigned char>(rest[kRoot.size()])) == 0;
}

MjcfText readMjcfText(const ModelQuestion& question) {
  MjcfTree tree = readMjcfTree(question);
  MjcfText out;
  out.files = tree.files;
  Reducer(question, tree, out.notes).reduce();
  Printer(tree, out).print();
  return out;
}

}  // namespace foretouch::internal
