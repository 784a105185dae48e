#include "tests/fuzz/world_inputs.h"

#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "assets/clip/rigid_poses.h"
#include "middleware/world/world.h"
#include "tests/fuzz/promise.h"
#include "tools/world/world_file.h"

namespace foretouch::fuzz {
namespace {

void checkPlace(const RigidPose& pose) {
  require(pose.translation.allFinite() && pose.translation.cwiseAbs().maxCoeff() <= kMaxCoordinate,
          "places are within reach");
  require(std::abs(pose.rotation.norm() - 1.0) < 1e-12, "rotations are unit");
}

bool isInstant(std::int64_t utimeUs) {
  return utimeUs >= -kMostUtimeUs && utimeUs <= kMostUtimeUs;
}

void checkShape(const tools::FileShape& shape) {
  const int kinds = static_cast<int>(!shape.avatarPath.empty()) +
                    static_cast<int>(!shape.meshPath.empty()) +
                    static_cast<int>(!shape.lss.empty()) + static_cast<int>(shape.box.has_value());
  require(kinds == 1, "a body is made of one thing");
  require(shape.lss.size() <= kMaxLssPerLink, "LSS are bounded");
  for (const Lss& lss : shape.lss) {
    require(isValid(lss) && lss.radius <= kMaxCoordinate, "an LSS is legal");
  }
  if (shape.box) require(((*shape.box)[1] - (*shape.box)[0]).minCoeff() > 0.0, "a box has sides");
  const double scale = shape.meshImport.scale.value_or(1.0);
  require(std::isfinite(scale) && scale > 0.0, "the scale is positive");
}

void checkBody(const tools::FileBody& body) {
  require(!body.name.empty(), "a body has a name");
  require(!body.massKg || (std::isfinite(*body.massKg) && *body.massKg > 0.0), "masses are some");
  checkShape(body.shape);
  require(body.poses.size() <= tools::kMaxFilePoses, "poses are bounded");
  for (std::size_t i = 0; i < body.poses.size(); ++i) {
    checkPlace(body.poses[i].pose);
    require(isInstant(body.poses[i].utimeUs), "instants are legal");
    require(i == 0 || body.poses[i].utimeUs > body.poses[i - 1].utimeUs, "poses go on");
  }
  if (body.place) checkPlace(*body.place);
  for (std::size_t i = 0; i < body.changes.size(); ++i) {
    const tools::FileChange& change = body.changes[i];
    require(isInstant(change.utimeUs), "instants are legal");
    require(i == 0 || change.utimeUs > body.changes[i - 1].utimeUs, "changes go on");
    require(change.isAttached != change.carrier.empty(), "who is attached has a carrier");
    if (change.pose) checkPlace(*change.pose);
  }
  const tools::ClipTiming& timing = body.timing;
  require(timing.speed > 0.0 && std::isfinite(timing.speed), "time goes on");
  require(timing.fromUs >= 0 && (!timing.untilUs || *timing.untilUs >= timing.fromUs),
          "a part of a clip has an end");
}

}  // namespace

bool feedWorldFile(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto parsed = tools::parseWorldFile(text, "input");
  if (!parsed.ok()) {
    checkError(parsed.error(), text);
    return false;
  }
  const tools::WorldFile& world = parsed.value();
  require(world.tolerance >= kMinWorldTolerance && world.tolerance <= kMaxTolerance,
          "the tolerance is legal");
  require(!world.bodies.empty() && world.bodies.size() <= tools::kMaxFileBodies,
          "bodies are bounded");
  std::set<std::string> names;
  for (const tools::FileBody& body : world.bodies) {
    require(names.insert(body.name).second, "names differ");
    checkBody(body);
  }
  return true;
}

bool feedRigidPoses(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto poses = parseRigidPoses(text, "input");
  if (!poses.ok()) {
    checkReason(poses.error());
    require(poses.error().file == "input", "an error names its file");
    return false;
  }
  require(!poses.value().empty(), "there is a pose");
  for (std::size_t i = 0; i < poses.value().size(); ++i) {
    checkPlace(poses.value()[i].pose);
    require(std::isfinite(poses.value()[i].timeS), "times are finite");
    require(i == 0 || poses.value()[i].timeS > poses.value()[i - 1].timeS, "time goes on");
  }
  return true;
}

}  // namespace foretouch::fuzz
