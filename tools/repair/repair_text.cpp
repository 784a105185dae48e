#include "tools/repair/repair_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/feet/feet_text.h"
#include "tools/repair/reasons.h"

namespace foretouch::tools {
namespace {

constexpr double kMm = 1e3, kDegrees = 180.0 / 3.14159265358979323846;
/// Joints in the table for people.
constexpr std::size_t kMostJoints = 12;
/// Lines about what is not mended; JSON has all.
constexpr std::size_t kMostLines = 40;

constexpr std::array kKinds{FaultKind::Scene, FaultKind::Own, FaultKind::Under, FaultKind::Slide,
                            FaultKind::Limit};

std::string countsText(const Faults& faults) {
  std::string text =
      fmt::format("{} of {} intervals at fault", faults.faulty, faults.isFaulty.size());
  for (const FaultKind kind : kKinds) {
    if (const auto count = faults.countOf(kind); count > 0) {
      text += fmt::format("{} {} {}", text.find(':') == std::string::npos ? ":" : ",", count,
                          toString(kind));
    }
  }
  return text;
}

std::string spreadText(const Spread& spread, double unit) {
  return fmt::format("mean {:.2f}, p99 {:.2f}, most {:.2f}", unit * spread.mean, unit * spread.p99,
                     unit * spread.most);
}

std::string jerkText(const Jerk& jerk) {
  return fmt::format("{:.2f} before, {:.2f} after ({:+.1f} %)", jerk.before, jerk.after,
                     100.0 * jerk.added());
}

std::string movedText(const RepairStage& stage, const Measures& measures) {
  if (measures.joints.empty()) return "nothing was changed\n";
  std::string text = fmt::format(
      "changed: {} of {} poses\n"
      "  joints moved, mm:          {}; at the poses that changed: {}\n"
      "  joints turned, degrees:    {}; at the poses that changed: {}\n"
      "  mean jerk, m/s^3:          {}; at the poses that changed: {}\n",
      measures.changedPoses, stage.numPoses(), spreadText(measures.move, kMm),
      spreadText(measures.moveChanged, kMm), spreadText(measures.turn, kDegrees),
      spreadText(measures.turnChanged, kDegrees), jerkText(measures.jerk),
      jerkText(measures.jerkChanged));
  text += fmt::format("{:<22} {:>32} {:>32} {:>7}\n", "what moved most", "mm: mean   p99  most",
                      "degrees: mean   p99  most", "frame");
  for (std::size_t i = 0; i < std::min(kMostJoints, measures.joints.size()); ++i) {
    const JointMoved& of = measures.joints[i];
    text +=
        fmt::format("{:<22} {:>20.2f} {:>5.1f} {:>5.1f} {:>20.2f} {:>5.2f} {:>5.2f} {:>7}\n",
                    stage.body().skeleton().name(of.joint), kMm * of.move.mean, kMm * of.move.p99,
                    kMm * of.move.most, kDegrees * of.turn.mean, kDegrees * of.turn.p99,
                    kDegrees * of.turn.most, stage.frameOf(of.worstPose));
  }
  return text;
}

std::string byText(const RepairStage& stage, const Unmended& fault) {
  if (!(fault.by > 0.0)) return "";
  const bool isTurn =
      fault.kind == FaultKind::Limit && stage.knobs()[slotOf(fault.link)].drives.front().turns;
  return isTurn ? fmt::format(" by {:.3f} degrees", kDegrees * fault.by)
                : fmt::format(" by {:.2f} mm", kMm * fault.by);
}

std::string unmendedText(const RepairStage& stage, const Repair& repair) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kMostLines, repair.unmended.size()); ++i) {
    const Unmended& fault = repair.unmended[i];
    text += fmt::format("not mended: frames {} to {}: {}{}: {}\n", stage.frameOf(fault.first),
                        stage.frameOf(fault.last),
                        faultText(stage, fault.kind, fault.link, fault.other, fault.object),
                        byText(stage, fault), fault.reason);
  }
  if (repair.unmended.size() > kMostLines) {
    text += fmt::format("and {} more that are not mended: --json has all\n",
                        repair.unmended.size() - kMostLines);
  }
  for (const BearingStance& stance : repair.meant) {
    const FeetInputs& inputs = stage.feet();
    text += fmt::format("left as it is: frames {} to {}: {} moves {:.0f} mm while it touches\n",
                        stance.fromFrame, stance.toFrame,
                        inputs.body.nameOf(inputs.body.parts[stance.part]), kMm * stance.moved);
  }
  return text;
}

void writeFaults(const RepairStage& stage, const Faults& faults, JsonWriter& out) {
  out.beginObject();
  out.field("intervals", faults.isFaulty.size());
  out.field("faulty", faults.faulty);
  for (const FaultKind kind : kKinds) {
    std::string name = toString(kind);
    std::replace(name.begin(), name.end(), ' ', '_');
    out.field(name, faults.countOf(kind));
  }
  out.key("runs");  // runs of frames between which each interval is at fault
  out.beginArray();
  for (std::size_t i = 0; i < faults.isFaulty.size();) {
    std::size_t end = i;
    while (end < faults.isFaulty.size() && faults.isFaulty[end] != 0) ++end;
    if (end > i) {
      out.beginArray();
      out.value(stage.frameOf(static_cast<std::int64_t>(i)));
      out.value(stage.frameOf(static_cast<std::int64_t>(end)));
      out.endArray();
    }
    i = end + 1;
  }
  out.endArray();
  out.endObject();
}

void writeSpread(const char* name, const Spread& spread, double unit, JsonWriter& out) {
  out.key(name);
  out.beginObject();
  out.key("mean");
  out.fixed(unit * spread.mean, 4);
  out.key("p99");
  out.fixed(unit * spread.p99, 4);
  out.key("most");
  out.fixed(unit * spread.most, 4);
  out.endObject();
}

void writeJerk(const std::string& where, const Jerk& jerk, JsonWriter& out) {
  out.key("jerk_before" + where);
  out.fixed(jerk.before, 4);
  out.key("jerk_after" + where);
  out.fixed(jerk.after, 4);
}

void writeMeasures(const RepairStage& stage, const Measures& measures, JsonWriter& out) {
  out.field("poses", stage.numPoses());
  out.field("changed_poses", measures.changedPoses);
  writeSpread("moved_mm", measures.move, kMm, out);
  writeSpread("turned_deg", measures.turn, kDegrees, out);
  writeSpread("moved_mm_where_changed", measures.moveChanged, kMm, out);
  writeSpread("turned_deg_where_changed", measures.turnChanged, kDegrees, out);
  writeJerk("", measures.jerk, out);
  writeJerk("_where_changed", measures.jerkChanged, out);
  out.list("joints", measures.joints, [&](const JointMoved& of) {
    out.beginObject();
    out.field("joint", stage.body().skeleton().name(of.joint));
    writeSpread("moved_mm", of.move, kMm, out);
    writeSpread("turned_deg", of.turn, kDegrees, out);
    out.field("worst_frame", stage.frameOf(of.worstPose));
    out.endObject();
  });
}

}  // namespace

std::string repairText(const RepairStage& stage, const Repair& repair) {
  const std::string& clip = stage.request().motionPath;
  std::string text = fmt::format("{}: {} poses at {:.4g} Hz\nbefore: {}\n", clip, stage.numPoses(),
                                 1.0 / stage.feet().stepS(), countsText(repair.before));
  if (repair.after.faulty == 0) {
    text += fmt::format("after:  every interval of {} is proven free ({} rounds)\n",
                        repair.after.isFaulty.size(), repair.rounds);
  } else {
    text += fmt::format("after:  {}; all others are proven free ({} rounds)\n",
                        countsText(repair.after), repair.rounds);
  }
  return text + movedText(stage, repair.measures) + unmendedText(stage, repair);
}

std::string repairJson(const RepairStage& stage, const Repair& repair) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("motion", stage.request().motionPath);
  out.field("scene", stage.request().scenePath);
  out.field("gap", stage.request().gap);
  out.field("rounds", repair.rounds);
  writeFit(stage.feet(), out);
  out.key("before");
  writeFaults(stage, repair.before, out);
  out.key("after");
  writeFaults(stage, repair.after, out);
  writeMeasures(stage, repair.measures, out);
  out.list("not_mended", repair.unmended, [&](const Unmended& fault) {
    out.beginObject();
    out.field("what", faultText(stage, fault.kind, fault.link, fault.other, fault.object));
    out.field("from_frame", stage.frameOf(fault.first));
    out.field("to_frame", stage.frameOf(fault.last));
    out.key("by");
    out.fixed(fault.by, 6);
    out.field("reason", fault.reason);
    out.endObject();
  });
  out.list("meant", repair.meant, [&](const BearingStance& stance) {
    const FeetInputs& inputs = stage.feet();
    out.beginObject();
    out.field("part", inputs.body.nameOf(inputs.body.parts[stance.part]));
    out.field("from_frame", stance.fromFrame);
    out.field("to_frame", stance.toFrame);
    out.key("moved_mm");
    out.fixed(kMm * stance.moved, 2);
    out.endObject();
  });
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
