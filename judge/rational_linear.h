// judge/rational_linear.h: do two features whose points move along straight lines meet on [0,1],
// and when first? The truth, in rational arithmetic, or by a filter of certified balls if that can
// decide. Shares neither code nor formulation with the product: it parametrises the features
// (barycentric coordinates of the coplanar instant), and finds signs at roots by Tarski queries.
//
// Vertex p, face f0 f1 f2: w = p - f0, e1, e2 its edges, n = e1 x e2. Where w.n = 0 and n != 0 the
// barycentric coordinates are U/n.n, V/n.n, 1 - (U+V)/n.n with U = (w x e2).n, V = (e1 x w).n.
// Where n = 0 the face is its three edges. Edges a + s u, b + r v: w = b - a, n = u x v, s = (w x
// v).n/n.n, r = (w x u).n/n.n; where n = 0 they meet only if an end of one lies on the other. A
// point p lies on the segment ab if (p-a) x (b-a) = 0 and (p-a).(p-b) <= 0, of length zero or not.
// All are polynomials in t. Contact is a closed set, so it begins at t = 0 or at a root of the
// coplanarity cubic, or, if that vanishes for all t, at a root of one of the other polynomials.
#pragma once

#include <array>
#include <optional>

#include "judge/vector.h"

namespace foretouch::oracle {

/// from + t*(to - from), of the doubles as real numbers.
struct Path {
  Vec3d from, to;
};

enum class LinearKind { VertexFace, EdgeEdge, VertexEdge, VertexVertex };
const char* toString(LinearKind kind);

/// Points in order: vertex and face, edge and edge, vertex and edge, vertex and vertex (the rest
/// unused). Finite; magnitudes that are not zero lie in [1e-100, 1e100].
struct LinearQuery {
  LinearKind kind = LinearKind::VertexFace;
  std::array<Path, 4> points;
};

/// The first contact, if there is one, lies in [low, high]; high - low <= kTruthWidth.
struct LinearTruth {
  bool hits = false;
  double low = 1.0, high = 1.0;
  bool byRationals = false;
};
inline constexpr double kTruthWidth = 0x1p-40;

/// Filter first, then rationals.
LinearTruth linearTruth(const LinearQuery& query);
/// Only rationals; high - low <= 2^-60, or low == high if that double is the instant itself.
LinearTruth linearTruthByRationals(const LinearQuery& query);
/// Only the filter: nothing if it cannot decide.
std::optional<LinearTruth> linearTruthByBalls(const LinearQuery& query);

}  // namespace foretouch::oracle
