#include "tools/ask/ask_text.h"

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "tools/json_line.h"
#include "tools/world/world_results.h"

namespace foretouch::tools {
namespace {

std::string said(const Eigen::Vector3d& v) {
  return fmt::format("({:.4f}, {:.4f}, {:.4f})", v.x(), v.y(), v.z());
}

/// "table of the scene", "Anna's LeftHand", "triangle 4 of the door".
std::string nameOf(const LoadedWorld& world, const WorldHit& hit) {
  const ContactSide& what = hit.what;
  const std::optional<Scene>& mesh = meshOf(world, what.body);
  const std::string object =
      mesh && hit.object != kEveryObject ? mesh->objectNames()[slotOf(hit.object)] : "";
  if (what.body == kStillScene) return fmt::format("{} of the scene", object);
  const std::string& body = world.nameOf(what.body);
  const std::string link = world.linkNameOf(what.body, what.link);
  if (!link.empty()) return fmt::format("{} of {}", link, body);
  return object.empty() || object == body ? body : fmt::format("{} of {}", object, body);
}

const char* reasonOf(AskUnknown why) {
  switch (why) {
    case AskUnknown::Assumed: return "silent, and taken to hold still";
    case AskUnknown::Silent: return "silent: nothing is known after its last pose";
    case AskUnknown::Unresolved: return "not resolved";
    case AskUnknown::Open: return "not closed, so it has no inside";
    case AskUnknown::NotThere: break;
  }
  return "not there yet";
}

void writeHit(const LoadedWorld& world, const WorldHit& hit, JsonWriter& out) {
  out.field("distance", hit.distance);
  out.key("of");
  writeContactSide(world, hit.what, true, out);
  out.field("normal", hit.nhat_W);
  if (hit.what.triangle >= 0) {
    out.field("weights", Eigen::Vector3d(hit.weights[0], hit.weights[1], hit.weights[2]));
  }
  if (hit.isAssumed) out.field("assumed", true);
}

}  // namespace

const char* toString(AskVerdict verdict) {
  if (verdict == AskVerdict::Hit) return "hit";
  return verdict == AskVerdict::Clear ? "clear" : "unknown";
}

std::string answerText(const LoadedWorld& world, const WorldQuestion& question,
                       const WorldAnswer& answer) {
  std::string text = fmt::format("at {:g} s: {}\n", LoadedWorld::secondsOf(question.time),
                                 toString(answer.verdict()));
  for (const WorldHit& hit : answer.hits) {
    text += fmt::format("  {:.4f} m: {}, at {}, normal {}{}\n", hit.distance, nameOf(world, hit),
                        said(hit.what.p_W), said(hit.nhat_W), hit.isAssumed ? ", assumed" : "");
  }
  for (const UnknownBody& body : answer.unknown) {
    text += fmt::format("  unknown: {} is {}\n", world.nameOf(body.body), reasonOf(body.why));
  }
  return text;
}

std::string answerLine(const LoadedWorld& world, const WorldQuestion& question,
                       const WorldAnswer& answer) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  writeInstant("time", question.time, out);
  out.field("verdict", toString(answer.verdict()));
  writeObjects("hits", answer.hits, out, [&](const WorldHit& hit) { writeHit(world, hit, out); });
  writeObjects("unknown", answer.unknown, out, [&](const UnknownBody& body) {
    out.field("body", world.nameOf(body.body));
    out.field("why", reasonOf(body.why));
  });
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
