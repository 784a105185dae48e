#include "tools/world/world_summary.h"

#include <algorithm>

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "tools/json_line.h"
#include "tools/percentile.h"

namespace foretouch::tools {
namespace {

constexpr std::size_t kMostPairRows = 20;

std::string line(const char* what, std::int64_t number, const std::string& remark = "") {
  return fmt::format("{:<24}{:>10}{}{}\n", what, number, remark.empty() ? "" : "   ", remark);
}

}  // namespace

void WorldSummary::add(const WorldStep& step) {
  ++windows_;
  bool touches = false;
  for (const WorldContact& contact : step.answer.contacts) {
    const Pair pair{contact.a.body, contact.b.body};
    for (Counts* counts : {&total_, &ofPair_[pair]}) {
      counts->contacts += contact.verdict == Verdict::Contact ? 1 : 0;
      counts->startsInContact += contact.verdict == Verdict::StartsInContact ? 1 : 0;
      counts->undecided += contact.verdict == Verdict::Undecided ? 1 : 0;
    }
    assumed_ += contact.isAssumed ? 1 : 0;
    touches = touches || contact.verdict != Verdict::Undecided;
  }
  windowsWithContact_ += touches ? 1 : 0;
  pairs_ += step.answer.counters.pairs;
  nearPairs_ += step.answer.counters.nearPairs;
  latenciesUs_.push_back(static_cast<float>(step.latencyUs));
}

void WorldSummary::add(const WorldTouches& touches) {
  touches_ = touches.counts();
  for (const Touch& touch : touches.listed()) {
    const TouchSides sides = touches.sidesOf(touch);
    ++ofPair_[{sides.a, sides.b}].touches;
    ++total_.touches;
  }
}

double WorldSummary::latencyUs(double share) const {
  std::vector<float> latencies = latenciesUs_;
  return percentile(latencies, share);
}

std::string WorldSummary::nameOf(const Pair& pair) const {
  const auto& [a, b] = pair;
  if (b == kStillScene) return world_.nameOf(a) + " and the scene";
  if (a == b) return world_.nameOf(a) + ", own links";
  return world_.nameOf(a) + " and " + world_.nameOf(b);
}

std::string WorldSummary::text() const {
  std::string text = line("windows", windows_);
  text += line("windows with contact", windowsWithContact_);
  text += line("touches of two bodies", touches_.bodies);
  text += line("touches with the scene", touches_.scene);
  if (touches_.own > 0) text += line("touches of own links", touches_.own);
  text +=
      line("missed", touches_.missed, "of these: nothing touches where a window begins or ends");
  text += line("contacts", total_.contacts);
  text += line("starts in contact", total_.startsInContact);
  text += line("undecided", total_.undecided);
  if (assumed_ > 0) {
    text += line("assumed", assumed_, "of these rest on a silent body that is taken to hold still");
  }
  std::vector<std::pair<Pair, Counts>> rows(ofPair_.begin(), ofPair_.end());
  std::stable_sort(rows.begin(), rows.end(), [](const auto& x, const auto& y) {
    return x.second.touches > y.second.touches;
  });
  if (!rows.empty()) {
    text += fmt::format("\n{:<44}{:>9}{:>10}{:>19}{:>11}\n", "who", "touches", "contacts",
                        "starts in contact", "undecided");
  }
  for (std::size_t i = 0; i < std::min(rows.size(), kMostPairRows); ++i) {
    const auto& [pair, counts] = rows[i];
    text += fmt::format("{:<44}{:>9}{:>10}{:>19}{:>11}\n", nameOf(pair), counts.touches,
                        counts.contacts, counts.startsInContact, counts.undecided);
  }
  if (rows.size() > kMostPairRows) {
    text += fmt::format("and {} more\n", rows.size() - kMostPairRows);
  }
  const auto aWindow = [&](std::uint64_t sum) {
    return static_cast<double>(sum) / static_cast<double>(std::max<std::int64_t>(1, windows_));
  };
  text += fmt::format(
      "\nlatency of a window, us  p50 {:.1f}   p90 {:.1f}   p99 {:.1f}   max {:.1f}\n"
      "pairs of bodies, mean    asked, with boxes that meet {:.1f}   near {:.1f}\n",
      latencyUs(0.5), latencyUs(0.9), latencyUs(0.99), latencyUs(1.0), aWindow(pairs_),
      aWindow(nearPairs_));
  return text;
}

std::string WorldSummary::jsonLine(const std::string& output, const std::string& report) const {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("world", world_.file.path);
  out.field("windows", windows_);
  out.field("windows_with_contact", windowsWithContact_);
  out.field("touches_bodies", touches_.bodies);
  out.field("touches_scene", touches_.scene);
  out.field("touches_own", touches_.own);
  out.field("touches_missed", touches_.missed);
  out.field("contacts", total_.contacts);
  out.field("starts_in_contact", total_.startsInContact);
  out.field("undecided", total_.undecided);
  out.field("assumed", assumed_);
  writeObject("latency_us", out, [&] {
    for (const auto& [name, share] :
         {std::make_pair("p50", 0.5), std::make_pair("p99", 0.99), std::make_pair("max", 1.0)}) {
      out.key(name);
      out.fixed(latencyUs(share), 1);
    }
  });
  out.field("output", output);
  if (!report.empty()) out.field("report", report);
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
