#include "tools/report/scene_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "lss/index.h"
#include "tools/report/indexed_mesh.h"

namespace foretouch::tools {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

/// Reaches (m) around the action: takes the first that leaves few enough triangles.
constexpr std::array kReachesM = {4.0, 2.0, 1.0};

/// Triangles of one object, some of which must stay as they are.
struct Part {
  std::string name;
  std::vector<TriangleId> ids;    ///< Ascending.
  std::vector<TriangleId> fixed;  ///< Those of `ids` that must stay; ascending.
};

bool isNear(const Triangle& triangle, const AlignedBox3d& box) {
  AlignedBox3d own;
  for (const Vector3d& vertex : triangle.vertices) own.extend(vertex);
  return box.intersects(own);
}

std::vector<TriangleId> sorted(std::vector<TriangleId> ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

bool contains(const std::vector<TriangleId>& ids, TriangleId id) {
  return std::binary_search(ids.begin(), ids.end(), id);
}

/// The finite triangles whose boxes meet `box`, and those of `always`; ascending.
std::vector<TriangleId> within(const Scene& scene, const AlignedBox3d& box,
                               const std::vector<TriangleId>& always) {
  std::vector<TriangleId> ids;
  const auto count = static_cast<TriangleId>(scene.numTriangles());
  for (TriangleId id = 0; id < count; ++id) {
    const Triangle& triangle = scene.triangle(id);
    if (isFinite(triangle) && (isNear(triangle, box) || contains(always, id))) ids.push_back(id);
  }
  return ids;
}

AlignedBox3d grown(const AlignedBox3d& box, double byM) {
  return {box.min() - Vector3d::Constant(byM), box.max() + Vector3d::Constant(byM)};
}

/// The part of a scene to show, before simplification.
struct Choice {
  std::vector<TriangleId> ids;
  double reachM = 0.0;  ///< 0: all of it.
};

Choice allOf(const Scene& scene, const std::vector<TriangleId>& contacted) {
  const SceneAudit& audit = scene.audit();
  return {within(scene, AlignedBox3d(audit.boxMin, audit.boxMax), contacted), 0.0};
}

/// The part near the action, with the widest reach that is light enough, else the widest of all;
/// the whole scene if nothing is near.
Choice nearAction(const Scene& scene, const SceneRequest& request,
                  const std::vector<TriangleId>& contacted) {
  if (request.action.isEmpty()) return allOf(scene, contacted);
  Choice widest;
  for (const double reachM : kReachesM) {
    Choice choice{within(scene, grown(request.action, reachM), contacted), reachM};
    if (choice.ids.size() > request.maxTriangles) {
      if (widest.ids.empty()) widest = std::move(choice);
    } else if (!choice.ids.empty()) {
      return choice;
    }
  }
  return widest.ids.empty() ? allOf(scene, contacted) : widest;
}

/// Near the action, if any, but no farther from the scene than necessary.
Vector3d originOf(const SceneAudit& audit, const AlignedBox3d& action) {
  const AlignedBox3d box(audit.boxMin, audit.boxMax);
  if (action.isEmpty()) return box.center();
  return action.center().cwiseMax(box.min()).cwiseMin(box.max());
}

std::vector<Part> partsOf(const Scene& scene, const Choice& choice,
                          const std::vector<TriangleId>& contacted) {
  std::vector<Part> parts;
  for (const std::string& name : scene.objectNames()) parts.push_back({name, {}, {}});
  for (const TriangleId id : choice.ids) {
    Part& part = parts[slotOf(scene.object(id))];
    part.ids.push_back(id);
    if (contains(contacted, id)) part.fixed.push_back(id);
  }
  parts.erase(
      std::remove_if(parts.begin(), parts.end(), [](const Part& part) { return part.ids.empty(); }),
      parts.end());
  return parts;
}

/// Objects of at most this many triangles lose too much by simplification.
constexpr std::size_t kSmallObject = 64;

bool isSmall(const Part& part) {
  return part.ids.size() <= kSmallObject;
}

/// Merges small objects into one, and returns true, if there are too many to leave unsimplified.
bool poolCrumbs(std::vector<Part>& parts, std::size_t mostTriangles) {
  std::size_t triangles = 0, objects = 0;
  for (const Part& part : parts) {
    triangles += isSmall(part) ? part.ids.size() : 0;
    objects += isSmall(part) ? 1 : 0;
  }
  if (triangles <= mostTriangles / 2) return false;
  Part pool{fmt::format("{} small objects", objects), {}, {}};
  for (const Part& part : parts) {
    if (!isSmall(part)) continue;
    pool.ids.insert(pool.ids.end(), part.ids.begin(), part.ids.end());
    pool.fixed.insert(pool.fixed.end(), part.fixed.begin(), part.fixed.end());
  }
  pool.ids = sorted(std::move(pool.ids));
  pool.fixed = sorted(std::move(pool.fixed));
  parts.erase(std::remove_if(parts.begin(), parts.end(), isSmall), parts.end());
  parts.push_back(std::move(pool));
  return true;
}

void append(const Scene& scene, TriangleId id, const Vector3d& origin, Corners& corners) {
  for (const Vector3d& vertex : scene.triangle(id).vertices) {
    const Eigen::Vector3f position = (vertex - origin).cast<float>();
    corners.insert(corners.end(), position.data(), position.data() + 3);
  }
}

/// The shown triangles, part by part.
class Gathering {
 public:
  Gathering(const Scene& scene, ViewScene& view) : scene_(scene), view_(view) {}

  void addWhole(const Part& part) {
    open(part);
    for (const TriangleId id : part.ids) {
      append(scene_, id, view_.origin, corners_);
      view_.triangleIds.push_back(static_cast<std::uint32_t>(id));
    }
    close();
  }

  /// `made` replaces the part's triangles that need not stay.
  void addSimplified(const Part& part, const Simplifier& simplifier, const Simplified& made) {
    open(part);
    simplifier.append(made, corners_);
    for (const TriangleId id : part.fixed) append(scene_, id, view_.origin, corners_);
    close();
  }

  void finish() { view_.mesh = indexed(std::move(corners_)); }

 private:
  [[nodiscard]] std::uint32_t triangles() const {
    return static_cast<std::uint32_t>(corners_.size() / 9);
  }
  void open(const Part& part) { view_.objects.push_back({part.name, triangles(), 0}); }
  void close() { view_.objects.back().count = triangles() - view_.objects.back().first; }

  const Scene& scene_;
  ViewScene& view_;
  Corners corners_;
};

/// A mesh of more triangles than this, and of more than so many times what may be shown, has
/// vertices merged first: to collapse edges of all would take seconds.
constexpr double kQuicklyDone = 2e5, kMostTimesShown = 2.0;

/// `share`: that of the triangles that may be shown in those that there are.
Simplifier simplifierOf(const Scene& scene, const Part& part, const Vector3d& origin,
                        double share) {
  Corners corners;
  for (const TriangleId id : part.ids) {
    if (!contains(part.fixed, id)) append(scene, id, origin, corners);
  }
  const double most =
      std::max(kQuicklyDone, kMostTimesShown * share * static_cast<double>(part.ids.size()));
  return Simplifier(corners, static_cast<std::size_t>(std::ceil(most)));
}

/// All objects with the same error, the least that leaves at most `most` triangles; if none does,
/// each with the same share of its triangles. One object alone takes what it may have at once.
std::vector<Simplified> simplifiedTo(const std::vector<Simplifier>& simplifiers, std::size_t most,
                                     double sizeM) {
  // From a millionth of the scene to a sixteenth, each 1.41 times the one before.
  constexpr int kFinest = -40, kCoarsest = -8;
  std::vector<Simplified> best;
  int low = kFinest, high = kCoarsest;
  while (low <= high && simplifiers.size() > 1) {
    const int middle = low + (high - low) / 2;
    std::vector<Simplified> made;
    std::size_t total = 0;
    for (const Simplifier& simplifier : simplifiers) {
      made.push_back(simplifier.within(sizeM * std::pow(2.0, 0.5 * middle)));
      total += made.back().triangles();
    }
    const bool isEnough = total <= most;
    if (isEnough) best = std::move(made);
    isEnough ? high = middle - 1 : low = middle + 1;
  }
  if (!best.empty()) return best;
  std::size_t total = 0;
  for (const Simplifier& simplifier : simplifiers) total += simplifier.triangles();
  for (const Simplifier& simplifier : simplifiers) {
    best.push_back(
        simplifier.downTo(most * simplifier.triangles() / std::max<std::size_t>(1, total)));
  }
  return best;
}

/// Adds all parts in at most about `most` triangles; returns the size of hidden details (m).
double addSimplified(const Scene& scene, const std::vector<Part>& parts, std::size_t most,
                     const Vector3d& origin, Gathering& gathering) {
  std::size_t spared = 0, given = 0;
  for (const Part& part : parts) {
    spared += isSmall(part) ? part.ids.size() : part.fixed.size();
    given += isSmall(part) ? 0 : part.ids.size();
  }
  const double share =
      static_cast<double>(most) / static_cast<double>(std::max<std::size_t>(1, given));
  std::vector<Simplifier> simplifiers;
  for (const Part& part : parts) {
    if (!isSmall(part)) simplifiers.push_back(simplifierOf(scene, part, origin, share));
  }
  const double sizeM = (scene.audit().boxMax - scene.audit().boxMin).norm();
  const auto made = simplifiedTo(simplifiers, most > spared ? most - spared : 0, sizeM);
  double errorM = 0.0;
  std::size_t next = 0;
  for (const Part& part : parts) {
    if (isSmall(part)) {
      gathering.addWhole(part);
      continue;
    }
    gathering.addSimplified(part, simplifiers[next], made[next]);
    errorM = std::max(errorM, made[next++].errorM);
  }
  return errorM;
}

void noteClipping(const ViewScene& view, const Choice& choice, std::vector<std::string>& notes) {
  notes.push_back(
      fmt::format("{} has {} triangles: only the {} within {:g} m of the action are shown. That is "
                  "for the page alone: queries take all of them.",
                  view.name, view.trianglesInFile, choice.ids.size(), choice.reachM));
}

void noteSimplifying(const ViewScene& view, const Choice& choice, double errorM,
                     std::vector<std::string>& notes) {
  const bool isClipped = choice.ids.size() < view.trianglesInFile;
  const std::string part = isClipped ? fmt::format(", of which {} are within {:g} m of the action",
                                                   choice.ids.size(), choice.reachM)
                                     : "";
  notes.push_back(fmt::format(
      "{} has {} triangles{}: they are shown simplified to {}, which may hide details of {:.2g} m. "
      "That is for the page alone: queries take the triangles as they are, and those that contacts "
      "name are shown so.",
      view.name, view.trianglesInFile, part, view.mesh.triangles(), errorM));
}

/// The parts of a scene's view that no choice changes.
ViewScene emptyView(const Scene& scene, const SceneRequest& request) {
  ViewScene view;
  view.name = request.name;
  view.origin = originOf(scene.audit(), request.action);
  view.trianglesInFile = scene.audit().triangles;
  view.boundsMin = scene.audit().boxMin;
  view.boundsMax = scene.audit().boxMax;
  return view;
}

ViewScene wholeTriangles(const Scene& scene, const SceneRequest& request, const Choice& choice,
                         const std::vector<TriangleId>& contacted) {
  ViewScene view = emptyView(scene, request);
  Gathering gathering(scene, view);
  for (const Part& part : partsOf(scene, choice, contacted)) gathering.addWhole(part);
  gathering.finish();
  const bool isAll = choice.ids.size() == scene.audit().triangles;
  view.reduction = isAll ? SceneReduction::None : SceneReduction::Clipped;
  return view;
}

struct SimplifiedView {
  ViewScene view;
  double errorM = 0.0;
  bool isPooled = false;  ///< Small objects became one.
};

SimplifiedView simplified(const Scene& scene, const SceneRequest& request, const Choice& choice,
                          const std::vector<TriangleId>& contacted) {
  SimplifiedView made{emptyView(scene, request), 0.0, false};
  std::vector<Part> parts = partsOf(scene, choice, contacted);
  made.isPooled = poolCrumbs(parts, request.maxTriangles);
  Gathering gathering(scene, made.view);
  made.errorM = addSimplified(scene, parts, request.maxTriangles, made.view.origin, gathering);
  gathering.finish();
  made.view.reduction = SceneReduction::Simplified;
  made.view.triangleIds.clear();
  return made;
}

}  // namespace

ViewScene viewOf(const Scene& scene, const SceneRequest& request, std::vector<std::string>& notes) {
  const std::vector<TriangleId> contacted = sorted(request.contacted);
  const std::size_t triangles = scene.audit().triangles;
  if (triangles <= request.maxTriangles) {
    return wholeTriangles(scene, request, allOf(scene, contacted), contacted);
  }
  if (request.harmlessM > 0.0 && triangles / kMostTimesTooHeavy <= request.maxTriangles) {
    const Choice all = allOf(scene, contacted);
    SimplifiedView made = simplified(scene, request, all, contacted);
    const bool isLight = made.view.mesh.triangles() <= request.maxTriangles + contacted.size();
    if (made.errorM <= request.harmlessM && isLight && !made.isPooled) {
      noteSimplifying(made.view, all, made.errorM, notes);
      return std::move(made.view);
    }
  }
  const Choice choice = nearAction(scene, request, contacted);
  if (choice.ids.size() <= request.maxTriangles) {
    ViewScene view = wholeTriangles(scene, request, choice, contacted);
    if (view.reduction == SceneReduction::Clipped) noteClipping(view, choice, notes);
    return view;
  }
  SimplifiedView made = simplified(scene, request, choice, contacted);
  noteSimplifying(made.view, choice, made.errorM, notes);
  return std::move(made.view);
}

}  // namespace foretouch::tools
