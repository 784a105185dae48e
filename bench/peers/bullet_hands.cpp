// Bullet's rigid bodies as hands that follow tracked ones.
#include <btBulletDynamicsCommon.h>
#include <cmath>

#include "bench/peers/bullet_mesh.h"
#include "bench/peers/peer_solvers.h"

namespace foretouch::tools {
namespace {

constexpr double kMassKg = 0.4, kSpringHz = 10.0, kPi = 3.14159265358979323846;
/// Shares of the radius, as Bullet's manual advises.
constexpr double kCcdMotion = 0.5, kCcdSphere = 0.7;

struct HandDrive {
  const char* name;
  bool isSpring, isContinuous;
  int substeps;
};
constexpr HandDrive kDrives[] = {{"Bullet, velocity", false, false, 1},
                                 {"Bullet, velocity, CCD", false, true, 1},
                                 // For one link, what Half-Physics [Siyao25] does for 55.
                                 {"Bullet, velocity, 4 substeps", false, false, 4},
                                 {"Bullet, spring", true, false, 1},
                                 {"Bullet, spring, CCD", true, true, 1},
                                 {"Bullet, velocity, CCD, 4 substeps", false, true, 4}};

/// The rotation vector from one to the other on the shorter arc.
btVector3 turnBetween(const btQuaternion& from, const btQuaternion& to) {
  btQuaternion turn = to * from.inverse();
  if (turn.w() < 0.0) turn = -turn;
  const btVector3 axis(turn.x(), turn.y(), turn.z());
  const double sine = axis.length();
  return sine > 0.0 ? axis * (2.0 * std::atan2(sine, turn.w()) / sine) : btVector3(0, 0, 0);
}

/// In its own world, so that no hand meets another.
class BulletHand final : public HandFollower {
 public:
  BulletHand(std::shared_ptr<BulletMesh> mesh, const Lss& hand_L, const HandDrive& drive)
      : HandFollower(drive.name),
        drive_(drive),
        mesh_(std::move(mesh)),
        ends_{toBullet(hand_L.a), toBullet(hand_L.b)},
        radii_{hand_L.radius, hand_L.radius},
        shape_(ends_, radii_, 2),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
        still_(btRigidBody::btRigidBodyConstructionInfo(0.0, nullptr, &mesh_->shape())) {
    btVector3 inertia;
    shape_.calculateLocalInertia(kMassKg, inertia);
    hand_ = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(kMassKg, nullptr, &shape_, inertia));
    hand_->setActivationState(DISABLE_DEACTIVATION);
    hand_->setFriction(0.0);
    if (drive.isContinuous) {
      hand_->setCcdMotionThreshold(kCcdMotion * hand_L.radius);
      hand_->setCcdSweptSphereRadius(kCcdSphere * hand_L.radius);
    }
    world_.setGravity({0, 0, 0});
    world_.addRigidBody(&still_);
    world_.addRigidBody(hand_.get());
  }
  ~BulletHand() override {
    world_.removeRigidBody(hand_.get());
    world_.removeRigidBody(&still_);
  }

  void begin(const RigidPose& at) override {
    const btTransform place = toBullet(at);
    hand_->setWorldTransform(place);
    hand_->setInterpolationWorldTransform(place);
    for (const auto set : {&btRigidBody::setLinearVelocity, &btRigidBody::setAngularVelocity}) {
      (hand_.get()->*set)({0, 0, 0});
    }
    hand_->setInterpolationLinearVelocity({0, 0, 0});
    hand_->setInterpolationAngularVelocity({0, 0, 0});
    hand_->clearForces();
    broadphase_.getOverlappingPairCache()->cleanProxyFromPairs(hand_->getBroadphaseHandle(),
                                                               &dispatcher_);
  }

  RigidPose follow(const RigidPose& tracked, double dtS) override {
    const double stepS = dtS / drive_.substeps;
    for (int i = drive_.substeps; i > 0; --i) {
      const btTransform& now = hand_->getWorldTransform();
      const btVector3 off = toBullet(tracked.pivot) - now.getOrigin();
      const btVector3 turn = turnBetween(now.getRotation(), toBullet(tracked.rotation));
      if (drive_.isSpring) {
        pull(off, turn);
      } else {
        hand_->setLinearVelocity(off / (i * stepS));
        hand_->setAngularVelocity(turn / (i * stepS));
      }
      world_.stepSimulation(stepS, 0);
    }
    return place();
  }

 private:
  void pull(const btVector3& off, const btVector3& turn) {
    const double omega = 2.0 * kPi * kSpringHz;
    const btVector3 push = omega * omega * off - 2.0 * omega * hand_->getLinearVelocity();
    const btVector3 twist = omega * omega * turn - 2.0 * omega * hand_->getAngularVelocity();
    hand_->applyCentralForce(kMassKg * push);
    hand_->applyTorque(hand_->getInvInertiaTensorWorld().inverse() * twist);
  }

  [[nodiscard]] RigidPose place() const {
    const btTransform& now = hand_->getWorldTransform();
    const btQuaternion q = now.getRotation();
    const btVector3& p = now.getOrigin();
    return {Quaternion(q.w(), q.x(), q.y(), q.z()), {p.x(), p.y(), p.z()}};
  }

  HandDrive drive_;
  std::shared_ptr<BulletMesh> mesh_;
  btVector3 ends_[2];
  btScalar radii_[2];
  btMultiSphereShape shape_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  btRigidBody still_;
  std::unique_ptr<btRigidBody> hand_;
};

}  // namespace

BulletHands::BulletHands(const std::vector<Triangle>& triangles)
    : mesh_(std::make_shared<BulletMesh>(triangles)) {}
BulletHands::~BulletHands() = default;

HandFollowers BulletHands::of(const Lss& hand_L) const {
  HandFollowers hands;
  for (const HandDrive& drive : kDrives) {
    hands.push_back(std::make_unique<BulletHand>(mesh_, hand_L, drive));
  }
  return hands;
}

}  // namespace foretouch::tools
