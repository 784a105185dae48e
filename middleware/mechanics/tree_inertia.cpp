#include "middleware/mechanics/tree_inertia.h"

#include "lss/index.h"

namespace foretouch::internal {
namespace {

Eigen::Matrix3d crossing(const Eigen::Vector3d& x) {
  Eigen::Matrix3d m;
  m << 0.0, -x.z(), x.y(), x.z(), 0.0, -x.x(), -x.y(), x.x(), 0.0;
  return m;
}

/// In the order of a way: leaves first, and a root's translation after its turn.
bool comesBefore(JointId one, JointId other) {
  const JointId x = one < 0 ? ~one : one, y = other < 0 ? ~other : other;
  return x != y ? x > y : one > other;
}

}  // namespace

void TreeInertia::reset(const std::vector<JointId>& parents, double leastMass) {
  leastMass_ = leastMass;
  nodes_.resize(parents.size());
  for (std::size_t j = 0; j < parents.size(); ++j) nodes_[j].parent = parents[j];
  begin();
}

void TreeInertia::begin() {
  for (Node& node : nodes_) node.inertia.setZero();
}

void TreeInertia::setOrigin(JointId joint, const Eigen::Vector3d& origin) {
  nodes_[slotOf(joint)].origin = origin;
}

void TreeInertia::addPoint(JointId link, const Eigen::Vector3d& x, double weight) {
  Matrix6d& inertia = nodes_[slotOf(link)].inertia;
  const double squared = x.squaredNorm();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) inertia(i, k) -= weight * x[i] * x[k];
    inertia(i, i) += weight * squared;
    inertia(3 + i, 3 + i) += weight;
  }
  const Eigen::Vector3d h = weight * x;
  inertia(0, 4) -= h.z();
  inertia(0, 5) += h.y();
  inertia(1, 3) += h.z();
  inertia(1, 5) -= h.x();
  inertia(2, 3) -= h.y();
  inertia(2, 4) += h.x();
}

void TreeInertia::addBody(JointId link, const Eigen::Vector3d& x, double weight,
                          const Eigen::Matrix3d& inertia) {
  addPoint(link, x, weight);
  nodes_[slotOf(link)].inertia.topLeftCorner<3, 3>() += inertia;
}

void TreeInertia::factor(const std::vector<double>& stiffness) {
  for (Node& node : nodes_) {
    node.inertia.bottomLeftCorner<3, 3>() = node.inertia.topRightCorner<3, 3>().transpose();
  }
  for (std::size_t j = nodes_.size(); j-- > 0;) {
    Node& node = nodes_[j];
    const Eigen::Matrix3d p = crossing(node.origin);
    node.U.noalias() = node.inertia.leftCols<3>() + node.inertia.rightCols<3>() * p;
    Eigen::Matrix3d D = node.U.topRows<3>() - p * node.U.bottomRows<3>();
    D.diagonal().array() += stiffness[j];
    node.inverse = D.inverse();
    node.share.noalias() = node.U * node.inverse;
    Matrix6d rest = node.inertia;
    rest.noalias() -= node.share * node.U.transpose();
    if (node.parent == kNoParent) {
      node.inertia = rest;  // from now on: what its translation moves
      Eigen::Matrix3d mass = rest.bottomRightCorner<3, 3>();
      mass.diagonal().array() += leastMass_;
      node.rootInverse = mass.inverse();
    } else {
      nodes_[slotOf(node.parent)].inertia += rest;
    }
  }
}

void TreeInertia::solve(const std::vector<Vector6d>& forces,
                        const std::vector<Eigen::Vector3d>& torques,
                        std::vector<Eigen::Vector3d>& turns, std::vector<Eigen::Vector3d>& shifts,
                        std::vector<Twist>& twists) {
  const std::size_t n = nodes_.size();
  forces_ = forces;
  inner_.resize(n);
  turns.resize(n);
  shifts.resize(n);
  twists.resize(n);
  for (std::size_t j = n; j-- > 0;) {
    const Node& node = nodes_[j];
    inner_[j] = torques[j] + momentAbout(node.origin, forces_[j]);
    forces_[j].noalias() -= node.share * inner_[j];
    if (node.parent != kNoParent) forces_[slotOf(node.parent)] += forces_[j];
  }
  for (std::size_t j = 0; j < n; ++j) {
    const Node& node = nodes_[j];
    Twist twist;
    shifts[j].setZero();
    if (node.parent == kNoParent) {
      shifts[j].noalias() = node.rootInverse * forces_[j].tail<3>();
      twist.v = shifts[j];
    } else {
      twist = twists[slotOf(node.parent)];
    }
    turns[j] = node.inverse * inner_[j] - node.share.topRows<3>().transpose() * twist.w -
               node.share.bottomRows<3>().transpose() * twist.v;
    twist.w += turns[j];
    twist.v += node.origin.cross(turns[j]);
    twists[j] = twist;
  }
}

void TreeInertia::appendPart(const Node& node, JointId joint, Vector6d& force,
                             std::vector<WayPart>& way) const {
  WayPart part;
  part.joint = joint;
  part.force = momentAbout(node.origin, force);
  part.weighted.noalias() = node.inverse * part.force;
  way.push_back(part);
  force.noalias() -= node.U * part.weighted;
}

void TreeInertia::appendWay(LinkId link, const Vector6d& force, LinkId other,
                            const Vector6d& otherForce, std::vector<WayPart>& way) const {
  Vector6d one = force, two = otherForce;
  while (link != kNoParent || other != kNoParent) {
    if (link == other) {
      one += two;
      other = kNoParent;
      two.setZero();
    }
    // The lower one goes on; a forest's roots end one by one.
    const bool isFirst = link > other;
    const JointId joint = isFirst ? link : other;
    Vector6d& carried = isFirst ? one : two;
    const Node& node = nodes_[slotOf(joint)];
    appendPart(node, joint, carried, way);
    if (node.parent == kNoParent) {
      WayPart part;
      part.joint = ~joint;
      part.force = carried.tail<3>();
      part.weighted.noalias() = node.rootInverse * part.force;
      way.push_back(part);
    }
    (isFirst ? link : other) = node.parent;
  }
}

double TreeInertia::product(const WayPart* one, const WayPart* oneEnd, const WayPart* other,
                            const WayPart* otherEnd) {
  double sum = 0.0;
  while (one != oneEnd && other != otherEnd) {
    if (one->joint == other->joint) {
      sum += one->force.dot(other->weighted);
      ++one;
      ++other;
    } else if (comesBefore(one->joint, other->joint)) {
      ++one;
    } else {
      ++other;
    }
  }
  return sum;
}

}  // namespace foretouch::internal
