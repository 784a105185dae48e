#include "tools/feet/feet_labels.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "assets/json_writer.h"
#include "tools/csv_cell.h"
#include "tools/feet/npz_file.h"

namespace foretouch::tools {
namespace {

/// The parts' names and joints, in order.
struct PartNames {
  std::vector<std::string> joints, parts;

  explicit PartNames(const FeetInputs& inputs) {
    for (const RestingPart& part : inputs.body.parts) {
      joints.push_back(inputs.body.avatar.skeleton().name(part.joint));
      parts.emplace_back(toString(part.part));
    }
  }
};

/// Metres to surfaces; nothing above a void.
double distanceOf(const PartSample& sample) {
  return std::isfinite(sample.height) ? std::max(0.0F, sample.height) : sample.height;
}

std::string numberOrNone(double value, const char* none) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string(none);
}

/// Calls `row(step, its first sample)` for each pose.
template <typename Row>
void forEachPose(const FeetInputs& inputs, const FeetAnswer& answer, const Row& row) {
  for (std::int64_t step = 0; step <= inputs.steps(); ++step) {
    row(step, &answer.sample(step, 0, inputs.body.parts.size()));
  }
}

void writeCsv(const FeetInputs& inputs, const FeetAnswer& answer, const PartNames& names,
              const std::function<void(const std::string&)>& write) {
  write("frame,time_s,joint,part,contact,distance_m,depth_m,slide_mps,rule\n");
  std::vector<std::string> lead;
  for (std::size_t part = 0; part < names.parts.size(); ++part) {
    lead.push_back(csvCell(names.joints[part]) + "," + names.parts[part]);
  }
  forEachPose(inputs, answer, [&](std::int64_t step, const PartSample* samples) {
    std::string text;
    const std::string when =
        fmt::format("{},{:.6f},", inputs.played.steps.frameOf(step), inputs.timeOf(step));
    for (std::size_t part = 0; part < lead.size(); ++part) {
      const PartSample& sample = samples[part];
      text += fmt::format("{}{},{},{},{:.6g},{:.6g},{}\n", when, lead[part], sample.touches ? 1 : 0,
                          numberOrNone(distanceOf(sample), ""), sample.depth, sample.slide,
                          sample.byRule ? 1 : 0);
    }
    write(text);
  });
}

/// A field with one value per part.
template <typename Value>
void writeField(const char* name, std::size_t parts, JsonWriter& out, const Value& value) {
  out.key(name);
  out.beginArray();
  for (std::size_t part = 0; part < parts; ++part) out.raw(value(part));
  out.endArray();
}

std::string jsonHeader(const FeetInputs& inputs, const PartNames& names) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("format", "foretouch-feet-labels");
  out.field("version", 1);
  out.field("motion", inputs.request.motionPath);
  out.field("scene", inputs.request.scenePath);
  out.field("rate", 1.0 / inputs.stepS());
  out.field("tolerance", inputs.request.tolerance);
  out.field("joints", names.joints);
  out.field("parts", names.parts);
  out.endObject();
  return text + "\n";
}

void writeJsonLines(const FeetInputs& inputs, const FeetAnswer& answer, const PartNames& names,
                    const std::function<void(const std::string&)>& write) {
  write(jsonHeader(inputs, names));
  const std::size_t parts = names.parts.size();
  forEachPose(inputs, answer, [&](std::int64_t step, const PartSample* samples) {
    std::string text;
    JsonWriter out(text);
    out.beginObject();
    out.field("frame", inputs.played.steps.frameOf(step));
    out.field("time", inputs.timeOf(step));
    writeField("contact", parts, out, [&](auto p) { return samples[p].touches ? "1" : "0"; });
    writeField("distance", parts, out,
               [&](auto p) { return numberOrNone(distanceOf(samples[p]), "null"); });
    writeField("depth", parts, out, [&](auto p) { return numberOrNone(samples[p].depth, "null"); });
    writeField("slide", parts, out, [&](auto p) { return numberOrNone(samples[p].slide, "null"); });
    writeField("rule", parts, out, [&](auto p) { return samples[p].byRule ? "1" : "0"; });
    out.endObject();
    write(text + "\n");
  });
}

/// A column over all samples, pose by pose.
template <typename Value, typename Of>
std::vector<Value> columnOf(const FeetAnswer& answer, const Of& of) {
  std::vector<Value> column;
  column.reserve(answer.samples.size());
  for (const PartSample& sample : answer.samples) column.push_back(static_cast<Value>(of(sample)));
  return column;
}

std::string npzOf(const FeetInputs& inputs, const FeetAnswer& answer, const PartNames& names) {
  const std::vector<std::size_t> shape{answer.samples.size() / names.parts.size(),
                                       names.parts.size()};
  std::vector<std::int64_t> frames;
  std::vector<double> times;
  forEachPose(inputs, answer, [&](std::int64_t step, const PartSample*) {
    frames.push_back(inputs.played.steps.frameOf(step));
    times.push_back(inputs.timeOf(step));
  });
  const auto floats = [&](auto of) { return columnOf<float>(answer, of); };
  const auto bools = [&](auto of) { return columnOf<std::uint8_t>(answer, of); };
  NpzFile file;
  file.add("frame", frames);
  file.add("time", times);
  file.add("joint", names.joints);
  file.add("part", names.parts);
  file.addBools("contact", bools([](const PartSample& s) { return s.touches; }), shape);
  file.add("distance", floats([](const PartSample& s) { return distanceOf(s); }), shape);
  file.add("depth", floats([](const PartSample& s) { return s.depth; }), shape);
  file.add("slide", floats([](const PartSample& s) { return s.slide; }), shape);
  file.addBools("rule", bools([](const PartSample& s) { return s.byRule; }), shape);
  return file.bytes();
}

}  // namespace

Result<LabelFormat> labelFormatOf(const std::string& path) {
  const std::string ending = path.substr(std::min(path.size(), path.rfind('.')));
  if (ending == ".csv") return LabelFormat::Csv;
  if (ending == ".jsonl") return LabelFormat::JsonLines;
  if (ending == ".npz") return LabelFormat::Npz;
  return Error::in("--labels", ErrorCode::Mismatch,
                   "expected a file that ends in .csv, .jsonl or .npz, found " + inQuotes(path));
}

Result<Done> writeLabels(const FeetInputs& inputs, const FeetAnswer& answer, LabelFormat format,
                         const std::function<void(const std::string&)>& write) {
  const PartNames names(inputs);
  if (format == LabelFormat::Csv) writeCsv(inputs, answer, names, write);
  if (format == LabelFormat::JsonLines) writeJsonLines(inputs, answer, names, write);
  if (format != LabelFormat::Npz) return Done{};
  const std::string bytes = npzOf(inputs, answer, names);
  if (bytes.empty()) {
    return Error::in("--labels", ErrorCode::LimitExceeded,
                     "expected an .npz below 4 GiB: take fewer poses (--rate, --from, --to)");
  }
  write(bytes);
  return Done{};
}

}  // namespace foretouch::tools
