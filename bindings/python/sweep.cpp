// bindings/python/sweep.cpp: foretouch.swept_surface().
#include <vector>

#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/motion.h"
#include "bindings/python/poses.h"
#include "tessellation/swept_surface.h"

namespace foretouch::python {
namespace {

/// All the LSS of one link together: they enclose the union, because no winding is negative.
struct Combined {
  std::vector<double> vertices, times;
  std::vector<std::uint32_t> triangles;
  double certifiedError = 0.0;
  std::size_t pieces = 0;
};

void append(const SweptSurface& surface, Combined& all) {
  const auto first = static_cast<std::uint32_t>(all.times.size());
  for (const Eigen::Vector3d& vertex : surface.vertices) {
    all.vertices.insert(all.vertices.end(), vertex.data(), vertex.data() + 3);
  }
  all.times.insert(all.times.end(), surface.timesS.begin(), surface.timesS.end());
  for (const auto& triangle : surface.triangles) {
    for (const std::uint32_t corner : triangle) all.triangles.push_back(first + corner);
  }
  all.certifiedError = std::max(all.certifiedError, surface.certifiedError);
  all.pieces += surface.pieces;
}

bool isSame(const Pose& x, const Pose& y) {
  const auto isSameTurn = [](const Quaternion& p, const Quaternion& q) {
    return p.coeffs() == q.coeffs();
  };
  return x.translations == y.translations &&
         std::equal(x.rotations.begin(), x.rotations.end(), y.rotations.begin(), isSameTurn);
}

/// Each must be of the same avatar, and begin where the one before ended.
void checkChain(const std::vector<const Motion*>& motions) {
  if (motions.empty()) refuse(ErrorCode::Empty, "motions", "expected at least one motion");
  for (std::size_t i = 1; i < motions.size(); ++i) {
    const std::string what = "motions[" + std::to_string(i) + "]";
    if (motions[i]->avatar->identity() != motions[0]->avatar->identity()) {
      refuse(ErrorCode::Mismatch, what, "expected a motion of the first one's avatar");
    }
    if (!isSame(motions[i]->start, motions[i - 1]->end)) {
      refuse(ErrorCode::Mismatch, what, "expected a motion from where the one before it ends");
    }
  }
}

Combined combined(const std::vector<const Motion*>& motions, LinkId link,
                  SweptSurfaceOptions options) {
  Combined all;
  const std::size_t most = options.maxTriangles;
  for (const Lss& lss : motions[0]->avatar->lss(link)) {
    options.maxTriangles = most - all.triangles.size() / 3;
    auto builder = valueOf(SweptSurfaceBuilder::create(lss, options), "error");
    double begin = 0.0;
    for (const Motion* motion : motions) {
      valueOf(builder.add(motion->chain, link, {0.0, 1.0, begin, begin + 1.0}), "swept_surface");
      begin += 1.0;
    }
    append(valueOf(builder.finish(), "swept_surface"), all);
  }
  return all;
}

SweptSurfaceOptions optionsFrom(const Shown<shown::Number>& error, const Shown<shown::Text>& side,
                                const Shown<shown::Truth>& singlePrecision,
                                const Shown<shown::Integer>& maxTriangles) {
  static constexpr std::array<std::pair<const char*, SurfaceSide>, 2> kSides{
      {{"outer", SurfaceSide::Outer}, {"inner", SurfaceSide::Inner}}};
  SweptSurfaceOptions options;
  options.error = number(error, "error");
  options.side = oneOf(side, "side", kSides);
  const int isSingle = PyObject_IsTrue(singlePrecision.ptr());
  if (isSingle < 0) throw py::error_already_set();
  if (isSingle != 0) options.bits = CoordinateBits::Single;
  options.maxTriangles = static_cast<std::size_t>(
      integer(maxTriangles, "max_triangles", 1, std::int64_t(SweptSurfaceOptions{}.maxTriangles)));
  return options;
}

/// Keeps the motions alive while the GIL is released.
struct GivenMotions {
  std::vector<py::object> objects;
  std::vector<const Motion*> motions;
};

GivenMotions motionsFrom(const py::object& given) {
  GivenMotions found;
  found.objects =
      py::isinstance<Motion>(given) ? std::vector<py::object>{given} : items(given, "motions");
  for (const py::object& object : found.objects) {
    if (!py::isinstance<Motion>(object)) {
      refuse(ErrorCode::Mismatch, "motions[" + std::to_string(found.motions.size()) + "]",
             "expected a foretouch.Motion");
    }
    found.motions.push_back(object.cast<const Motion*>());
  }
  checkChain(found.motions);
  return found;
}

Shown<shown::SweptSurface> sweptSurface(const Shown<shown::Motions>& motions,
                                        const Shown<shown::Link>& link,
                                        const Shown<shown::Number>& error,
                                        const Shown<shown::Text>& side,
                                        const Shown<shown::Truth>& singlePrecision,
                                        const Shown<shown::Integer>& maxTriangles) {
  const GivenMotions given = motionsFrom(motions);
  const Avatar& avatar = *given.motions[0]->avatar;
  const LinkId id = linkOf(avatar, link, "link");
  if (avatar.lss(id).empty()) {
    refuse(ErrorCode::Empty, "link", "expected a link with an LSS: this one sweeps nothing");
  }
  const SweptSurfaceOptions options = optionsFrom(error, side, singlePrecision, maxTriangles);
  Combined all;
  {
    const py::gil_scoped_release free;
    all = combined(given.motions, id, options);
  }
  const auto vertices = static_cast<py::ssize_t>(all.times.size());
  const auto triangles = static_cast<py::ssize_t>(all.triangles.size() / 3);
  return pythonType("SweptSurface")(
      Numbers(Shape{vertices, 3}, all.vertices.data()),
      py::array_t<std::uint32_t>(Shape{triangles, 3}, all.triangles.data()), all.certifiedError,
      Numbers(vertices, all.times.data()), all.pieces);
}

}  // namespace

void bindSweep(py::module_& module) {
  const SweptSurfaceOptions usual;
  module.def("swept_surface", &sweptSurface, py::arg("motions"), py::arg("link"), py::kw_only(),
             py::arg("error") = usual.error, py::arg("side") = "outer",
             py::arg("single_precision") = false, py::arg("max_triangles") = usual.maxTriangles,
             "The surface that a link's LSS sweep during one motion, or during several of which\n"
             "each begins where the one before ends: a SweptSurface. side: 'outer' encloses all\n"
             "that is swept, and nothing further away than error (metres); 'inner' encloses\n"
             "nothing else. single_precision: every coordinate fits a float.");
}

}  // namespace foretouch::python
