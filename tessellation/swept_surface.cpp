#include "tessellation/swept_surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/rounding.h"
#include "tessellation/sheet_bound.h"
#include "tessellation/swept_chain.h"
#include "tessellation/swept_lss.h"

namespace foretouch {
namespace {

std::string tooSmall(double error, const std::string& what) {
  return "an error of " + inDigits(error) + " m is too small for " + what;
}

using Eigen::Vector3d;
using internal::kInflation;

// Shares of the error. The chord's share counts twice: once for the pieces' growth, once for the
// distance of their hulls from the path. The number of pieces is proportional to the inverse of the
// sheet's share (both ends seldom move in one direction), that of a piece's facets to the inverse
// root of theirs: their product is least at 2 : 1. The rest is for rounding.
constexpr double kChordShare = 0.1, kFacetShare = 0.27, kSheetShare = 0.46;
constexpr double kPositionShare = 0.005;  // for the computed axis ends; counts twice
constexpr double kSpacingsPerError = 128.0;
/// Half the diagonal of a lattice cell, in spacings: how far rounding moves an end of the axis.
constexpr double kLatticeRounding = 0.8661;
/// More pieces per motion than this are an error, before any is made.
constexpr double kMaxPiecesPerSpan = 1e8;

/// The largest power of two that is at most the error / kSpacingsPerError.
double spacingFor(double error) {
  int exponent = 0;
  std::frexp(error / kSpacingsPerError, &exponent);
  return std::ldexp(1.0, exponent - 1);
}

Error problem(ErrorCode code, std::string message) {
  return Error::of(code, std::move(message));
}

/// Lengths of one surface, in metres.
struct Budget {
  double spacing = 0.0, chord = 0.0, sheet = 0.0, position = 0.0;
  /// How far a corner of a piece may be from the true axis end.
  [[nodiscard]] double corner() const { return position + kLatticeRounding * spacing; }
};

Budget budgetFor(double error) {
  return {spacingFor(error), kChordShare * error, kSheetShare * error, kPositionShare * error};
}

/// Around the LSS's ball: the piece contains the sweep. Within it: the sweep contains the piece.
Result<BallPolytope> polytopeFor(const Lss& lss, const SweptSurfaceOptions& options,
                                 const Budget& budget) {
  const double facets = kFacetShare * options.error / budget.spacing;
  if (options.side == SurfaceSide::Outer) {
    const double radius = (lss.radius + budget.chord + budget.corner()) * kInflation;
    return polytopeAround(radius / budget.spacing, facets);
  }
  const double radius =
      (lss.radius - (budget.chord + budget.sheet + budget.corner()) * kInflation) / kInflation;
  return polytopeWithin(radius / budget.spacing, facets);
}

/// Thinner LSS have no inner surface: the ball has too little room for a polytope.
bool vanishes(const Lss& lss, const SweptSurfaceOptions& options) {
  return options.side == SurfaceSide::Inner && lss.radius < 1.2 * options.error;
}

/// Cuts the span from `begin` to the last of `ends` into enough parts to make its sheet `excess`
/// times flatter, if that were linear; false if doubles have none between.
bool cutSpan(double begin, double excess, std::vector<double>& ends) {
  constexpr double kMostParts = 64.0;
  const double parts = std::ceil(std::clamp(1.02 * excess, 2.0, kMostParts));
  const double end = ends.back(), middle = begin + 0.5 * (end - begin);
  if (!(begin < middle && middle < end)) return false;
  for (double part = parts - 1.0; part >= 1.0; part -= 1.0) {
    const double t = begin + (part / parts) * (end - begin);
    if (begin < t && t < ends.back()) ends.push_back(t);
  }
  if (ends.back() == end) ends.push_back(middle);
  return true;
}

/// The certificate of swept_surface.md 5, rounded up.
double certified(const Lss& lss, const SweptSurfaceOptions& options, const Budget& budget,
                 const BallPolytope& polytope, double sheet) {
  const double ball = options.side == SurfaceSide::Outer
                          ? polytope.circumradius * budget.spacing * kInflation - lss.radius
                          : lss.radius - polytope.inradius * budget.spacing / kInflation;
  const double sheets = options.side == SurfaceSide::Outer ? sheet : 0.0;
  return (ball + budget.chord + sheets + budget.corner()) * kInflation;
}

}  // namespace

class SweptSurfaceBuilder::Parts {
 public:
  Parts(const Lss& lss, const SweptSurfaceOptions& options)
      : lss_(lss), options_(options), budget_(budgetFor(options.error)) {}

  Result<Done> prepare() {
    if (foretouch::vanishes(lss_, options_)) {
      vanishes_ = true;
      return Done{};
    }
    FORETOUCH_TRY(polytope_, polytopeFor(lss_, options_, budget_));
    if (certified(lss_, options_, budget_, polytope_, budget_.sheet) > options_.error) {
      return problem(ErrorCode::OutOfRange,
                     tooSmall(options_.error, "a radius of " + inDigits(lss_.radius) + " m"));
    }
    return Done{};
  }

  Result<Done> add(const ChainMotion& motion, LinkId link, const SweptSpan& span);
  Result<SweptSurface> finish();
  [[nodiscard]] std::size_t triangles() const { return chain_ ? chain_->triangles() : 0; }

 private:
  struct Instant {
    double t = 0.0;
    LatticeEnds lattice;
    AxisEnds ends;  ///< On the lattice, in spacings.
  };
  Result<Instant> instantAt(const ChainMotion& motion, LinkId link, double t) const;
  Result<Done> addUntil(const ChainMotion& motion, LinkId link, const SweptSpan& span, double endT);
  [[nodiscard]] Result<LatticePoint> onLattice(const Vector3d& point) const;
  [[nodiscard]] std::int64_t largestCoordinate() const {
    const bool isSingle = options_.bits == CoordinateBits::Single;
    // Half a spacing, of vertices half way, takes a bit.
    return isSingle ? (std::int64_t{1} << 23) : kMaxLatticeCoordinate;
  }
  [[nodiscard]] Error tooFarOut() const;
  [[nodiscard]] Error tooMany() const {
    return problem(ErrorCode::LimitExceeded,
                   "more than " + std::to_string(options_.maxTriangles) + " triangles");
  }

  Lss lss_;
  SweptSurfaceOptions options_;
  Budget budget_;
  BallPolytope polytope_;
  std::unique_ptr<SweptChain> chain_;
  Instant last_;
  double worstSheet_ = 0.0;  ///< Spacings.
  std::size_t pieces_ = 0;
  bool vanishes_ = false;
};

Error SweptSurfaceBuilder::Parts::tooFarOut() const {
  const bool isSingle = options_.bits == CoordinateBits::Single;
  const double reach = static_cast<double>(largestCoordinate()) * budget_.spacing;
  return problem(ErrorCode::OutOfRange,
                 tooSmall(options_.error, std::string(isSingle ? "single-precision" : "double") +
                                              " coordinates beyond " + inDigits(reach, 3) + " m"));
}

Result<LatticePoint> SweptSurfaceBuilder::Parts::onLattice(const Vector3d& point) const {
  const Vector3d scaled = point / budget_.spacing;  // exact: a power of two
  const double limit = static_cast<double>(largestCoordinate()) - polytope_.circumradius - 1.0;
  if (!(scaled.cwiseAbs().maxCoeff() < limit)) return tooFarOut();
  return LatticePoint{std::llround(scaled.x()), std::llround(scaled.y()), std::llround(scaled.z())};
}

Result<SweptSurfaceBuilder::Parts::Instant> SweptSurfaceBuilder::Parts::instantAt(
    const ChainMotion& motion, LinkId link, double t) const {
  const AxisEnds ends = axisEnds(lss_, motion.stateAt(link, t));
  const auto a = onLattice(ends.a);
  const auto b = onLattice(lss_.a == lss_.b ? ends.a : ends.b);
  if (!a.ok()) return a.error();
  if (!b.ok()) return b.error();
  const auto asVector = [](const LatticePoint& p) {
    return Vector3d(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
  };
  return Instant{t, {a.value(), b.value()}, {asVector(a.value()), asVector(b.value())}};
}

/// Extends the chain to `endT`, in as many pieces as the sheet needs.
Result<Done> SweptSurfaceBuilder::Parts::addUntil(const ChainMotion& motion, LinkId link,
                                                  const SweptSpan& span, double endT) {
  const double sheetSpacings = budget_.sheet / budget_.spacing;
  std::vector<double> ends{endT};
  while (!ends.empty()) {
    FORETOUCH_TRY(auto next, instantAt(motion, link, ends.back()));
    const AxisEnds& end = next.ends;
    const double extent = std::max({(end.a - last_.ends.a).norm(), (end.b - last_.ends.b).norm(),
                                    (end.b - end.a).norm(), (end.b - last_.ends.a).norm(),
                                    (end.a - last_.ends.b).norm()});
    const double sheet = hullLeavesSheetBy(last_.ends, end);
    if (!(sheet <= sheetSpacings) && cutSpan(last_.t, sheet / sheetSpacings, ends)) continue;
    if (!(sheet <= sheetSpacings) || !(extent < static_cast<double>(kMaxLatticeDifference))) {
      return tooFarOut();
    }
    worstSheet_ = std::max(worstSheet_, sheet);
    last_ = next;
    const double share = (last_.t - span.beginT) / (span.endT - span.beginT);
    chain_->add(last_.lattice, span.beginS + share * (span.endS - span.beginS));
    ++pieces_;
    if (chain_->triangles() > options_.maxTriangles) {
      return tooMany();
    }
    ends.pop_back();
  }
  return Done{};
}

Result<Done> SweptSurfaceBuilder::Parts::add(const ChainMotion& motion, LinkId link,
                                             const SweptSpan& span) {
  FORETOUCH_ASSERT(span.beginT >= 0.0 && span.beginT < span.endT && span.endT <= 1.0);
  if (vanishes_) return Done{};
  const AxisBounds bounds = axisBounds(lss_, motion.bounds(link));
  if (!(std::max(bounds.positionRoundingA, bounds.positionRoundingB) <= budget_.position)) {
    return problem(ErrorCode::OutOfRange,
                   tooSmall(options_.error, "the rounding of poses this far from the origin"));
  }
  const double acceleration = std::max(bounds.accelerationA, bounds.accelerationB);
  const double length = span.endT - span.beginT;
  const double wanted =
      std::ceil(length * std::sqrt(acceleration / (8.0 * budget_.chord)) * kInflation);
  if (!(wanted < kMaxPiecesPerSpan)) {
    return problem(ErrorCode::LimitExceeded,
                   "an error of " + inDigits(options_.error) + " m takes more than " +
                       inDigits(kMaxPiecesPerSpan) + " pieces of one step");
  }
  FORETOUCH_TRY(auto first, instantAt(motion, link, span.beginT));
  if (!chain_) {
    last_ = first;
    chain_ = std::make_unique<SweptChain>(polytope_, last_.lattice, span.beginS);
  }
  // A chain continues from its place: within the same rounding of the same true place.
  last_.t = span.beginT;
  const auto count = std::max<std::int64_t>(1, static_cast<std::int64_t>(wanted));
  for (std::int64_t i = 1; i <= count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count);
    const double endT = i == count ? span.endT : span.beginT + share * length;
    FORETOUCH_CHECK(addUntil(motion, link, span, endT));
  }
  return Done{};
}

Result<SweptSurface> SweptSurfaceBuilder::Parts::finish() {
  SweptSurface surface;
  surface.spacing = budget_.spacing;
  surface.vanishes = vanishes_;
  surface.pieces = pieces_;
  if (vanishes_) return surface;
  FORETOUCH_ASSERT(chain_ != nullptr);
  chain_->close();
  surface.certifiedError =
      certified(lss_, options_, budget_, polytope_, worstSheet_ * budget_.spacing);
  ClosedMesh mesh = chain_->mesh();
  surface.triangles = std::move(mesh.triangles);
  if (surface.triangles.size() > options_.maxTriangles) return tooMany();
  for (const ClosedMesh::Vertex& vertex : mesh.vertices) {
    const LatticePoint twice = chain_->place(vertex.a) + chain_->place(vertex.b);
    surface.vertices.push_back(0.5 * budget_.spacing *
                               Vector3d(static_cast<double>(twice.x), static_cast<double>(twice.y),
                                        static_cast<double>(twice.z)));
    surface.timesS.push_back(0.5 * (chain_->timeS(vertex.a) + chain_->timeS(vertex.b)));
  }
  chain_.reset();
  return surface;
}

SweptSurfaceBuilder::SweptSurfaceBuilder(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SweptSurfaceBuilder::SweptSurfaceBuilder(SweptSurfaceBuilder&&) noexcept = default;
SweptSurfaceBuilder& SweptSurfaceBuilder::operator=(SweptSurfaceBuilder&&) noexcept = default;
SweptSurfaceBuilder::~SweptSurfaceBuilder() = default;

Result<SweptSurfaceBuilder> SweptSurfaceBuilder::create(const Lss& lss_L,
                                                        const SweptSurfaceOptions& options) {
  if (!isValid(lss_L)) return problem(ErrorCode::NonFinite, "expected a finite LSS, radius >= 0");
  // Above this, and below, powers of two near the error leave a double's range.
  if (!(options.error >= 1e-12 && options.error <= 1e6)) {
    return problem(ErrorCode::OutOfRange,
                   "expected an error from 1e-12 to 1e6 m, found " + inDigits(options.error));
  }
  auto parts = std::make_unique<Parts>(lss_L, options);
  FORETOUCH_CHECK(parts->prepare());
  return SweptSurfaceBuilder(std::move(parts));
}

Result<Done> SweptSurfaceBuilder::add(const ChainMotion& motion, LinkId link,
                                      const SweptSpan& span) {
  return parts_->add(motion, link, span);
}

std::size_t SweptSurfaceBuilder::triangles() const {
  return parts_->triangles();
}

Result<SweptSurface> SweptSurfaceBuilder::finish() {
  return parts_->finish();
}

}  // namespace foretouch
