#include "assets/certificate/certificate_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assets/decimal.h"
#include "assets/json_writer.h"
#include "lss/index.h"
#include "lss/lss.h"
#include "lss/segment_triangle.h"

namespace foretouch {
namespace {

/// What both sides of a plane keep from it (m), against the rounding of either program: 1e-16 of a
/// coordinate, and a turn by as much.
constexpr double kSlackM = 1e-9;
/// Of our bounds: the verifier's are rounded up at every step.
constexpr double kInflation = 1.0 + 1e-4;
/// A span of a 16-millionth: what needs more is nearer than a millionth of the motion.
constexpr int kDeepestSpan = 24;
/// More planes than this: two shorter spans need fewer in all.
constexpr std::size_t kMostPlanes = 8;

/// Short, and the very number that is written.
double inFewDigits(double number) {
  char text[32];
  const auto end = fmt::format_to_n(text, sizeof text, "{:.7g}", number);
  internal::readDecimal(text, end.out, number);
  return number;
}

void addNumbers(std::string& text, const Eigen::Vector3d& v) {
  for (int axis = 0; axis < 3; ++axis) text += " " + numberText(v[axis]);
}

}  // namespace

/// Of one LSS on one motion.
struct CertificateWriter::Bound {
  Lss lss;
  double acceleration = 0.0;  ///< At least that of any point of its axis, per unit of t squared.
};

/// Four points, and how far beyond their hull the LSS may reach.
struct CertificateWriter::Hull {
  std::array<Eigen::Vector3d, 4> corners;
  double reach = 0.0, stray = 0.0;
  Eigen::AlignedBox3d box;

  [[nodiscard]] double leastAlong(const Eigen::Vector3d& normal) const {
    double least = normal.dot(corners[0]);
    for (const Eigen::Vector3d& corner : corners) least = std::min(least, normal.dot(corner));
    return least - reach * normal.norm();
  }
};

struct CertificateWriter::Plane {
  Eigen::Vector3d normal;
  double offset = 0.0;

  [[nodiscard]] bool holds(const Triangle& triangle) const {
    return std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                       [&](const auto& v) { return normal.dot(v) <= offset - kSlackM; });
  }
};

CertificateWriter::CertificateWriter(const Avatar& avatar, const Scene& scene)
    : avatar_(avatar), scene_(scene) {
  const auto count = static_cast<TriangleId>(scene.numTriangles());
  for (TriangleId id = 0; id < count; ++id) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : scene.triangle(id).vertices) box.extend(vertex);
    boxes_.push_back(box);
    if (isFinite(scene.triangle(id))) all_.push_back(id);
  }
}

CertificateWriter::Hull CertificateWriter::hullOf(LinkId link, const Bound& bound, int level,
                                                  std::int64_t index) const {
  Hull hull;
  const double width = std::ldexp(1.0, -level);
  for (std::size_t i = 0; i < 2; ++i) {
    const double t = static_cast<double>(index + static_cast<std::int64_t>(i)) * width;
    const LinkState state = evaluator_.motion().stateAt(link, t);
    hull.corners[2 * i] = state.pointAt(bound.lss.a);
    hull.corners[2 * i + 1] = state.pointAt(bound.lss.b);
  }
  hull.stray = bound.acceleration * width * width / 8.0;
  hull.reach = bound.lss.radius + hull.stray + kSlackM;
  for (const Eigen::Vector3d& corner : hull.corners) hull.box.extend(corner);
  hull.box.min().array() -= hull.reach;
  hull.box.max().array() += hull.reach;
  return hull;
}

CertificateWriter::Triangles CertificateWriter::nearOf(const Hull& hull, double more,
                                                       const Triangles& among) const {
  Eigen::AlignedBox3d box = hull.box;
  box.min().array() -= more;
  box.max().array() += more;
  Triangles near;
  for (const TriangleId id : among) {
    if (boxes_[slotOf(id)].intersects(box)) near.push_back(id);
  }
  return near;
}

/// One plane after the other, each for the nearest triangle that none holds yet. False: some
/// triangle has none, or there would be too many.
bool CertificateWriter::planesFor(const Hull& hull, const Triangles& near,
                                  std::vector<Plane>& planes) const {
  const Eigen::Vector3d a = 0.5 * (hull.corners[0] + hull.corners[2]);
  const Eigen::Vector3d b = 0.5 * (hull.corners[1] + hull.corners[3]);
  Triangles open = near;
  while (!open.empty()) {
    if (planes.size() == kMostPlanes) return false;
    ClosestPoints nearest;
    nearest.distance = std::numeric_limits<double>::infinity();
    TriangleId of = open.front();
    for (const TriangleId id : open) {
      const ClosestPoints found = closestPoints(a, b, scene_.triangle(id));
      if (found.distance < nearest.distance) {
        nearest = found;
        of = id;
      }
    }
    if (!(nearest.distance > 0.0)) return false;
    Plane plane;
    plane.normal = nearest.difference / nearest.distance;
    for (double& part : plane.normal) part = inFewDigits(part);
    const double least = hull.leastAlong(plane.normal);
    double most = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& v : scene_.triangle(of).vertices) {
      most = std::max(most, plane.normal.dot(v));
    }
    if (!(most + 4.0 * kSlackM < least)) return false;
    // Near to the LSS, so that it holds as many others as it can.
    plane.offset = inFewDigits(least - 0.05 * (least - most));
    if (plane.offset > least - kSlackM) plane.offset = least - kSlackM;
    if (plane.offset < most + kSlackM) plane.offset = 0.5 * (least + most);
    open.erase(std::remove_if(open.begin(), open.end(),
                              [&](TriangleId id) { return plane.holds(scene_.triangle(id)); }),
               open.end());
    planes.push_back(plane);
  }
  // A later plane may hold all that an earlier one was made for: each that stays is needed.
  for (std::size_t i = 0; i < planes.size();) {
    const bool isNeeded = std::any_of(near.begin(), near.end(), [&](TriangleId id) {
      for (std::size_t k = 0; k < planes.size(); ++k) {
        if (k != i && planes[k].holds(scene_.triangle(id))) return false;
      }
      return true;
    });
    isNeeded ? static_cast<void>(++i)
             : static_cast<void>(planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(i)));
  }
  return true;
}

bool CertificateWriter::spans(LinkId link, const Bound& bound, int level, std::int64_t index,
                              const Triangles& among, std::string& text) {
  const Hull hull = hullOf(link, bound, level, index);
  // Half of this span strays as far from this hull as this span from its own, and so on.
  const Triangles near = nearOf(hull, 0.0, among);
  std::vector<Plane> planes;
  if (planesFor(hull, near, planes)) {
    text += "span " + std::to_string(level) + " " + std::to_string(index) + "\n";
    for (const Plane& plane : planes) {
      text += "plane";
      addNumbers(text, plane.normal);
      text += " " + numberText(plane.offset) + "\n";
    }
    ++counts_.spans;
    counts_.planes += static_cast<std::int64_t>(planes.size());
    return true;
  }
  if (level == kDeepestSpan) return false;
  const Triangles below = nearOf(hull, hull.stray, among);
  return spans(link, bound, level + 1, 2 * index, below, text) &&
         spans(link, bound, level + 1, 2 * index + 1, below, text);
}

std::optional<std::string> CertificateWriter::link(LinkId link, const ChainMotion& motion) {
  // As the verifier bounds it: (sum of turns)^2 |arm| + 2 (sum of turns) |drift|, down the chain.
  std::vector<LinkId> chain;
  for (LinkId up = link; up != kNoParent; up = motion.parent(up)) chain.push_back(up);
  double turns = 0.0, origin = 0.0;
  for (auto joint = chain.rbegin(); joint != chain.rend(); ++joint) {
    const ChainMotion::JointBounds own = motion.jointBounds(*joint);
    origin += turns * turns * own.length + 2.0 * turns * own.driftLength;
    turns += own.turn * (1.0 + 2e-2);  // the verifier's sine stands for the angle
  }
  const std::vector<Lss>& all = avatar_.lss(link);
  std::string text = "link " + std::to_string(link) + "\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    Bound bound;
    bound.lss = all[i];
    const double far = std::max(all[i].a.norm(), all[i].b.norm());
    bound.acceleration = kInflation * (origin + turns * turns * far) + 1e-12;
    text += "lss " + std::to_string(i) + "\n";
    if (!spans(link, bound, 0, 0, all_, text)) return std::nullopt;
    ++counts_.capsules;
  }
  return text;
}

std::string CertificateWriter::step(std::int64_t number, const ChainMotion& motion,
                                    const std::vector<LinkId>& links) {
  evaluator_.reset(motion);
  std::string text;
  for (const LinkId one : links) {
    const CertificateCounts before = counts_;
    auto claim = link(one, motion);
    if (!claim) {
      counts_ = before;
      ++counts_.unproven;
      continue;
    }
    ++counts_.links;
    text += *claim;
  }
  return text.empty() ? text : "step " + std::to_string(number) + "\n" + text;
}

std::string sceneAsObj(const Scene& scene) {
  std::string vertices, faces;
  const auto count = static_cast<TriangleId>(scene.numTriangles());
  std::int64_t last = 0;
  for (TriangleId id = 0; id < count; ++id) {
    if (!isFinite(scene.triangle(id))) continue;
    faces += "f";
    for (const Eigen::Vector3d& vertex : scene.triangle(id).vertices) {
      vertices += "v";
      addNumbers(vertices, vertex);
      vertices += "\n";
      faces += " " + std::to_string(++last);
    }
    faces += "\n";
  }
  return vertices + faces;
}

std::string stepText(std::int64_t number, const Pose& from, const Pose& to) {
  std::string text = "step " + std::to_string(number) + "\n";
  for (const Pose* const pose : {&from, &to}) {
    for (std::size_t joint = 0; joint < pose->rotations.size(); ++joint) {
      const auto& q = pose->rotations[joint];
      const Eigen::Vector3d& p = pose->translations[joint];
      text += numberText(p.x()) + " " + numberText(p.y()) + " " + numberText(p.z());
      for (const double part : {q.w(), q.x(), q.y(), q.z()}) text += " " + numberText(part);
      text += "\n";
    }
  }
  return text;
}

}  // namespace foretouch
