#include "network/service/metrics_text.h"

#include <cstdio>
#include <string_view>

#include "lss/index.h"

namespace foretouch {
namespace {

constexpr double kSecondsPerUs = 1e-6;

std::string number(double value) {
  char text[32];
  const int length = std::snprintf(text, sizeof text, "%.12g", value);
  return {text, countOf(length)};
}

/// A label's value: escapes backslash, quote and line break.
std::string asLabel(std::string_view text) {
  std::string value = "\"";
  for (const char c : text) {
    if (c == '\\' || c == '"') value += '\\';
    if (c == '\n') {
      value += "\\n";
    } else {
      value += c;
    }
  }
  return value + "\"";
}

class Page {
 public:
  void counter(const std::string& name, const std::string& help, std::uint64_t value) {
    head(name, help, "counter");
    line(name, "", std::to_string(value));
  }
  void gauge(const std::string& name, const std::string& help, const std::string& value) {
    head(name, help, "gauge");
    line(name, "", value);
  }
  void info(const std::string& name, const std::string& help, const std::string& labels) {
    head(name, help, "gauge");
    line(name, labels, "1");
  }
  void rejects(const std::string& name, const std::string& help, const RejectCounts& counts) {
    head(name, help, "counter");
    for (std::size_t i = 1; i < kNumRejects; ++i) {
      line(name, "reason=" + asLabel(toString(static_cast<Reject>(i))), std::to_string(counts[i]));
    }
  }
  void faults(const std::string& name, const std::string& help, const WireCounts& counts) {
    head(name, help, "counter");
    for (std::size_t i = 1; i < kNumDatagramFaults; ++i) {
      line(name, "fault=" + asLabel(toString(static_cast<DatagramFault>(i))),
           std::to_string(counts.faults[i]));
    }
  }
  void histogram(const std::string& name, const std::string& help, const LatencyHistogram& values) {
    head(name, help, "histogram");
    for (std::size_t i = 0; i < LatencyHistogram::kBoundsUs.size(); ++i) {
      line(name + "_bucket",
           "le=" + asLabel(number(LatencyHistogram::kBoundsUs[i] * kSecondsPerUs)),
           std::to_string(values.countAtMost(i)));
    }
    line(name + "_bucket", "le=\"+Inf\"", std::to_string(values.count()));
    line(name + "_sum", "", number(values.sumUs() * kSecondsPerUs));
    line(name + "_count", "", std::to_string(values.count()));
  }
  /// One metric: `value` of each avatar.
  template <typename Counts, typename Value>
  void ofAvatars(const std::string& name, const std::string& help, const char* type,
                 const Counts& counts, const Value& value) {
    head(name, help, type);
    for (const auto& count : counts.avatars) line(name, labelOf(count), value(count));
  }
  /// Only the kinds that occurred, each by its word.
  template <typename Kind, typename Counts, typename Numbers>
  void byKind(const std::string& name, const std::string& help, const std::string& label,
              const Counts& counts, const Numbers& numbers) {
    head(name, help, "counter");
    for (const auto& count : counts.avatars) {
      for (std::size_t i = 0; i < numbers(count).size(); ++i) {
        if (numbers(count)[i] == 0) continue;
        line(name, labelOf(count) + "," + label + "=" + asLabel(toString(static_cast<Kind>(i))),
             std::to_string(numbers(count)[i]));
      }
    }
  }
  void events(const std::string& name, const std::string& help, const WorldCounts& counts) {
    head(name, help, "counter");
    for (std::size_t i = 0; i < kNumEventKinds; ++i) {
      line(name, "kind=" + asLabel(toString(static_cast<EventKind>(i))),
           std::to_string(counts.events[i]));
    }
  }
  void refusedBodies(const std::string& name, const std::string& help, const WorldCounts& counts) {
    if (counts.refusedLongest.empty()) return;
    head(name, help, "gauge");
    for (const RefusedBody& body : counts.refusedLongest) {
      line(name,
           "body=" + asLabel(std::to_string(body.body)) +
               ",reason=" + asLabel(toString(body.reason)),
           std::to_string(body.poses));
    }
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void head(const std::string& name, const std::string& help, const char* type) {
    text_ += "# HELP " + name + " " + help + "\n# TYPE " + name + " " + type + "\n";
  }
  void line(const std::string& name, const std::string& labels, const std::string& value) {
    text_ += name;
    if (!labels.empty()) text_ += "{" + labels + "}";
    text_ += " " + value + "\n";
  }
  template <typename Count>
  static std::string labelOf(const Count& count) {
    return "avatar=" + asLabel(std::to_string(count.avatar));
  }
  std::string text_;
};

void addPoses(Page& page, const ServiceCounts& counts) {
  page.counter("foretouch_poses_received_total", "Poses that arrived, whatever became of them.",
               counts.received);
  page.counter("foretouch_poses_answered_total", "Accepted poses, each with its answer.",
               counts.answered);
  page.rejects("foretouch_poses_rejected_total", "Poses that were refused.", counts.rejects);
  page.gauge("foretouch_poses_waiting", "Poses in the mailboxes or being answered.",
             std::to_string(counts.waiting));
  page.counter("foretouch_poses_lost_total", "Poses that never came, by their sequence.",
               counts.lost);
  page.counter("foretouch_answers_across_gap_total", "Answers that claim nothing to be clear.",
               counts.gaps);
  page.counter("foretouch_vast_gaps_total",
               "Answers across more than a million poses, which do not count as lost.",
               counts.vastGaps);
  page.gauge("foretouch_last_pose_timestamp_seconds", "When the last pose arrived; 0 before any.",
             number(static_cast<double>(counts.lastPoseUtimeUs) * kSecondsPerUs));
  page.counter("foretouch_skeletons_received_total", "Skeletons that arrived.", counts.skeletons);
  page.rejects("foretouch_skeletons_rejected_total", "Skeletons that were refused.",
               counts.skeletonRejects);
}

void addWire(Page& page, const ServiceCounts& counts) {
  page.counter("foretouch_publish_failures_total", "Messages that the system did not take.",
               counts.publishFailures);
  page.counter("foretouch_journal_failures_total", "Events that could not be recorded.",
               counts.journalFailures);
  page.counter("foretouch_refusals_unrecorded_total",
               "Refused messages that the log leaves out, beyond some per second.",
               counts.unrecorded);
  page.counter("foretouch_datagrams_received_total", "Datagrams that were read.",
               counts.wire.datagrams);
  page.counter("foretouch_datagrams_foreign_total", "Datagrams of senders that are not heard.",
               counts.wire.foreign);
  page.faults("foretouch_datagrams_faulty_total", "Datagrams that were no messages.", counts.wire);
  page.counter("foretouch_datagrams_dropped_total", "Datagrams that the system dropped unread.",
               counts.wire.kernelDrops);
  page.counter("foretouch_messages_other_channels_total", "Messages on channels of others.",
               counts.wire.otherChannels);
}

void addSolids(Page& page, const SolidCounts& solids) {
  if (solids.avatars.empty()) return;
  page.byKind<SolidState>(
      "foretouch_solid_poses_total", "Poses that a solid avatar showed, by its state.", "state",
      solids, [](const SolidCount& solid) -> const auto& { return solid.poses; });
  page.ofAvatars("foretouch_solid_uncertified_total", "Of these, those whose way was not proven.",
                 "counter", solids,
                 [](const SolidCount& solid) { return std::to_string(solid.uncertified); });
  page.ofAvatars("foretouch_solid_deviation_metres",
                 "How far the last shown pose was from the tracked one.", "gauge", solids,
                 [](const SolidCount& solid) { return number(solid.deviation); });
  page.ofAvatars("foretouch_solid_queries_total", "Motions asked for solid avatars.", "counter",
                 solids, [](const SolidCount& solid) { return std::to_string(solid.queries); });
  page.ofAvatars("foretouch_solid_work_total", "Work done for them, in evaluations in lanes.",
                 "counter", solids,
                 [](const SolidCount& solid) { return std::to_string(solid.work); });
  page.ofAvatars("foretouch_solid_pushed_total",
                 "Of a moving world: ticks at which something that moves pressed against it.",
                 "counter", solids,
                 [](const SolidCount& solid) { return std::to_string(solid.pushed); });
  page.ofAvatars("foretouch_solid_crushed_total",
                 "Of a moving world: ticks at which something left it no proven way.", "counter",
                 solids, [](const SolidCount& solid) { return std::to_string(solid.crushed); });
  page.histogram("foretouch_solid_seconds", "What a solid avatar took for one pose.", solids.times);
}

void addPersons(Page& page, const PersonCounts& persons) {
  if (persons.avatars.empty()) return;
  page.byKind<BracketVerdict>(
      "foretouch_person_links_total", "Links, times steps, by what is known of the person.",
      "verdict", persons, [](const PersonCount& person) -> const auto& { return person.links; });
  page.ofAvatars("foretouch_person_bounds_broken_total",
                 "Claims of the bounds that poses showed to be wrong, link by link.", "counter",
                 persons, [](const PersonCount& person) { return std::to_string(person.broken); });
  page.histogram("foretouch_person_seconds", "What a message about a person took.", persons.times);
}

void addWorld(Page& page, const WorldReport& world) {
  const WorldCounts& counts = world.counts;
  page.gauge("foretouch_world_bodies", "Bodies that are there, avatars included.",
             std::to_string(counts.bodies));
  page.gauge("foretouch_world_silent", "Of these, those that the watermark has left behind.",
             std::to_string(counts.silent));
  page.gauge("foretouch_world_waiting", "Poses ahead of the watermark.",
             std::to_string(counts.waiting));
  page.gauge("foretouch_world_answered_until_seconds", "The watermark; -1e-06 before any.",
             number(static_cast<double>(counts.answeredUntilUs) * kSecondsPerUs));
  page.gauge("foretouch_world_waits_for", "The body that the watermark waits for; -1: none.",
             std::to_string(counts.waitsFor));
  page.counter("foretouch_world_states_total", "States of bodies that arrived.", counts.states);
  page.counter("foretouch_world_rigid_poses_total", "Poses of rigid bodies that arrived.",
               counts.rigidPoses);
  page.counter("foretouch_world_poses_taken_total", "Poses that are on the timeline.",
               counts.taken);
  page.rejects("foretouch_world_refused_total", "States and poses that the world refused.",
               counts.rejects);
  page.gauge("foretouch_world_bodies_refused",
             "Bodies of which poses come, and none is accepted for half a second.",
             std::to_string(counts.refusedBodies));
  page.refusedBodies("foretouch_world_body_refused_poses",
                     "Of some of these, the poses since one was accepted.", counts);
  page.counter("foretouch_world_gaps_total", "Poses before which something is not known.",
               counts.gaps);
  page.counter("foretouch_world_late_changes_total",
               "Changes that took effect later than their sender says.", counts.lateChanges);
  page.counter("foretouch_world_silences_total", "How often the watermark went on without a body.",
               counts.silences);
  page.counter("foretouch_world_forgotten_total", "Bodies that nobody spoke of any more.",
               counts.forgotten);
  page.counter("foretouch_world_failures_total", "What the world could not take or answer.",
               counts.failures);
  page.counter("foretouch_world_timelines_total", "Timelines begun.", counts.timelines);
  page.counter("foretouch_world_advances_total", "Advances of the watermark.", counts.advances);
  page.events("foretouch_world_events_total", "What happened between bodies.", counts);
  page.counter("foretouch_world_events_marked_total",
               "Of these, those that rest on what is not known.", counts.marked);
  page.histogram("foretouch_world_latency_seconds",
                 "From receiving what let the watermark advance to having sent what happened.",
                 world.times.latency);
  page.histogram("foretouch_world_advance_seconds", "Of that, from telling the world on.",
                 world.times.advance);
}

}  // namespace

std::string metricsText(const ServiceFacts& facts, const ServiceCounts& counts,
                        const AnswerTimes& times, const SolidCounts& solids,
                        const WorldReport* world, const PersonCounts& persons) {
  Page page;
  page.info("foretouch_build_info", "What is running.",
            "build=" + asLabel(facts.build) + ",scene=" + asLabel(facts.scene));
  page.gauge("foretouch_start_time_seconds", "When the service started.",
             number(static_cast<double>(facts.startUtimeUs) * kSecondsPerUs));
  page.gauge("foretouch_avatars", "Avatars that are served.", std::to_string(facts.numAvatars));
  page.gauge("foretouch_workers", "Threads that answer.", std::to_string(facts.numWorkers));
  addPoses(page, counts);
  addWire(page, counts);
  page.histogram("foretouch_answer_latency_seconds",
                 "From receiving a pose to having sent its answer.", times.latency);
  page.histogram("foretouch_query_seconds", "Of the answers' latency, the query alone.",
                 times.query);
  addSolids(page, solids);
  addPersons(page, persons);
  if (world != nullptr) addWorld(page, *world);
  return page.text();
}

}  // namespace foretouch
