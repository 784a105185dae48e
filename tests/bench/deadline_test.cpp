#include "bench/deadline.h"

#include <gtest/gtest.h>

namespace foretouch::tools {
namespace {

LinkContact link(Verdict verdict, double freeUntil) {
  LinkContact contact;
  contact.verdict = verdict;
  contact.freeUntil = contact.toi = freeUntil;
  return contact;
}

TEST(UnsoundLinks, AreThoseSaidToBeFreeBeyondTheirTouch) {
  StepContacts touch, answer;
  touch.links = {link(Verdict::Contact, 0.5), link(Verdict::Clear, 1.0),
                 link(Verdict::StartsInContact, 0.0), link(Verdict::Contact, 0.5)};
  answer.links = {link(Verdict::Contact, 0.5), link(Verdict::Undecided, 0.9),
                  link(Verdict::Undecided, 0.0), link(Verdict::Undecided, 0.3)};
  EXPECT_EQ(unsoundLinks(answer, touch), 0);
  answer.links[0] = link(Verdict::Clear, 1.0);      // a miss
  answer.links[2] = link(Verdict::Undecided, 0.1);  // free where it touches
  EXPECT_EQ(unsoundLinks(answer, touch), 2);
  answer.links[3] = link(Verdict::Contact, 0.6);  // late
  EXPECT_EQ(unsoundLinks(answer, touch), 3);
}

TEST(BenchDeadline, JudgesEveryAnswerOfASmallRun) {
  DeadlineRequest request;
  request.options.workload.steps = 20;
  request.options.workload.rateHz = 5.0;
  request.deadlinesUs = {5.0};
  request.workBudgets = {300, 3000};
  request.asks = 60;
  const auto bench = measureDeadlines(request);
  ASSERT_TRUE(bench.ok()) << describe(bench.error());
  EXPECT_EQ(bench.value().violations, 0u);
  const auto& rows = bench.value().report.tables.front().rows;
  ASSERT_EQ(rows.size(), 4u);
  const auto undecided = [&](std::size_t row) { return std::get<double>(rows[row][3]); };
  EXPECT_EQ(undecided(0), 0.0) << "without a limit every link is decided";
  EXPECT_GT(undecided(2), undecided(3)) << "more work decides more";
}

}  // namespace
}  // namespace foretouch::tools
