// Whoever tells of a contact by names of his own has the fields of middleware/contact.h, all
// of them and no others, in types that fit: the C struct, the message on the wire, the stub of the
// Python class, the page's decoder and the tables for readers.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/contact.h"
#include "network/wire/world_message_fields.h"
#include "tests/house/source_files.h"

namespace foretouch {
namespace {

/// The type of each name, as the text writes it.
using Types = std::map<std::string, std::string>;
using Names = std::set<std::string>;

/// Of the repository's file, from `begin` to `end`.
std::string between(const std::string& path, const std::string& begin, const std::string& end) {
  const std::string text = house::contentOf(std::filesystem::path(FORETOUCH_SOURCE_DIR) / path);
  const std::size_t from = text.find(begin);
  const std::size_t to = text.find(end, from);
  EXPECT_NE(to, std::string::npos) << path << " has no " << begin << " ... " << end;
  return to == std::string::npos ? "" : text.substr(from, to - from);
}

/// What the first group of `pattern` matches, everywhere in `text`.
Names namesIn(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  Names names;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) {
    names.insert((*at)[1].str());
  }
  return names;
}

/// The members of a struct of C, "double[3]" for three of them.
Types membersIn(const std::string& text) {
  const std::regex comment("/\\*[^*]*\\*/"), line("(\\w+) ([^;]+);"), name("(\\w+)(\\[\\d\\])?");
  const std::string bare = std::regex_replace(text.substr(text.find('{')), comment, "");
  Types types;
  for (std::sregex_iterator at(bare.begin(), bare.end(), line), end; at != end; ++at) {
    const std::string list = (*at)[2].str();
    for (std::sregex_iterator one(list.begin(), list.end(), name); one != end; ++one) {
      types[(*one)[1].str()] = (*at)[1].str() + (*one)[2].str();
    }
  }
  return types;
}

/// The arrays of `text` that have as many elements as there are contacts.
Types arraysIn(const std::string& text) {
  const std::regex array("(\\w+) (\\w+)\\[num_(contacts|links)\\];");
  Types types;
  for (std::sregex_iterator at(text.begin(), text.end(), array), end; at != end; ++at) {
    types[(*at)[2].str()] = (*at)[1].str();
  }
  return types;
}

/// Names of the types that hold a member: of whole numbers, numbers, vectors and enumerations.
std::string typeOf(const ContactField& field, const std::array<const char*, 4>& names) {
  return std::visit(
      [&](auto member) -> std::string {
        using Value = std::remove_reference_t<decltype(LinkContact().*member)>;
        if (std::is_same_v<Value, std::int32_t>) return names[0];
        if (std::is_same_v<Value, double>) return names[1];
        return std::is_enum_v<Value> ? names[3] : names[2];
      },
      field.member);
}

std::string camelCase(const std::string& name) {
  std::string camel;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool begins = i > 0 && name[i - 1] == '_';
    if (name[i] == '_') continue;
    camel +=
        begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(name[i]))) : name[i];
  }
  return camel;
}

TEST(ContactFields, AreThoseOfTheStructInC) {
  Types found = membersIn(
      between("bindings/c/include/foretouch/foretouch.h", "typedef struct ft_contact {", "} ft_c"));
  EXPECT_EQ(found["size"], "uint32_t");
  found.erase("size");
  Types expected;
  for (const ContactField& field : kContactFields) {
    expected[field.inC] = typeOf(field, {"int32_t", "double", "double[3]", "int32_t"});
  }
  EXPECT_EQ(found, expected);
}

TEST(ContactFields, AreThoseOfTheMessage) {
  Types found =
      arraysIn(between("network/wire/lcm/foretouch_contacts_t.lcm", "struct contacts_t {", "\n}"));
  EXPECT_EQ(found["link_names"], "string");  // for those who have no avatar
  found.erase("link_names");
  Types expected;
  for (const ContactField& field : kContactFields) {
    const std::string name = field.onWire;
    if (name.empty()) continue;
    const std::string type = typeOf(field, {"int32_t", "double", "vector", "byte"});
    if (type == "vector") {
      for (const char* axis : {"_x", "_y", "_z"}) expected[name + axis] = "double";
    } else {
      expected[name] = type;
    }
  }
  expected["objects"] = "string";  // the word, and not the number
  EXPECT_EQ(found, expected);
}

TEST(ContactFields, AreThoseOfTheClassInPython) {
  const std::string text =
      between("bindings/python/foretouch/_foretouch.pyi", "class Contact:", "def details");
  Names expected{"link_id", "object_id"};  // the numbers of what `link` and `object` name
  for (const ContactField& field : kContactFields) expected.insert(field.name);
  EXPECT_EQ(namesIn(text, "def (\\w+)\\(self\\)"), expected);
}

TEST(ContactFields, AreReadByThePage) {
  const std::string decoder = between("viewer/src/data/decode_contact.ts",
                                      "export function decodeContact", "return contact");
  // And what a solid avatar adds, and a second body.
  Names inJson{"time", "missed_by_poses", "push", "slip", "other_avatar", "other"};
  Names inCode{"time", "missedByPoses", "push", "slip", "otherAvatar", "otherLink"};
  for (const ContactField& field : kContactFields) {
    // The page shows no mesh's features.
    const auto use = field.use;
    if (use == ContactFieldUse::Never || use == ContactFieldUse::Exact) continue;
    inJson.insert(field.name);
    inCode.insert(camelCase(field.name));
  }
  EXPECT_EQ(namesIn(decoder, "(?:field\\(|item, )\"(\\w+)\""), inJson);
  EXPECT_EQ(namesIn(decoder, "\n    (\\w+)[:,]"), inCode);
}

TEST(ContactFields, AreExplainedToReaders) {
  const std::string table =
      between("docs/formats.md", "A contact holds:", "\n\nAn entry of `objects`");
  Names found;
  const std::regex row("\n\\|([^|]*)\\|");
  for (std::sregex_iterator at(table.begin(), table.end(), row), end; at != end; ++at) {
    found.merge(namesIn((*at)[1].str(), "`(\\w+)`"));
  }
  Names expected{"time"};
  for (const ContactField& field : kContactFields) {
    if (field.use != ContactFieldUse::Never) expected.insert(field.name);
  }
  EXPECT_EQ(found, expected);
}

/// Of what lines of JSON hold.
template <typename... Lists>
Names namesOf(const Lists&... lists) {
  Names names;
  const auto add = [&](const char* name) {
    if (name[0] != '\0') names.insert(name);
  };
  (std::apply([&](const auto&... field) { (add(field.name), ...); }, lists), ...);
  return names;
}

Names with(Names names, const Names& more) {
  names.insert(more.begin(), more.end());
  return names;
}

/// What docs/formats.md names from `begin` to `end`.
Names toldBetween(const std::string& begin, const std::string& end) {
  const std::string text = between("docs/formats.md", begin, end);
  return namesIn(text.substr(std::min(text.size(), begin.size())), "`(\\w+)`");
}

TEST(MessageFields, AreExplainedWhereLinesAre) {
  using namespace wire;
  const Names ofTwo{"object", "other"};
  EXPECT_EQ(toldBetween("only where they say something, `contacts` of", "and\n`crushes`"),
            namesOf(kPush));
  EXPECT_EQ(toldBetween("and\n`crushes` of", "`listen --world"), namesOf(kCrush));
  EXPECT_EQ(toldBetween("`deviations`,\n`contacts` of", "and `counters`"),
            with(namesOf(kShownSides, kShownPush), ofTwo));
  EXPECT_EQ(toldBetween("ahead, `brackets` of", "and `broken`"),
            with(namesOf(kBracketSides, kBracketPossible, kBracketCertain, kBracketGrowth), ofTwo));
  EXPECT_EQ(toldBetween("and `broken` of", "\n\n"), with(namesOf(kBroken), {"gap", "ahead"}));
  EXPECT_EQ(toldBetween("fields of `status_t`:", "\n\n"),
            with(namesOf(kStatus, kStatusFailures, kStatusLatency, kStatusQuery),
                 {"reasons", "latency_us", "query_us"}));
  // Behind the setting of that name.
  EXPECT_EQ(with(toldBetween("| `skeleton` | `avatar`", "\n"), {"avatar"}),
            with(namesOf(kSkeleton, kSkeletonJoint), {"joints"}));
  EXPECT_EQ(toldBetween("| `pose` |", "\n"),
            with(namesOf(kPose, kPoseJoint, kPoseRotation, kMovedJoint, kMovedPlace),
                 {"joints", "translations"}));
  EXPECT_EQ(toldBetween("| `counters` |", "\n"), namesOf(solidCounters(Self{})));
}

/// The fields of a message, in order; but its version and its numbers of others.
std::vector<std::string> fieldsOfMessage(const std::string& type) {
  const std::string text =
      between("network/wire/lcm/foretouch_" + type + ".lcm", "struct " + type + " {", "\n}");
  const std::regex line("\n  (?:\\w+) (\\w+)(?:\\[\\w+\\])*;");
  std::vector<std::string> fields;
  for (std::sregex_iterator at(text.begin(), text.end(), line), end; at != end; ++at) {
    const std::string name = (*at)[1].str();
    if (name != "version" && name.rfind("num_", 0) != 0) fields.push_back(name);
  }
  return fields;
}

/// Those that `text` names: alone, from one to another, or as `rotation_*`.
Names namedIn(const std::string& text, const std::vector<std::string>& fields) {
  const Names alone = namesIn(text, "`(\\w+)`"), begins = namesIn(text, "`(\\w+_)\\*`");
  Names named;
  for (const std::string& field : fields) {
    const auto isBegun = [&](const std::string& begin) { return field.rfind(begin, 0) == 0; };
    if (alone.count(field) != 0 || std::any_of(begins.begin(), begins.end(), isBegun)) {
      named.insert(field);
    }
  }
  const std::regex range("`(\\w+)` to `(\\w+)`");
  for (std::sregex_iterator at(text.begin(), text.end(), range), end; at != end; ++at) {
    const auto from = std::find(fields.begin(), fields.end(), (*at)[1].str());
    const auto to = std::find(from, fields.end(), (*at)[2].str());
    if (to != fields.end()) named.insert(from, to + 1);
  }
  return named;
}

TEST(MessageFields, AreExplainedWhereTheWireIs) {
  const std::pair<const char*, const char*> sections[] = {
      {"person_t", "### The person, live\n"},
      {"solid_t", "### Shown poses on the wire\n"},
      {"pushes_t", "### Pushes on the wire\n"}};
  for (const auto& [type, title] : sections) {
    const std::string text = between("docs/formats.md", title, "\n### ");
    const std::vector<std::string> fields = fieldsOfMessage(type);
    ASSERT_GT(fields.size(), 15u) << type;
    // Whose message it is, each of them says in its first words.
    Names expected(fields.begin() + 2, fields.end()), named = namedIn(text, fields);
    named.erase("avatar");
    named.erase("session");
    EXPECT_EQ(named, expected) << type;
    // The first cells of its table name nothing else.
    const std::regex cell("\n\\|([^|]*)\\|");
    for (std::sregex_iterator at(text.begin(), text.end(), cell), end; at != end; ++at) {
      for (const std::string& name : namesIn((*at)[1].str(), "`(\\w+)`")) {
        EXPECT_EQ(std::count(fields.begin(), fields.end(), name), 1) << type << " " << name;
      }
    }
  }
}

}  // namespace
}  // namespace foretouch
