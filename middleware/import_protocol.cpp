#include "middleware/import_protocol.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "middleware/import_text.h"

namespace foretouch::internal {
namespace {

enum FrameType : std::uint32_t { kTotals = 1, kObject, kTriangles, kTrailer, kFailure };

struct Greeting {
  std::array<char, 8> magic = {'F', 'T', 'I', 'M', 'P', 'O', 'R', 'T'};
  std::uint32_t version = 1;
  std::uint32_t byteOrder = 0x01020304;
};
struct FrameHead {
  std::uint32_t type, bytes;
};
struct Trailer {
  std::uint64_t triangles, checksum;
};

using TriangleBytes = std::array<double, 9>;
constexpr std::size_t kTriangleBytes = sizeof(TriangleBytes);
constexpr std::size_t kTrianglesPerFrame = 8192;
constexpr std::uint64_t kChecksumSeed = 0xCBF29CE484222325;
static_assert(kTrianglesPerFrame * kTriangleBytes <= kMaxImportFrameBytes);

template <typename T>
std::string_view bytesOf(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// The value at the start of `bytes`, which must be long enough.
template <typename T>
T valueIn(std::string_view bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

/// Eight bytes a step, as 700 MB of triangles pass through here for ten million of them. The
/// multiplier is odd, so each step is a bijection of the state: a single changed word always shows.
std::uint64_t addToChecksum(std::uint64_t sum, std::string_view bytes) {
  const auto add = [&sum](std::uint64_t word) {
    sum = (sum ^ word) * 0x9E3779B97F4A7C15;
    sum ^= sum >> 32;
  };
  while (bytes.size() >= sizeof(std::uint64_t)) {
    add(valueIn<std::uint64_t>(bytes));
    bytes.remove_prefix(sizeof(std::uint64_t));
  }
  std::uint64_t last = bytes.size();
  for (const char byte : bytes) last = last << 8 | static_cast<unsigned char>(byte);
  add(last);
  return sum;
}

}  // namespace

ImportWriter::ImportWriter(Sink sink) : sink_(std::move(sink)), checksum_(kChecksumSeed) {
  put(bytesOf(Greeting{}));
}

void ImportWriter::put(std::string_view bytes) {
  outgoing_ += bytes;
  if (outgoing_.size() >= kMaxImportFrameBytes) flush();
}

void ImportWriter::flush() {
  intact_ = intact_ && sink_(outgoing_);
  outgoing_.clear();
}

void ImportWriter::frame(std::uint32_t type, std::string_view payload) {
  const FrameHead head{type, static_cast<std::uint32_t>(payload.size())};
  checksum_ = addToChecksum(addToChecksum(checksum_, bytesOf(head)), payload);
  put(bytesOf(head));
  put(payload);
}

void ImportWriter::totals(const ImportTotals& totals) {
  frame(kTotals, bytesOf(totals));
}

void ImportWriter::object(std::string_view name, std::uint64_t triangles) {
  flushTriangles();
  std::string payload(bytesOf(triangles));
  payload += name;
  frame(kObject, payload);
}

void ImportWriter::triangle(const std::array<Eigen::Vector3d, 3>& vertices) {
  TriangleBytes numbers;
  for (std::size_t i = 0; i < 9; ++i) {
    numbers[i] = vertices[i / 3][static_cast<Eigen::Index>(i % 3)];
  }
  pending_ += bytesOf(numbers);
  ++triangles_;
  if (pending_.size() == kTrianglesPerFrame * kTriangleBytes) flushTriangles();
}

void ImportWriter::flushTriangles() {
  if (!pending_.empty()) frame(kTriangles, pending_);
  pending_.clear();
}

bool ImportWriter::finish() {
  flushTriangles();
  frame(kTrailer, bytesOf(Trailer{triangles_, checksum_}));
  flush();
  return intact_;
}

bool ImportWriter::fail(ImportFailure failure, std::string_view text) {
  std::string payload(bytesOf(failure));
  payload += text.substr(0, kMaxFailureTextBytes);
  frame(kFailure, payload);
  flush();
  return intact_;
}

ImportReader::State ImportReader::feed(std::string_view bytes) {
  if (state_ != State::Reading) return state_;
  // Whole frames are parsed where they lie; only an incomplete one is kept.
  const bool continues = !pending_.empty();
  if (continues) {
    pending_ += bytes;
    bytes = pending_;
  }
  std::size_t parsed = 0;
  while (state_ == State::Reading) {
    const std::size_t step = parseOne(bytes.substr(parsed));
    if (step == 0) break;
    parsed += step;
  }
  if (continues) {
    pending_.erase(0, parsed);
  } else {
    pending_ = bytes.substr(parsed);
  }
  return state_;
}

/// Parses the first frame; returns its size, 0 where it is not yet complete.
std::size_t ImportReader::parseOne(std::string_view bytes) {
  if (!greeted_) return parseGreeting(bytes);
  if (bytes.size() < sizeof(FrameHead)) return 0;
  const auto head = valueIn<FrameHead>(bytes);
  if (head.bytes > kMaxImportFrameBytes) {
    breakOff("a frame of " + std::to_string(head.bytes) + " bytes");
    return 0;
  }
  const std::size_t size = sizeof head + head.bytes;
  if (bytes.size() < size) return 0;
  const std::string_view payload = bytes.substr(sizeof head, head.bytes);
  parseFrame(head.type, payload);
  checksum_ = addToChecksum(addToChecksum(checksum_, bytesOf(head)), payload);
  return size;
}

std::size_t ImportReader::parseGreeting(std::string_view bytes) {
  const Greeting expected;
  // Judged by what is there: garbage shorter than a greeting is garbage all the same.
  const std::size_t present = std::min(bytes.size(), sizeof expected);
  if (bytes.substr(0, present) != bytesOf(expected).substr(0, present)) {
    breakOff("it does not open with the greeting of this version");
    return 0;
  }
  if (present < sizeof expected) return 0;
  greeted_ = true;
  checksum_ = kChecksumSeed;
  return sizeof expected;
}

void ImportReader::parseFrame(std::uint32_t type, std::string_view payload) {
  if (type == kFailure) return parseFailure(payload);
  if ((type == kTotals) == haveTotals_) {
    return breakOff(haveTotals_ ? "totals twice" : "a frame before the totals");
  }
  switch (type) {
    case kTotals: return parseTotals(payload);
    case kObject: return parseObject(payload);
    case kTriangles: return parseTriangles(payload);
    case kTrailer: return parseTrailer(payload);
    default: return breakOff("a frame of unknown type " + std::to_string(type));
  }
}

void ImportReader::parseTotals(std::string_view payload) {
  if (payload.size() != sizeof(ImportTotals)) return breakOff("totals of a wrong size");
  totals_ = valueIn<ImportTotals>(payload);
  if (totals_.triangles > kMaxTriangles || totals_.objects > kMaxImportObjects) {
    return breakOff("totals beyond the limits");
  }
  haveTotals_ = true;
  SceneImportReport& report = scene_.report;
  report.nodes = totals_.nodes;
  report.meshInstances = totals_.meshInstances;
  report.uniqueMeshes = totals_.uniqueMeshes;
  report.skippedPrimitives = totals_.skippedPrimitives;
  report.skippedFaces = totals_.skippedFaces;
}

void ImportReader::parseObject(std::string_view payload) {
  if (payload.size() < sizeof(std::uint64_t)) return breakOff("an object of a wrong size");
  if (leftInObject_ != 0) return breakOff("an object that lacks triangles");
  const auto count = valueIn<std::uint64_t>(payload);
  const std::string_view name = payload.substr(sizeof count);
  std::vector<std::string>& names = scene_.scene.objectNames;
  if (count == 0 || count > totals_.triangles - claimedTriangles_ ||
      names.size() >= totals_.objects) {
    return breakOff("more objects or triangles than the totals said");
  }
  names.push_back(readableText(name, kMaxObjectNameBytes));
  nameBytes_ += names.back().size();
  if (nameBytes_ > kMaxImportNameBytes) return breakOff("names beyond the limit");
  claimedTriangles_ += count;
  leftInObject_ = count;
}

void ImportReader::parseTriangles(std::string_view payload) {
  const std::size_t count = payload.size() / kTriangleBytes;
  if (payload.size() % kTriangleBytes != 0) return breakOff("triangles of a wrong size");
  if (count > leftInObject_) return breakOff("more triangles than their object said");
  makeRoomFor(count);
  RawScene& scene = scene_.scene;
  const auto object = static_cast<ObjectId>(scene.objectNames.size()) - 1;
  for (; !payload.empty(); payload.remove_prefix(kTriangleBytes)) {
    const auto numbers = valueIn<TriangleBytes>(payload);
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.vertices[k] = {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
    }
    scene.triangles.push_back(triangle);
    scene.objectOf.push_back(object);
  }
  leftInObject_ -= count;
}

/// Doubles like a vector would, but never past the promised total: a full scene ends up without
/// slack, and a lying total reserves at most twice what was really received.
void ImportReader::makeRoomFor(std::size_t triangles) {
  RawScene& scene = scene_.scene;
  const std::size_t needed = scene.triangles.size() + triangles;
  if (needed <= scene.triangles.capacity()) return;
  const std::size_t room = std::min(static_cast<std::size_t>(totals_.triangles), 2 * needed);
  scene.triangles.reserve(room);
  scene.objectOf.reserve(room);
}

void ImportReader::parseFailure(std::string_view payload) {
  if (payload.size() < sizeof(ImportFailure)) return breakOff("a failure of a wrong size");
  const auto failure = valueIn<std::uint32_t>(payload);
  if (failure == 0 || failure > static_cast<std::uint32_t>(ImportFailure::OutOfMemory)) {
    return breakOff("a failure of unknown kind");
  }
  failure_ = static_cast<ImportFailure>(failure);
  failureText_ = readableText(payload.substr(sizeof failure), kMaxFailureTextBytes);
  state_ = State::Failed;
}

void ImportReader::parseTrailer(std::string_view payload) {
  if (payload.size() != sizeof(Trailer)) return breakOff("a trailer of a wrong size");
  const auto trailer = valueIn<Trailer>(payload);
  const std::size_t received = scene_.scene.triangles.size();
  if (leftInObject_ != 0 || received != totals_.triangles || received != trailer.triangles ||
      scene_.scene.objectNames.size() != totals_.objects) {
    return breakOff("a trailer before everything promised arrived");
  }
  if (trailer.checksum != checksum_) return breakOff("a wrong checksum");
  state_ = State::Complete;
}

void ImportReader::breakOff(std::string reason) {
  state_ = State::Broken;
  broken_ = std::move(reason);
}

}  // namespace foretouch::internal
