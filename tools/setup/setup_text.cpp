#include <fmt/format.h>

#include "tools/settings/frame_settings.h"
#include "tools/setup/setup.h"

namespace foretouch::tools {
namespace {

template <typename Value>
void writeFinding(const char* name, const Finding<Value>& finding, const std::string& value,
                  JsonWriter& out) {
  out.key(name);
  out.beginObject();
  out.rawField("value", value);
  out.field("sure", finding.offer.isSure);
  out.field("said_by", finding.isSaidByFile ? "file" : finding.isSaidByUser ? "user" : "setup");
  out.field("reason", finding.offer.reason);
  out.endObject();
}

void writeFrame(const char* name, const std::string& file, const Finding<double>& scale,
                const Finding<UpAxis>& up, JsonWriter& out) {
  out.key(name);
  out.beginObject();
  out.field("file", file);
  writeFinding("scale", scale, numberText(scale.offer.value), out);
  writeFinding("up", up, jsonString(wordOf(up.offer.value)), out);
  out.endObject();
}

}  // namespace

std::string describe(const Setup& setup) {
  return describe(setup.checks) + fmt::format("  {:<6}{:<14}{}\n", "", "place",
                                              setup.isPlaceFound || setup.request.place
                                                  ? "--place " + textOf(setup.place)
                                                  : "none found: --place " + textOf(setup.place));
}

void writeSetup(const Setup& setup, JsonWriter& out) {
  const BodyRequest& body = setup.request.body;
  writeFrame("scene", setup.request.scene, setup.sceneScale, setup.sceneUp, out);
  writeFrame("body", body.motionPath.empty() ? body.avatarPath : body.motionPath, setup.bodyScale,
             setup.bodyUp, out);
  const Placement& place = setup.place;
  out.key("place");
  out.beginArray();
  for (const double value : {place.origin.x(), place.origin.y(), place.origin.z(), place.yawDeg}) {
    out.value(value);
  }
  out.endArray();
  out.field("place_found", setup.isPlaceFound);
  out.key("checks");
  writeChecks(setup.checks, out);
  out.field("notes", setup.notes);
}

}  // namespace foretouch::tools
