#include "tools/report/swept_views.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "articulated/motion.h"
#include "tessellation/swept_surface.h"
#include "tools/report/track_builder.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// A contact whose link's sweep to show.
struct Wanted {
  std::size_t avatar = 0;
  const ReportedContact* contact = nullptr;

  [[nodiscard]] auto rank() const {
    const bool starts = contact->contact.verdict == Verdict::StartsInContact;
    const int kind = starts ? 2 : contact->missedByPoses ? 0 : 1;
    return std::make_tuple(kind, contact->timeS, avatar, contact->step, contact->contact.link);
  }
};

std::vector<Wanted> wantedOf(const ViewDocument& document) {
  std::vector<Wanted> wanted;
  for (std::size_t i = 0; i < document.avatars.size(); ++i) {
    const ViewAvatar& avatar = document.avatars[i];
    for (const ReportedContact& contact : avatar.contacts) {
      const bool hasLss = !avatar.avatar->lss(contact.contact.link).empty();
      const auto step = static_cast<std::size_t>(contact.step);
      const bool isMotion = avatar.track->stepFrom[step] != avatar.track->stepTo[step];
      if (contact.contact.verdict != Verdict::Undecided && hasLss && isMotion) {
        wanted.push_back({i, &contact});
      }
    }
  }
  std::sort(wanted.begin(), wanted.end(),
            [](const Wanted& x, const Wanted& y) { return x.rank() < y.rank(); });
  return wanted;
}

ChainMotion motionOf(const ViewAvatar& avatar, std::uint32_t step) {
  const ViewTrack& track = *avatar.track;
  return ChainMotion(avatar.avatar->skeleton(), poseOf(track, track.stepFrom[step]),
                     poseOf(track, track.stepTo[step]));
}

/// Vertices lie on a lattice, and so do their differences, which then fit floats exactly; false if
/// the surface is too large for that.
bool append(const SweptSurface& surface, ViewSwept& swept) {
  if (swept.mesh.positions.empty()) swept.origin = surface.vertices.front();
  const auto first = static_cast<std::uint32_t>(swept.mesh.vertices());
  for (const Vector3d& vertex : surface.vertices) {
    const Eigen::Vector3f position = (vertex - swept.origin).cast<float>();
    if (swept.origin + position.cast<double>() != vertex) return false;
    swept.mesh.positions.insert(swept.mesh.positions.end(), position.data(), position.data() + 3);
  }
  for (const auto& triangle : surface.triangles) {
    for (const std::uint32_t corner : triangle) swept.mesh.indices.push_back(first + corner);
  }
  swept.error = std::max(swept.error, surface.certifiedError);
  return true;
}

/// Nothing if a surface would need more than `maxTriangles` or is impossible at that error.
std::optional<ViewSwept> sweptBy(const ViewAvatar& avatar, const ReportedContact& contact,
                                 const SweptRequest& request, std::size_t maxTriangles) {
  const LinkId link = contact.contact.link;
  ViewSwept swept;
  swept.step = static_cast<std::uint32_t>(contact.step);
  const ChainMotion motion = motionOf(avatar, swept.step);
  swept.link = link;
  for (const Lss& lss : avatar.avatar->lss(link)) {
    SweptSurfaceOptions options;
    options.error = std::max(request.errorShare * lss.radius, request.leastErrorM);
    options.maxTriangles = maxTriangles - swept.mesh.triangles();
    auto builder = SweptSurfaceBuilder::create(lss, options);
    if (!builder.ok() || !builder.value().add(motion, link, {}).ok()) return std::nullopt;
    const auto surface = builder.value().finish();
    if (!surface.ok() || surface.value().triangles.size() > options.maxTriangles) {
      return std::nullopt;
    }
    if (!append(surface.value(), swept)) return std::nullopt;
  }
  return swept;
}

}  // namespace

void addSwept(const SweptRequest& request, ViewDocument& document, const ReportProgress& progress) {
  const std::vector<Wanted> wanted = wantedOf(document);
  std::size_t room = request.maxTriangles, failed = 0, done = 0;
  for (; done < wanted.size() && room > 0; ++done) {
    if (!progress(static_cast<std::int64_t>(done), static_cast<std::int64_t>(wanted.size()))) {
      return;
    }
    ViewAvatar& avatar = document.avatars[wanted[done].avatar];
    const std::size_t most = std::min(room, request.maxTrianglesOfOne);
    auto swept = sweptBy(avatar, *wanted[done].contact, request, most);
    if (swept) {
      room -= swept->mesh.triangles();
      avatar.swept.push_back(std::move(*swept));
    } else if (most < request.maxTrianglesOfOne) {
      break;  // the document is full
    } else {
      ++failed;
    }
  }
  if (failed > 0) {
    document.notes.push_back(
        fmt::format("The swept surfaces of {} contacts are not shown: each would need more than {} "
                    "triangles, or "
                    "finer coordinates than the page has.",
                    failed, request.maxTrianglesOfOne));
  }
  if (done < wanted.size()) {
    document.notes.push_back(fmt::format(
        "Swept surfaces are shown of {} of {} contacts: first of those that a check of the poses "
        "misses, then of the earliest.",
        done - failed, wanted.size()));
  }
}

}  // namespace foretouch::tools
