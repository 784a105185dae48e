#include "tools/log/log_inspection.h"

#include <algorithm>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/json_writer.h"
#include "tools/microseconds.h"
#include "tools/progress.h"

namespace foretouch::tools {
namespace {

/// The rate with a point, whole or not.
std::string rateText(double rateHz) {
  std::string text = numberText(rateHz);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

void writeFacts(const ChannelFacts& facts, JsonWriter& out) {
  out.field("events", facts.events);
  out.field("payload_bytes", facts.payloadBytes);
  out.field("earliest_us", facts.earliestUs);
  out.field("latest_us", facts.latestUs);
  out.rawField("rate_hz", rateText(facts.rateHz()));
}

void write(const LogFinding& finding, JsonWriter& out) {
  out.beginObject();
  out.field("damage", toString(finding.damage));
  out.field("offset", finding.offset);
  out.field("bytes", finding.bytes);
  if (finding.count > 0) out.field("count", finding.count);
  out.endObject();
}

void write(const LogCounts& counts, JsonWriter& out) {
  out.beginObject();
  out.field("events", counts.events);
  out.field("unchecked_events", counts.uncheckedEvents);
  out.field("tail_events", counts.tailEvents);
  out.field("blocks", counts.blocks);
  out.field("bad_blocks", counts.badBlocks);
  out.field("missing_blocks", counts.missingBlocks);
  out.field("bad_events", counts.badEvents);
  out.field("skipped_bytes", counts.skippedBytes);
  out.field("truncated", counts.isTruncated);
  out.field("check_sums", counts.hasCheckSums);
  out.field("closed", counts.isClosed);
  out.endObject();
}

void writeChannel(const std::string& name, const ChannelFacts& facts, JsonWriter& out) {
  out.beginObject();
  out.field("channel", name);
  writeFacts(facts, out);
  out.endObject();
}

std::string line(const char* name, const std::string& value) {
  return fmt::format("  {:<25}{}\n", name, value);
}

std::string channelLine(std::string name, const ChannelFacts& facts) {
  // A channel may hold any bytes but control characters; a long one would break the table.
  constexpr std::size_t kLongest = 63;
  if (name.size() > kLongest) name = name.substr(0, kLongest) + "...";
  return fmt::format("  {:<25}{:>10} events {:>12.2f} Hz {:>14} bytes\n", name, facts.events,
                     facts.rateHz(), facts.payloadBytes);
}

std::string checkSumsOf(const LogCounts& counts) {
  if (!counts.hasCheckSums) return "none";
  std::string text = fmt::format("{} blocks are right", counts.blocks);
  if (counts.badBlocks > 0) text += fmt::format(", {} are wrong", counts.badBlocks);
  if (counts.missingBlocks > 0) text += fmt::format(", {} are missing", counts.missingBlocks);
  return text;
}

}  // namespace

void ChannelFacts::add(std::int64_t utimeUs, std::size_t bytes) {
  earliestUs = events == 0 ? utimeUs : std::min(earliestUs, utimeUs);
  latestUs = events == 0 ? utimeUs : std::max(latestUs, utimeUs);
  ++events;
  payloadBytes += bytes;
}

double ChannelFacts::durationS() const {
  // As doubles: stamps may be any distance apart.
  return (static_cast<double>(latestUs) - static_cast<double>(earliestUs)) / kUsPerS;
}

double ChannelFacts::rateHz() const {
  return latestUs > earliestUs ? static_cast<double>(events - 1) / durationS() : 0.0;
}

bool LogInspection::isSound() const {
  return findings.empty() && counts.badEvents == 0;
}

Result<LogInspection> inspectLog(const std::string& path) {
  LogInspection inspection;
  inspection.path = path;
  LogReadOptions options;
  options.onFinding = [&inspection](const LogFinding& finding) {
    if (inspection.findings.size() < kMaxListedFindings) {
      inspection.findings.push_back(finding);
    } else {
      ++inspection.unlistedFindings;
    }
  };
  FORETOUCH_TRY(auto opened, EventLogReader::open(path, options));
  EventLogReader reader = std::move(opened);
  inspection.bytes = reader.size();
  ProgressBar bar("log", static_cast<std::int64_t>(reader.size()));
  std::int64_t lastUs = 0;
  for (LogEvent event;;) {
    FORETOUCH_TRY(const auto more, reader.next(event));
    if (!more) break;
    bar.advanceTo(static_cast<std::int64_t>(reader.position()));
    const auto known = inspection.channels.find(event.channel);
    const bool isListed =
        known != inspection.channels.end() || inspection.channels.size() < kMaxListedChannels;
    ChannelFacts& facts = isListed ? inspection.channels[event.channel] : inspection.otherChannels;
    facts.add(event.utimeUs, event.payload.size());
    if (inspection.all.events > 0 && event.utimeUs < lastUs) ++inspection.stampsBackwards;
    lastUs = event.utimeUs;
    inspection.all.add(event.utimeUs, event.payload.size());
  }
  inspection.counts = reader.counts();
  return inspection;
}

std::string formatOf(const LogCounts& counts) {
  if (!counts.hasCheckSums) return "LCM event log without check sums";
  return counts.isClosed ? "LCM event log with check sums"
                         : "LCM event log with check sums, not closed: its writer was stopped, or "
                           "is writing still, or its end is missing";
}

std::string describe(const LogFinding& finding) {
  std::string text = fmt::format("bytes {} to {}: {}", finding.offset,
                                 finding.offset + finding.bytes, toString(finding.damage));
  switch (finding.damage) {
    case LogDamage::MissingBlocks: return text + fmt::format(": {}", finding.count);
    case LogDamage::UncheckedTail:
      return text + fmt::format(" of {} events: log recover --keep-tail takes them", finding.count);
    case LogDamage::OtherLog:
      return text + fmt::format(" begins there and is not read: tail -c +{} cuts it out",
                                finding.offset + 1);
    default: return text;
  }
}

std::string describe(const LogInspection& inspection) {
  const LogCounts& counts = inspection.counts;
  const ChannelFacts& all = inspection.all;
  std::string text = inspection.path + "\n" + line("format", formatOf(counts)) +
                     line("size", fmt::format("{} bytes", inspection.bytes)) +
                     line("events", std::to_string(counts.events)) +
                     line("check sums", checkSumsOf(counts)) +
                     line("index", counts.hasCheckSums ? "by check sums" : "none");
  if (all.events > 0) {
    text += line("stamps", fmt::format("{} to {} us, {:.3f} s", all.earliestUs, all.latestUs,
                                       all.durationS()));
  }
  if (inspection.stampsBackwards > 0) {
    text += line("stamps that go back", std::to_string(inspection.stampsBackwards));
  }
  if (counts.tailEvents > 0) text += line("unchecked tail", std::to_string(counts.tailEvents));
  if (counts.skippedBytes > 0)
    text += line("bytes passed over", std::to_string(counts.skippedBytes));
  for (const auto& [name, facts] : inspection.channels) text += channelLine(name, facts);
  if (inspection.otherChannels.events > 0) {
    text += channelLine("(further channels)", inspection.otherChannels);
  }
  return text;
}

std::string jsonLine(const LogInspection& inspection) {
  const auto writeAll = [](const ChannelFacts& facts, JsonWriter& out) {
    out.beginObject();
    writeFacts(facts, out);
    out.endObject();
  };
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("file", inspection.path);
  out.field("state", inspection.isSound() ? "sound" : "damaged");
  out.field("bytes", inspection.bytes);
  out.key("counts");
  write(inspection.counts, out);
  out.key("all");
  writeAll(inspection.all, out);
  out.field("stamps_backwards", inspection.stampsBackwards);
  out.list("channels", inspection.channels,
           [&](const auto& channel) { writeChannel(channel.first, channel.second, out); });
  out.key("other_channels");
  writeAll(inspection.otherChannels, out);
  out.list("findings", inspection.findings,
           [&](const LogFinding& finding) { write(finding, out); });
  out.field("unlisted_findings", inspection.unlistedFindings);
  out.endObject();
  return text + "\n";
}

std::string jsonLine(const std::string& path, const Error& error) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("file", path);
  out.field("state", "unreadable");
  out.field("error", foretouch::describe(error));
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
