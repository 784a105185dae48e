#include <algorithm>
#include <cmath>
#include <console_bridge/console.h>
#include <exception>
#include <map>
#include <set>
#include <string>
#include <urdf_parser/urdf_parser.h>
#include <utility>
#include <vector>

#include "assets/import/failure.h"
#include "assets/import/memory_budget.h"
#include "assets/import/model.h"
#include "assets/import/text.h"
#include "assets/import/urdf_surface.h"
#include "assets/import/urdf_text.h"
#include "assets/text_file.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMaxUrdfBytes = std::size_t{16} << 20;

/// urdfdom reports errors only in its log, some of them nowhere else: it returns a link without the
/// shapes that it could not read. The first error is the nearest to the cause.
class FirstError : public console_bridge::OutputHandler {
 public:
  FirstError() { console_bridge::useOutputHandler(this); }
  ~FirstError() override { console_bridge::noOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && text_.empty()) text_ = text;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Puts "line 7: " before a reason that has a word in brackets or quotes, if that word is on only
/// one line of the file: urdfdom reports no lines.
std::string withLine(const std::string& reason, const std::string& text) {
  for (std::size_t open = reason.find_first_of("['"); open != std::string::npos;
       open = reason.find_first_of("['", open + 1)) {
    const std::size_t close = reason.find(reason[open] == '[' ? ']' : '\'', open + 1);
    if (close == std::string::npos) break;
    const std::string word = reason.substr(open + 1, close - open - 1);
    const std::size_t first = text.find(word);
    open = close;
    if (word.empty() || first == std::string::npos) continue;
    const std::size_t end = text.find('\n', first);
    if (end != std::string::npos && text.find(word, end) != std::string::npos) continue;
    const auto begin = text.begin();
    const auto line = std::count(begin, begin + static_cast<std::ptrdiff_t>(first), '\n') + 1;
    return "line " + std::to_string(line) + ": " + reason;
  }
  return reason;
}

urdf::ModelInterfaceSharedPtr parse(const std::string& xml, const std::string& text) {
  FirstError reason;
  urdf::ModelInterfaceSharedPtr robot;
  try {
    robot = urdf::parseURDF(xml);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    refuse(withLine(error.what(), text));
  }
  if (!reason.text().empty()) refuse(withLine(reason.text(), text));
  if (robot == nullptr || robot->getRoot() == nullptr) refuse("urdfdom gives no reason");
  return robot;
}

Vector3d axisOf(const urdf::Joint& joint) {
  const Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  const Vector3d unit = axis.stableNormalized();
  if (!(std::abs(unit.norm() - 1.0) < 1e-6)) {
    refuse("joint " + quotedName(joint.name) + " has no axis: zero or not finite");
  }
  return unit;
}

class RobotTree {
 public:
  RobotTree(const urdf::ModelInterface& robot, bool isStrict, UrdfSurface& surface,
            ModelBuilder& builder)
      : robot_(robot), isStrict_(isStrict), surface_(surface), builder_(builder) {}

  /// Depth first from the root, on an explicit stack.
  void add() {
    struct Pending {
      const urdf::Link* link;
      const urdf::Joint* joint;
      std::int32_t parent;
    };
    std::vector<Pending> pending{{robot_.getRoot().get(), nullptr, -1}};
    std::set<const urdf::Link*> reached;
    while (!pending.empty()) {
      const Pending current = pending.back();
      pending.pop_back();
      if (!reached.insert(current.link).second) {
        refuse("link " + quotedName(current.link->name) + " is the child of several joints");
      }
      const auto index = static_cast<std::int32_t>(builder_.model.nodes.size());
      addNode(*current.link, current.joint, current.parent);
      surface_.add(*current.link, index);
      const auto& joints = current.link->child_joints;
      for (auto joint = joints.rbegin(); joint != joints.rend(); ++joint) {
        const auto child = robot_.getLink((*joint)->child_link_name);
        if (child == nullptr) refuse("joint " + quotedName((*joint)->name) + " leads to no link");
        pending.push_back({child.get(), joint->get(), index});
      }
    }
    if (reached.size() != robot_.links_.size()) {
      refuse("the links form a cycle: " + std::to_string(robot_.links_.size() - reached.size()) +
             " of them hang on no root");
    }
    addMimics();
  }

 private:
  void addNode(const urdf::Link& link, const urdf::Joint* joint, std::int32_t parent) {
    ModelNode node;
    node.name = link.name;
    node.parent = parent;
    if (joint != nullptr) setJoint(*joint, node);
    ModelSize more;
    more.nodes = 1;
    more.nameBytes = node.name.size() + node.jointName.size();
    builder_.count(more);
    builder_.model.nodes.push_back(std::move(node));
  }

  void setJoint(const urdf::Joint& joint, ModelNode& node) {
    node.jointName = joint.name;
    node.toParent =
        affineOf(joint.parent_to_joint_origin_transform, "joint " + quotedName(joint.name));
    switch (joint.type) {
      case urdf::Joint::FIXED: node.joint = ModelJointType::Fixed; return;
      case urdf::Joint::REVOLUTE: node.joint = ModelJointType::Revolute; break;
      case urdf::Joint::CONTINUOUS: node.joint = ModelJointType::Continuous; break;
      case urdf::Joint::PRISMATIC: node.joint = ModelJointType::Prismatic; break;
      case urdf::Joint::PLANAR: node.joint = ModelJointType::Planar; break;
      case urdf::Joint::FLOATING:
      case urdf::Joint::UNKNOWN:
        if (isStrict_) {
          refuse("joint " + quotedName(joint.name) +
                 " is floating; expected one that is fixed, revolute, continuous, prismatic or "
                 "planar");
        }
        return;
    }
    node.axis = axisOf(joint);
    const bool isLimited =
        node.joint == ModelJointType::Revolute || node.joint == ModelJointType::Prismatic;
    if (isLimited && joint.limits != nullptr) setLimits(joint, node);
    if (isLimited && isStrict_ && node.lowerLimit == node.upperLimit) {
      refuse("joint " + quotedName(joint.name) +
             " states no limits, or equal ones; expected a lower one below an upper one, or a "
             "joint that is continuous or fixed");
    }
  }

  /// Once all nodes are known: a leader may come later.
  void addMimics() {
    std::map<std::string, std::int32_t> nodeOf;
    const auto& nodes = builder_.model.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i].parent >= 0) nodeOf.emplace(nodes[i].jointName, static_cast<std::int32_t>(i));
    }
    for (const auto& [name, node] : nodeOf) {
      const auto mimic = robot_.getJoint(name)->mimic;
      if (mimic == nullptr) continue;
      const auto leader = nodeOf.find(mimic->joint_name);
      if (leader == nodeOf.end()) {
        if (!isStrict_) continue;
        refuse("joint " + quotedName(name) + " mimics " + quotedName(mimic->joint_name) +
               ", which the file does not hold");
      }
      if (!std::isfinite(mimic->multiplier) || !std::isfinite(mimic->offset)) {
        refuse("joint " + quotedName(name) + " mimics another one by a number that is not finite");
      }
      ModelSize more;
      more.mimics = 1;
      builder_.count(more);
      builder_.model.mimics.push_back({node, leader->second, mimic->multiplier, mimic->offset});
    }
  }

  void setLimits(const urdf::Joint& joint, ModelNode& node) {
    const double lower = joint.limits->lower, upper = joint.limits->upper;
    if (!std::isfinite(lower) || !std::isfinite(upper)) {
      refuse("joint " + quotedName(joint.name) + " has a limit that is not finite");
    }
    if (lower > upper && isStrict_) {
      refuse("joint " + quotedName(joint.name) + " has its lower limit above its upper one");
    }
    if (lower > upper) {
      builder_.note("joint " + quotedName(joint.name) +
                    " has its lower limit above its upper one: read as without limits");
      return;
    }
    node.lowerLimit = lower;
    node.upperLimit = upper;
  }

  const urdf::ModelInterface& robot_;
  bool isStrict_;  // as ModelImportOptions::isRobot says
  UrdfSurface& surface_;
  ModelBuilder& builder_;
};

}  // namespace

Model readUrdf(const ModelQuestion& question) {
  const auto text = readWholeFile(question.path, kMaxUrdfBytes);
  if (!text.ok()) {
    throw Failure{text.error().code == ErrorCode::LimitExceeded ? ImportFailure::TooLarge
                                                                : ImportFailure::Refused,
                  text.error().message};
  }
  grantMemoryFor(text.value().size());
  const UrdfText reduced = readUrdfText(text.value());
  const auto robot = parse(reduced.xml, text.value());
  ModelBuilder builder;
  for (const std::string& note : reduced.notes) builder.note(note);
  UrdfSurface surface(question, reduced, builder);
  RobotTree(*robot, question.isRobot, surface, builder).add();
  return builder.take();
}

}  // namespace foretouch::internal
