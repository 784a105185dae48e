#include <algorithm>
#include <cstdio>

#include "tests/world_fuzz/fuzz_world.h"

namespace foretouch::test {
namespace {

using oracle::OraclePart;
using oracle::OraclePlace;

template <typename... Numbers>
std::string printed(const char* format, Numbers... numbers) {
  char text[256];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

std::string secondsOf(std::int64_t us) {
  const std::int64_t size = us < 0 ? -us : us;
  return printed("%s%lld.%06lld", us < 0 ? "-" : "", static_cast<long long>(size / 1'000'000),
                 static_cast<long long>(size % 1'000'000));
}

std::string keysOf(const OraclePlace& place) {
  const auto& t = place.translation;
  const auto& r = place.rotation;
  return printed("position = [%.17g, %.17g, %.17g]\n", t.x, t.y, t.z) +
         printed("rotation = [%.17g, %.17g, %.17g, %.17g]\n", r[0], r[1], r[2], r[3]);
}

std::string shapeOf(const FuzzBody& body) {
  if (body.isBox) {
    const double h = body.half;
    return printed("box = { low = [%.17g, %.17g, %.17g], high = [%.17g, %.17g, %.17g] }\n", -h, -h,
                   -h, h, h, h);
  }
  if (body.isTrigger) return printed("sphere = %.17g\n", body.parts.front().radius);
  std::string list;
  for (const OraclePart& part : body.parts) {
    const auto &a = part.corners[0], &b = part.corners[1];
    list += printed("{ a = [%.17g, %.17g, %.17g], b = [%.17g, %.17g, %.17g], radius = %.17g },",
                    a.x, a.y, a.z, b.x, b.y, b.z, part.radius);
  }
  return "lss = [" + list + "]\n";
}

std::string tableOf(const FuzzWorld& world, const FuzzBody& body, Random& random) {
  const std::string kind = body.isTrigger ? "trigger" : "body";
  std::string all = "[[" + kind + "]]\nname = \"" + body.name + "\"\n" + shapeOf(body);
  all += "when_silent = \"" + body.whenSilent + "\"\n";
  if (!body.isTrigger) all += "group = \"" + body.group + "\"\n";
  if (body.stands) all += keysOf(body.place);
  if (body.watches >= 0) {
    all += "watches = [{ body = \"" + world.bodies[static_cast<std::size_t>(body.watches)].name +
           "\" }]\n";
  }
  // Changes of carriers may come in any order, poses in that of time.
  std::vector<std::string> changes, poses;
  for (std::size_t i = 0; i < body.segments.size(); ++i) {
    const FuzzSegment& now = body.segments[i];
    if (now.begin != FuzzBegin::GoesOn) {
      std::string table = "[[" + kind + (now.carrier >= 0 ? ".attach]]\n" : ".detach]]\n");
      table += "time = " + secondsOf(world.cuts[i]) + "\n";
      if (now.carrier >= 0) {
        table += "to = \"" + world.bodies[static_cast<std::size_t>(now.carrier)].name + "\"\n";
      }
      if (now.moves) table += "moves = true\n";
      if (now.begin == FuzzBegin::Said) table += keysOf(now.place);
      changes.push_back(table);
    }
    for (std::size_t k = 0; k < now.times.size(); ++k) {
      poses.push_back("[[" + kind + ".pose]]\ntime = " + secondsOf(now.times[k]) + "\n" +
                      keysOf(now.poses[k]));
    }
  }
  shuffle(changes, random);
  for (std::size_t c = 0, p = 0; c < changes.size() || p < poses.size();) {
    const bool isPose = c == changes.size() || (p < poses.size() && random.chance(0.5));
    all += isPose ? poses[p++] : changes[c++];
  }
  return all;
}

}  // namespace

std::string textOf(const FuzzWorld& world, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::string> bodies, triggers;
  for (const FuzzBody& body : world.bodies) {
    (body.isTrigger ? triggers : bodies).push_back(tableOf(world, body, random));
  }
  std::string all = "format = \"foretouch-world\"\nversion = 1\n";
  all += printed("[query]\ntolerance = %.17g\n", world.tolerance);
  if (world.areApart) {
    // Of a group that nobody is in, nothing can be said.
    const auto has = [&](const std::string& group) {
      return std::any_of(world.bodies.begin(), world.bodies.end(), [&](const FuzzBody& body) {
        return !body.isTrigger && body.group == group;
      });
    };
    if (has("one") && has("other")) {
      all += "[[ask]]\ngroup = \"one\"\nwith = \"other\"\nasked = false\n";
    }
  }
  for (std::size_t b = 0, t = 0; b < bodies.size() || t < triggers.size();) {
    const bool isBody = t == triggers.size() || (b < bodies.size() && random.chance(0.5));
    all += isBody ? bodies[b++] : triggers[t++];
  }
  return all;
}

}  // namespace foretouch::test
