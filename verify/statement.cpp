#include "verify/statement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "verify/json.h"
#include "verify/text_lines.h"

namespace verify {
namespace {

/// Lines of an OBJ that say nothing of its triangles.
bool isOfNoShape(std::string_view word) {
  for (const char* const known : {"vn", "vt", "o", "g", "s", "usemtl", "mtllib"}) {
    if (word == known) return true;
  }
  return word.front() == '#';
}

/// Lines of each kind so far.
struct ObjCounts {
  std::size_t vertices = 0, textures = 0, normals = 0;
};

/// "7", "7/1", "7//3" or "7/1/3", each from 1, of what is above.
bool isCorner(std::string_view word, const ObjCounts& counts, std::size_t& vertex) {
  const std::size_t first = word.find('/');
  if (!isWhole(word.substr(0, first), std::size_t{1}, counts.vertices, vertex)) return false;
  if (first == word.npos) return true;
  const std::string_view rest = word.substr(first + 1);
  const std::size_t second = rest.find('/');
  const std::string_view texture = rest.substr(0, second);
  std::size_t other = 0;
  const bool hasNormal = second != rest.npos;
  if (!(texture.empty() && hasNormal) &&
      !isWhole(texture, std::size_t{1}, counts.textures, other)) {
    return false;
  }
  return !hasNormal || isWhole(rest.substr(second + 1), std::size_t{1}, counts.normals, other);
}

/// What readers of single and of double precision take it for. Not all of them round to the
/// nearest: one more on each side, unless single precision holds it exactly.
Interval readings(double number) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto nearest = static_cast<float>(number);
  if (nearest == number) return number;
  return {std::nextafter(std::nextafter(nearest, -kInfinity), -kInfinity),
          std::nextafter(std::nextafter(nearest, kInfinity), kInfinity)};
}

/// "v" and three coordinates; a colour may follow.
bool isVertex(const std::vector<std::string_view>& words, Vector& vertex) {
  std::array<double, 3> point{}, colour{};
  if (words.size() != 4 && words.size() != 7) return false;
  if (!areNumbers(words, 1, point)) return false;
  if (words.size() == 7 && !areNumbers(words, 4, colour)) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) vertex[axis] = readings(point[axis]);
  return true;
}

/// A pose of all joints, a line each.
bool readPose(TextLines& lines, std::size_t joints, std::vector<JointPose>& pose) {
  for (std::size_t i = 0; i < joints; ++i) {
    std::array<double, 7> numbers{};
    if (!lines.next() || lines.words().size() != 7 || !areNumbers(lines.words(), 0, numbers)) {
      return false;
    }
    pose.push_back(
        {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5], numbers[6]}});
  }
  return true;
}

template <std::size_t Count>
bool readPoint(const Json* value, std::array<double, Count>& point) {
  if (value == nullptr || value->items.size() != Count) return false;
  for (std::size_t i = 0; i < Count; ++i) {
    if (value->items[i].kind != Json::Kind::Number) return false;
    point[i] = value->items[i].number;
  }
  return true;
}

bool readCapsules(const Json* list, Link& link) {
  if (list == nullptr || list->kind != Json::Kind::Array) return false;
  for (const Json& item : list->items) {
    Capsule capsule{};
    const Json* const radius = item.find("radius");
    if (!readPoint(item.find("a"), capsule.a) || !readPoint(item.find("b"), capsule.b) ||
        radius == nullptr || radius->kind != Json::Kind::Number || radius->number < 0.0) {
      return false;
    }
    capsule.radius = radius->number;
    link.capsules.push_back(capsule);
  }
  return true;
}

}  // namespace

Fault readScene(std::string_view text, std::vector<Triangle>& scene) {
  if (Fault fault = otherLinesIn(text); !fault.what.empty()) return fault;
  std::vector<Vector> vertices;
  ObjCounts counts;
  for (TextLines lines(text); lines.next();) {
    const auto& words = lines.words();
    counts.textures += words[0] == "vt" ? 1 : 0;
    counts.normals += words[0] == "vn" ? 1 : 0;
    if (lines.isIndented()) {
      return {lines.line(),
              "expected no blanks before the first word: some readers skip such lines"};
    }
    if (words[0] == "v") {
      if (!isVertex(words, vertices.emplace_back())) {
        return {lines.line(), "expected three coordinates, or these and a colour of three numbers"};
      }
      ++counts.vertices;
    } else if (words[0] == "f") {
      std::array<std::size_t, 3> at{};
      if (words.size() != 4) return {lines.line(), "expected a face of three corners"};
      for (std::size_t i = 0; i < 3; ++i) {
        if (!isCorner(words[i + 1], counts, at[i])) {
          return {lines.line(), "expected a vertex above, counted from 1, and such /vt/vn"};
        }
      }
      scene.push_back({{vertices[at[0] - 1], vertices[at[1] - 1], vertices[at[2] - 1]}});
    } else if (!isOfNoShape(words[0])) {
      return {lines.line(), "expected v or f: other shapes are not known here"};
    }
  }
  if (scene.empty()) return {0, "expected at least one triangle"};
  return {};
}

Fault readAvatar(std::string_view text, std::vector<Link>& links) {
  Json root;
  if (!parseJson(text, root)) return {0, "expected JSON, keys without escapes"};
  const Json* const format = root.find("format");
  const Json* const list = root.find("links");
  if (format == nullptr || format->text != "foretouch-avatar" || list == nullptr) {
    return {0, "expected an avatar file: format and links"};
  }
  if (list->items.size() > kMostLinks) {
    return {0, "expected at most " + std::to_string(kMostLinks) + " links"};
  }
  std::map<std::string, int> places;
  for (const Json& item : list->items) {
    Link link;
    const Json* const name = item.find("name");
    const Json* const parent = item.find("parent");
    if (name == nullptr || parent == nullptr || !readCapsules(item.find("lss"), link)) {
      return {0, "link " + std::to_string(links.size()) + ": expected name, parent and lss"};
    }
    const bool isRoot = parent->kind == Json::Kind::Null;
    if (!name->isPlainText() || !(isRoot || parent->isPlainText())) {
      return {0, "link " + std::to_string(links.size()) +
                     ": expected a name without escapes, and such a parent or null"};
    }
    link.name = name->text;
    const Json* const rotation = item.find("rotation");
    link.hasRest = readPoint(item.find("offset"), link.offset) &&
                   (std::count(item.keys.begin(), item.keys.end(), "rotation") == 0 ||
                    readPoint(rotation, link.rotation));
    if (!isRoot) {
      const auto found = places.find(parent->text);
      if (found == places.end())
        return {0, "link " + link.name + ": expected its parent before it"};
      link.parent = found->second;
    }
    if (!places.emplace(link.name, static_cast<int>(links.size())).second) {
      return {0, "link " + link.name + ": expected names that differ"};
    }
    links.push_back(std::move(link));
  }
  if (links.empty()) return {0, "expected at least one link"};
  return {};
}

Fault readSteps(std::string_view text, std::size_t joints, std::vector<Step>& steps) {
  if (Fault fault = otherLinesIn(text); !fault.what.empty()) return fault;
  TextLines lines(text);
  const bool hasFirst = lines.next() && lines.words().size() == 2 &&
                        lines.words()[0] == "foretouch-steps" && lines.words()[1] == "1";
  if (!hasFirst) return {lines.line(), "expected the line foretouch-steps 1 first"};
  while (lines.next()) {
    Step step;
    const auto& words = lines.words();
    if (words.size() != 2 || words[0] != "step" ||
        !isWhole(words[1], 0LL, 1LL << 53, step.number)) {
      return {lines.line(), "expected step and its number"};
    }
    if (!readPose(lines, joints, step.from) || !readPose(lines, joints, step.to)) {
      return {lines.line(), "expected two poses of " + std::to_string(joints) +
                                " joints, each a line of x y z and w x y z"};
    }
    steps.push_back(std::move(step));
  }
  return {};
}

}  // namespace verify
