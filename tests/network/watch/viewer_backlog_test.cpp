#include "network/watch/viewer_backlog.h"

#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/network/sent_events.h"

namespace foretouch {
namespace {

using test::eventOf;
using test::SentEvent;
using test::sentEvents;

constexpr std::size_t kTopics = 3;

SharedText wholeOf(const ViewEvent& event) {
  return std::make_shared<const std::string>(sentText(event));
}

/// Everything that waits, as a viewer reads it.
void drain(ViewerBacklog& backlog, std::string& text, std::size_t most = SIZE_MAX) {
  for (std::size_t i = 0; i < most && !backlog.isEmpty(); ++i) text += *backlog.next();
}

TEST(SentText, IsOneEvent) {
  ViewEvent event = eventOf(4, 2, {17, 18});
  event.steps = 3;
  EXPECT_EQ(
      sentText(event),
      "event: step\ndata: {\"avatar\":4,\"sequence\":2,\"contacts\":[17,18],\"skipped\":2}\n\n");
  event.numLeftOut = 5;
  event.contacts = {};
  EXPECT_EQ(sentText(event),
            "event: step\ndata: {\"avatar\":4,\"sequence\":2,\"contacts\":[],\"skipped\":2,"
            "\"contacts_left_out\":5}\n\n");
  ViewEvent status;
  status.name = "status";
  status.fields = std::make_shared<const std::string>("\"answered\":1");
  EXPECT_EQ(sentText(status), "event: status\ndata: {\"answered\":1}\n\n");
}

TEST(ViewerBacklog, PassesOnWhatNothingJoined) {
  ViewerBacklog backlog;
  const ViewEvent event = eventOf(0, 1, {1});
  const SharedText whole = wholeOf(event);
  backlog.add(event, whole);
  EXPECT_EQ(backlog.next(), whole);
  EXPECT_TRUE(backlog.isEmpty());
  EXPECT_EQ(backlog.next(), nullptr);
}

// Whatever a viewer misses of steps, it sees each of their contacts, once and in order.
TEST(ViewerBacklog, KeepsEveryContactOfStepsThatAreSkipped) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    ViewerBacklog backlog;
    std::map<std::int64_t, std::vector<int>> said;
    std::map<std::int64_t, std::int64_t> steps;
    std::string read;
    for (int i = 1; i <= 2000; ++i) {
      const auto topic = static_cast<std::int64_t>(random() % kTopics);
      std::vector<int> contacts(random() % 4);
      for (std::size_t c = 0; c < contacts.size(); ++c) contacts[c] = 10 * i + static_cast<int>(c);
      ViewEvent event = eventOf(topic, i, contacts);
      event.steps = 1 + random() % 5;
      said[topic].insert(said[topic].end(), contacts.begin(), contacts.end());
      steps[topic] += static_cast<std::int64_t>(event.steps);
      backlog.add(event, wholeOf(event));
      const auto mood = random() % 40;  // mostly asleep
      if (mood == 0) drain(backlog, read);
      if (mood == 1) drain(backlog, read, 1);
    }
    drain(backlog, read);
    EXPECT_EQ(backlog.bytes(), 0u);
    std::map<std::int64_t, std::vector<int>> seen;
    std::map<std::int64_t, std::int64_t> seenSteps, last;
    for (const SentEvent& event : sentEvents(read)) {
      seen[event.avatar].insert(seen[event.avatar].end(), event.contacts.begin(),
                                event.contacts.end());
      seenSteps[event.avatar] += 1 + event.skipped;
      EXPECT_GT(event.sequence, last[event.avatar]);
      last[event.avatar] = event.sequence;
      EXPECT_EQ(event.leftOut, 0);
    }
    EXPECT_EQ(seen, said) << seed;
    EXPECT_EQ(seenSteps, steps) << seed;
  }
}

TEST(ViewerBacklog, IsBoundedAndSaysWhatItLeftOut) {
  constexpr std::size_t kMost = 2000;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    ViewerBacklog backlog(kMost);
    std::int64_t said = 0, seen = 0, leftOut = 0;
    std::string read;
    for (int i = 0; i < 3000; ++i) {
      std::vector<int> contacts(random() % 20, 123456);
      said += static_cast<std::int64_t>(contacts.size());
      const ViewEvent event = eventOf(static_cast<std::int64_t>(random() % kTopics), i, contacts);
      backlog.add(event, wholeOf(event));
      EXPECT_LE(backlog.bytes(), kMost);
      if (random() % 1000 == 0) drain(backlog, read, 1);
    }
    drain(backlog, read);
    for (const SentEvent& event : sentEvents(read)) {
      seen += static_cast<std::int64_t>(event.contacts.size());
      leftOut += event.leftOut;
    }
    EXPECT_EQ(seen + leftOut, said);
    EXPECT_GT(leftOut, said / 2);
    EXPECT_GT(seen, 0);
  }
}

}  // namespace
}  // namespace foretouch
