#include "middleware/mechanics/mass.h"

#include <cmath>

#include <Eigen/Dense>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch {
namespace {

/// What rounding of a table's printed digits may do to an inertia.
constexpr double kPrinted = 1e-6;

/// The inertia of a point of 1 kg at x.
Eigen::Matrix3d inertiaOfPoint(const Eigen::Vector3d& x) {
  return x.squaredNorm() * Eigen::Matrix3d::Identity() - x * x.transpose();
}

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& x) {
  Eigen::Matrix3d m;
  m << 0.0, -x.z(), x.y(), x.z(), 0.0, -x.x(), -x.y(), x.x(), 0.0;
  return m;
}

}  // namespace

Result<Mass> checkedMass(const Mass& mass) {
  if (!std::isfinite(mass.kg) || !mass.center_B.allFinite() || !mass.inertia_B.allFinite()) {
    return Error::of(ErrorCode::NonFinite, "expected finite mass, centre and inertia");
  }
  if (!(mass.kg > 0.0)) {
    return Error::of(ErrorCode::OutOfRange,
                     "expected a mass above 0 kg, found " + std::to_string(mass.kg));
  }
  Mass checked = mass;
  checked.inertia_B = 0.5 * (mass.inertia_B + mass.inertia_B.transpose());
  const double size = checked.inertia_B.cwiseAbs().maxCoeff();
  if ((mass.inertia_B - checked.inertia_B).cwiseAbs().maxCoeff() > kPrinted * size) {
    return Error::of(ErrorCode::OutOfRange, "expected a symmetric inertia");
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(checked.inertia_B,
                                                              Eigen::EigenvaluesOnly);
  const Eigen::Vector3d& moments = solver.eigenvalues();  // least first
  if (!(moments[0] > 0.0)) {
    return Error::of(ErrorCode::OutOfRange, "expected three principal moments above 0");
  }
  if (moments[2] > (1.0 + kPrinted) * (moments[0] + moments[1])) {
    return Error::of(
        ErrorCode::OutOfRange,
        "expected no principal moment above the sum of the other two: no body has one");
  }
  return checked;
}

Mass massOf(const Lss& lss, double density) {
  constexpr double kPi = 3.14159265358979323846;
  const Eigen::Vector3d axis = lss.b - lss.a;
  const double h = axis.norm(), r = lss.radius, r2 = r * r;
  const double rod = density * kPi * r2 * h, ball = density * 4.0 / 3.0 * kPi * r2 * r;
  Mass mass;
  mass.kg = rod + ball;
  mass.center_B = lss.a + 0.5 * axis;
  // The half spheres' own centres are 3/8 r beyond the cylinder's ends; by the parallel axes.
  const double along = rod * r2 / 2.0 + ball * 0.4 * r2;
  const double across =
      rod * (r2 / 4.0 + h * h / 12.0) + ball * (0.4 * r2 + h * h / 4.0 + 3.0 / 8.0 * h * r);
  const Eigen::Vector3d n = h > 0.0 ? Eigen::Vector3d(axis / h) : Eigen::Vector3d::UnitX();
  mass.inertia_B = across * Eigen::Matrix3d::Identity() + (along - across) * n * n.transpose();
  return mass;
}

Mass sumOf(const Mass& one, const Mass& other) {
  Mass sum;
  sum.kg = one.kg + other.kg;
  if (!(sum.kg > 0.0)) return sum;
  const Eigen::Vector3d apart = other.center_B - one.center_B;
  sum.center_B = one.center_B + (other.kg / sum.kg) * apart;
  sum.inertia_B =
      one.inertia_B + other.inertia_B + (one.kg / sum.kg) * other.kg * inertiaOfPoint(apart);
  return sum;
}

Result<std::vector<Mass>> massesOfLinks(const Avatar& avatar, double kg) {
  if (!std::isfinite(kg) || !(kg > 0.0)) {
    return Error::of(ErrorCode::OutOfRange,
                     "expected a mass above 0 kg, found " + std::to_string(kg));
  }
  double cubicMetres = 0.0;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) cubicMetres += volume(lss);
  }
  const double density = kg / cubicMetres;
  if (!(cubicMetres > 0.0) || !std::isfinite(density)) {
    return Error::of(ErrorCode::Empty, "expected LSS with a volume");
  }
  std::vector<Mass> masses(countOf(avatar.numLinks()));
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    Mass& mass = masses[slotOf(link)];
    for (const Lss& lss : avatar.lss(link)) mass = sumOf(mass, massOf(lss, density));
  }
  return masses;
}

Eigen::Matrix3d inverseMassAt(const Mass& mass, const RigidPose& pose, const Eigen::Vector3d& p_W) {
  const Eigen::Matrix3d R = pose.rotation.normalized().toRotationMatrix();
  const Eigen::Matrix3d cross = crossMatrix(p_W - pose.translation - R * mass.center_B);
  const Eigen::Matrix3d turns = R * mass.inertia_B.inverse() * R.transpose();
  // -[r] I^-1 [r] as a product with its own transpose, so that it is not negative.
  const Eigen::Matrix3d K =
      Eigen::Matrix3d::Identity() / mass.kg + cross * turns * cross.transpose();
  return 0.5 * (K + K.transpose());
}

}  // namespace foretouch
