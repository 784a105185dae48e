#include "assets/clip/asf_skeleton.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_text.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

constexpr double kRadians = 3.14159265358979323846 / 180.0;
constexpr std::size_t kMaxBones = 4096;

Error wrong(const AcclaimLine& line, const std::string& message,
            ErrorCode code = ErrorCode::Syntax) {
  return bvhError(code, line.number, message);
}

Result<double> numberIn(const AcclaimLine& line, std::size_t i) {
  if (i >= line.words.size()) {
    return wrong(line, "expected " + std::to_string(i) + " numbers after " +
                           inQuotes(std::string(line.words[0])));
  }
  const BvhNumber number = readBvhNumber(line.words[i]);
  if (number.problem == nullptr) return number.value;
  return bvhError(number.code, line.number,
                  "expected a number, found " + inQuotes(std::string(line.words[i])) +
                      ", which is " + number.problem);
}

Result<Vector3d> threeIn(const AcclaimLine& line) {
  Vector3d three;
  for (std::size_t i = 0; i < 3; ++i) {
    FORETOUCH_TRY(three[static_cast<Eigen::Index>(i)], numberIn(line, i + 1));
  }
  return three;
}

bool isOrder(std::string_view order) {
  std::string letters(order);
  std::sort(letters.begin(), letters.end());
  return letters == "XYZ";
}

std::string inCapitals(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return text;
}

std::optional<AcclaimDof> dofOf(std::string_view word) {
  constexpr std::array<const char*, 6> kChannelWords{"TX", "TY", "TZ", "RX", "RY", "RZ"};
  const std::string capitals = inCapitals(word);
  for (std::size_t i = 0; i < kChannelWords.size(); ++i) {
    if (capitals == kChannelWords[i]) return static_cast<AcclaimDof>(i);
  }
  return std::nullopt;
}

class AsfReader {
 public:
  explicit AsfReader(std::string_view text) : lines_(text) {}

  Result<AsfSkeleton> read() {
    skeleton_.bones.push_back({"root", 0, {}, {}, {}});
    skeleton_.bones[0].axis = Quaternion::Identity();
    for (line_ = lines_.next(); !line_.words.empty();) {
      const std::string_view section = line_.words[0];
      if (section[0] != ':') return wrong(line_, "expected a section such as ':bonedata'");
      if (section == ":units") {
        FORETOUCH_CHECK(readUnits());
      } else if (section == ":root") {
        FORETOUCH_CHECK(readRoot());
      } else if (section == ":bonedata") {
        FORETOUCH_CHECK(readBones());
      } else if (section == ":hierarchy") {
        FORETOUCH_CHECK(readHierarchy());
      } else {  // :version, :name, :documentation, :skin
        skip();
      }
    }
    if (!hasRoot_) return wrong(line_, "expected a section ':root'", ErrorCode::Empty);
    if (!hasHierarchy_) return wrong(line_, "expected a section ':hierarchy'", ErrorCode::Empty);
    return inOrder();
  }

 private:
  void advance() { line_ = lines_.next(); }
  [[nodiscard]] bool isInSection() const {
    return !line_.words.empty() && line_.words[0][0] != ':';
  }
  [[nodiscard]] bool is(const char* word) const { return isKeyword(line_.words[0], word); }

  void skip() {
    for (advance(); isInSection(); advance()) {
    }
  }

  Result<Done> readUnits() {
    for (advance(); isInSection(); advance()) {
      if (is("length")) {
        FORETOUCH_TRY(skeleton_.length, numberIn(line_, 1));
        if (!(skeleton_.length > 0.0)) return wrong(line_, "expected a length above 0");
      } else if (is("angle")) {
        const bool isRad = line_.words.size() > 1 && isKeyword(line_.words[1], "rad");
        const bool isDeg = line_.words.size() > 1 && isKeyword(line_.words[1], "deg");
        if (!isRad && !isDeg) return wrong(line_, "expected 'deg' or 'rad' after 'angle'");
        radians_ = isRad ? 1.0 : kRadians;
      }
    }
    return Done{};
  }

  Result<Done> readRoot() {
    hasRoot_ = true;
    Vector3d orientation = Vector3d::Zero();
    std::string axis = "XYZ";
    for (advance(); isInSection(); advance()) {
      if (is("order")) {
        FORETOUCH_CHECK(readDofs(skeleton_.bones[0]));
      } else if (is("axis")) {
        if (line_.words.size() != 2 || !isOrder(inCapitals(line_.words[1]))) {
          return wrong(line_, "expected an order such as 'XYZ' after 'axis'");
        }
        axis = inCapitals(line_.words[1]);
      } else if (is("position")) {
        FORETOUCH_TRY(skeleton_.rootPosition, threeIn(line_));
      } else if (is("orientation")) {
        FORETOUCH_TRY(orientation, threeIn(line_));
      }
    }
    skeleton_.bones[0].axis = rotationOf(axis, orientation * radians_);
    return Done{};
  }

  Result<Done> readDofs(AsfBone& bone) {
    bone.dofs.clear();
    for (std::size_t i = 1; i < line_.words.size(); ++i) {
      const auto dof = dofOf(line_.words[i]);
      if (!dof) {
        return wrong(line_, "bone " + inQuotes(bone.name) + " has a degree of freedom " +
                                inQuotes(std::string(line_.words[i])) +
                                ", which cannot be read; expected tx, ty, tz, rx, ry or rz");
      }
      if (std::count(bone.dofs.begin(), bone.dofs.end(), *dof) != 0) {
        return wrong(line_, "bone " + inQuotes(bone.name) + " has a degree of freedom twice",
                     ErrorCode::DuplicateName);
      }
      bone.dofs.push_back(*dof);
    }
    return Done{};
  }

  Result<Done> readBones() {
    for (advance(); isInSection(); advance()) {
      if (!is("begin")) return wrong(line_, "expected 'begin'");
      if (skeleton_.bones.size() > kMaxBones) {
        return wrong(line_, "expected at most 4096 bones", ErrorCode::LimitExceeded);
      }
      FORETOUCH_CHECK(readBone());
    }
    return Done{};
  }

  Result<Done> readBone() {
    AsfBone bone;
    bone.line = line_.number;
    bone.axis = Quaternion::Identity();
    double length = 0.0;
    Vector3d direction = Vector3d::Zero();
    for (advance(); isInSection() && !is("end"); advance()) {
      if (is("name")) {
        if (line_.words.size() != 2) return wrong(line_, "expected one word after 'name'");
        bone.name = std::string(line_.words[1]);
      } else if (is("direction")) {
        FORETOUCH_TRY(direction, threeIn(line_));
      } else if (is("length")) {
        FORETOUCH_TRY(length, numberIn(line_, 1));
      } else if (is("axis")) {
        FORETOUCH_TRY(const Vector3d angles, threeIn(line_));
        if (line_.words.size() != 5 || !isOrder(inCapitals(line_.words[4]))) {
          return wrong(line_, "expected three angles and an order such as 'XYZ' after 'axis'");
        }
        bone.axis = rotationOf(inCapitals(line_.words[4]), angles * radians_);
      } else if (is("dof")) {
        FORETOUCH_CHECK(readDofs(bone));
      }  // id, limits, bodymass, cofmass: not about where it is
    }
    if (!isInSection()) return wrong(line_, "expected 'end' of the bone");
    if (const auto problem = nameProblem(bone.name)) {
      return bvhError(ErrorCode::Syntax, bone.line, "the name of a bone " + *problem);
    }
    // A direction's own length does not count.
    const double norm = direction.norm();
    bone.direction = norm > 0.0 ? Vector3d(direction * (length / norm)) : Vector3d::Zero();
    const bool isNew =
        bone.name != "root" && named_.emplace(bone.name, skeleton_.bones.size()).second;
    if (!isNew) {
      return bvhError(ErrorCode::DuplicateName, bone.line,
                      "two bones are called " + inQuotes(bone.name));
    }
    skeleton_.bones.push_back(std::move(bone));
    return Done{};
  }

  Result<std::size_t> boneOf(std::string_view name) const {
    if (name == "root") return std::size_t{0};
    const auto found = named_.find(name);
    if (found != named_.end()) return found->second;
    return wrong(line_, "no bone is called " + inQuotes(std::string(name)), ErrorCode::UnknownName);
  }

  Result<Done> readHierarchy() {
    hasHierarchy_ = true;
    children_.assign(skeleton_.bones.size(), {});
    std::vector<bool> isChild(skeleton_.bones.size(), false);
    for (advance(); isInSection(); advance()) {
      if (is("begin") || is("end")) continue;
      FORETOUCH_TRY(const std::size_t parent, boneOf(line_.words[0]));
      for (std::size_t i = 1; i < line_.words.size(); ++i) {
        FORETOUCH_TRY(const std::size_t child, boneOf(line_.words[i]));
        if (child == 0 || isChild[child]) {
          return wrong(line_,
                       "bone " + inQuotes(std::string(line_.words[i])) + " has a parent already",
                       ErrorCode::BadHierarchy);
        }
        isChild[child] = true;
        children_[parent].push_back(child);
      }
    }
    return Done{};
  }

  /// Depth first. What does not hang on the root is an error: also a cycle.
  Result<AsfSkeleton> inOrder() {
    children_.resize(skeleton_.bones.size());
    std::vector<std::pair<std::size_t, JointId>> pending{{0, kNoParent}};
    AsfSkeleton ordered;
    ordered.rootPosition = skeleton_.rootPosition;
    ordered.length = skeleton_.length;
    while (!pending.empty()) {
      const auto [bone, parent] = pending.back();
      pending.pop_back();
      const auto place = static_cast<JointId>(ordered.bones.size());
      ordered.placeOf.emplace(skeleton_.bones[bone].name, ordered.bones.size());
      ordered.bones.push_back(skeleton_.bones[bone]);
      ordered.parents.push_back(parent);
      for (auto child = children_[bone].rbegin(); child != children_[bone].rend(); ++child) {
        pending.emplace_back(*child, place);
      }
    }
    for (const AsfBone& bone : skeleton_.bones) {
      if (ordered.placeOf.count(bone.name) != 0) continue;
      return bvhError(ErrorCode::BadHierarchy, bone.line,
                      "bone " + inQuotes(bone.name) + " does not hang on the root");
    }
    return ordered;
  }

  AcclaimLines lines_;
  AcclaimLine line_;
  AsfSkeleton skeleton_;  // in the file's order
  std::map<std::string, std::size_t, std::less<>> named_;
  std::vector<std::vector<std::size_t>> children_;
  double radians_ = kRadians;
  bool hasRoot_ = false, hasHierarchy_ = false;
};

}  // namespace

AcclaimLine AcclaimLines::next() {
  AcclaimLine line;
  while (!rest_.empty() && line.words.empty()) {
    ++number_;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    std::string_view text = rest_.substr(0, end);
    const bool isCrLf = rest_.substr(end, 2) == "\r\n";
    rest_.remove_prefix(std::min(end + (isCrLf ? 2 : 1), rest_.size()));
    text = text.substr(0, text.find('#'));
    constexpr std::string_view kBlanks = " \t\v\f";
    for (;;) {
      text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
      if (text.empty()) break;
      const std::size_t length = std::min(text.find_first_of(kBlanks), text.size());
      line.words.push_back(text.substr(0, length));
      text.remove_prefix(length);
    }
  }
  line.number = number_;
  return line;
}

Quaternion rotationOf(const std::string& order, const Vector3d& angles) {
  Quaternion rotation = Quaternion::Identity();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Vector3d axis = Vector3d::Unit(order[i] - 'X');
    const double angle = angles[static_cast<Eigen::Index>(i)];
    rotation = Quaternion(Eigen::AngleAxisd(angle, axis)) * rotation;
  }
  return rotation;
}

Result<AsfSkeleton> parseAsf(std::string_view text) {
  if (const auto binary = binaryContent(text)) return *binary;
  return AsfReader(text).read();
}

}  // namespace foretouch::internal
