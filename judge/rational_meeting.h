// judge/rational_meeting.h: the polynomials of a linear query, in any arithmetic. Derived in
// rational_linear.h.
#pragma once

#include <array>
#include <vector>

#include "judge/rational_form.h"

namespace foretouch::oracle {

template <typename S>
using Moving = Form3<S, 1>;  // a point, or a difference of points

/// Point on a segment: all of `across` zero and `along` <= 0.
template <typename S>
struct OnSegment {
  Form3<S, 2> across;
  Form<S, 2> along;

  OnSegment(const Moving<S>& p, const Moving<S>& a, const Moving<S>& b)
      : across(cross(p - a, b - a)), along(dot(p - a, p - b)) {}
};

/// Two features that span a plane whenever `area` is not zero: they then meet if `coplanar` is zero
/// and every one of `inside` is >= 0. When `area` is zero, the segments below decide.
template <typename S>
struct PlanarMeeting {
  Form<S, 3> coplanar;
  Form<S, 4> area;  // n.n
  std::vector<Form<S, 4>> inside;
};

template <typename S>
PlanarMeeting<S> vertexMeetsFace(const std::array<Moving<S>, 4>& p) {
  const Moving<S> w = p[0] - p[1], first = p[2] - p[1], second = p[3] - p[1];
  const Form3<S, 2> normal = cross(first, second);
  PlanarMeeting<S> m;
  m.coplanar = dot(w, normal);
  m.area = dot(normal, normal);
  const Form<S, 4> u = dot(cross(w, second), normal), v = dot(cross(first, w), normal);
  m.inside = {u, v, m.area - u - v};
  return m;
}

/// A face without area is its three edges.
template <typename S>
std::vector<OnSegment<S>> faceSegments(const std::array<Moving<S>, 4>& p) {
  return {{p[0], p[1], p[2]}, {p[0], p[2], p[3]}, {p[0], p[3], p[1]}};
}

template <typename S>
PlanarMeeting<S> edgeMeetsEdge(const std::array<Moving<S>, 4>& p) {
  const Moving<S> w = p[2] - p[0], one = p[1] - p[0], other = p[3] - p[2];
  const Form3<S, 2> normal = cross(one, other);
  PlanarMeeting<S> m;
  m.coplanar = dot(w, normal);
  m.area = dot(normal, normal);
  const Form<S, 4> s = dot(cross(w, other), normal), r = dot(cross(w, one), normal);
  m.inside = {s, m.area - s, r, m.area - r};
  return m;
}

/// Parallel or point-like edges meet only if an end of one lies on the other.
template <typename S>
std::vector<OnSegment<S>> edgeSegments(const std::array<Moving<S>, 4>& p) {
  return {{p[0], p[2], p[3]}, {p[1], p[2], p[3]}, {p[2], p[0], p[1]}, {p[3], p[0], p[1]}};
}

}  // namespace foretouch::oracle
