#include "tools/log/replay_log_summary.h"

#include <algorithm>

#include <fmt/format.h>

#include "lss/index.h"
#include "network/wire/messages.h"
#include "tools/percentile.h"

namespace foretouch::tools {
namespace {

std::string row(const std::string& what, std::int64_t number, const std::string& remark = "") {
  return fmt::format("{:<22}{:>10}{}{}\n", what, number, remark.empty() ? "" : "   ", remark);
}

/// The damage that the reader of the log skipped.
std::string damage(const LogCounts& log) {
  std::string text;
  const auto note = [&text](std::uint64_t number, const char* what) {
    if (number > 0) text += fmt::format("the log: {} {}\n", number, what);
  };
  note(log.badBlocks, "blocks whose check sum is wrong were left out");
  note(log.badEvents, "events with impossible lengths were passed over");
  note(log.skippedBytes, "damaged bytes were passed over");
  note(log.tailEvents, "events after the last check sum were left out");
  if (log.isTruncated) text += "the log ends within an event\n";
  return text;
}

}  // namespace

std::string LogReplaySummary::compared(const JournalCheck& journal, const char* what,
                                       std::int64_t answers) {
  if (!journal.hasRecord()) return "";
  std::string text =
      fmt::format("{} of {} {} equal the journal's, byte for byte\n", journal.equal(),
                  std::max(answers - journal.beyondEnd(), journal.recorded()), what);
  if (journal.beyondEnd() > 0) {
    text += fmt::format("{} more are beyond the end of the log, which was cut off\n",
                        journal.beyondEnd());
  }
  return text;
}

LogReplaySummary::LogReplaySummary(const LogReplayInputs& inputs) : inputs_(inputs) {
  for (const Avatar& avatar : inputs.avatars) {
    ofLink_.emplace_back(countOf(avatar.numLinks()));
  }
}

void LogReplaySummary::add(const ContactsMessage& answer, std::size_t avatar) {
  bool touches = false;
  for (const AnsweredContact& answered : answer.contacts) {
    const Verdict verdict = answered.contact.verdict;
    touches = touches || verdict != Verdict::Undecided;
    if (verdict == Verdict::Undecided) ++reasons_[slotOf(answered.contact.reason)];
    const auto link = slotOf(answered.contact.link);
    for (Counts* counts : {&total_, &ofLink_[avatar][link]}) {
      counts->contacts += verdict == Verdict::Contact ? 1 : 0;
      counts->startsInContact += verdict == Verdict::StartsInContact ? 1 : 0;
      counts->undecided += verdict == Verdict::Undecided ? 1 : 0;
    }
  }
  withContact_ += touches ? 1 : 0;
  queriesUs_.push_back(static_cast<float>(answer.queryUs));
}

double LogReplaySummary::queryUs(double share) const {
  std::vector<float> queries = queriesUs_;
  return percentile(queries, share);
}

std::string LogReplaySummary::text(const LogReplayReport& report) const {
  return head() + stream(report) + verdicts() + byLink() + cost() + damage(report.log) +
         comparison(report);
}

std::string LogReplaySummary::comparison(const LogReplayReport& report) {
  std::string text;
  if (report.isEmpty()) {
    text += "nothing was answered: no pose of these avatars could be trusted and understood";
    const bool isDamaged = report.log.badBlocks + report.log.missingBlocks > 0;
    text += isDamaged ? "; foretouch log recover --unchecked may help\n" : "\n";
  }
  if (report.unreadableAnswers > 0) {
    text += fmt::format("{} of the log's verdicts cannot be read\n", report.unreadableAnswers);
  }
  text += compared(report.journal, "verdicts", report.answers);
  text += compared(report.solids, "shown poses", report.shown);
  if (report.solidsNotAsked > 0) {
    text += fmt::format("the log also has {} shown poses: --solid compares them\n",
                        report.solidsNotAsked);
  }
  text += compared(report.persons, "messages about the person", report.said);
  if (report.personsNotAsked > 0) {
    text += fmt::format("the log also has {} messages about the person: --bounds compares them\n",
                        report.personsNotAsked);
  }
  if (report.eventsNotAsked > 0) {
    text += fmt::format(
        "the log also has {} messages of a moving world: foretouch log replay compares them\n",
        report.eventsNotAsked);
  }
  for (const JournalCheck* journal : {&report.journal, &report.solids, &report.persons}) {
    const auto difference =
        journal->hasRecord() ? journal->firstDifference() : std::optional<std::string>();
    if (difference) text += "first: " + *difference + "\n";
  }
  return text.empty() ? "" : "\n" + text;
}

std::string LogReplaySummary::head() const {
  const LogReplayRequest& request = inputs_.request;
  const QueryOptions& query = request.world.query;
  std::string text =
      fmt::format("{} in {}: {} triangles, {} {}\ntolerance {:.3g} m, {} fidelity\n\n",
                  request.logPath, request.world.scenePath, inputs_.scene.audit().triangles,
                  inputs_.avatars.size(), inputs_.avatars.size() == 1 ? "avatar" : "avatars",
                  query.tolerance, toString(query.fidelity));
  return text;
}

std::string LogReplaySummary::stream(const LogReplayReport& report) const {
  std::string text = row("poses", report.poses);
  text += row("answered", report.answers);
  text += row("timelines", report.timelines);
  text += row("lost poses", report.lost, fmt::format("in {} gaps", report.gaps));
  for (std::size_t i = 1; i < kNumRejects; ++i) {
    if (report.rejects[i] == 0) continue;
    text += row(fmt::format("refused, {}", toString(static_cast<Reject>(i))),
                static_cast<std::int64_t>(report.rejects[i]));
  }
  for (const auto& [avatar, poses] : report.others) {
    text += row(fmt::format("of avatar {}", avatar), poses, "poses; not given by --avatar");
  }
  return text;
}

std::string LogReplaySummary::verdicts() const {
  std::string text =
      row("touches", touches_.touches, fmt::format("{} of them missed by poses", touches_.missed));
  text += row("touches of the ground", touches_.ground);
  text += row("answers with contact", withContact_);
  text += row("contacts", total_.contacts);
  text += row("starts in contact", total_.startsInContact);
  text += row("undecided", total_.undecided);
  for (std::size_t i = 0; i < reasons_.size(); ++i) {
    if (reasons_[i] > 0) {
      text += row(fmt::format("  {}", toString(static_cast<UndecidedReason>(i))), reasons_[i]);
    }
  }
  return text;
}

std::string LogReplaySummary::byLink() const {
  constexpr std::size_t kMaxRows = 40;
  struct Row {
    std::string name;
    Counts counts;
  };
  std::vector<Row> rows;
  for (std::size_t avatar = 0; avatar < ofLink_.size(); ++avatar) {
    for (std::size_t link = 0; link < ofLink_[avatar].size(); ++link) {
      const Counts& counts = ofLink_[avatar][link];
      if (counts.contacts + counts.startsInContact + counts.undecided == 0) continue;
      const std::string& name = inputs_.avatars[avatar].skeleton().name(static_cast<LinkId>(link));
      const bool isAlone = inputs_.avatars.size() == 1;
      rows.push_back(
          {isAlone ? name : fmt::format("{}:{}", inputs_.request.avatars[avatar].id, name),
           counts});
    }
  }
  if (rows.empty()) return "";
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return a.counts.contacts > b.counts.contacts;
  });
  std::string text = fmt::format("\n{:<32}{:>10}{:>19}{:>11}\n", "link", "contacts",
                                 "starts in contact", "undecided");
  for (std::size_t i = 0; i < std::min(rows.size(), kMaxRows); ++i) {
    const Counts& counts = rows[i].counts;
    text += fmt::format("{:<32}{:>10}{:>19}{:>11}\n", rows[i].name, counts.contacts,
                        counts.startsInContact, counts.undecided);
  }
  if (rows.size() > kMaxRows) text += fmt::format("and {} more\n", rows.size() - kMaxRows);
  return text;
}

std::string LogReplaySummary::cost() const {
  if (queriesUs_.empty()) return "";
  std::vector<float> queries = queriesUs_;
  const double median = percentile(queries, 0.5), most = percentile(queries, 0.9);
  return fmt::format(
      "\nlatency of a query, us   p50 {:.1f}   p90 {:.1f}   p99 {:.1f}   max {:.1f}\n", median,
      most, percentile(queries, 0.99), percentile(queries, 1.0));
}

}  // namespace foretouch::tools
