#include "verify/statement.h"

#include <algorithm>

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

/// "7", "7/1" or "7//3", from 1.
bool isCorner(std::string_view word, std::size_t vertices, std::size_t& vertex) {
  return isWhole(word.substr(0, word.find('/')), std::size_t{1}, vertices, vertex);
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

bool readPoint(const Json* value, Point& point) {
  if (value == nullptr || value->items.size() != 3) return false;
  for (std::size_t i = 0; i < 3; ++i) {
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
  std::vector<Point> vertices;
  for (TextLines lines(text); lines.next();) {
    const auto& words = lines.words();
    if (words[0] == "v") {
      Point point{};
      if (words.size() < 4 || !areNumbers(words, 1, point)) {
        return {lines.line(), "expected three coordinates"};
      }
      vertices.push_back(point);
    } else if (words[0] == "f") {
      std::array<std::size_t, 3> at{};
      if (words.size() != 4) return {lines.line(), "expected a face of three corners"};
      for (std::size_t i = 0; i < 3; ++i) {
        if (!isCorner(words[i + 1], vertices.size(), at[i])) {
          return {lines.line(), "expected a vertex above, counted from 1"};
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
  if (!parseJson(text, root)) return {0, "expected JSON"};
  const Json* const format = root.find("format");
  const Json* const list = root.find("links");
  if (format == nullptr || format->text != "foretouch-avatar" || list == nullptr) {
    return {0, "expected an avatar file: format and links"};
  }
  for (const Json& item : list->items) {
    Link link;
    const Json* const name = item.find("name");
    const Json* const parent = item.find("parent");
    if (name == nullptr || parent == nullptr || !readCapsules(item.find("lss"), link)) {
      return {0, "link " + std::to_string(links.size()) + ": expected name, parent and lss"};
    }
    link.name = name->text;
    if (parent->kind == Json::Kind::Text) {
      const auto found = std::find_if(links.begin(), links.end(), [&](const Link& other) {
        return other.name == parent->text;
      });
      if (found == links.end()) return {0, "link " + link.name + ": expected its parent before it"};
      link.parent = static_cast<int>(found - links.begin());
    }
    links.push_back(std::move(link));
  }
  if (links.empty()) return {0, "expected at least one link"};
  return {};
}

Fault readSteps(std::string_view text, std::size_t joints, std::vector<Step>& steps) {
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
