// network/wire/wire_fields.h: a message's fields as one list: for each field its name in lines of
// JSON, its place in the message, its place in the lcm-gen type, and which values are legal. A
// reader checks every value before it hands it on, and what a list writes it reads. Code that
// writes a message by names has them from here, and leaves out a field without a name.
//
// The same list serves a message's head, whose fields stand alone, and its rows (contacts, joints),
// whose fields stand in one vector each.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "lss/index.h"
#include "network/wire/codec_lcm.h"

namespace foretouch::wire {

// What is legal.

/// Every value.
struct Any {
  template <typename Value>
  Reject operator()(const Value&) const {
    return Reject::None;
  }
};
inline constexpr Any kAny;
/// Every value, of which people see the 16 hexadecimal digits.
struct Hash : Any {};
inline constexpr Hash kHash;

/// Whole numbers from `least` to `most`.
struct Whole {
  std::int64_t least = 0, most = kMaxWireInteger;
  Reject otherwise = Reject::OutOfRange;

  Reject operator()(std::int64_t value) const {
    return value >= least && value <= most ? Reject::None : otherwise;
  }
};
inline constexpr Whole kWhole, kFlag{0, 1};
inline constexpr Whole kKnownFlags{0, kKnownJointFlags};
/// An enumeration's values, from 0 to below `count`.
constexpr Whole codeBelow(std::int64_t count) {
  return {0, count - 1};
}
/// A number of a link, a body, a triangle.
constexpr Whole indexFrom(std::int64_t least, std::int64_t most = kMaxWireInteger) {
  return {least, most, Reject::BadIndex};
}

/// Finite numbers from `least` to `most`.
struct Real {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();

  Reject operator()(double value) const {
    if (!std::isfinite(value)) return Reject::NonFinite;
    return value >= least && value <= most ? Reject::None : Reject::OutOfRange;
  }
  Reject operator()(const Eigen::Vector3d& vector) const {
    if (!vector.allFinite()) return Reject::NonFinite;
    const bool isInside = vector.minCoeff() >= least && vector.maxCoeff() <= most;
    return isInside ? Reject::None : Reject::OutOfRange;
  }
};
inline constexpr Real kFinite, kNotNegative{0.0}, kFraction{0.0, 1.0};

/// A vector: finite, and no longer than a unit vector, but for rounding.
struct Unit {
  Reject operator()(const Eigen::Vector3d& vector) const {
    constexpr double kMost = 1.0 + 1e-6;
    if (!vector.allFinite()) return Reject::NonFinite;
    return vector.norm() <= kMost ? Reject::None : Reject::OutOfRange;
  }
};
inline constexpr Unit kUnit;

/// A rotation.
struct Turn {
  Reject operator()(const Quaternion& rotation) const {
    if (!rotation.coeffs().allFinite()) return Reject::NonFinite;
    return unitQuaternion(rotation) ? Reject::None : Reject::NonUnit;
  }
};
inline constexpr Turn kTurn;
inline constexpr Real kCoordinate{-kMaxCoordinate, kMaxCoordinate};

/// What a joint may be called.
struct JointName {
  Reject operator()(const std::string& name) const {
    return nameProblem(name) ? Reject::BadName : Reject::None;
  }
};
inline constexpr JointName kJointName;

// Where a value stands.

/// A member of a member.
template <typename Outer, typename Inner>
struct Path {
  Outer outer;
  Inner inner;
};
template <typename Outer, typename Inner>
constexpr Path<Outer, Inner> in(Outer outer, Inner inner) {
  return {outer, inner};
}

/// What a list is about, where it stands for itself and not in a row.
struct Self {};
template <typename Inner>
constexpr Inner in(Self, Inner inner) {
  return inner;
}

template <typename Object, typename Value, typename Owner>
constexpr auto& at(Object& object, Value Owner::*member) {
  return object.*member;
}
template <typename Object, typename Outer, typename Inner>
constexpr auto& at(Object& object, const Path<Outer, Inner>& path) {
  return at(at(object, path.outer), path.inner);
}

/// The place in the lcm-gen type of a field that stands alone.
struct Alone {};

template <typename Wire, typename Member>
auto& cell(Wire& wire, Member member, Alone) {
  return wire.*member;
}
template <typename Wire, typename Member>
auto& cell(Wire& wire, Member member, std::size_t row) {
  return (wire.*member)[row];
}

template <typename Value, typename Given>
void assign(const Given& given, Value& value) {
  if constexpr (std::is_same_v<Value, Given>) {
    value = given;  // keeps a text's memory
  } else {
    value = static_cast<Value>(given);
  }
}

/// One value: whole numbers, flags and enumerations as the wire's own type has them.
template <typename Member, typename Wired, typename Rule>
struct Field {
  const char* name;
  Member member;
  Wired wired;
  Rule rule;

  template <typename Wire, typename Place, typename Message>
  Reject read(const Wire& wire, Place place, Message& message) const {
    const auto& value = cell(wire, wired, place);
    const Reject reject = rule(value);
    if (reject == Reject::None) assign(value, at(message, member));
    return reject;
  }
  template <typename Message, typename Place, typename Wire>
  void write(const Message& message, Place place, Wire& wire) const {
    assign(at(message, member), cell(wire, wired, place));
  }
  template <typename Wire>
  void resize(std::size_t rows, Wire& wire) const {
    (wire.*wired).resize(rows);
  }
};
template <typename Member, typename Wired, typename Rule>
constexpr Field<Member, Wired, Rule> field(const char* name, Member member, Wired wired,
                                           Rule rule) {
  return {name, member, wired, rule};
}

/// An Eigen::Vector3d as three values, or a Quaternion as four: w, x, y, z.
template <typename Member, typename Wired, std::size_t kNum, typename Rule>
struct Numbers {
  const char* name;
  Member member;
  std::array<Wired, kNum> wired;
  Rule rule;

  template <typename Wire, typename Place, typename Message>
  Reject read(const Wire& wire, Place place, Message& message) const {
    const auto number = [&](std::size_t k) { return cell(wire, wired[k], place); };
    auto& value = at(message, member);
    if constexpr (kNum == 4) {
      value = Quaternion(number(0), number(1), number(2), number(3));
    } else {
      value = Eigen::Vector3d(number(0), number(1), number(2));
    }
    return rule(value);
  }
  template <typename Message, typename Place, typename Wire>
  void write(const Message& message, Place place, Wire& wire) const {
    const auto& value = at(message, member);
    if constexpr (kNum == 4) {
      const std::array<double, kNum> values{value.w(), value.x(), value.y(), value.z()};
      for (std::size_t k = 0; k < kNum; ++k) cell(wire, wired[k], place) = values[k];
    } else {
      for (std::size_t k = 0; k < kNum; ++k) {
        cell(wire, wired[k], place) = value[static_cast<Eigen::Index>(k)];
      }
    }
  }
  template <typename Wire>
  void resize(std::size_t rows, Wire& wire) const {
    for (const Wired column : wired) (wire.*column).resize(rows);
  }
};
template <typename Member, typename Wired, typename Rule>
constexpr Numbers<Member, Wired, 3, Rule> field(const char* name, Member member, Wired x, Wired y,
                                                Wired z, Rule rule) {
  return {name, member, {x, y, z}, rule};
}
template <typename Member, typename Wired, typename Rule>
constexpr Numbers<Member, Wired, 4, Rule> field(const char* name, Member member, Wired w, Wired x,
                                                Wired y, Wired z, Rule rule) {
  return {name, member, {w, x, y, z}, rule};
}

/// A field that is not reported by name.
template <typename Member, typename... Rest,
          typename = std::enable_if_t<!std::is_convertible_v<Member, const char*>>>
constexpr auto field(Member member, Rest... rest) {
  return field("", member, rest...);
}

/// A field that lines have only where it is not what it is at first: a flag that is set, a count
/// that is not 0.
template <typename Told>
struct Sparse : Told {};
template <typename Member, typename Wired, typename Rule>
constexpr Sparse<Field<Member, Wired, Rule>> sparse(const char* name, Member member, Wired wired,
                                                    Rule rule) {
  return {field(name, member, wired, rule)};
}

/// Which pose of which avatar a message is about.
template <typename Message, typename Wire, typename Rule = Any>
constexpr auto poseKey(Rule avatar = {}) {
  return std::make_tuple(field("avatar", &Message::avatar, &Wire::avatar, avatar),
                         field("session", &Message::session, &Wire::session, kWhole),
                         field("sequence", &Message::sequence, &Wire::sequence, kWhole),
                         field("utime", &Message::utimeUs, &Wire::utime, kWhole));
}

/// What no replay repeats: when it was received and sent, and the time that it took.
template <typename Wire, typename Message>
constexpr auto stamps(const char* name, double Message::*member, double Wire::*wired) {
  return std::make_tuple(
      field("receive_utime", &Message::receiveUtimeUs, &Wire::receive_utime, kWhole),
      field("send_utime", &Message::sendUtimeUs, &Wire::send_utime, kWhole),
      field(name, member, wired, kNotNegative));
}

// Whole lists of fields (tuples of the above).

/// The first reason against a value, in the list's order; `message` has the fields before it.
template <typename Wire, typename Message, typename Fields, typename Place = Alone>
[[nodiscard]] Reject read(const Wire& wire, const Fields& fields, Message& message,
                          Place place = {}) {
  Reject reject = Reject::None;
  std::apply(
      [&](const auto&... each) {
        static_cast<void>((((reject = each.read(wire, place, message)) == Reject::None) && ...));
      },
      fields);
  return reject;
}

template <typename Message, typename Fields, typename Wire, typename Place = Alone>
void write(const Message& message, const Fields& fields, Wire& wire, Place place = {}) {
  std::apply([&](const auto&... each) { (each.write(message, place, wire), ...); }, fields);
}

inline bool isSame(double x, double y) {
  return x == y && std::signbit(x) == std::signbit(y);
}
inline bool isSame(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  return isSame(x.x(), y.x()) && isSame(x.y(), y.y()) && isSame(x.z(), y.z());
}
template <typename Value>
bool isSame(const Value& x, const Value& y) {
  return x == y;
}

/// Bit for bit.
template <typename Record, typename Fields>
bool areSame(const Record& x, const Record& y, const Fields& fields) {
  return std::apply(
      [&](const auto&... each) { return (isSame(at(x, each.member), at(y, each.member)) && ...); },
      fields);
}

/// Makes room for as many rows, and says so in `count`.
template <typename Fields, typename Wire>
void resize(std::size_t rows, const Fields& fields, std::int32_t Wire::*count, Wire& wire) {
  wire.*count = static_cast<std::int32_t>(rows);
  std::apply([&](const auto&... each) { (each.resize(rows, wire), ...); }, fields);
}

/// Nothing else can be wrong with a row.
inline constexpr auto kAnyRow = [](const auto&, std::size_t) { return Reject::None; };

/// As many rows as `count` says; `check(row, i)` says what else is wrong with one.
template <typename Wire, typename Fields, typename List, typename Check>
[[nodiscard]] Reject readRows(const Wire& wire, const Fields& fields, std::int32_t Wire::*count,
                              List& list, const Check& check) {
  list.resize(countOf(wire.*count));
  for (std::size_t i = 0; i < list.size(); ++i) {
    Reject reject = read(wire, fields, list[i], i);
    if (reject == Reject::None) reject = check(list[i], i);
    if (reject != Reject::None) return reject;
  }
  return Reject::None;
}

template <typename List, typename Fields, typename Wire>
void writeRows(const List& list, const Fields& fields, std::int32_t Wire::*count, Wire& wire) {
  resize(list.size(), fields, count, wire);
  for (std::size_t i = 0; i < list.size(); ++i) write(list[i], fields, wire, i);
}

/// The lcm-gen type in which a thread's messages are made: it keeps its memory, for a stream has
/// hundreds of messages per second.
template <typename Wire>
[[nodiscard]] Wire& scratch() {
  static thread_local Wire wire;
  return wire;
}

}  // namespace foretouch::wire
