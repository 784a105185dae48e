#include "tools/report/view_writer.h"

#include <algorithm>
#include <cstring>

#include "assets/json_writer.h"
#include "tools/contact_json.h"
#include "tools/report/base64.h"
#include "tools/touches/touch_json.h"

namespace foretouch::tools {
namespace {

#if defined(__BYTE_ORDER__)
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "typed arrays are written as they lie");
#endif

const char* toString(ViewKind kind) {
  switch (kind) {
    case ViewKind::Replay: return "replay";
    case ViewKind::World: return "world";
    case ViewKind::Log: return "log";
    case ViewKind::Inspection: return "inspection";
    case ViewKind::Live: return "live";
  }
  return "";
}

const char* toString(SceneReduction reduction) {
  switch (reduction) {
    case SceneReduction::None: return "none";
    case SceneReduction::Clipped: return "clipped";
    case SceneReduction::Simplified: return "simplified";
  }
  return "";
}

constexpr const char* nameOf(double) {
  return "f64";
}
constexpr const char* nameOf(float) {
  return "f32";
}
constexpr const char* nameOf(std::uint32_t) {
  return "u32";
}
constexpr const char* nameOf(std::uint16_t) {
  return "u16";
}

/// Passes the text on in pieces.
class Writer : public JsonWriter {
 public:
  Writer(const TextSink& sink, std::string& text)
      : JsonWriter(text, JsonPlace::Page), sink_(sink), text_(text) {}

  void handOn() {
    sink_(text_);
    text_.clear();
  }
  void handOnPieces() {
    if (text_.size() > kPieceBytes) handOn();
  }

  template <typename Number>
  void array(const char* name, const std::vector<Number>& numbers) {
    key(name);
    beginObject();
    key(nameOf(Number{}));
    raw("\"");
    const auto* const bytes = reinterpret_cast<const unsigned char*>(numbers.data());
    const std::size_t size = numbers.size() * sizeof(Number);
    for (std::size_t at = 0; at < size; at += kPieceBytes) {
      appendBase64(bytes + at, std::min(kPieceBytes, size - at), text_);
      handOn();
    }
    text_ += '"';
    endObject();
  }

 private:
  /// A multiple of three, as appendBase64() requires.
  static constexpr std::size_t kPieceBytes = 3 << 14;

  const TextSink& sink_;
  std::string& text_;
};

void writeRows(Writer& out, const char* name, const std::vector<ViewRow>& rows) {
  out.list(name, rows, [&](const ViewRow& row) {
    out.beginObject();
    out.field("name", row.name);
    out.field("value", row.value);
    if (!row.note.empty()) out.field("note", row.note);
    out.endObject();
    out.handOnPieces();
  });
}

void writeMesh(Writer& out, const ViewMesh& mesh) {
  out.array("positions", mesh.positions);
  out.array("indices", mesh.indices);
}

void writeScene(Writer& out, const ViewScene& scene) {
  out.key("scene");
  out.beginObject();
  out.field("name", scene.name);
  out.field("origin", scene.origin);
  writeMesh(out, scene.mesh);
  if (scene.reduction != SceneReduction::Simplified) {
    out.array("triangle_ids", scene.triangleIds);
  }
  out.list("objects", scene.objects, [&](const ViewObject& object) {
    out.beginObject();
    out.field("name", object.name);
    out.field("first", object.first);
    out.field("count", object.count);
    out.endObject();
    out.handOnPieces();
  });
  out.field("triangles_in_file", scene.trianglesInFile);
  out.field("reduction", toString(scene.reduction));
  out.key("bounds");
  out.beginObject();
  out.field("min", scene.boundsMin);
  out.field("max", scene.boundsMax);
  out.endObject();
  out.endObject();
}

void writeLss(Writer& out, LinkId link, const Lss& lss) {
  out.beginObject();
  out.field("link", link);
  out.field("a", lss.a);
  out.field("b", lss.b);
  out.field("radius", lss.radius);
  out.endObject();
  out.handOnPieces();
}

void writeLinks(Writer& out, const Avatar& avatar, bool hasLss) {
  const Skeleton& skeleton = avatar.skeleton();
  out.key("links");
  out.beginArray();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    out.beginObject();
    out.field("name", skeleton.name(link));
    out.field("parent", skeleton.parent(link));
    out.endObject();
    out.handOnPieces();
  }
  out.endArray();
  out.key("lss");
  out.beginArray();
  for (LinkId link = 0; hasLss && link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) writeLss(out, link, lss);
  }
  out.endArray();
}

void writeTrack(Writer& out, const char* name, const ViewTrack& track) {
  out.key(name);
  out.beginObject();
  out.array("pose_times", track.poseTimesS);
  out.array("rotations", track.rotations);
  out.key("translations");
  out.beginObject();
  out.array("offsets", track.offsets);
  out.list("moving", track.moving, [&](LinkId link) { out.value(link); });
  out.array("values", track.values);
  out.endObject();
  out.key("steps");
  out.beginObject();
  out.array("from", track.stepFrom);
  out.array("to", track.stepTo);
  out.endObject();
  if (!track.latencyUs.empty()) out.array("latency_us", track.latencyUs);
  if (!track.touchingFirst.empty()) {
    out.key("touching_at_poses");
    out.beginObject();
    out.array("first", track.touchingFirst);
    out.array("links", track.touching);
    out.endObject();
  }
  out.endObject();
}

void writeSolid(Writer& out, const ViewSolid& solid) {
  out.key("solid");
  out.beginObject();
  out.array("times", solid.timesS);
  out.array("states", solid.states);
  out.array("deviations", solid.deviations);
  out.endObject();
}

/// The fields of a results file, with the step before them and the touches at the poses after them.
void write(const ReportedContact& found, const ViewPush* push, bool knowsMissed, Writer& out) {
  const std::string link = std::to_string(found.contact.link);
  const std::string object = jsonString(found.object, JsonPlace::Page);
  ContactWords words;
  words.link = link;
  words.object = object;
  words.timeS = found.timeS;
  const bool isOwn = found.other >= 0;
  const std::string other = isOwn ? std::to_string(found.other) : "";
  words.other = other;
  out.beginObject();
  out.field("step", found.step);
  writeContact(found.contact, words, out);
  if (found.otherBody >= 0) out.field("other_avatar", found.otherBody);
  if (isOwn) out.field("object", found.object);
  if (push != nullptr) {
    out.field("push", push->push);
    out.field("slip", push->slipSpeed);
  } else if (knowsMissed && !isOwn && found.contact.verdict == Verdict::Contact) {
    out.field("missed_by_poses", found.missedByPoses);
  }
  out.endObject();
  out.handOnPieces();
}

void write(const ViewSwept& swept, Writer& out) {
  out.beginObject();
  out.field("step", swept.step);
  out.field("link", swept.link);
  out.field("origin", swept.origin);
  writeMesh(out, swept.mesh);
  out.field("error", swept.error);
  out.endObject();
}

void write(const ViewLinkMesh& part, Writer& out) {
  out.beginObject();
  out.field("link", part.link);
  writeMesh(out, part.mesh);
  out.endObject();
}

void write(const ViewCarried& carried, Writer& out) {
  out.beginObject();
  out.field("from", carried.fromS);
  if (carried.untilS) out.field("until", *carried.untilS);
  out.field("avatar", carried.avatar);
  out.field("link", carried.link);
  out.endObject();
}

void write(const ViewAvatar& avatar, Writer& out) {
  const auto writeOne = [&](const auto& item) { write(item, out); };
  out.beginObject();
  out.field("id", avatar.id);
  out.field("name", avatar.name);
  writeLinks(out, *avatar.avatar, avatar.hasLss);
  if (!avatar.meshes.empty()) out.list("meshes", avatar.meshes, writeOne);
  if (avatar.track) writeTrack(out, "track", *avatar.track);
  if (avatar.tracked) writeTrack(out, "tracked", *avatar.tracked);
  if (avatar.solid) writeSolid(out, *avatar.solid);
  if (avatar.isLiveSolid) out.field("is_solid", true);
  if (!avatar.outline.empty()) out.array("outline", avatar.outline);
  std::size_t contact = 0;
  out.list("contacts", avatar.contacts, [&](const ReportedContact& found) {
    const bool hasPush = contact < avatar.pushes.size();
    write(found, hasPush ? &avatar.pushes[contact] : nullptr, avatar.knowsMissed, out);
    ++contact;
  });
  out.list("swept", avatar.swept, writeOne);
  if (!avatar.carried.empty()) out.list("carried", avatar.carried, writeOne);
  out.endObject();
}

void write(const ViewTouch& shown, Writer& out) {
  const Touch& touch = shown.touch;
  const std::string link = std::to_string(touch.link);
  const std::string other = touch.other >= 0 ? std::to_string(touch.other) : "";
  const std::string object = jsonString(touch.object, JsonPlace::Page);
  TouchWords words;
  words.link = link;
  words.other = other;
  words.object = object;
  out.beginObject();
  if (shown.avatar > 0) out.field("avatar", shown.avatar);
  if (shown.otherAvatar) out.field("other_avatar", *shown.otherAvatar);
  writeTouch(touch, words, out);
  if (shown.strength) writeForce(*shown.strength, out);
  if (shown.unresolved != UndecidedReason::None) {
    out.field("unresolved", toString(shown.unresolved));
  }
  out.list("rows", shown.rows, [&](std::uint32_t row) { out.value(row); });
  out.endObject();
  out.handOnPieces();
}

void write(const ViewStay& stay, Writer& out) {
  out.beginObject();
  out.field("trigger", stay.trigger);
  out.field("avatar", stay.avatar);
  out.field("link", stay.link);
  out.field("begin", stay.beginS);
  out.field("end", stay.endS);
  out.field("begins", stay.beginsInside ? "inside" : "enter");
  out.field("ends", stay.isOpen ? "open" : "left");
  if (stay.isUnresolved) out.field("unresolved", true);
  out.endObject();
  out.handOnPieces();
}

void write(const ViewStance& stance, Writer& out) {
  out.beginObject();
  out.field("kind", stance.kind);
  out.field("begin", stance.beginS);
  out.field("end", stance.endS);
  if (stance.beganBefore) out.field("began_before", true);
  if (stance.goesOn) out.field("goes_on", true);
  if (!stance.slides.empty()) {
    out.field("slide", stance.slide);
    out.field("slides", stance.slides);
    out.field("depth", stance.depth);
    out.field("deepest", stance.deepest);
    out.field("depth_at", stance.depthAtS);
  } else {
    out.field("hover", stance.hover);
  }
  if (!stance.trace_W.empty()) {
    out.list("trace", stance.trace_W, [&](const Eigen::Vector3d& p_W) { out.value(p_W); });
  }
  out.endObject();
  out.handOnPieces();
}

void write(const ViewFoot& foot, Writer& out) {
  out.beginObject();
  out.field("link", foot.link);
  out.list("stances", foot.stances, [&](const ViewStance& stance) { write(stance, out); });
  out.endObject();
}

void write(const ViewPersonTouch& shown, Writer& out) {
  out.beginObject();
  if (shown.avatar > 0) out.field("avatar", shown.avatar);
  writeShownTouch(shown.touch, shown.object, out);
  out.endObject();
  out.handOnPieces();
}

void write(const ViewPerson& person, Writer& out) {
  out.beginObject();
  out.field("bounds", person.bounds);
  out.field("between", person.between);
  if (person.rateHz > 0.0) out.field("rate_hz", person.rateHz);
  out.list("touches", person.touches, [&](const ViewPersonTouch& touch) { write(touch, out); });
  out.endObject();
}

}  // namespace

void writeView(const ViewDocument& document, const TextSink& sink) {
  std::string text;
  Writer out(sink, text);
  out.beginObject();
  out.field("format", "foretouch-view");
  out.field("version", 1);
  out.field("tool", "foretouch " FORETOUCH_VERSION);
  out.field("kind", toString(document.kind));
  out.field("title", document.title);
  writeRows(out, "settings", document.settings);
  writeRows(out, "summary", document.summary);
  out.field("notes", document.notes);
  if (!document.checks.empty()) {
    out.key("checks");
    writeChecks(document.checks, out);
  }
  if (document.scene) writeScene(out, *document.scene);
  out.list("avatars", document.avatars, [&](const ViewAvatar& avatar) { write(avatar, out); });
  if (document.touches) {
    out.list("touches", *document.touches, [&](const ViewTouch& touch) { write(touch, out); });
  }
  if (!document.stays.empty()) {
    out.list("stays", document.stays, [&](const ViewStay& stay) { write(stay, out); });
  }
  if (document.frameTimeS > 0.0) out.field("frame_time", document.frameTimeS);
  if (!document.feet.empty()) {
    out.list("feet", document.feet, [&](const ViewFoot& foot) { write(foot, out); });
  }
  if (document.person) {
    out.key("person");
    write(*document.person, out);
  }
  if (document.kind == ViewKind::Live) {
    out.key("live");
    out.beginObject();
    out.field("events", "/events");
    out.endObject();
  }
  out.endObject();
  out.handOn();
}

}  // namespace foretouch::tools
