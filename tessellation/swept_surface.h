// tessellation/swept_surface.h: what an LSS covers while its link moves, as a closed surface with a
// certified error. The pieces are the culler's: over a span of length h the LSS lies in the hull of
// its axis ends at both instants, grown by radius + A h^2/8 (tessellation/swept_lss.h). Their
// union's surface is built on a lattice, so that no rounding is left in what is written out.
// Proof: tessellation/swept_surface.md. Source of the tessellated LSS sweep: [Kim07].
// Lengths in metres, world W.
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
  Outer,  ///< Nothing of the swept volume is outside the surface.
  Inner,  ///< Everything inside the surface is in the swept volume.
};

/// What a vertex's coordinate must fit: the significant bits of a double or of a float.
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
/// opposite directions. The surface may pass through itself: what it encloses are the points that
/// it winds around at least once; it winds around none less than zero times.
struct SweptSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<double> timesS;  ///< Per vertex: when the LSS is there. It may be there again.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Outer: every point enclosed is this close to the swept volume. Inner: every point of the swept
  /// volume is this close to an enclosed one. Rounded up; at most SweptSurfaceOptions::error.
  double certifiedError = 0.0;
  std::size_t pieces = 0;
  double spacing = 0.0;  ///< Every coordinate is a multiple of half of this power of two.
  /// Inner side only: the LSS is so thin for the error that nothing can be said to be inside.
  bool vanishes = false;
};

/// Builds the surface of one LSS over consecutive spans. Time and memory: O(pieces * facets) and
/// O(triangles).
class SweptSurfaceBuilder {
 public:
  /// Error where `lss_L` is not valid, where the error is not a positive number, or where it is too
  /// small for a radius this large.
  static Result<SweptSurfaceBuilder> create(const Lss& lss_L, const SweptSurfaceOptions& options);
  SweptSurfaceBuilder(SweptSurfaceBuilder&&) noexcept;
  SweptSurfaceBuilder& operator=(SweptSurfaceBuilder&&) noexcept;
  ~SweptSurfaceBuilder();

  /// Carries the LSS on. Precondition: the LSS is where the span before left it. Errors:
  /// coordinates that the error is too small for; more triangles than allowed. The builder is then
  /// of no use.
  [[nodiscard]] Result<Done> add(const ChainMotion& motion, LinkId link, const SweptSpan& span);

  /// Triangles so far, but for what touches the last instant.
  [[nodiscard]] std::size_t triangles() const;

  /// Precondition: something was added. The builder is then of no further use.
  [[nodiscard]] Result<SweptSurface> finish();

 private:
  class Parts;
  explicit SweptSurfaceBuilder(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace foretouch
