#include "assets/import/mjcf_tree.h"

#include <algorithm>
#include <filesystem>
#include <tinyxml.h>

#include "assets/import/failure.h"
#include "assets/import/memory_budget.h"
#include "assets/import/side_files.h"
#include "assets/import/text.h"
#include "assets/import/xml_document.h"
#include "assets/text_file.h"

namespace foretouch::internal {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{16} << 20;  // of all files together
constexpr std::size_t kMaxFiles = 64;
/// Elements in elements: the links of a chain, and what stands around them.
constexpr int kMaxDepth = kMaxChainDepth + 16;

class TreeReader {
 public:
  explicit TreeReader(const ModelQuestion& question) : question_(question) {}

  MjcfTree read() {
    tree_.files.push_back(fs::path(question_.path).filename().string());
    paths_.push_back(question_.path);
    TiXmlDocument document;
    parse(question_.path, document);
    const TiXmlElement& root = rootOf(document, "mujoco");
    tree_.root = bare(root, 0);
    addChildren(root, 0, tree_.root, 1);
    return std::move(tree_);
  }

 private:
  void parse(const std::string& path, TiXmlDocument& document) {
    const auto text = readWholeFile(path, kMaxBytes - bytes_);
    if (!text.ok()) {
      const bool isTooLarge = text.error().code == ErrorCode::LimitExceeded;
      throw Failure{isTooLarge ? ImportFailure::TooLarge : ImportFailure::Refused,
                    isTooLarge ? "more than " + std::to_string(kMaxBytes) + " bytes of MJCF"
                               : text.error().message};
    }
    bytes_ += text.value().size();
    grantMemoryFor(text.value().size());
    parseXml(text.value(), document);
  }

  static MjcfElement bare(const TiXmlElement& from, std::size_t file) {
    MjcfElement element;
    element.name = from.ValueStr();
    element.file = file;
    element.line = from.Row();
    for (const auto* a = from.FirstAttribute(); a != nullptr; a = a->Next()) {
      element.attributes.emplace_back(a->Name(), a->ValueStr());
    }
    return element;
  }

  void addChildren(const TiXmlElement& from, std::size_t file, MjcfElement& to, int depth) {
    for (const auto* e = from.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      MjcfElement element = bare(*e, file);
      if (depth == kMaxDepth) {
        throw Failure{ImportFailure::TooLarge, placeIn(tree_.files, file, element.line) +
                                                   "more than " + std::to_string(kMaxDepth) +
                                                   " elements in one another"};
      }
      if (element.name == "include") {
        addIncluded(element, to, depth);
        continue;
      }
      addChildren(*e, file, element, depth + 1);
      to.children.push_back(std::move(element));
    }
  }

  void addIncluded(const MjcfElement& include, MjcfElement& to, int depth) {
    const std::string place = placeIn(tree_.files, include.file, include.line);
    const std::string* reference = include.find("file");
    if (reference == nullptr) refuse(place + "expected a file to include, found none");
    const std::string path = findMjcfFile(
        question_, tree_, include, fs::path(question_.path).parent_path().string(), *reference);
    std::error_code unknown;
    if (std::any_of(paths_.begin(), paths_.end(), [&](const std::string& known) {
          return fs::equivalent(known, path, unknown);
        })) {
      refuse(place + "file " + quotedName(*reference) + " is included a second time");
    }
    if (paths_.size() == kMaxFiles) {
      throw Failure{ImportFailure::TooLarge,
                    place + "more than " + std::to_string(kMaxFiles) + " files"};
    }
    paths_.push_back(path);
    tree_.files.push_back(*reference);
    const std::size_t file = tree_.files.size() - 1;
    TiXmlDocument document;
    try {
      parse(path, document);
    } catch (const Failure& failure) {
      throw Failure{failure.kind, place + "file " + quotedName(*reference) + ": " + failure.text};
    }
    const TiXmlElement* root = document.RootElement();
    if (root == nullptr) refuse(place + "file " + quotedName(*reference) + " holds no element");
    addChildren(*root, file, to, depth);
  }

  const ModelQuestion& question_;
  MjcfTree tree_;
  std::vector<std::string> paths_;
  std::size_t bytes_ = 0;
};

}  // namespace

const std::string* MjcfElement::find(std::string_view attribute) const {
  for (const auto& [key, value] : attributes) {
    if (key == attribute) return &value;
  }
  return nullptr;
}

void MjcfElement::set(const std::string& attribute, std::string value) {
  drop(attribute);
  attributes.emplace_back(attribute, std::move(value));
}

void MjcfElement::drop(std::string_view attribute) {
  attributes.erase(std::remove_if(attributes.begin(), attributes.end(),
                                  [&](const auto& a) { return a.first == attribute; }),
                   attributes.end());
}

std::string placeIn(const std::vector<std::string>& files, std::size_t file, int line) {
  return (file == 0 ? "" : quotedName(files[file]) + " ") + "line " + std::to_string(line) + ": ";
}

std::string findMjcfFile(const ModelQuestion& question, const MjcfTree& tree,
                         const MjcfElement& element, const std::string& folder,
                         const std::string& reference) {
  const std::string about =
      placeIn(tree.files, element.file, element.line) + "file " + quotedName(reference);
  const fs::path path = fs::absolute(fs::path(folder) / reference).lexically_normal();
  std::error_code unknown;
  if (!fs::is_regular_file(path, unknown)) refuse(about + " was not found");
  if (!isWithin(foldersBeside(question.path, question.packagePaths), path.string())) {
    refuse(
        about +
        " is not read: it is neither beside the model or in a folder there, nor in a folder that "
        "was named (of packages)");
  }
  return path.string();
}

MjcfTree readMjcfTree(const ModelQuestion& question) {
  return TreeReader(question).read();
}

}  // namespace foretouch::internal
