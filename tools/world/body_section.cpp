#include "tools/world/body_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/avatar.h"
#include "assets/text_file.h"
#include "tools/settings/config_reading.h"

namespace foretouch::tools {
namespace {

constexpr double kMostYawDeg = 1e6;

Eigen::Vector3d vectorOf(const std::vector<double>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

void readLss(TomlSection& section, const std::string& title, FileShape& shape) {
  for (TomlSection& one : section.tables("lss", title, kMaxLssPerLink)) {
    one.allowOnly({"a", "b", "radius"});
    std::vector<double> a, b;
    Lss lss;
    const bool hasA = one.numbers("a", 3, kMaxCoordinate, a);
    const bool hasB = one.numbers("b", 3, kMaxCoordinate, b);
    one.number(
        "radius", "a finite number of metres from 0 to 1e7",
        [](double radius) { return radius >= 0.0 && radius <= kMaxCoordinate; }, lss.radius);
    if (!hasA || !hasB || !hasKey(one, "radius")) {
      one.fail(ErrorCode::Empty, "expected a, b and radius");
      return;
    }
    lss.a = vectorOf(a);
    lss.b = vectorOf(b);
    shape.lss.push_back(lss);
  }
  if (hasKey(section, "lss") && shape.lss.empty()) {
    section.fail(ErrorCode::Empty, "expected at least one LSS");
  }
}

void readBox(TomlSection& section, FileShape& shape) {
  if (!hasKey(section, "box")) return;
  TomlSection box = section.table("box");
  box.allowOnly({"low", "high"});
  std::vector<double> low, high;
  const bool hasLow = box.numbers("low", 3, kMaxCoordinate, low);
  const bool hasHigh = box.numbers("high", 3, kMaxCoordinate, high);
  if (!hasLow || !hasHigh) return section.fail(ErrorCode::Empty, "expected low and high in box");
  const Eigen::Vector3d sides = vectorOf(high) - vectorOf(low);
  if (!(sides.minCoeff() > 0.0)) {
    return section.fail(ErrorCode::OutOfRange,
                        "expected every number of box high above that of low");
  }
  shape.box = {vectorOf(low), vectorOf(high)};
}

}  // namespace

void readShape(TomlSection& section, const std::string& file, bool isTrigger, FileShape& shape) {
  const std::array<const char*, 5> kinds{"avatar", "mesh", "sphere", "lss", "box"};
  const auto given = std::count_if(kinds.begin(), kinds.end(),
                                   [&](const char* key) { return hasKey(section, key); });
  if (given != 1) {
    section.fail(ErrorCode::Mismatch,
                 fmt::format("expected exactly one of {}mesh, sphere, lss and box, found {}",
                             isTrigger ? "" : "avatar, ", given));
  }
  for (const auto& [key, path] :
       {std::make_pair("avatar", &shape.avatarPath), std::make_pair("mesh", &shape.meshPath)}) {
    section.text(key, *path, false);
    *path = besideFile(*path, file);
  }
  section.text("node", shape.node, false);
  if (hasKey(section, "scale")) {
    section.number(
        "scale", "a finite number greater than 0", [](double unit) { return unit > 0.0; },
        shape.meshImport.scale.emplace(1.0));
  }
  if (hasKey(section, "up")) {
    section.word<UpAxis>("up", {"y", "z"}, {UpAxis::Y, UpAxis::Z},
                         shape.meshImport.up.emplace(UpAxis::Y));
  }
  for (const char* const key : {"node", "scale", "up"}) {
    if (!hasKey(section, key) || !shape.meshPath.empty()) continue;
    section.fail(ErrorCode::Mismatch, std::string("expected a mesh beside ") + key);
  }
  if (hasKey(section, "sphere")) {
    section.number(
        "sphere", "a radius in metres greater than 0, at most 1e7",
        [](double radius) { return radius > 0.0 && radius <= kMaxCoordinate; },
        shape.lss.emplace_back().radius);
  }
  readLss(section, isTrigger ? "[[trigger.lss]]" : "[[body.lss]]", shape);
  readBox(section, shape);
}

std::optional<RigidPose> readPlace(TomlSection& section) {
  RigidPose pose;
  std::vector<double> numbers;
  if (section.numbers("position", 3, kMaxCoordinate, numbers)) {
    pose.translation = vectorOf(numbers);
  }
  if (section.numbers("rotation", 4, 2.0, numbers)) {
    const auto unit = unitQuaternion({numbers[0], numbers[1], numbers[2], numbers[3]});
    if (!unit) {
      section.outOfRange("rotation", "w, x, y, z of norm 1 within 0.001", "another norm",
                         *section.find("rotation"));
    }
    pose.rotation = unit.value_or(Quaternion::Identity());
  }
  if (hasKey(section, "yaw")) {
    constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
    double yawDeg = 0.0;
    section.number(
        "yaw", "a finite number of degrees from -1e6 to 1e6",
        [](double degrees) { return std::abs(degrees) <= kMostYawDeg; }, yawDeg);
    pose.rotation =
        Quaternion(Eigen::AngleAxisd(yawDeg * kRadPerDeg, Eigen::Vector3d::UnitY())).normalized();
    if (hasKey(section, "rotation")) {
      section.fail(ErrorCode::Mismatch, "expected rotation or yaw, found both");
    }
  }
  if (hasKey(section, "position") || hasKey(section, "rotation") || hasKey(section, "yaw"))
    return pose;
  return std::nullopt;
}

}  // namespace foretouch::tools
