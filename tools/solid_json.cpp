#include "tools/solid_json.h"

#include <cmath>

#include "network/wire/message_fields.h"
#include "tools/fields_json.h"
#include "tools/json_line.h"

namespace foretouch::tools {
namespace {

/// The shortest text that reads back as the same bits: readers of JSON take "-0" for a whole 0.
void writeBits(double x, JsonWriter& out) {
  x == 0.0 && std::signbit(x) ? out.raw("-0.0") : out.value(x);
}

}  // namespace

void writePose(const Pose& pose, JsonWriter& out) {
  out.list("rotations", pose.rotations, [&](const Quaternion& q) {
    out.beginArray();
    for (const double x : {q.w(), q.x(), q.y(), q.z()}) writeBits(x, out);
    out.endArray();
  });
  out.list("translations", pose.translations, [&](const Eigen::Vector3d& p) {
    out.beginArray();
    for (const double x : p) writeBits(x, out);
    out.endArray();
  });
}

void writeCounters(const SolidCounters& counters, JsonWriter& out) {
  writeObject("counters", out,
              [&] { writeFields(counters, out, wire::solidCounters(wire::Self{})); });
}

void writeSolidContact(const SolidContact& contact, std::string_view link, std::string_view touched,
                       JsonWriter& out) {
  out.rawField("link", link);
  out.field("lss", contact.lss);
  out.rawField(contact.triangle >= 0 ? "object" : "other", touched);
  writeFields(contact, out, wire::pushFields<solid_t, SolidContact>(wire::Self{}));
}

}  // namespace foretouch::tools
