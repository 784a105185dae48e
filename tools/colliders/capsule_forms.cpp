#include "tools/colliders/capsule_forms.h"

#include <algorithm>

#include "lss/rounding.h"
#include "lss/single.h"

namespace foretouch::tools {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Covers the error of computing an end or a radius here, as a share of the largest length in it:
/// a product by a matrix and a sum round less than 16 times, an angle and its sine and cosine
/// (URDF) less than 16 more.
constexpr double kOwnRounding = 64.0 * kUnitRoundoff;
/// The error of a tool that computes height / 2 - radius in floats, as a share of the result,
/// twice.
constexpr double kToolsRounding = 4.0 * 0x1p-24;

Vector3d heldVector(const Vector3d& v, HeldAs held) {
  return held == HeldAs::Floats ? nearestFloat(v) : v;
}

Quaternion heldTurn(const Quaternion& q, HeldAs held) {
  return {heldNumber(q.w(), held), heldNumber(q.x(), held), heldNumber(q.y(), held),
          heldNumber(q.z(), held)};
}

double sizeOf(const Lss& lss) {
  return lss.radius + std::max(lss.a.norm(), lss.b.norm());
}

/// The radius about ends that are off by so much.
double radiusFor(const Lss& lss, double off, HeldAs held) {
  return heldAbove(lss.radius + off + kOwnRounding * (sizeOf(lss) + off), held);
}

}  // namespace

double heldNumber(double number, HeldAs held) {
  return held == HeldAs::Floats ? nearestFloat(number) : number;
}

double heldAbove(double number, HeldAs held) {
  return held == HeldAs::Floats ? static_cast<double>(internal::floatAbove(number)) : number;
}

Lss asCollider(const Lss& lss) {
  const double length = (lss.b - lss.a).norm();
  const double radius = std::max(lss.radius, kLeastRadius);
  if (length >= kLeastAxis || length == 0.0) return {lss.a, lss.b, radius};
  const Vector3d middle = lss.a + 0.5 * (lss.b - lss.a);
  const double off = std::max((lss.a - middle).norm(), (lss.b - middle).norm());
  return {middle, middle, radius + off + kOwnRounding * sizeOf(lss)};
}

Lss byEnds(const Lss& lss, HeldAs held) {
  const Vector3d a = heldVector(lss.a, held), b = heldVector(lss.b, held);
  const double off = std::max((a - lss.a).norm(), (b - lss.b).norm());
  return {a, b, off == 0.0 ? heldAbove(lss.radius, held) : radiusFor(lss, off, held)};
}

Matrix3d turnMatrix(const Quaternion& turn, HeldAs held) {
  Matrix3d matrix = turn.normalized().toRotationMatrix();
  for (double& element : matrix.reshaped()) element = heldNumber(element, held);
  return matrix;
}

StandingCapsule standing(const Lss& lss, const Vector3d& axis, HeldAs held) {
  const Vector3d along = lss.b - lss.a;
  StandingCapsule capsule;
  capsule.middle = heldVector(lss.a + 0.5 * along, held);
  if (along.isZero(0.0)) {
    capsule.radius = byEnds(lss, held).radius;
    return capsule;
  }
  capsule.turn = heldTurn(Quaternion::FromTwoVectors(axis, along), held);
  capsule.halfLength = heldAbove(0.5 * along.norm(), held);
  double off = 0.0;
  for (const Matrix3d& turn :
       {capsule.turn.toRotationMatrix(), capsule.turn.normalized().toRotationMatrix(),
        turnMatrix(capsule.turn, held)}) {
    const Vector3d half = capsule.halfLength * (turn * axis);
    off = std::max(
        {off, (capsule.middle - half - lss.a).norm(), (capsule.middle + half - lss.b).norm()});
  }
  capsule.radius = radiusFor(lss, off, held);
  return capsule;
}

double wholeHeight(const StandingCapsule& capsule, HeldAs held) {
  const double rounding = held == HeldAs::Floats ? kToolsRounding : kOwnRounding;
  const double height = 2.0 * (capsule.halfLength * (1.0 + rounding) + capsule.radius);
  return heldAbove(height * (1.0 + kOwnRounding), held);
}

}  // namespace foretouch::tools
