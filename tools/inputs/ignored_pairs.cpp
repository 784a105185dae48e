#include "tools/inputs/ignored_pairs.h"

#include <algorithm>
#include <string_view>
#include <tuple>

#include "articulated/try.h"
#include "assets/near_names.h"
#include "assets/text_file.h"
#include "tools/inputs/name_pattern.h"

namespace foretouch::tools {
namespace {

Error refusal(ErrorCode code, std::string message) {
  return {code, "--ignore", -1, -1, std::move(message)};
}

/// One way to read a text: its links, and their objects.
struct Reading {
  std::vector<std::int32_t> links;
  std::vector<std::int32_t> objects;
};

class PairReader {
 public:
  PairReader(const std::vector<std::string>& linkNames, const std::vector<std::string>& objectNames)
      : linkNames_(linkNames), objectNames_(objectNames) {}

  Result<Reading> read(std::string_view text) const {
    std::vector<Reading> readings;
    if (auto links = matching(text, linkNames_); !links.empty()) {
      readings.push_back({std::move(links), {IgnoredPair::kEveryObject}});
    }
    std::string_view unknownObject;
    for (std::size_t colon = text.find(':'); colon != std::string_view::npos;
         colon = text.find(':', colon + 1)) {
      auto links = matching(text.substr(0, colon), linkNames_);
      if (links.empty()) continue;
      const std::string_view object = text.substr(colon + 1);
      auto objects = object == "*" ? std::vector<std::int32_t>{IgnoredPair::kEveryObject}
                                   : matching(object, objectNames_);
      if (objects.empty()) {
        unknownObject = object;
      } else {
        readings.push_back({std::move(links), std::move(objects)});
      }
    }
    if (readings.size() == 1) return std::move(readings.front());
    if (!readings.empty()) {
      return refusal(ErrorCode::Mismatch, inQuotes(text) +
                                              " can be read in more than one way, as " +
                                              "names contain colons; expected one reading");
    }
    if (unknownObject.data() != nullptr) {
      return refusal(ErrorCode::UnknownName, inQuotes(unknownObject) + " of " + inQuotes(text) +
                                                 " is no object of the scene" +
                                                 didYouMean(unknownObject, objectNames_));
    }
    const std::string_view link = text.substr(0, text.rfind(':'));
    return refusal(ErrorCode::UnknownName,
                   inQuotes(link) + " is no link of the avatar" + didYouMean(link, linkNames_));
  }

 private:
  const std::vector<std::string>& linkNames_;
  const std::vector<std::string>& objectNames_;
};

Result<Done> addPairs(const Reading& reading, std::vector<IgnoredPair>& pairs) {
  if (reading.objects.size() > (kMaxIgnoredPairs - pairs.size()) / reading.links.size()) {
    return refusal(ErrorCode::LimitExceeded, "stands for more than " +
                                                 std::to_string(kMaxIgnoredPairs) +
                                                 " pairs; expected fewer, or `*` as the object");
  }
  for (const std::int32_t link : reading.links) {
    for (const std::int32_t object : reading.objects) pairs.push_back({link, object});
  }
  return Done{};
}

void sortUnique(std::vector<IgnoredPair>& pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const IgnoredPair& p, const IgnoredPair& q) {
    return std::tie(p.link, p.object) < std::tie(q.link, q.object);
  });
  const auto same = [](const IgnoredPair& p, const IgnoredPair& q) {
    return p.link == q.link && p.object == q.object;
  };
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
}

}  // namespace

Result<std::vector<IgnoredPair>> parseIgnoredPairs(const std::vector<std::string>& texts,
                                                   const Skeleton& skeleton,
                                                   const std::vector<std::string>& objectNames) {
  std::vector<std::string> linkNames;
  for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
    linkNames.push_back(skeleton.name(link));
  }
  const PairReader reader(linkNames, objectNames);
  std::vector<IgnoredPair> pairs;
  for (const std::string& text : texts) {
    std::string_view rest = text;
    for (bool more = true; more;) {
      const std::size_t comma = rest.find(',');
      more = comma != std::string_view::npos;
      FORETOUCH_TRY(const auto reading, reader.read(rest.substr(0, comma)));
      FORETOUCH_CHECK(addPairs(reading, pairs));
      if (more) rest.remove_prefix(comma + 1);
    }
  }
  sortUnique(pairs);
  return pairs;
}

}  // namespace foretouch::tools
