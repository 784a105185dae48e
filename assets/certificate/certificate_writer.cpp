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
/// Enlarges our bounds: the verifier's are rounded up at every step.
constexpr double kInflation = 1.0 + 1e-4;
/// A span of a 16-millionth: what needs more is nearer than a millionth of the motion.
constexpr int kDeepestSpan = 24;
/// More planes than this: two shorter spans need fewer in all.
constexpr std::size_t kMostPlanes = 8;

/// How far the verifier's readings of the number go from it: where single precision does not hold
/// it, two such numbers to each side of the nearest.
double blurOf(double number) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto nearest = static_cast<float>(number);
  if (nearest == number) return 0.0;
  const double least = std::nextafter(std::nextafter(nearest, -kInfinity), -kInfinity);
  const double most = std::nextafter(std::nextafter(nearest, kInfinity), kInfinity);
  return std::max(number - least, most - number);
}

double blurOf(const Triangle& triangle) {
  double blur = 0.0;
  for (const Eigen::Vector3d& vertex : triangle.vertices) {
    for (const double part : vertex) blur = std::max(blur, blurOf(part));
  }
  return blur;
}

/// Short, and the very number that is written.
double inFewDigits(double number) {
  char text[32];
  const auto end = fmt::format_to_n(text, sizeof text, "{:.7g}", number);
  internal::readDecimal(text, end.out, number);
  return number;
}

}  // namespace

/// The bound on one LSS on one motion.
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
  /// The middle of where its axis is: the segment that planes are made for.
  [[nodiscard]] Eigen::Vector3d begin() const { return 0.5 * (corners[0] + corners[2]); }
  [[nodiscard]] Eigen::Vector3d end() const { return 0.5 * (corners[1] + corners[3]); }
};

struct CertificateWriter::Plane {
  Eigen::Vector3d normal;
  double offset = 0.0;

  /// The most along the normal of a triangle whose coordinates may be read as others, `blur` away.
  [[nodiscard]] double mostAlong(const Triangle& triangle, double blur) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& v : triangle.vertices) most = std::max(most, normal.dot(v));
    return most + blur * normal.lpNorm<1>();
  }
  [[nodiscard]] bool holds(const Triangle& triangle, double blur) const {
    return mostAlong(triangle, blur) <= offset - kSlackM;
  }
  [[nodiscard]] bool isBetween(const Hull& one, const Hull& other) const {
    return one.leastAlong(normal) >= offset + kSlackM &&
           other.leastAlong(-normal) >= kSlackM - offset;
  }

  /// From the axis towards what is nearest to it, in few digits; its length is not 1. False: none.
  static bool towards(const ClosestPoints& nearest, Plane& plane) {
    if (!(nearest.distance > 0.0)) return false;
    plane.normal = nearest.difference / nearest.distance;
    for (double& part : plane.normal) part = inFewDigits(part);
    return true;
  }
  /// The offset beyond `most` and below `least`, nearer to the latter. False: there is no room.
  bool place(double least, double most, double share) {
    if (!(most + 4.0 * kSlackM < least)) return false;
    offset = inFewDigits(least - share * (least - most));
    if (offset > least - kSlackM) offset = least - kSlackM;
    if (offset < most + kSlackM) offset = 0.5 * (least + most);
    return true;
  }
};

CertificateWriter::CertificateWriter(const Avatar& avatar, const Scene& scene,
                                     CertificateAsked asked)
    : avatar_(avatar), scene_(scene), asked_(std::move(asked)) {
  const auto count = static_cast<TriangleId>(scene.numTriangles());
  for (TriangleId id = 0; id < count; ++id) {
    const double blur = blurOf(scene.triangle(id));
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : scene.triangle(id).vertices) box.extend(vertex);
    box.min().array() -= blur;
    box.max().array() += blur;
    boxes_.push_back(box);
    blurs_.push_back(blur);
    if (isFinite(scene.triangle(id))) all_.push_back(id);
  }
}

/// The hull in the part that is looked at; `level` and `index` are within that part.
CertificateWriter::Hull CertificateWriter::hullOf(LinkId carrier, LinkId link, const Bound& bound,
                                                  int level, std::int64_t index, double more) {
  Hull hull;
  const double width = std::ldexp(1.0, -level);
  for (std::size_t i = 0; i < 2; ++i) {
    const double t = static_cast<double>(index + static_cast<std::int64_t>(i)) * width;
    const LinkState state = carrier == kNoParent ? parts_[part_].stateAt(link, t)
                                                 : parts_[part_].stateIn(carrier, link, t);
    hull.corners[2 * i] = state.pointAt(bound.lss.a);
    hull.corners[2 * i + 1] = state.pointAt(bound.lss.b);
  }
  hull.stray = bound.acceleration * width * width / 8.0;
  hull.reach = bound.lss.radius + hull.stray + more + kSlackM;
  for (const Eigen::Vector3d& corner : hull.corners) hull.box.extend(corner);
  hull.box.min().array() -= hull.reach;
  hull.box.max().array() += hull.reach;
  return hull;
}

std::vector<CertificateWriter::Hull> CertificateWriter::hullsOf(LinkId carrier, LinkId link,
                                                                int level, std::int64_t index,
                                                                double more) {
  std::vector<Hull> hulls;
  for (const Lss& lss : avatar_.lss(link)) {
    hulls.push_back(hullOf(carrier, link, boundOf(carrier, link, lss), level, index, more));
  }
  return hulls;
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

bool CertificateWriter::isHeld(const Plane& plane, TriangleId id) const {
  return plane.holds(scene_.triangle(id), blurs_[slotOf(id)]);
}

/// One plane after the other, each for the nearest triangle that none holds yet. False: some
/// triangle has none, or there would be too many.
bool CertificateWriter::planesFor(const Hull& hull, const Triangles& near,
                                  std::vector<Plane>& planes) const {
  const Eigen::Vector3d a = hull.begin(), b = hull.end();
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
    Plane plane;
    if (!Plane::towards(nearest, plane)) return false;
    const double most = plane.mostAlong(scene_.triangle(of), blurs_[slotOf(of)]);
    // Near to the LSS, so that it holds as many others as it can.
    if (!plane.place(hull.leastAlong(plane.normal), most, 0.05)) return false;
    open.erase(
        std::remove_if(open.begin(), open.end(), [&](TriangleId id) { return isHeld(plane, id); }),
        open.end());
    planes.push_back(plane);
  }
  // A later plane may hold all that an earlier one was made for: each that stays is needed.
  for (std::size_t i = 0; i < planes.size();) {
    const bool isNeeded = std::any_of(near.begin(), near.end(), [&](TriangleId id) {
      for (std::size_t k = 0; k < planes.size(); ++k) {
        if (k != i && isHeld(planes[k], id)) return false;
      }
      return true;
    });
    isNeeded ? static_cast<void>(++i)
             : static_cast<void>(planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(i)));
  }
  return true;
}

/// `level` and `index` are of the part.
void CertificateWriter::addSpan(int level, std::int64_t index, const std::vector<Plane>& planes,
                                std::string& text) {
  int deeper = 0;
  while ((std::size_t{1} << deeper) < numParts_) ++deeper;
  const std::int64_t before = static_cast<std::int64_t>(part_) << level;
  text += "span " + std::to_string(level + deeper) + " " + std::to_string(before + index) + "\n";
  for (const Plane& plane : planes) {
    text += "plane";
    for (const double part : plane.normal) text += " " + numberText(part);
    text += " " + numberText(plane.offset) + "\n";
  }
  ++counts_.spans;
  counts_.planes += static_cast<std::int64_t>(planes.size());
}

bool CertificateWriter::spans(LinkId link, const Bound& bound, int level, std::int64_t index,
                              const Triangles& among, std::string& text) {
  const Hull hull = hullOf(kNoParent, link, bound, level, index, asked_.clearance);
  // Half of this span strays as far from this hull as this span from its own, and so on.
  const Triangles near = nearOf(hull, 0.0, among);
  std::vector<Plane> planes;
  if (planesFor(hull, near, planes)) {
    addSpan(level, index, planes, text);
    return true;
  }
  if (level == kDeepestSpan) return false;
  const Triangles below = nearOf(hull, hull.stray, among);
  return spans(link, bound, level + 1, 2 * index, below, text) &&
         spans(link, bound, level + 1, 2 * index + 1, below, text);
}

/// As the verifier bounds it: (sum of turns)^2 |arm| + 2 (sum of turns) |drift|, down the chain.
/// Its arms are the longest ones of all parts.
CertificateWriter::Bound CertificateWriter::boundOf(LinkId carrier, LinkId link,
                                                    const Lss& lss) const {
  const ChainMotion& motion = parts_.front().motion();
  std::vector<LinkId> chain;
  for (LinkId up = link; up != carrier; up = motion.parent(up)) chain.push_back(up);
  double turns = 0.0, origin = 0.0;
  for (auto joint = chain.rbegin(); joint != chain.rend(); ++joint) {
    const ChainMotion::JointBounds& own = joints_[slotOf(*joint)];
    origin += turns * turns * own.length + 2.0 * turns * own.driftLength;
    turns += own.turn * (1.0 + 2e-2);  // the verifier's sine stands for the angle
  }
  const double far = std::max(lss.a.norm(), lss.b.norm());
  return {lss, kInflation * (origin + turns * turns * far) + 1e-12};
}

std::optional<std::string> CertificateWriter::link(LinkId link) {
  const std::vector<Lss>& all = avatar_.lss(link);
  const Triangles triangles = trianglesFor(link);
  std::string text = "link " + std::to_string(link) + "\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += "lss " + std::to_string(i) + "\n";
    for (part_ = 0; part_ < numParts_; ++part_) {
      const Bound bound = boundOf(kNoParent, link, all[i]);
      if (!spans(link, bound, 0, 0, triangles, text)) return std::nullopt;
    }
    ++counts_.capsules;
  }
  return text;
}

/// The triangles that the link may not touch.
CertificateWriter::Triangles CertificateWriter::trianglesFor(LinkId link) const {
  Triangles triangles = all_;
  for (const IgnoredPair& pair : asked_.ignored) {
    if (pair.link != link) continue;
    const auto isIgnored = [&](TriangleId id) {
      return pair.object == IgnoredPair::kEveryObject || scene_.object(id) == pair.object;
    };
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), isIgnored), triangles.end());
  }
  return triangles;
}

/// One plane for each two hulls whose boxes meet, unless an earlier one is between them, too.
bool CertificateWriter::planesBetween(const std::vector<Hull>& ones,
                                      const std::vector<Hull>& others, std::vector<Plane>& planes) {
  for (const Hull& one : ones) {
    for (const Hull& other : others) {
      if (!one.box.intersects(other.box)) continue;
      const auto isBetween = [&](const Plane& plane) { return plane.isBetween(one, other); };
      if (std::any_of(planes.begin(), planes.end(), isBetween)) continue;
      if (planes.size() == kMostPlanes) return false;
      Plane plane;
      const Triangle axis{other.begin(), other.end(), other.end()};
      if (!Plane::towards(closestPoints(one.begin(), one.end(), axis), plane)) return false;
      const double least = one.leastAlong(plane.normal), most = -other.leastAlong(-plane.normal);
      if (!plane.place(least, most, 0.5)) return false;
      planes.push_back(plane);
    }
  }
  return true;
}

bool CertificateWriter::pairSpans(const LinkPair& pair, LinkId carrier, int level,
                                  std::int64_t index, std::string& text) {
  const auto ones = hullsOf(carrier, pair.a, level, index, asked_.clearance);
  const auto others = hullsOf(carrier, pair.b, level, index, 0.0);
  std::vector<Plane> planes;
  if (planesBetween(ones, others, planes)) {
    addSpan(level, index, planes, text);
    return true;
  }
  return level < kDeepestSpan && pairSpans(pair, carrier, level + 1, 2 * index, text) &&
         pairSpans(pair, carrier, level + 1, 2 * index + 1, text);
}

std::optional<std::string> CertificateWriter::pair(const LinkPair& pair) {
  const ChainMotion& motion = parts_.front().motion();
  LinkId carrier = pair.a;  // parents stand before their children
  for (LinkId other = pair.b; carrier != other;) {
    LinkId& later = carrier > other ? carrier : other;
    later = motion.parent(later);
  }
  std::string text = "pair " + std::to_string(pair.a) + " " + std::to_string(pair.b) + "\n";
  for (part_ = 0; part_ < numParts_; ++part_) {
    if (!pairSpans(pair, carrier, 0, 0, text)) return std::nullopt;
  }
  ++counts_.pairs;
  return text;
}

void CertificateWriter::setParts(const ChainMotion* first, std::size_t count) {
  if (parts_.size() < count) parts_.resize(count);
  numParts_ = count;
  joints_.assign(countOf(avatar_.numLinks()), {0.0, 0.0, 0.0});
  for (std::size_t i = 0; i < count; ++i) {
    parts_[i].reset(first[i]);
    for (JointId joint = 0; joint < avatar_.numLinks(); ++joint) {
      const ChainMotion::JointBounds own = first[i].jointBounds(joint);
      ChainMotion::JointBounds& most = joints_[slotOf(joint)];
      most = {std::max(most.turn, own.turn), std::max(most.length, own.length),
              std::max(most.driftLength, own.driftLength)};
    }
  }
}

std::string CertificateWriter::step(std::int64_t number, const ChainMotion& motion,
                                    const std::vector<LinkId>& links) {
  setParts(&motion, 1);
  std::string text;
  for (const LinkId one : links) {
    const CertificateCounts before = counts_;
    auto claim = link(one);
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

std::optional<std::string> CertificateWriter::edge(std::int64_t number,
                                                   const std::vector<ChainMotion>& parts) {
  setParts(parts.data(), parts.size());
  const CertificateCounts before = counts_;
  std::string text = "edge " + std::to_string(number) + "\n";
  const auto add = [&](const std::optional<std::string>& claim) {
    if (claim) {
      text += *claim;
    } else {
      counts_ = before;
      ++counts_.unproven;
    }
    return claim.has_value();
  };
  for (LinkId one = 0; one < avatar_.numLinks(); ++one) {
    if (avatar_.lss(one).empty()) continue;
    if (!add(link(one))) return std::nullopt;
    ++counts_.links;
  }
  for (const LinkPair& own : asked_.pairs) {
    if (!add(pair(own))) return std::nullopt;
  }
  return text;
}

}  // namespace foretouch
