#include "middleware/contact.h"

#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

LinkContact contactOf(LinkId link, Verdict verdict, double time) {
  LinkContact contact;
  contact.link = link;
  contact.verdict = verdict;
  contact.toi = contact.freeUntil = time;
  return contact;
}

TEST(Reported, ListsTheEarliestFirstAndTiesByLink) {
  StepContacts step;
  step.links = {contactOf(0, Verdict::Contact, 0.5),    contactOf(1, Verdict::Clear, 1.0),
                contactOf(2, Verdict::Undecided, 0.25), contactOf(3, Verdict::StartsInContact, 0.0),
                contactOf(4, Verdict::Contact, 0.25),   contactOf(5, Verdict::Contact, 0.5)};
  EXPECT_EQ(reported(step), (std::vector<LinkId>{3, 2, 4, 0, 5}));
  step.links = {contactOf(0, Verdict::Clear, 1.0)};
  EXPECT_TRUE(reported(step).empty());
}

TEST(Reported, PlacesAnUndecidedLinkAtTheEndOfWhatIsFree) {
  StepContacts step;
  step.links = {contactOf(0, Verdict::Contact, 0.5), contactOf(1, Verdict::Undecided, 0.4)};
  step.links[1].toi = 1.0;  // says nothing of a link that is undecided
  EXPECT_EQ(reported(step), (std::vector<LinkId>{1, 0}));
}

// Oracle: each link that is not clear is there once, and none is before one that is earlier, or as
// early with a lower number.
TEST(Reported, HasEveryLinkThatIsNotClearInOrder) {
  std::vector<LinkId> links{7, 7, 7};  // of a step before
  for (int i = 0; i < 300; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    StepContacts step;
    const int count = random.below(20);
    for (LinkId link = 0; link < count; ++link) {
      const auto verdict = static_cast<Verdict>(random.below(4));
      step.links.push_back(contactOf(link, verdict, 0.25 * random.below(4)));
    }
    listReported(step.links.data(), step.links.size(), links);
    EXPECT_EQ(links, reported(step));
    const auto expected = std::count_if(step.links.begin(), step.links.end(),
                                        [](const auto& c) { return c.verdict != Verdict::Clear; });
    ASSERT_EQ(static_cast<std::ptrdiff_t>(links.size()), expected);
    for (std::size_t k = 0; k < links.size(); ++k) {
      const LinkContact& contact = step.links[static_cast<std::size_t>(links[k])];
      EXPECT_NE(contact.verdict, Verdict::Clear);
      if (k == 0) continue;
      const LinkContact& before = step.links[static_cast<std::size_t>(links[k - 1])];
      EXPECT_TRUE(before.freeUntil < contact.freeUntil ||
                  (before.freeUntil == contact.freeUntil && before.link < contact.link));
    }
  }
}

TEST(UndecidedContact, ClaimsNothingButThatTheLinkIsFreeUntilThen) {
  const LinkContact contact = undecidedContact(4, 0.25, UndecidedReason::AfterFirst);
  EXPECT_EQ(contact.link, 4);
  EXPECT_EQ(contact.verdict, Verdict::Undecided);
  EXPECT_EQ(contact.reason, UndecidedReason::AfterFirst);
  EXPECT_EQ(contact.freeUntil, 0.25);
  EXPECT_EQ(contact.toi, 0.25);
  EXPECT_EQ(contact.triangle, -1);
  EXPECT_EQ(contact.lss, -1);
}

TEST(ContactFields, NameEveryMemberOnce) {
  std::set<std::string> names;
  for (const ContactField& field : kContactFields) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_GT(std::string(field.meaning).size(), 3U) << field.name;
    for (const ContactField& other : kContactFields) {
      // The object is told by the triangle.
      const bool areWords = std::string(field.name) == "object" ||
                            std::string(other.name) == "object" || &field == &other;
      EXPECT_TRUE(areWords || field.member != other.member) << field.name << " " << other.name;
    }
  }
}

/// The bytes of the members that the list has; a member that it lacks leaves a gap in them.
std::size_t listedBytes() {
  const LinkContact contact;
  std::set<const void*> seen;
  std::size_t bytes = 0;
  for (const ContactField& field : kContactFields) {
    std::visit(
        [&](auto member) {
          if (seen.insert(&(contact.*member)).second) bytes += sizeof(contact.*member);
        },
        field.member);
  }
  return bytes;
}

TEST(ContactFields, LeaveNoMemberOut) {
  // What is left is what aligns the doubles, and the end.
  EXPECT_GT(listedBytes() + alignof(double), sizeof(LinkContact)) << "name the new member";
  EXPECT_LE(listedBytes(), sizeof(LinkContact));
}

TEST(ContactFields, AreToldOfTheContactsThatHaveThem) {
  const auto told = [](const LinkContact& contact) {
    std::string names;
    for (const ContactField& field : kContactFields) {
      if (isTold(field.use, contact)) names += (names.empty() ? "" : " ") + std::string(field.name);
    }
    return names;
  };
  EXPECT_EQ(told(contactOf(0, Verdict::Clear, 1.0)), "link verdict");
  EXPECT_EQ(told(undecidedContact(0, 0.5, UndecidedReason::Gap)), "link verdict free_until reason");
  LinkContact contact = contactOf(0, Verdict::Contact, 0.5);
  EXPECT_EQ(told(contact), "link verdict toi separation point on_link normal triangle object");
  contact.linkTriangle = 0;
  contact.verdict = Verdict::StartsInContact;
  EXPECT_EQ(told(contact),
            "link verdict toi separation penetration point on_link normal triangle object "
            "link_triangle link_feature scene_feature");
}

}  // namespace
}  // namespace foretouch
