#include "verify/edges.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "verify/text_lines.h"

namespace verify {
namespace {

/// As near to unit as an avatar file must be.
bool isUnit(const std::array<double, 4>& q) {
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return std::abs(norm - 1.0) <= 1e-3;
}

/// The lines below the first one.
class StatementReader {
 public:
  StatementReader(const std::vector<Link>& links, std::size_t triangles, EdgeStatement& statement)
      : links_(links), triangles_(triangles), all_(statement) {
    all_.joints.resize(links.size());
    all_.ignored.resize(links.size());
  }

  /// Clearance and the number of coordinates. Empty, or what is wrong.
  std::string readHead(TextLines& lines) {
    const auto& words = lines.words();
    if (!lines.next() || words.size() != 2 || words[0] != "clearance" ||
        !isNumber(words[1], all_.clearance) || all_.clearance < 0.0) {
      return "expected clearance and metres, at least 0";
    }
    if (!lines.next() || words.size() != 2 || words[0] != "coordinates" ||
        !isWhole(words[1], std::size_t{1}, 3 * kMostLinks, all_.coordinates)) {
      return "expected coordinates and their number";
    }
    return "";
  }

  /// One line, or the three of an edge.
  std::string read(TextLines& lines) {
    const auto& words = lines.words();
    if (words[0] == "edge" && words.size() == 2) return readEdge(lines);
    if (!all_.edges.empty()) return "expected edge and its number: all else stands above edges";
    const bool turns = words[0] == "turn";
    if ((turns || words[0] == "shift") && words.size() == 8) return readDrive(words, turns);
    if (words[0] == "ignore" && (words.size() == 2 || words.size() == 4)) return readIgnored(words);
    if (words[0] == "pair" && words.size() == 3) return readPair(words);
    return "expected turn or shift JOINT X Y Z COORDINATE FACTOR OFFSET, ignore LINK, ignore LINK "
           "TRIANGLE COUNT, pair A B or edge K";
  }

 private:
  using Words = std::vector<std::string_view>;

  [[nodiscard]] bool isLink(std::string_view word, std::size_t& link) const {
    return isWhole(word, std::size_t{0}, links_.size() - 1, link);
  }

  std::string readDrive(const Words& words, bool turns) {
    std::size_t joint = 0;
    Drive drive;
    std::array<double, 2> line{};
    if (!isLink(words[1], joint) || !areNumbers(words, 2, drive.axis) ||
        !isWhole(words[5], std::size_t{0}, all_.coordinates - 1, drive.coordinate) ||
        !areNumbers(words, 6, line)) {
      return "expected a joint, an axis, a coordinate, a factor and an offset";
    }
    const auto& a = drive.axis;
    if (!(a[0] * a[0] + a[1] * a[1] + a[2] * a[2] > 1e-12)) return "expected an axis, not zero";
    drive.factor = line[0];
    drive.offset = line[1];
    DrivenJoint& driven = all_.joints[joint];
    if (!turns) {
      // A plane has two; more would be work without a bound.
      if (driven.shifts.size() == 3) return "expected at most three shifts of a joint";
      driven.shifts.push_back(drive);
      return "";
    }
    if (driven.turn) return "expected one turn of a joint";
    driven.turn = drive;
    return "";
  }

  std::string readIgnored(const Words& words) {
    Ignored ignored;
    std::size_t link = 0;
    if (!isLink(words[1], link)) return "expected a link's number";
    ignored.end = triangles_;
    if (words.size() == 4) {
      std::size_t count = 0;
      if (!isWhole(words[2], std::size_t{0}, triangles_ - 1, ignored.first) ||
          !isWhole(words[3], std::size_t{1}, triangles_ - ignored.first, count)) {
        return "expected a triangle of the scene, from 0, and how many from there on";
      }
      ignored.end = ignored.first + count;
    }
    all_.ignored[link].push_back(ignored);
    return "";
  }

  std::string readPair(const Words& words) {
    std::size_t a = 0, b = 0;
    if (!isLink(words[1], a) || !isLink(words[2], b) || a >= b) {
      return "expected the numbers of two links, the smaller one first";
    }
    if (links_[a].capsules.empty() || links_[b].capsules.empty()) {
      return "expected links with LSS";
    }
    if (!pairs_.insert({a, b}).second) return "this pair is there twice";
    all_.pairs.emplace_back(a, b);
    return "";
  }

  std::string readEdge(TextLines& lines) {
    Edge edge;
    if (!isWhole(lines.words()[1], 0LL, 1LL << 53, edge.number)) return "expected an edge's number";
    if (!numbers_.insert(edge.number).second) return "this edge is there twice";
    for (std::vector<double>* const end : {&edge.from, &edge.to}) {
      end->resize(all_.coordinates);
      if (!lines.next() || lines.words().size() != all_.coordinates ||
          !areNumbers(lines.words(), 0, *end)) {
        return "expected two lines of " + std::to_string(all_.coordinates) +
               " coordinates below edge and its number";
      }
    }
    all_.edges.push_back(std::move(edge));
    return "";
  }

  const std::vector<Link>& links_;
  std::size_t triangles_;
  EdgeStatement& all_;
  std::set<std::pair<std::size_t, std::size_t>> pairs_;
  std::set<long long> numbers_;
};

void merge(std::vector<Ignored>& ignored) {
  std::sort(ignored.begin(), ignored.end(),
            [](const Ignored& a, const Ignored& b) { return a.first < b.first; });
  std::vector<Ignored> merged;
  for (const Ignored& one : ignored) {
    if (merged.empty() || one.first > merged.back().end) {
      merged.push_back(one);
    } else {
      merged.back().end = std::max(merged.back().end, one.end);
    }
  }
  ignored = std::move(merged);
}

}  // namespace

bool isIgnored(const std::vector<Ignored>& ignored, std::size_t triangle) {
  const auto behind =
      std::upper_bound(ignored.begin(), ignored.end(), triangle,
                       [](std::size_t at, const Ignored& one) { return at < one.first; });
  return behind != ignored.begin() && triangle < (behind - 1)->end;
}

bool isOfEdges(std::string_view text) {
  TextLines lines(text);
  return lines.next() && lines.words()[0] == "foretouch-edges";
}

Fault readEdges(std::string_view text, const std::vector<Link>& links, std::size_t triangles,
                EdgeStatement& statement) {
  if (Fault fault = otherLinesIn(text); !fault.what.empty()) return fault;
  for (const Link& link : links) {
    if (link.hasRest && isUnit(link.rotation)) continue;
    return {0, "link " + link.name + ": edges need its offset and a unit rotation in the avatar"};
  }
  TextLines lines(text);
  const bool hasFirst = lines.next() && lines.words().size() == 2 &&
                        lines.words()[0] == "foretouch-edges" && lines.words()[1] == "1";
  if (!hasFirst) return {lines.line(), "expected the line foretouch-edges 1 first"};
  StatementReader reader(links, triangles, statement);
  std::string what = reader.readHead(lines);
  bool isEnded = false;
  while (what.empty() && lines.next()) {
    if (isEnded) return {lines.line(), "expected nothing behind the line end"};
    isEnded = lines.words().size() == 1 && lines.words()[0] == "end";
    if (!isEnded) what = reader.read(lines);
  }
  if (!what.empty()) return {lines.line(), std::move(what)};
  if (!isEnded) return {lines.line(), "expected the line end last: the text is cut"};
  for (std::vector<Ignored>& ofLink : statement.ignored) merge(ofLink);
  return {};
}

}  // namespace verify
