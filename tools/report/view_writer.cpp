#include "tools/report/view_writer.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "tools/contact_json.h"
#include "tools/json_text.h"
#include "tools/report/base64.h"

namespace foretouch::tools {
namespace {

#if defined(__BYTE_ORDER__)
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "typed arrays are written as they lie");
#endif

const char* toString(ViewKind kind) {
  switch (kind) {
    case ViewKind::Replay: return "replay";
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

std::string vectorText(const Eigen::Vector3d& v) {
  return fmt::format("[{},{},{}]", numberText(v.x()), numberText(v.y()), numberText(v.z()));
}

/// Puts the commas, and hands the text on by the piece.
class Writer {
 public:
  explicit Writer(const TextSink& sink) : sink_(sink) {}
  void finish() { handOn(); }

  void open(char bracket) {
    separate();
    text_ += bracket;
    isFirst_ = true;
  }
  void close(char bracket) {
    text_ += bracket;
    isFirst_ = false;
  }
  void key(const char* name) {
    separate();
    text_ += '"';
    text_ += name;
    text_ += "\":";
    isFirst_ = true;  // no comma between a key and its value
  }
  /// JSON already.
  void raw(const std::string& json) {
    separate();
    text_ += json;
    if (text_.size() > kPieceBytes) handOn();
  }
  void field(const char* name, const std::string& json) {
    key(name);
    raw(json);
  }

  template <typename Number>
  void array(const char* name, const std::vector<Number>& numbers) {
    key(name);
    open('{');
    key(nameOf(Number{}));
    separate();
    text_ += '"';
    const auto* const bytes = reinterpret_cast<const unsigned char*>(numbers.data());
    const std::size_t size = numbers.size() * sizeof(Number);
    for (std::size_t at = 0; at < size; at += kPieceBytes) {
      appendBase64(bytes + at, std::min(kPieceBytes, size - at), text_);
      handOn();
    }
    text_ += '"';
    close('}');
  }

 private:
  /// A multiple of three, as appendBase64() wants pieces to be.
  static constexpr std::size_t kPieceBytes = 3 << 14;

  void separate() {
    if (!isFirst_) text_ += ',';
    isFirst_ = false;
  }
  void handOn() {
    sink_(text_);
    text_.clear();
  }

  const TextSink& sink_;
  std::string text_;
  bool isFirst_ = true;
};

void writeRows(Writer& out, const char* name, const std::vector<ViewRow>& rows) {
  out.key(name);
  out.open('[');
  for (const ViewRow& row : rows) {
    out.open('{');
    out.field("name", viewString(row.name));
    out.field("value", viewString(row.value));
    if (!row.note.empty()) out.field("note", viewString(row.note));
    out.close('}');
  }
  out.close(']');
}

void writeMesh(Writer& out, const ViewMesh& mesh) {
  out.array("positions", mesh.positions);
  out.array("indices", mesh.indices);
}

void writeScene(Writer& out, const ViewScene& scene) {
  out.key("scene");
  out.open('{');
  out.field("name", viewString(scene.name));
  out.field("origin", vectorText(scene.origin));
  writeMesh(out, scene.mesh);
  if (scene.reduction != SceneReduction::Simplified) {
    out.array("triangle_ids", scene.triangleIds);
  }
  out.key("objects");
  out.open('[');
  for (const ViewObject& object : scene.objects) {
    out.raw(fmt::format(R"({{"name":{},"first":{},"count":{}}})", viewString(object.name),
                        object.first, object.count));
  }
  out.close(']');
  out.field("triangles_in_file", std::to_string(scene.trianglesInFile));
  out.field("reduction", fmt::format("\"{}\"", toString(scene.reduction)));
  out.field("bounds", fmt::format(R"({{"min":{},"max":{}}})", vectorText(scene.boundsMin),
                                  vectorText(scene.boundsMax)));
  out.close('}');
}

void writeLinks(Writer& out, const Avatar& avatar) {
  const Skeleton& skeleton = avatar.skeleton();
  out.key("links");
  out.open('[');
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    out.raw(fmt::format(R"({{"name":{},"parent":{}}})", viewString(skeleton.name(link)),
                        skeleton.parent(link)));
  }
  out.close(']');
  out.key("lss");
  out.open('[');
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) {
      out.raw(fmt::format(R"({{"link":{},"a":{},"b":{},"radius":{}}})", link, vectorText(lss.a),
                          vectorText(lss.b), numberText(lss.radius)));
    }
  }
  out.close(']');
}

void writeTrack(Writer& out, const ViewTrack& track) {
  out.key("track");
  out.open('{');
  out.array("pose_times", track.poseTimesS);
  out.array("rotations", track.rotations);
  out.key("translations");
  out.open('{');
  out.array("offsets", track.offsets);
  out.key("moving");
  out.open('[');
  for (const LinkId link : track.moving) out.raw(std::to_string(link));
  out.close(']');
  out.array("values", track.values);
  out.close('}');
  out.key("steps");
  out.open('{');
  out.array("from", track.stepFrom);
  out.array("to", track.stepTo);
  out.close('}');
  if (!track.latencyUs.empty()) out.array("latency_us", track.latencyUs);
  if (!track.touchingFirst.empty()) {
    out.key("touching_at_poses");
    out.open('{');
    out.array("first", track.touchingFirst);
    out.array("links", track.touching);
    out.close('}');
  }
  out.close('}');
}

/// The text of a results file, with the step before it and what the poses show after it.
std::string contactText(const ViewContact& found) {
  const bool isDecided = found.contact.verdict != Verdict::Undecided;
  const std::string link = std::to_string(found.contact.link);
  const std::string object = isDecided ? viewString(found.object) : "";
  const std::string instant = isDecided ? "\"time\":" + numberText(found.timeS) : "";
  std::string text;
  appendContact(found.contact, {link, object, found.reason, instant}, text);
  text.replace(0, 1, fmt::format("{{\"step\":{},", found.step));
  if (found.contact.verdict == Verdict::Contact) {
    text.pop_back();
    text += found.missedByPoses ? ",\"missed_by_poses\":true}" : ",\"missed_by_poses\":false}";
  }
  return text;
}

void writeSwept(Writer& out, const ViewSwept& swept) {
  out.open('{');
  out.field("step", std::to_string(swept.step));
  out.field("link", std::to_string(swept.link));
  out.field("origin", vectorText(swept.origin));
  writeMesh(out, swept.mesh);
  out.field("error", numberText(swept.error));
  out.close('}');
}

void writeAvatar(Writer& out, const ViewAvatar& avatar) {
  out.open('{');
  out.field("id", std::to_string(avatar.id));
  out.field("name", viewString(avatar.name));
  writeLinks(out, *avatar.avatar);
  if (!avatar.meshes.empty()) {
    out.key("meshes");
    out.open('[');
    for (const ViewLinkMesh& part : avatar.meshes) {
      out.open('{');
      out.field("link", std::to_string(part.link));
      writeMesh(out, part.mesh);
      out.close('}');
    }
    out.close(']');
  }
  if (avatar.track) writeTrack(out, *avatar.track);
  out.key("contacts");
  out.open('[');
  for (const ViewContact& contact : avatar.contacts) out.raw(contactText(contact));
  out.close(']');
  out.key("swept");
  out.open('[');
  for (const ViewSwept& swept : avatar.swept) writeSwept(out, swept);
  out.close(']');
  out.close('}');
}

}  // namespace

std::string viewString(const std::string& text) {
  std::string json = jsonString(text);
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at)) {
    json.replace(at, 1, "\\u003c");
  }
  return json;
}

void writeView(const ViewDocument& document, const TextSink& sink) {
  Writer out(sink);
  out.open('{');
  out.field("format", "\"foretouch-view\"");
  out.field("version", "1");
  out.field("tool", "\"foretouch " FORETOUCH_VERSION "\"");
  out.field("kind", fmt::format("\"{}\"", toString(document.kind)));
  out.field("title", viewString(document.title));
  writeRows(out, "settings", document.settings);
  writeRows(out, "summary", document.summary);
  out.key("notes");
  out.open('[');
  for (const std::string& note : document.notes) out.raw(viewString(note));
  out.close(']');
  if (document.scene) writeScene(out, *document.scene);
  out.key("avatars");
  out.open('[');
  for (const ViewAvatar& avatar : document.avatars) writeAvatar(out, avatar);
  out.close(']');
  if (document.kind == ViewKind::Live) out.field("live", R"({"events":"/events"})");
  out.close('}');
  out.finish();
}

}  // namespace foretouch::tools
