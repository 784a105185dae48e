#include "tools/world/world_results.h"

#include "lss/index.h"
#include "tools/contact_json.h"
#include "tools/json_line.h"
#include "tools/replay/results_writer.h"
#include "tools/touches/touch_json.h"

namespace foretouch::tools {
namespace {

void writeBody(const LoadedWorld& world, BodyId id, JsonWriter& out) {
  const FileBody& file = world.file.bodies[slotOf(id)];
  const LoadedBody& body = world.bodies[slotOf(id)];
  out.beginObject();
  out.field("name", file.name);
  out.field("made_of", madeOf(file.shape));
  if (file.fidelity == Fidelity::Exact) out.field("fidelity", toString(file.fidelity));
  if (const std::string path = fileOf(file.shape); !path.empty()) {
    writeFileName("file", path, out);
  }
  if (!file.clip.motionPath.empty()) writeFileName("motion", file.clip.motionPath, out);
  if (!file.posesPath.empty()) writeFileName("motion", file.posesPath, out);
  if (!file.group.empty()) out.field("group", file.group);
  if (file.massKg) out.field("mass", *file.massKg);
  out.field("when_silent", toString(file.whenSilent));
  out.field("poses", body.numPoses);
  if (!file.shape.avatarPath.empty()) writeLinkNames(*body.shape.avatar, out);
  if (body.self) writeSelf(*body.self, body.shape.skeleton, file.pairsPath, out);
  out.endObject();
}

void writeAsks(const LoadedWorld& world, JsonWriter& out) {
  writeObjects("asks", world.file.asks, out, [&](const FileAsk& ask) {
    out.field("group", ask.group);
    out.field("with", ask.with.empty() ? "scene" : ask.with.c_str());
    out.field("asked", ask.isAsked);
  });
}

}  // namespace

void writeSide(const LoadedWorld& world, const NamedSide& side, JsonWriter& out) {
  if (side.body == kStillScene) return;
  out.field("body", world.nameOf(side.body));
  if (side.link == kEveryLink) return;
  const std::string link = world.linkNameOf(side.body, side.link);
  if (!link.empty()) out.field("link", link);
}

void writeInstant(const char* name, const WorldTime& time, JsonWriter& out) {
  out.field(name, LoadedWorld::secondsOf(time));
  out.field("utime", time.us);
  out.field("fraction", time.fraction);
}

void writeInstantObject(const char* name, const WorldTime& time, JsonWriter& out) {
  writeObject(name, out, [&] { writeInstant("time", time, out); });
}

void writeContactSide(const LoadedWorld& world, const ContactSide& side, bool isTold,
                      JsonWriter& out) {
  out.beginObject();
  writeSide(world, {side.body, side.link}, out);
  if (isTold) {
    if (side.lss >= 0) out.field("lss", side.lss);
    if (side.triangle >= 0) {
      out.field("triangle", side.triangle);
      const std::optional<Scene>& mesh = meshOf(world, side.body);
      if (mesh) out.field("object", mesh->objectNames()[slotOf(mesh->object(side.triangle))]);
    }
    out.field("point", side.p_W);
  }
  out.endObject();
}

const std::optional<Scene>& meshOf(const LoadedWorld& world, BodyId body) {
  return body == kStillScene ? world.scene : world.bodies[slotOf(body)].shape.mesh;
}

void writeWorldFields(const LoadedWorld& world, JsonWriter& out) {
  writeFileName("world", world.file.path, out);
  if (world.scene) {
    WorldRequest scene = world.file.scene;
    Settings settings;
    addSceneSettings(settings, scene);
    writeHeaderFields(settings, {"scene", "scene_scale", "up"}, out);
  }
  out.field("tolerance", world.file.tolerance);
}

void writeBodies(const LoadedWorld& world, JsonWriter& out) {
  out.key("bodies");
  out.beginArray();
  for (std::size_t body = 0; body < world.numBodies(); ++body) {
    writeBody(world, static_cast<BodyId>(body), out);
  }
  out.endArray();
  writeAsks(world, out);
}

std::string worldHeader(const LoadedWorld& world, const WindowRequest& request,
                        const std::vector<std::int64_t>& cuts) {
  std::string text;
  JsonWriter out(text);
  beginResults(out, "foretouch-world-results");
  writeWorldFields(world, out);
  if (world.file.askMeshes) out.field("ask_meshes", true);
  out.key("rate");
  request.rateHz ? out.value(*request.rateHz) : out.null();
  out.field("from", LoadedWorld::secondsOf(cuts.front()));
  out.field("until", LoadedWorld::secondsOf(cuts.back()));
  out.field("windows", cuts.size() - 1);
  writeBodies(world, out);
  out.endObject();
  return text + "\n";
}

void writeWorldContact(const LoadedWorld& world, const WorldContact& contact, JsonWriter& out) {
  const bool isTold = contact.verdict != Verdict::Undecided;
  out.beginObject();
  out.key("a");
  writeContactSide(world, contact.a, isTold, out);
  out.key("b");
  writeContactSide(world, contact.b, isTold, out);
  out.field("verdict", toString(contact.verdict));
  writeInstant(isTold ? "time" : "free_until", contact.time, out);
  if (isTold) {
    out.field("separation", contact.separation);
    if (contact.verdict == Verdict::StartsInContact) writePenetration(contact.penetration, out);
    out.field("normal", contact.nhat_BA_W);
  } else {
    out.field("reason", toString(contact.reason));
  }
  if (contact.isAssumed) out.field("assumed", true);
  out.endObject();
}

std::string windowLine(const LoadedWorld& world, const WorldStep& step) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("window", step.window);
  out.field("t0", LoadedWorld::secondsOf(step.fromUs));
  out.field("t1", LoadedWorld::secondsOf(step.toUs));
  out.list("contacts", step.answer.contacts,
           [&](const WorldContact& contact) { writeWorldContact(world, contact, out); });
  if (!step.answer.silent.empty()) {
    writeObjects("silent", step.answer.silent, out, [&](const SilentBody& silent) {
      out.field("body", world.nameOf(silent.body));
      out.field("since", LoadedWorld::secondsOf(silent.sinceUs));
      out.field("taken_to", toString(silent.takenTo));
    });
  }
  out.key("latency_us");
  out.fixed(step.latencyUs, 1);
  out.endObject();
  return text + "\n";
}

void writeWorldTouch(const LoadedWorld& world, const TouchSides& sides, const WorldTouch& touch,
                     JsonWriter& out) {
  writeObject("a", out, [&] { writeSide(world, {sides.a, sides.linkOfA}, out); });
  writeObject("b", out, [&] {
    writeSide(world, {sides.b, sides.linkOfB}, out);
    if (sides.b == kStillScene) out.field("object", touch.object);
  });
  writeTouchCourse(touch, "windows", out);
  if (touch.strength) writeForce(*touch.strength, out);
}

std::string touchLines(const LoadedWorld& world, const WorldTouches& touches,
                       std::int64_t windows) {
  std::string text;
  for (const WorldTouch& touch : touches.listed()) {
    text += objectLine("touch", [&](JsonWriter& out) {
      writeWorldTouch(world, touches.sidesOf(touch), touch, out);
    });
  }
  const WorldTouchCounts& counts = touches.counts();
  return text + objectLine("summary", [&](JsonWriter& out) {
           out.field("windows", windows);
           out.field("touches_bodies", counts.bodies);
           out.field("touches_scene", counts.scene);
           out.field("touches_own", counts.own);
           out.field("touches_missed", counts.missed);
         });
}

}  // namespace foretouch::tools
