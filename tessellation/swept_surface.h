// tessellation/swept_surface.h: the space that an LSS covers while its link moves, as a closed
// surface with a certified error. The pieces are the culler's: over a span of length h the LSS lies
// in the hull of its axis ends at both instants, grown by radius + A h^2/8
// (tessellation/swept_lss.h). The union's surface is built on a lattice, so that the output has no
// rounding error. Proof: tessellation/swept_surface.md. Source of the tessellated LSS sweep:
// [Kim07]. Lengths in metres, world W.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "articulated/result.h"
#include "lss/lss.h"

namespace foretouch {

enum class SurfaceSide : std::uint8_t {
  Outer,  ///< The swept volume is entirely inside the surface.
  Inner,  ///< Everything inside the surface is in the swept volume.
};

/// A vertex's coordinates must fit the significant bits of a double or of a float.
enum class CoordinateBits : std::uint8_t { Double = 53, Single = 24 };

struct SweptSurfaceOptions {
  SurfaceSide side = SurfaceSide::Outer;
  double error = 1e-3;  ///< Largest distance allowed between surface and swept volume.
  CoordinateBits bits = CoordinateBits::Double;
  std::size_t maxTriangles = 50'000'000;
};

/// Part of one motion, and when it happens.
struct SweptSpan {
  double beginT = 0.0, endT = 1.0;  ///< In the motion's [0,1].
  double beginS = 0.0, endS = 1.0;  ///< Seconds.
};

/// Triangles counter-clockwise seen from outside; every edge is shared by exactly two of them, in
/// opposite directions. The surface may pass through itself: it encloses the points that it winds
/// around at least once; no winding number is negative.
struct SweptSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<double> timesS;  ///< Per vertex: a time when the LSS is there; there may be others.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Outer: every point enclosed is this close to the swept volume. Inner: every point of the swept
  /// volume is this close to an enclosed one. Rounded up; at most SweptSurfaceOptions::error.
  double certifiedError = 0.0;
  std::size_t pieces = 0;
  double spacing = 0.0;  ///< Every coordinate is a multiple of half of this power of two.
  /// Inner side only: the LSS is too thin for the error, so nothing is provably inside.
  bool vanishes = false;
};

/// Builds the surface of one LSS over consecutive spans. Time and memory: O(pieces * facets) and
/// O(triangles).
class SweptSurfaceBuilder {
 public:
  /// Error if `lss_L` is not valid, if the error is not a positive number, or if it is too small
  /// for this radius.
  static Result<SweptSurfaceBuilder> create(const Lss& lss_L, const SweptSurfaceOptions& options);
  SweptSurfaceBuilder(SweptSurfaceBuilder&&) noexcept;
  SweptSurfaceBuilder& operator=(SweptSurfaceBuilder&&) noexcept;
  ~SweptSurfaceBuilder();

  /// Adds the next span. Precondition: the LSS begins where the span before ended. Errors: an error
  /// too small for the coordinates; more triangles than allowed. The builder is then unusable.
  [[nodiscard]] Result<Done> add(const ChainMotion& motion, LinkId link, const SweptSpan& span);

  /// Triangles so far, except those at the last instant.
  [[nodiscard]] std::size_t triangles() const;

  /// Precondition: at least one add(). The builder is unusable afterwards.
  [[nodiscard]] Result<SweptSurface> finish();

 private:
  class Parts;
  explicit SweptSurfaceBuilder(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace foretouch
