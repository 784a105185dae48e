#include "tools/replay/summary_json.h"

#include "assets/json_writer.h"
#include "tools/json_line.h"

namespace foretouch::tools {
namespace {

void writeCounts(const ReplaySummary::Counts& counts, JsonWriter& out) {
  out.field("contacts", counts.contacts);
  out.field("starts_in_contact", counts.startsInContact);
  out.field("undecided", counts.undecided);
}

void writeCounts(const char* name, const ReplaySummary::Counts& counts, JsonWriter& out) {
  writeObject(name, out, [&] { writeCounts(counts, out); });
}

/// Writes the links that met something.
void writeByLink(const ReplaySummary& summary, JsonWriter& out) {
  const Avatar& avatar = summary.inputs().avatar;
  out.key("by_link");
  out.beginArray();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const ReplaySummary::Counts& counts = summary.ofLink(link);
    if (counts.contacts + counts.startsInContact + counts.undecided == 0) continue;
    out.beginObject();
    out.field("link", avatar.skeleton().name(link));
    writeCounts(counts, out);
    out.field("missed_by_poses", counts.missedByPoses);
    out.endObject();
  }
  out.endArray();
}

void writeLatency(const ReplaySummary& summary, JsonWriter& out) {
  writeObject("latency_us", out, [&] {
    out.field("p50", summary.latencyUs(0.5));
    out.field("p90", summary.latencyUs(0.9));
    out.field("p99", summary.latencyUs(0.99));
    out.field("max", summary.latencyUs(1.0));
  });
}

}  // namespace

std::string summaryLine(const ReplaySummary& summary, int threads, const std::string& output,
                        const std::string& report) {
  const ReplayInputs& inputs = summary.inputs();
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("motion", inputs.request.motionPath);
  out.field("scene", inputs.request.scenePath);
  out.field("rate", rateTaken(inputs.steps, inputs.clip.frameTimeS));
  out.field("steps", summary.steps());
  out.field("steps_with_contact", summary.stepsWithContact());
  out.field("touches", summary.touches().touches);
  out.field("touches_missed", summary.touches().missed);
  out.field("touches_ground", summary.touches().ground);
  writeCounts(summary.total(), out);
  out.field("missed_by_poses", summary.total().missedByPoses);
  writeByLink(summary, out);
  if (inputs.query.scope == Scope::EveryObject) {
    writeCounts("by_object", summary.totalOfObjects(), out);
  }
  if (inputs.query.self) writeCounts("own_links", summary.totalOfPairs(), out);
  writeLatency(summary, out);
  out.field("threads", threads);
  out.field("output", output);
  if (!report.empty()) out.field("report", report);
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
