#include "tools/world/world_audit.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "lss/index.h"
#include "tools/audit/audits.h"
#include "tools/world/world_results.h"

namespace foretouch::tools {
namespace {

constexpr std::size_t kMostOverlapRows = 20;
constexpr double kMmPerM = 1e3;

/// When the body's own poses begin and end.
struct ToldTime {
  std::int64_t firstUs = 0, lastUs = 0;
};

ToldTime toldTime(const LoadedBody& body) {
  return {body.stretches.front().beginUs, body.stretches.back().track.knownUntilUs()};
}

/// "60 Hz", by the mean distance of poses; nothing for a body that stands.
std::string rateOf(const LoadedBody& body) {
  if (body.numPoses == 0) return "stands";
  if (body.numPoses < 2) return "";
  return fmt::format("{:.3g} Hz", static_cast<double>(body.numPoses - 1) * kUsPerS /
                                      static_cast<double>(body.lastPoseUs - body.firstPoseUs));
}

std::string bodyRow(const LoadedWorld& world, BodyId id) {
  const FileBody& file = world.file.bodies[slotOf(id)];
  const LoadedBody& body = world.bodies[slotOf(id)];
  const ToldTime told = toldTime(body);
  return fmt::format("  {:<18}{:<8}{:<12}{:>9}{:>9}{:>10}  {:>9}{:>9}  {}\n", file.name,
                     madeOf(file.shape), file.trigger ? "(trigger)" : file.group,
                     file.massKg ? fmt::format("{:g} kg", *file.massKg) : "", body.numPoses,
                     rateOf(body), fmt::format("{:.3f}", LoadedWorld::secondsOf(told.firstUs)),
                     fmt::format("{:.3f}", LoadedWorld::secondsOf(told.lastUs)),
                     toString(file.whenSilent));
}

std::string sideInWords(const LoadedWorld& world, const ContactSide& side) {
  if (side.body == kStillScene) {
    return "the scene's " +
           inQuotes(world.scene->objectNames()[slotOf(world.scene->object(side.triangle))]);
  }
  const std::string link = world.linkNameOf(side.body, side.link);
  return inQuotes(world.nameOf(side.body)) + (link.empty() ? "" : " " + link);
}

std::string carriersInWords(const LoadedWorld& world) {
  std::string text;
  for (std::size_t id = 0; id < world.bodies.size(); ++id) {
    const BodyStretches& stretches = world.bodies[id].stretches;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      if (!stretches[i].carrier) continue;
      const Carrier& carrier = *stretches[i].carrier;
      const std::string link = world.linkNameOf(carrier.body, carrier.link);
      text += fmt::format(
          "  {} {} {}{}, from {:.3f} s{}\n", inQuotes(world.file.bodies[id].name),
          carrier.movesInFrame ? "moves in the frame of" : "is held by",
          inQuotes(world.nameOf(carrier.body)), link.empty() ? "" : " " + link,
          LoadedWorld::secondsOf(stretches[i].beginUs),
          i + 1 < stretches.size()
              ? fmt::format(" to {:.3f} s", LoadedWorld::secondsOf(stretches[i + 1].beginUs))
              : "");
    }
  }
  return text.empty() ? "" : "\ncarriers\n" + text;
}

std::string overlapsInWords(const LoadedWorld& world, const std::vector<WorldContact>& overlaps) {
  if (overlaps.empty()) return "\nnobody touches anything where it appears\n";
  std::string text = fmt::format(
      "\n{} where a body appears\n",
      overlaps.size() == 1 ? "an overlap" : std::to_string(overlaps.size()) + " overlaps");
  for (std::size_t i = 0; i < std::min(overlaps.size(), kMostOverlapRows); ++i) {
    const WorldContact& overlap = overlaps[i];
    text += fmt::format("  {} and {}, at {:.3f} s{}\n", sideInWords(world, overlap.a),
                        sideInWords(world, overlap.b), LoadedWorld::secondsOf(overlap.time.us),
                        overlap.penetration > 0.0
                            ? fmt::format(", {:.1f} mm deep", kMmPerM * overlap.penetration)
                            : "");
  }
  if (overlaps.size() > kMostOverlapRows) {
    text += fmt::format("  and {} more\n", overlaps.size() - kMostOverlapRows);
  }
  return text;
}

/// Pairs that a world is not asked about unless its file says so.
std::string notAskedInWords(const LoadedWorld& world) {
  const auto meshes = std::count_if(
      world.bodies.begin(), world.bodies.begin() + static_cast<std::ptrdiff_t>(world.numBodies()),
      [](const LoadedBody& body) { return body.isMesh(); });
  if (meshes == 0 || world.file.askMeshes) return "";
  std::string text = auditRow("not asked", "");
  if (meshes > 1) {
    text =
        auditRow("not asked", fmt::format("whether two of the {} meshes and boxes meet", meshes));
  } else if (world.scene) {
    text = auditRow("not asked", "whether a mesh or box meets the scene");
  } else {
    return "";
  }
  if (meshes > 1 && world.scene) text += auditRow("", "nor whether one of them meets the scene");
  return text;
}

std::string timeInWords(const LoadedWorld& world) {
  std::string text = fmt::format("{:.3f} s to {:.3f} s", LoadedWorld::secondsOf(world.beginUs),
                                 LoadedWorld::secondsOf(world.endUs));
  if (world.waitsFor) {
    text += ", where the poses of " + inQuotes(world.nameOf(*world.waitsFor)) + " end";
  }
  return auditRow("time", text);
}

}  // namespace

std::string describe(const LoadedWorld& world, const std::vector<WorldContact>& overlaps) {
  std::string text = world.file.path + "\n";
  text +=
      auditRow("scene", world.scene ? fmt::format("{}, {} triangles", world.file.scene.scenePath,
                                                  world.scene->audit().triangles)
                                    : "none");
  text += auditRow("bodies", std::to_string(world.numBodies()));
  if (world.file.hasTriggers()) {
    text += auditRow("triggers", std::to_string(world.triggers.numTriggers()));
  }
  text += timeInWords(world);
  text += auditRow("tolerance", fmt::format("{:g} m", world.file.tolerance));
  for (const FileAsk& ask : world.file.asks) {
    text += auditRow(ask.isAsked ? "asked" : "not asked",
                     ask.group + " and " + (ask.with.empty() ? "the scene" : ask.with));
  }
  text += notAskedInWords(world);
  text += fmt::format("\n  {:<18}{:<8}{:<12}{:>9}{:>9}{:>10}  {:>9}{:>9}  {}\n", "body", "of",
                      "group", "mass", "poses", "rate", "from, s", "to, s", "when silent");
  for (BodyId body = 0; body < world.world.numBodies(); ++body) text += bodyRow(world, body);
  return text + carriersInWords(world) + overlapsInWords(world, overlaps);
}

std::string auditLine(const LoadedWorld& world, const std::vector<WorldContact>& overlaps) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("world", world.file.path);
  if (world.scene) {
    out.field("scene", world.file.scene.scenePath);
    out.field("triangles", world.scene->audit().triangles);
  }
  out.field("tolerance", world.file.tolerance);
  out.field("from", LoadedWorld::secondsOf(world.beginUs));
  out.field("until", LoadedWorld::secondsOf(world.endUs));
  out.key("bodies");
  out.beginArray();
  for (std::size_t id = 0; id < world.bodies.size(); ++id) {
    const FileBody& file = world.file.bodies[id];
    const LoadedBody& body = world.bodies[id];
    const ToldTime told = toldTime(body);
    out.beginObject();
    out.field("name", file.name);
    out.field("made_of", madeOf(file.shape));
    if (file.fidelity == Fidelity::Exact) out.field("fidelity", toString(file.fidelity));
    if (!file.group.empty()) out.field("group", file.group);
    if (file.trigger) out.field("trigger", true);
    if (file.massKg) out.field("mass", *file.massKg);
    out.field("poses", body.numPoses);
    out.field("from", LoadedWorld::secondsOf(told.firstUs));
    out.field("until", LoadedWorld::secondsOf(told.lastUs));
    out.field("when_silent", toString(file.whenSilent));
    out.endObject();
  }
  out.endArray();
  out.list("overlaps", overlaps,
           [&](const WorldContact& overlap) { writeWorldContact(world, overlap, out); });
  out.field("notes", world.remarks);
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
