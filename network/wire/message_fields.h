// network/wire/message_fields.h: the fields of the messages of messages.h (wire_fields.h). The
// codecs read and write by these lists; lines of JSON and what compares messages go by them, too.
#pragma once

#include <foretouch/contacts_t.hpp>
#include <foretouch/person_t.hpp>
#include <foretouch/pose_t.hpp>
#include <foretouch/skeleton_t.hpp>
#include <foretouch/solid_t.hpp>
#include <foretouch/status_t.hpp>
#include <limits>
#include <string>
#include <tuple>

#include "network/wire/messages.h"
#include "network/wire/wire_fields.h"

namespace foretouch::wire {

// Skeletons and poses.

inline constexpr auto kSkeleton = std::make_tuple(
    field("avatar", &SkeletonMessage::avatar, &skeleton_t::avatar, kAny),
    field("session", &SkeletonMessage::session, &skeleton_t::session, kWhole),
    field("send_utime", &SkeletonMessage::sendUtimeUs, &skeleton_t::send_utime, kWhole),
    field("generation", &SkeletonMessage::generation, &skeleton_t::generation, kWhole),
    field("hash", &SkeletonMessage::hash, &skeleton_t::hash, kHash),
    field("source", &SkeletonMessage::source, &skeleton_t::source, kAny),
    field("rate", &SkeletonMessage::rateHz, &skeleton_t::rate, kNotNegative));

inline constexpr auto kSkeletonJoint = std::make_tuple(
    field("name", &RawJoint::name, &skeleton_t::names, kJointName),
    field("parent", &RawJoint::parent, &skeleton_t::parents, kAny),
    field("offset", &RawJoint::offset, &skeleton_t::offset_x, &skeleton_t::offset_y,
          &skeleton_t::offset_z, kCoordinate),
    field("rotation", &RawJoint::rotation, &skeleton_t::rotation_w, &skeleton_t::rotation_x,
          &skeleton_t::rotation_y, &skeleton_t::rotation_z, kTurn));

inline constexpr auto kPose = std::tuple_cat(
    poseKey<PoseMessage, pose_t>(),
    std::make_tuple(
        field("send_utime", &PoseMessage::sendUtimeUs, &pose_t::send_utime, kWhole),
        field("skeleton_hash", &PoseMessage::skeletonHash, &pose_t::skeleton_hash, kHash)));

inline constexpr auto kPoseJoint =
    std::make_tuple(field("joint", &PoseJoint::joint, &pose_t::joints, kAny),
                    field("flags", &PoseJoint::flags, &pose_t::flags, kKnownFlags));
/// Meaningless unless kJointValid.
inline constexpr auto kPoseRotation =
    std::make_tuple(field("rotation", &PoseJoint::rotation, &pose_t::rotation_w,
                          &pose_t::rotation_x, &pose_t::rotation_y, &pose_t::rotation_z, kTurn));
inline constexpr auto kMovedJoint =
    std::make_tuple(field("joint", &PoseTranslation::joint, &pose_t::translated_joints, kAny));
inline constexpr auto kMovedPlace =
    std::make_tuple(field("translation", &PoseTranslation::translation, &pose_t::translation_x,
                          &pose_t::translation_y, &pose_t::translation_z, kCoordinate));

// Contacts.

inline constexpr auto kContactsKey = std::make_tuple(
    field("avatar", &ContactsMessage::avatar, &contacts_t::avatar, kAny),
    field("session", &ContactsMessage::session, &contacts_t::session, kWhole),
    field("sequence_to", &ContactsMessage::sequenceTo, &contacts_t::sequence_to, kWhole));
/// What any answer to the same pose has by the same options; `fidelity`, too.
inline constexpr auto kContactsTolerance = std::make_tuple(
    field("tolerance", &ContactsMessage::tolerance, &contacts_t::tolerance, kNotNegative));
inline constexpr auto kContactsOptions = std::make_tuple(
    field("work_budget", &ContactsMessage::workBudget, &contacts_t::work_budget, kWhole),
    field("skeleton_hash", &ContactsMessage::skeletonHash, &contacts_t::skeleton_hash, kHash),
    field("kind", &ContactsMessage::kind, &contacts_t::kind, codeBelow(kNumStepKinds)));
inline constexpr auto kContactsStep = std::make_tuple(
    field("sequence_from", &ContactsMessage::sequenceFrom, &contacts_t::sequence_from, kWhole),
    field("utime_from", &ContactsMessage::utimeFromUs, &contacts_t::utime_from, kWhole),
    field("utime_to", &ContactsMessage::utimeToUs, &contacts_t::utime_to, kWhole),
    field("lost", &ContactsMessage::lost, &contacts_t::lost, kWhole));
inline constexpr auto kContactsStamps =
    stamps("query_us", &ContactsMessage::queryUs, &contacts_t::query_us);

template <typename Member>
constexpr auto ofContact(Member member) {
  return in(&AnsweredContact::contact, member);
}
inline constexpr auto kContactLink =
    std::make_tuple(field(ofContact(&LinkContact::link), &contacts_t::links, indexFrom(0)),
                    field("link", &AnsweredContact::linkName, &contacts_t::link_names, kJointName));
inline constexpr int kNumFeatures = static_cast<int>(FeatureKind::Face) + 1;
inline constexpr auto kContact = std::make_tuple(
    field("reason", ofContact(&LinkContact::reason), &contacts_t::reasons,
          codeBelow(kNumUndecidedReasons)),
    field("free_until", ofContact(&LinkContact::freeUntil), &contacts_t::free_until, kFraction),
    field("separation", ofContact(&LinkContact::separation), &contacts_t::separation, kNotNegative),
    field("penetration", ofContact(&LinkContact::penetration), &contacts_t::penetration,
          kNotNegative),
    field("triangle", ofContact(&LinkContact::triangle), &contacts_t::triangles, Whole{-1}),
    field("object", &AnsweredContact::objectName, &contacts_t::objects, kAny),
    field("point", ofContact(&LinkContact::p_WScene), &contacts_t::point_x, &contacts_t::point_y,
          &contacts_t::point_z, kFinite),
    field("on_link", ofContact(&LinkContact::p_WLink), &contacts_t::on_link_x,
          &contacts_t::on_link_y, &contacts_t::on_link_z, kFinite),
    field("normal", ofContact(&LinkContact::nhat_SL_W), &contacts_t::normal_x,
          &contacts_t::normal_y, &contacts_t::normal_z, kFinite),
    field("link_triangle", ofContact(&LinkContact::linkTriangle), &contacts_t::link_triangles,
          Whole{-1}),
    field("link_feature", ofContact(&LinkContact::linkFeature), &contacts_t::link_features,
          codeBelow(kNumFeatures)),
    field("scene_feature", ofContact(&LinkContact::sceneFeature), &contacts_t::scene_features,
          codeBelow(kNumFeatures)));

// Solid avatars.

inline constexpr auto kSolidKey = poseKey<SolidMessage, solid_t>();
inline constexpr auto kSolidOptions =
    std::make_tuple(field("kind", &SolidMessage::kind, &solid_t::kind, codeBelow(kNumStepKinds)),
                    field("lost", &SolidMessage::lost, &solid_t::lost, kWhole),
                    field("step_us", &SolidMessage::stepUs, &solid_t::step_us, kWhole),
                    field("avatar_hash", &SolidMessage::avatarHash, &solid_t::avatar_hash, kHash),
                    field("skin", &SolidMessage::skin, &solid_t::skin, kNotNegative),
                    field("tolerance", &SolidMessage::tolerance, &solid_t::tolerance, kNotNegative),
                    field("catch_up", &SolidMessage::catchUp, &solid_t::catch_up, kNotNegative),
                    field("work_budget", &SolidMessage::workBudget, &solid_t::work_budget, kWhole));
/// For whatever holds what is shown at one tick: this message, a page's step, a line of a file.
template <typename Shown>
constexpr auto shownState() {
  return std::make_tuple(field("state", &Shown::state, &solid_t::state, codeBelow(kNumSolidStates)),
                         field("limit", &Shown::limit, &solid_t::limit, codeBelow(kNumSolidLimits)),
                         field("certified", &Shown::isCertified, &solid_t::certified, kFlag));
}
template <typename Shown>
constexpr auto shownLengths() {
  return std::make_tuple(field("deviation", &Shown::deviation, &solid_t::deviation, kNotNegative),
                         field("lift", &Shown::lift, &solid_t::lift, kNotNegative),
                         field("clearance", &Shown::clearance, &solid_t::clearance, kNotNegative));
}
inline constexpr auto kSolidState = std::tuple_cat(
    shownState<SolidMessage>(),
    std::make_tuple(sparse("appeared", &SolidMessage::hasAppeared, &solid_t::appeared, kFlag)));
inline constexpr auto kSolidLengths = std::tuple_cat(
    shownLengths<SolidMessage>(), std::make_tuple(sparse("snap_in_us", &SolidMessage::snapInUs,
                                                         &solid_t::snap_in_us, Whole{-1})));
inline constexpr auto kSolidLeftOut = std::make_tuple(sparse(
    "contacts_left_out", &SolidMessage::contactsLeftOut, &solid_t::contacts_left_out, kWhole));
inline constexpr auto kSolidStamps = stamps("solid_us", &SolidMessage::solidUs, &solid_t::solid_us);

template <typename Outer>
constexpr auto solidCounters(Outer of) {
  constexpr Whole kCount{0, std::numeric_limits<std::uint32_t>::max()};
  return std::make_tuple(
      field("queries", in(of, &SolidCounters::queries), &solid_t::queries, kCount),
      field("iterations", in(of, &SolidCounters::iterations), &solid_t::iterations, kCount),
      field("features", in(of, &SolidCounters::features), &solid_t::features, kCount),
      field("rows", in(of, &SolidCounters::rows), &solid_t::rows, kCount),
      field("around_queries", in(of, &SolidCounters::aroundQueries), &solid_t::around_queries,
            kCount),
      field("placing_queries", in(of, &SolidCounters::placingQueries), &solid_t::placing_queries,
            kCount),
      field("work", in(of, &SolidCounters::work), &solid_t::work, kWhole));
}

/// What is pushed, for a row that holds a contact and its link's name: in solid_t and in pushes_t.
template <typename Wire, typename Row, typename Contact>
constexpr auto pushedLink(Contact Row::*contact, std::string Row::*linkName) {
  return std::make_tuple(field(in(contact, &Contact::link), &Wire::links, kAny),
                         field("link", linkName, &Wire::link_names, kJointName),
                         field("lss", in(contact, &Contact::lss), &Wire::lss, indexFrom(-1)));
}
/// Where and how hard.
template <typename Wire, typename Contact, typename Outer>
constexpr auto pushFields(Outer of) {
  return std::make_tuple(
      sparse("triangle", in(of, &Contact::triangle), &Wire::triangles, indexFrom(-1)),
      field("point", in(of, &Contact::p_W), &Wire::point_x, &Wire::point_y, &Wire::point_z,
            kFinite),
      field("normal", in(of, &Contact::nhat_W), &Wire::normal_x, &Wire::normal_y, &Wire::normal_z,
            kUnit),
      field("gap", in(of, &Contact::gap), &Wire::gap, kFinite),
      field("push", in(of, &Contact::push), &Wire::push, kNotNegative),
      field("slip", in(of, &Contact::slipSpeed), &Wire::slip_speed, kNotNegative));
}
/// Lines say whether the other side is an object or an own link.
inline constexpr auto kShownSides = std::tuple_cat(
    pushedLink<solid_t>(&ShownContact::contact, &ShownContact::linkName),
    std::make_tuple(
        field(&ShownContact::otherName, &solid_t::objects, kAny),
        field(in(&ShownContact::contact, &SolidContact::other), &solid_t::others, kAny)));
inline constexpr auto kShownPush = pushFields<solid_t, SolidContact>(&ShownContact::contact);

// Persons.

inline constexpr auto kPersonKey = poseKey<PersonMessage, person_t>();
inline constexpr auto kPersonOptions = std::make_tuple(
    field("between", &PersonMessage::model, &person_t::between,
          codeBelow(person_t::CUBIC_LATE + 1)),
    field("bounds_hash", &PersonMessage::boundsHash, &person_t::bounds_hash, kHash),
    field("resolution", &PersonMessage::resolution, &person_t::resolution, kNotNegative));
inline constexpr auto kPersonStep = std::make_tuple(
    field("kind", &PersonMessage::kind, &person_t::kind, codeBelow(kNumStepKinds)),
    field("sequence_from", &PersonMessage::sequenceFrom, &person_t::sequence_from, kWhole),
    field("sequence_to", &PersonMessage::sequenceTo, &person_t::sequence_to, kWhole),
    field("utime_from", &PersonMessage::utimeFromUs, &person_t::utime_from, kWhole),
    field("utime_to", &PersonMessage::utimeToUs, &person_t::utime_to, kWhole));
inline constexpr auto kPersonAhead =
    std::make_tuple(sparse("ahead_us", &PersonMessage::aheadUs, &person_t::ahead_us, kWhole));
inline constexpr auto kPersonLeftOut = std::make_tuple(sparse(
    "brackets_left_out", &PersonMessage::bracketsLeftOut, &person_t::brackets_left_out, kWhole));
inline constexpr auto kPersonStamps =
    stamps("person_us", &PersonMessage::personUs, &person_t::person_us);

template <typename Member>
constexpr auto ofBracket(Member member) {
  return in(&ToldBracket::bracket, member);
}
/// Lines say whether the other side is an object or an own link.
inline constexpr auto kBracketSides =
    std::make_tuple(field(ofBracket(&LinkBracket::link), &person_t::links, kAny),
                    field("link", &ToldBracket::linkName, &person_t::link_names, kJointName),
                    field(ofBracket(&LinkBracket::other), &person_t::others, kAny),
                    field(&ToldBracket::otherName, &person_t::objects, kAny));
inline constexpr auto kBracketPossible = std::make_tuple(
    sparse("triangle", ofBracket(&LinkBracket::triangle), &person_t::triangles, indexFrom(-1)),
    field("verdict", ofBracket(&LinkBracket::verdict), &person_t::claims,
          Whole{person_t::POSSIBLE, person_t::CERTAIN}),
    field("possible_from", ofBracket(&LinkBracket::possibleFrom), &person_t::possible_from,
          kFraction),
    field("possible_until", ofBracket(&LinkBracket::possibleUntil), &person_t::possible_until,
          kFraction));
inline constexpr auto kBracketCertain = std::make_tuple(
    field("certain_from", ofBracket(&LinkBracket::certainFrom), &person_t::certain_from, kFraction),
    field("certain_until", ofBracket(&LinkBracket::certainUntil), &person_t::certain_until,
          kFraction));
inline constexpr auto kBracketGrowth = std::make_tuple(
    field("growth", ofBracket(&LinkBracket::growth), &person_t::growth, kNotNegative));

inline constexpr auto kBroken =
    std::make_tuple(field("link", &BrokenBound::link, &person_t::broken_links, indexFrom(0)),
                    field("claim", &BrokenBound::claim, &person_t::broken_claims,
                          codeBelow(person_t::BROKEN_AHEAD + 1)),
                    field("beyond", &BrokenBound::beyond, &person_t::beyond, kNotNegative));

// What a service says of itself.

inline constexpr auto kStatus = std::make_tuple(
    field("utime", &StatusMessage::utimeUs, &status_t::utime, kWhole),
    field("start_utime", &StatusMessage::startUtimeUs, &status_t::start_utime, kWhole),
    field("build", &StatusMessage::build, &status_t::build, kAny),
    field("scene", &StatusMessage::scene, &status_t::scene, kAny),
    field("avatars", &StatusMessage::numAvatars, &status_t::num_avatars, kWhole),
    field("workers", &StatusMessage::numWorkers, &status_t::num_workers, kWhole),
    field("received", &StatusMessage::received, &status_t::received, kWhole),
    field("answered", &StatusMessage::answered, &status_t::answered, kWhole),
    field("rejected", &StatusMessage::rejected, &status_t::rejected, kWhole),
    field("lost", &StatusMessage::lost, &status_t::lost, kWhole),
    field("gaps", &StatusMessage::gaps, &status_t::gaps, kWhole),
    field("waiting", &StatusMessage::waiting, &status_t::waiting, kWhole));
inline constexpr auto kStatusReason =
    std::make_tuple(field("reason", &StatusMessage::Count::reason, &status_t::reasons, kAny),
                    field("count", &StatusMessage::Count::count, &status_t::counts, kWhole));
inline constexpr auto kStatusFailures = std::make_tuple(
    field("publish_failures", &StatusMessage::publishFailures, &status_t::publish_failures, kWhole),
    field("journal_failures", &StatusMessage::journalFailures, &status_t::journal_failures, kWhole),
    field("kernel_drops", &StatusMessage::kernelDrops, &status_t::kernel_drops, kWhole));
inline constexpr auto kStatusLatency = std::make_tuple(
    field("p50", &StatusMessage::latencyP50Us, &status_t::latency_p50, kNotNegative),
    field("p99", &StatusMessage::latencyP99Us, &status_t::latency_p99, kNotNegative),
    field("max", &StatusMessage::latencyMaxUs, &status_t::latency_max, kNotNegative));
inline constexpr auto kStatusQuery =
    std::make_tuple(field("p50", &StatusMessage::queryP50Us, &status_t::query_p50, kNotNegative),
                    field("p99", &StatusMessage::queryP99Us, &status_t::query_p99, kNotNegative),
                    field("max", &StatusMessage::queryMaxUs, &status_t::query_max, kNotNegative));

}  // namespace foretouch::wire
