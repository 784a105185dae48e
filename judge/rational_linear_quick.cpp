// judge/rational_linear_quick.cpp: the filter: halves [0,1], earlier half first, until the signs of
// Bernstein coefficients show every part free, or a change of sign shows a contact. In balls, so
// that its answers are true; the rationals decide the rest.
#include <algorithm>
#include <optional>
#include <vector>

#include "judge/rational_ball.h"
#include "judge/rational_linear.h"
#include "judge/rational_meeting.h"

namespace foretouch::oracle {
namespace {

/// A polynomial by its Bernstein coefficients on the current span: its values there lie between the
/// least and the greatest of them.
struct Bernstein {
  std::array<Ball, 5> c;
  std::size_t degree = 0;

  template <std::size_t N>
  explicit Bernstein(const Form<Ball, N>& form) : degree(N) {
    double binomial = 1;
    for (std::size_t i = 0; i <= N; ++i) {
      // Division by a small integer is one rounding.
      const long double quotient = form.c[i].center / binomial;
      c[i] = {quotient,
              (form.c[i].radius / binomial + kBallRounding * std::fabs(quotient)) * kBallGrowth};
      binomial = binomial * static_cast<double>(N - i) / static_cast<double>(i + 1);
    }
  }
  [[nodiscard]] bool isPositive() const {
    return std::all_of(c.begin(), c.begin() + degree + 1, [](auto& b) { return b.isPositive(); });
  }
  [[nodiscard]] bool isNegative() const {
    return std::all_of(c.begin(), c.begin() + degree + 1, [](auto& b) { return b.isNegative(); });
  }
  /// Leaves the second half here and returns the first.
  Bernstein takeFirstHalf() {
    Bernstein first = *this;
    for (std::size_t level = 0; level <= degree; ++level) {
      first.c[level] = c[0];
      for (std::size_t i = 0; i + level < degree; ++i) c[i] = half(c[i] + c[i + 1]);
    }
    return first;
  }
};

/// Conditions for contact: some polynomials vanish, others are >= 0.
struct Span {
  double low = 0.0, high = 1.0;
  std::vector<Bernstein> zero, inside;
};

enum class Answer { Free, Contact, Unknown };

class Search {
 public:
  explicit Search(bool certifiesContact) : certifiesContact_(certifiesContact) {}

  Answer search(Span span) {
    if (isFree(span)) return Answer::Free;
    const bool surelyInside = span.inside.empty();
    if (span.high - span.low <= kTruthWidth) {
      if (!(certifiesContact_ && surelyInside && changesSign(span.zero[0]))) return Answer::Unknown;
      truth.hits = true;
      truth.low = span.low;
      truth.high = span.high;
      return Answer::Contact;
    }
    if (++looks_ > kMostLooks) return Answer::Unknown;
    Span first;
    first.low = span.low;
    first.high = span.low = span.low + 0.5 * (span.high - span.low);
    for (Bernstein& b : span.zero) first.zero.push_back(b.takeFirstHalf());
    for (Bernstein& b : span.inside) first.inside.push_back(b.takeFirstHalf());
    const Answer answer = search(std::move(first));
    return answer == Answer::Free ? search(std::move(span)) : answer;
  }
  LinearTruth truth;

 private:
  static constexpr int kMostLooks = 200;

  /// Drops the conditions that hold throughout.
  static bool isFree(Span& span) {
    for (const Bernstein& b : span.zero) {
      if (b.isPositive() || b.isNegative()) return true;
    }
    auto& inside = span.inside;
    if (std::any_of(inside.begin(), inside.end(), [](auto& b) { return b.isNegative(); })) {
      return true;
    }
    inside.erase(
        std::remove_if(inside.begin(), inside.end(), [](auto& b) { return b.isPositive(); }),
        inside.end());
    return false;
  }
  static bool changesSign(const Bernstein& b) {
    const Ball &first = b.c[0], &last = b.c[b.degree];
    return (first.isNegative() && last.isPositive()) || (first.isPositive() && last.isNegative());
  }

  bool certifiesContact_;
  int looks_ = 0;
};

std::array<Moving<Ball>, 4> ballsOf(const LinearQuery& query) {
  std::array<Moving<Ball>, 4> moving;
  for (std::size_t i = 0; i < 4; ++i) {
    const Path& p = query.points[i];
    moving[i][0].c = {Ball(p.from.x), Ball(p.to.x)};
    moving[i][1].c = {Ball(p.from.y), Ball(p.to.y)};
    moving[i][2].c = {Ball(p.from.z), Ball(p.to.z)};
  }
  return moving;
}

/// The number of points of the first feature, and of all.
std::pair<std::size_t, std::size_t> pointsOf(LinearKind kind) {
  switch (kind) {
    case LinearKind::VertexFace: return {1, 4};
    case LinearKind::EdgeEdge: return {2, 4};
    case LinearKind::VertexEdge: return {1, 3};
    case LinearKind::VertexVertex: break;
  }
  return {1, 2};
}

/// On one axis, every point of one feature stays below every point of the other: comparisons only.
/// At both ends in the same order suffices, as all points move linearly.
bool staysApart(const LinearQuery& query) {
  const auto [split, count] = pointsOf(query.kind);
  for (double Vec3d::*axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    bool below = true, above = true;
    for (const auto end : {&Path::from, &Path::to}) {
      for (std::size_t i = 0; i < split; ++i) {
        for (std::size_t j = split; j < count; ++j) {
          const double a = query.points[i].*end.*axis, b = query.points[j].*end.*axis;
          below = below && a < b;
          above = above && a > b;
        }
      }
    }
    if (below || above) return true;
  }
  return false;
}

Span spanOf(const LinearQuery& query) {
  const auto p = ballsOf(query);
  Span span;
  if (query.kind == LinearKind::VertexFace || query.kind == LinearKind::EdgeEdge) {
    const auto m = query.kind == LinearKind::VertexFace ? vertexMeetsFace(p) : edgeMeetsEdge(p);
    span.zero.emplace_back(m.coplanar);
    for (const auto& form : m.inside) span.inside.emplace_back(form);
  } else if (query.kind == LinearKind::VertexEdge) {
    const OnSegment<Ball> on(p[0], p[1], p[2]);
    for (const auto& form : on.across) span.zero.emplace_back(form);
    span.inside.emplace_back(Form<Ball, 2>{} - on.along);
  } else {
    for (const auto& form : p[0] - p[1]) span.zero.emplace_back(form);
  }
  return span;
}

}  // namespace

// A strict sign change of the coplanarity together with strict signs inside means n.n > 0 and
// contact; one negative sign means n.n > 0 and no contact. With two or more polynomials that must
// vanish at once, changes of sign do not show contact.
std::optional<LinearTruth> linearTruthByBalls(const LinearQuery& query) {
  if (staysApart(query)) return LinearTruth{};
  Span span = spanOf(query);
  Search search(span.zero.size() == 1);
  if (search.search(std::move(span)) == Answer::Unknown) return std::nullopt;
  return search.truth;
}

}  // namespace foretouch::oracle
