#include "network/wire/payload_check.h"

#include <cstring>
#include <foretouch/body_t.hpp>
#include <foretouch/contacts_t.hpp>
#include <foretouch/events_t.hpp>
#include <foretouch/person_t.hpp>
#include <foretouch/pose_t.hpp>
#include <foretouch/pushes_t.hpp>
#include <foretouch/rigid_pose_t.hpp>
#include <foretouch/skeleton_t.hpp>
#include <foretouch/solid_t.hpp>
#include <foretouch/speaker_t.hpp>
#include <foretouch/status_t.hpp>

#include "lss/index.h"

namespace foretouch {
namespace {

/// A place in a payload that cannot leave it. Integers are big-endian.
class Cursor {
 public:
  explicit Cursor(ByteView bytes) : at_(bytes.data), left_(bytes.size) {}

  [[nodiscard]] const std::uint8_t* at() const { return at_; }
  [[nodiscard]] std::size_t left() const { return left_; }

  [[nodiscard]] bool skip(std::size_t bytes) {
    if (bytes > left_) return false;
    at_ += bytes;
    left_ -= bytes;
    return true;
  }

  template <typename Integer>
  [[nodiscard]] bool read(Integer& integer) {
    const std::uint8_t* const from = at_;
    if (!skip(sizeof(Integer))) return false;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) bits = bits << 8 | from[i];
    integer = static_cast<Integer>(bits);
    return true;
  }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
};

/// One or more fields of a type, in the order of its bytes.
struct Field {
  enum class Kind : std::uint8_t {
    Fixed,  ///< `size` bytes.
    Count,  ///< An int32 up to kMaxListed: the length of the next lists.
    List,   ///< `size` bytes, as often as the last count says.
    Table,  ///< The same, as often as the last count times the one before says.
    Text,   ///< At most `size` bytes and its NUL, after their number.
    Texts,  ///< As often as the last count says.
  };
  Kind kind;
  std::size_t size;
};

constexpr std::size_t kInt8 = 1, kByte = 1, kInt32 = 4, kInt64 = 8, kDouble = 8;

constexpr Field fixed(std::size_t size) {
  return {Field::Kind::Fixed, size};
}
constexpr Field count() {
  return {Field::Kind::Count, 0};
}
constexpr Field list(std::size_t size) {
  return {Field::Kind::List, size};
}
constexpr Field table(std::size_t size) {
  return {Field::Kind::Table, size};
}
constexpr Field text() {
  return {Field::Kind::Text, kMaxTextBytes};
}
constexpr Field texts(std::size_t limit) {
  return {Field::Kind::Texts, limit};
}

// Each type after its version, in the order of network/lcm.
constexpr Field kSkeletonFields[] = {
    fixed(kInt32 + 2 * kInt64 + kInt32 + kInt64),  // avatar, session, send_utime, generation, hash
    text(),                                        // source
    fixed(kDouble),                                // rate
    count(),
    texts(kMaxNameBytes),                       // names
    list(kInt32 + 3 * kDouble + 4 * kDouble)};  // parents, offsets, rotations

constexpr Field kPoseFields[] = {
    fixed(kInt32 + 5 * kInt64),  // avatar, session, sequence, utime, send_utime, skeleton_hash
    count(),
    list(kInt32 + kByte + 4 * kDouble),    // joints, flags, rotations
    count(), list(kInt32 + 3 * kDouble)};  // translated_joints, translations

constexpr Field kContactsFields[] = {
    fixed(kInt32 + 6 * kInt64),       // avatar, session, sequences, utimes, skeleton_hash
    fixed(kInt8 + kInt64 + kDouble),  // kind, lost, tolerance
    text(),                           // fidelity
    fixed(kInt64),                    // work_budget
    count(),
    list(kByte),  // verdicts
    count(),
    list(kInt32),                  // links
    texts(kMaxNameBytes),          // link_names
    list(kByte + 3 * kDouble),     // reasons, free_until, separation, penetration
    list(9 * kDouble + kInt32),    // witness points, normals, triangles
    texts(kMaxTextBytes),          // objects
    list(kInt32 + 2 * kByte),      // link_triangles, link_features, scene_features
    fixed(2 * kInt64 + kDouble)};  // receive_utime, send_utime, query_us

constexpr Field kSolidFields[] = {
    fixed(kInt32 + 3 * kInt64),               // avatar, session, sequence, utime
    fixed(kInt8 + 3 * kInt64),                // kind, lost, step_us, avatar_hash
    fixed(3 * kDouble + kInt64),              // skin, tolerance, catch_up, work_budget
    fixed(4 * kInt8 + 3 * kDouble + kInt64),  // state to appeared, lengths, snap_in_us
    count(),
    list(kByte + kDouble),  // joint_states, link_deviation
    count(),
    list(kDouble),             // times
    table((4 + 3) * kDouble),  // rotations, translations
    count(),
    list(kInt32),                  // links
    texts(kMaxNameBytes),          // link_names
    list(2 * kInt32),              // lss, triangles
    texts(kMaxTextBytes),          // objects
    list(kInt32 + 9 * kDouble),    // others, points, normals, gap, push, slip_speed
    fixed(kInt32 + 7 * kInt64),    // contacts_left_out, counters
    fixed(2 * kInt64 + kDouble)};  // receive_utime, send_utime, solid_us

constexpr Field kStatusFields[] = {
    fixed(2 * kInt64),  // utime, start_utime
    text(),             // build
    text(),             // scene
    fixed(2 * kInt32),  // num_avatars, num_workers
    fixed(6 * kInt64),  // received, answered, rejected, lost, gaps, waiting
    count(),
    texts(kMaxTextBytes),              // reasons
    list(kInt64),                      // counts
    fixed(3 * kInt64 + 6 * kDouble)};  // failures and drops, latencies

constexpr Field kSpeakerFields[] = {
    fixed(kInt32 + kInt64 + 2 * kInt32)};  // avatar, utime, address, port

constexpr Field kBodyFields[] = {
    fixed(kInt32 + 4 * kInt64 + 2 * kInt8),  // body, session, sequence, utimes, kind, state
    text(),                                  // shape
    fixed(kInt64 + 2 * kInt32 + kInt8),      // shape_hash, carried_by, carried_link, moves_in_frame
    fixed(7 * kDouble + kInt64)};            // rotation, position, since_utime

constexpr Field kRigidPoseFields[] = {fixed(4 * kInt64),  // session, sequence, utime, send_utime
                                      count(), list(kInt32 + kByte + 7 * kDouble)};

constexpr Field kEventsFields[] = {
    fixed(4 * kInt64 + kInt8 + kDouble),  // timeline to tolerance
    count(),
    list(kInt32 + kInt64 + kByte),  // bodies, known_until, waiting
    count(),
    list(2 * kInt32 + kByte + 2 * kInt64),  // unknown
    count(),
    list(4 * kByte + 2 * (kInt64 + kDouble)),  // kinds to since_fraction
    list(9 * kInt32 + 18 * kDouble + kByte),   // sides, object, points to numbers_of_points
    count(),
    list(7 * kDouble),             // near points
    fixed(2 * kInt64 + kDouble)};  // receive_utime, send_utime, world_us

constexpr Field kPushesFields[] = {
    fixed(kInt32 + 5 * kInt64 + kInt8),  // avatar to assumed
    count(),
    list(kInt32),                    // links
    texts(kMaxNameBytes),            // link_names
    list(3 * kInt32 + 9 * kDouble),  // lss, bodies, triangles, points, normals, gap to slip_speed
    fixed(kInt32),                   // contacts_left_out
    count(),
    list(2 * kInt32),                       // crushers, crushed_links
    texts(kMaxNameBytes),                   // crushed_names
    list(kInt64 + kByte + kDouble),         // crushed_since, over, depth
    fixed(kInt32 + 2 * kInt64 + kDouble)};  // crushes_left_out, receive_utime, send_utime, tick_us

constexpr Field kPersonFields[] = {
    fixed(kInt32 + 3 * kInt64),       // avatar, session, sequence, utime
    fixed(kInt8 + kInt64 + kDouble),  // between, bounds_hash, resolution
    fixed(kInt8 + 4 * kInt64),        // kind, the step
    count(),
    list(kByte + kInt64),  // verdicts, not_before
    fixed(kInt64),         // ahead_us
    count(),
    list(kInt32),                        // links
    texts(kMaxNameBytes),                // link_names
    list(kInt32),                        // triangles
    texts(kMaxTextBytes),                // objects
    list(kInt32 + kByte + 5 * kDouble),  // others, claims, instants, growth
    fixed(kInt32),                       // brackets_left_out
    count(),
    list(kInt32 + kByte + kDouble),  // broken_links, broken_claims, beyond
    fixed(2 * kInt64 + kDouble)};    // receive_utime, send_utime, person_us

Reject checkText(Cursor& cursor, std::size_t limit) {
  std::int32_t length = 0;  // with its NUL
  if (!cursor.read(length) || length < 1) return Reject::Length;
  const auto bytes = countOf(length);
  if (bytes - 1 > limit) return Reject::Limit;
  const std::uint8_t* const first = cursor.at();
  if (!cursor.skip(bytes)) return Reject::Length;
  // An inner NUL would end the text early in other languages, and in our encoder.
  return std::memchr(first, 0, bytes) == first + (bytes - 1) ? Reject::None : Reject::Length;
}

Reject checkCount(Cursor& cursor, std::size_t& counted) {
  std::int32_t number = 0;
  if (!cursor.read(number)) return Reject::Length;
  if (number < 0 || number > kMaxListed) return Reject::Limit;
  counted = static_cast<std::size_t>(number);
  return Reject::None;
}

/// The last count before a field, and the one before that.
struct Counts {
  std::size_t last = 0, before = 0;
};

Reject checkField(const Field& field, Cursor& cursor, Counts& counts) {
  const auto skip = [&](std::size_t bytes) {
    return cursor.skip(bytes) ? Reject::None : Reject::Length;
  };
  switch (field.kind) {
    case Field::Kind::Fixed: return skip(field.size);
    case Field::Kind::List: return skip(counts.last * field.size);
    case Field::Kind::Table: return skip(counts.last * counts.before * field.size);
    case Field::Kind::Count: {
      counts.before = counts.last;
      return checkCount(cursor, counts.last);
    }
    case Field::Kind::Text: return checkText(cursor, field.size);
    case Field::Kind::Texts: {
      Reject reject = Reject::None;
      for (std::size_t i = 0; i < counts.last && reject == Reject::None; ++i) {
        reject = checkText(cursor, field.size);
      }
      return reject;
    }
  }
  return Reject::Length;
}

template <std::size_t n>
Reject checkFields(const Field (&fields)[n], Cursor cursor) {
  Counts counts;
  for (const Field& field : fields) {
    const Reject reject = checkField(field, cursor, counts);
    if (reject != Reject::None) return reject;
  }
  return cursor.left() == 0 ? Reject::None : Reject::Length;
}

std::int64_t fingerprintOf(PayloadType type) {
  switch (type) {
    case PayloadType::Skeleton: return skeleton_t::getHash();
    case PayloadType::Pose: return pose_t::getHash();
    case PayloadType::Contacts: return contacts_t::getHash();
    case PayloadType::Solid: return solid_t::getHash();
    case PayloadType::Status: return status_t::getHash();
    case PayloadType::Speaker: return speaker_t::getHash();
    case PayloadType::Body: return body_t::getHash();
    case PayloadType::RigidPose: return rigid_pose_t::getHash();
    case PayloadType::Events: return events_t::getHash();
    case PayloadType::Pushes: return pushes_t::getHash();
    case PayloadType::Person: return person_t::getHash();
  }
  return 0;
}

}  // namespace

Reject checkPayload(PayloadType type, ByteView payload) {
  if (payload.size > kMaxMessageBytes) return Reject::Limit;
  Cursor cursor(payload);
  std::int64_t fingerprint = 0;
  std::int16_t version = 0;
  if (!cursor.read(fingerprint)) return Reject::Length;
  if (fingerprint != fingerprintOf(type)) return Reject::Fingerprint;
  if (!cursor.read(version)) return Reject::Length;
  if (version != kMessageVersion) return Reject::Version;
  switch (type) {
    case PayloadType::Skeleton: return checkFields(kSkeletonFields, cursor);
    case PayloadType::Pose: return checkFields(kPoseFields, cursor);
    case PayloadType::Contacts: return checkFields(kContactsFields, cursor);
    case PayloadType::Solid: return checkFields(kSolidFields, cursor);
    case PayloadType::Status: return checkFields(kStatusFields, cursor);
    case PayloadType::Speaker: return checkFields(kSpeakerFields, cursor);
    case PayloadType::Body: return checkFields(kBodyFields, cursor);
    case PayloadType::RigidPose: return checkFields(kRigidPoseFields, cursor);
    case PayloadType::Events: return checkFields(kEventsFields, cursor);
    case PayloadType::Pushes: return checkFields(kPushesFields, cursor);
    case PayloadType::Person: return checkFields(kPersonFields, cursor);
  }
  return Reject::Length;
}

}  // namespace foretouch
