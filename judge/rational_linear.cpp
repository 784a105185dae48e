// judge/rational_linear.cpp: every instant at which contact can begin, each decided exactly.
#include "judge/rational_linear.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "judge/rational_meeting.h"
#include "judge/rational_polynomial.h"

namespace foretouch::oracle {
namespace {

/// All formal coefficients of a form.
using Coefficients = std::vector<Integer>;

template <std::size_t N>
Coefficients coefficients(const Form<Integer, N>& form) {
  return {form.c.begin(), form.c.end()};
}

Polynomial polynomialOf(Coefficients c) {
  while (!c.empty() && c.back() == 0) c.pop_back();
  return c;
}

bool isZero(const Coefficients& c) {
  return std::all_of(c.begin(), c.end(), [](const Integer& i) { return i == 0; });
}

/// An instant in [0,1], exactly: an end or a root inside.
struct Instant {
  enum class Place { Start, Inside, End } place = Place::Start;
  Root root;

  [[nodiscard]] int sign(const Coefficients& c) const {
    if (place == Place::Start) return c.front().sign();
    if (place == Place::End) return c.back().sign();
    return signAt(polynomialOf(c), root);
  }
};

/// Polynomials of which all must vanish in contact (`gates`); those whose roots are the other
/// places where contact can begin; and the question itself.
struct Question {
  std::vector<Coefficients> gates, others;
  std::function<bool(const Instant&)> meet;
};

struct Segment {
  std::array<Coefficients, 3> across;
  Coefficients along;

  explicit Segment(const OnSegment<Integer>& s) : along(coefficients(s.along)) {
    for (std::size_t i = 0; i < 3; ++i) across[i] = coefficients(s.across[i]);
  }
  [[nodiscard]] bool holds(const Instant& at) const {
    return std::all_of(across.begin(), across.end(),
                       [&](const Coefficients& c) { return at.sign(c) == 0; }) &&
           at.sign(along) <= 0;
  }
};

std::vector<Segment> segmentsOf(const std::vector<OnSegment<Integer>>& all) {
  return {all.begin(), all.end()};
}

/// `segments` matter only if the area vanishes or everything stays coplanar.
Question planarQuestion(const PlanarMeeting<Integer>& m,
                        const std::function<std::vector<Segment>()>& segments) {
  Question q;
  q.gates = {coefficients(m.coplanar)};
  const Coefficients area = coefficients(m.area);
  std::vector<Coefficients> inside;
  for (const auto& form : m.inside) inside.push_back(coefficients(form));
  if (isZero(q.gates[0])) {
    q.others = inside;
    q.others.push_back(area);
    for (const Segment& s : segments()) {
      q.others.insert(q.others.end(), s.across.begin(), s.across.end());
      q.others.push_back(s.along);
    }
  }
  q.meet = [coplanar = q.gates[0], area, inside, segments](const Instant& at) {
    if (at.sign(coplanar) != 0) return false;
    const auto isIn = [&](const Coefficients& c) { return at.sign(c) >= 0; };
    if (at.sign(area) != 0) return std::all_of(inside.begin(), inside.end(), isIn);
    const std::vector<Segment> all = segments();
    return std::any_of(all.begin(), all.end(), [&](const Segment& s) { return s.holds(at); });
  };
  return q;
}

Question segmentQuestion(const OnSegment<Integer>& onSegment) {
  const Segment segment(onSegment);
  Question q;
  q.gates.assign(segment.across.begin(), segment.across.end());
  q.others = {segment.along};
  q.meet = [segment](const Instant& at) { return segment.holds(at); };
  return q;
}

/// Two points are a point and a segment of length zero: (p-a).(p-a) <= 0.
Question questionOf(LinearKind kind, const std::array<Moving<Integer>, 4>& p) {
  switch (kind) {
    case LinearKind::VertexFace:
      return planarQuestion(vertexMeetsFace(p), [p] { return segmentsOf(faceSegments(p)); });
    case LinearKind::EdgeEdge:
      return planarQuestion(edgeMeetsEdge(p), [p] { return segmentsOf(edgeSegments(p)); });
    case LinearKind::VertexEdge: return segmentQuestion({p[0], p[1], p[2]});
    case LinearKind::VertexVertex: break;
  }
  Question q = segmentQuestion({p[0], p[1], p[1]});
  q.gates = {q.others[0]};  // the squared distance; the cross products always vanish
  return q;
}

std::vector<double> coordinates(const LinearQuery& query) {
  std::vector<double> all;
  for (const Path& path : query.points) {
    for (const Vec3d& v : {path.from, path.to}) all.insert(all.end(), {v.x, v.y, v.z});
  }
  return all;
}

/// All coordinates times one power of two, which changes no answer.
std::array<Moving<Integer>, 4> integersOf(const LinearQuery& query) {
  int lowest = 1 << 20;
  for (const double c : coordinates(query)) {
    if (c != 0.0) lowest = std::min(lowest, std::ilogb(c) - 52);
  }
  const auto scaled = [&](double c) {
    if (c == 0.0) return Integer(0);
    const int exponent = std::ilogb(c) - 52;
    const Integer mantissa(static_cast<long long>(std::ldexp(c, -exponent)));
    return Integer(mantissa << static_cast<unsigned>(exponent - lowest));
  };
  std::array<Moving<Integer>, 4> moving;
  for (std::size_t i = 0; i < 4; ++i) {
    const Path& p = query.points[i];
    moving[i][0].c = {scaled(p.from.x), scaled(p.to.x)};
    moving[i][1].c = {scaled(p.from.y), scaled(p.to.y)};
    moving[i][2].c = {scaled(p.from.z), scaled(p.to.z)};
  }
  return moving;
}

/// The polynomials at whose roots contact can begin: one gate that is not always open suffices.
std::vector<Polynomial> beginnings(const Question& q) {
  for (const Coefficients& gate : q.gates) {
    if (!isZero(gate)) return {polynomialOf(gate)};
  }
  std::vector<Polynomial> all;
  for (const Coefficients& c : q.others) {
    if (!isZero(c)) all.push_back(polynomialOf(c));
  }
  return all;
}

}  // namespace

const char* toString(LinearKind kind) {
  switch (kind) {
    case LinearKind::VertexFace: return "vertex-face";
    case LinearKind::EdgeEdge: return "edge-edge";
    case LinearKind::VertexEdge: return "vertex-edge";
    case LinearKind::VertexVertex: return "vertex-vertex";
  }
  return "?";
}

LinearTruth linearTruthByRationals(const LinearQuery& query) {
  constexpr unsigned kBits = 60;
  const Question question = questionOf(query.kind, integersOf(query));
  LinearTruth truth;
  truth.byRationals = true;
  if (question.meet({Instant::Place::Start, {}})) {
    truth.hits = true;
    truth.low = truth.high = 0.0;
    return truth;
  }
  for (const Polynomial& p : beginnings(question)) {
    for (Root& root : interiorRoots(p)) {
      if (truth.hits && roundedDown(root.low) >= truth.high) break;
      if (!question.meet({Instant::Place::Inside, root})) continue;
      refine(root, kBits);
      const double low = roundedDown(root.low), high = roundedUp(root.high);
      truth.low = truth.hits ? std::min(truth.low, low) : low;
      truth.high = truth.hits ? std::min(truth.high, high) : high;
      truth.hits = true;
      break;  // the roots come in increasing order
    }
  }
  if (!truth.hits) truth.hits = question.meet({Instant::Place::End, {}});
  return truth;
}

LinearTruth linearTruth(const LinearQuery& query) {
  const auto quick = linearTruthByBalls(query);
  return quick ? *quick : linearTruthByRationals(query);
}

}  // namespace foretouch::oracle
