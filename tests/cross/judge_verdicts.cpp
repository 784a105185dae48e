// judge_verdicts CASES ANSWERS: the judge on what one machine answered (verdicts.cpp): every link
// of every step, by the poses that it was asked about. Says how many of each verdict there are and
// which promises are broken; 1 where one is, or where the judge could not decide.
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "assets/avatar/avatar_file.h"
#include "bindings/c/include/foretouch/foretouch.h"
#include "judge/judge.h"
#include "tests/cross/cases.h"
#include "tests/support/judged.h"

namespace foretouch::test {
namespace {

oracle::Scene sceneOf(const std::string& path) {
  const ObjScene read = readObj(path);
  const auto vertex = [&](std::size_t corner) {
    const std::size_t at = 3 * std::size_t{read.indices[corner]};
    return oracle::Vec3d(
        Eigen::Vector3d(read.positions[at], read.positions[at + 1], read.positions[at + 2]));
  };
  std::vector<oracle::Triangle> triangles;
  for (std::size_t i = 0; i < read.indices.size(); i += 3) {
    triangles.push_back({vertex(i), vertex(i + 1), vertex(i + 2)});
  }
  return oracle::Scene(std::move(triangles));
}

/// The next word, which "%a" wrote.
double number(std::istream& words) {
  std::string word;
  words >> word;
  return std::strtod(word.c_str(), nullptr);
}

oracle::Vec3d point(std::istream& words) {
  const double x = number(words), y = number(words), z = number(words);
  return oracle::Vec3d(Eigen::Vector3d(x, y, z));
}

oracle::Verdict verdictOf(int verdict) {
  switch (verdict) {
    case FT_VERDICT_CLEAR: return oracle::Verdict::Clear;
    case FT_VERDICT_CONTACT: return oracle::Verdict::Contact;
    case FT_VERDICT_STARTS_IN_CONTACT: return oracle::Verdict::StartsInContact;
    default: return oracle::Verdict::Undecided;
  }
}

class AnswersJudge {
 public:
  explicit AnswersJudge(std::vector<CrossCase> cases) : cases_(std::move(cases)) {}

  void read(const std::string& path) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if (kind == "case") {
        begin(words);
      } else if (kind == "pose") {
        readPose(words);
      } else if (kind == "link" && truth_) {
        judge(words);
      } else {
        throw std::runtime_error(path + ": expected a case, a pose or a link, found '" +
                                 line.substr(0, 40) + "'");
      }
      if (!words) throw std::runtime_error(path + ": a line is cut: '" + line.substr(0, 40) + "'");
    }
    if (at_ + 1 != cases_.size()) throw std::runtime_error(path + ": cases are missing");
  }

  /// False where a promise is broken, or something is not known.
  bool tell() const {
    std::uint64_t judged = 0;
    for (const auto& [verdict, number] : verdicts_) {
      std::printf("%s %llu, ", toString(verdict), static_cast<unsigned long long>(number));
      judged += number;
    }
    std::printf("%llu judged: ", static_cast<unsigned long long>(judged));
    for (const auto& [finding, number] : findings_) {
      std::printf(" %s %llu", toString(finding), static_cast<unsigned long long>(number));
    }
    std::printf("\n");
    for (const std::string& line : lines_) std::printf("  %s\n", line.c_str());
    return judged > 0 && findings_.size() == 1 && findings_.count(oracle::Finding::Ok) != 0 &&
           verdicts_.count(oracle::Verdict::Contact) != 0;
  }

 private:
  void begin(std::istream& words) {
    std::size_t number = 0;
    words >> number;
    if (number >= cases_.size() || (avatar_ && number != at_ + 1) || (!avatar_ && number != 0)) {
      throw std::runtime_error("expected the cases one after another, found case " +
                               std::to_string(number));
    }
    if (number == 0 || cases_[number].scene != cases_[at_].scene) {
      scene_ = std::make_unique<oracle::Scene>(sceneOf(cases_[number].scene));
    }
    at_ = number;
    auto avatar = readAvatarFile(cases_[at_].avatar);
    if (!avatar) throw std::runtime_error(describe(avatar.error()));
    avatar_.emplace(std::move(avatar).value());
    from_.reset();
    truth_.reset();
  }

  void readPose(std::istream& words) {
    if (!avatar_) throw std::runtime_error("expected a case, found a pose");
    words >> frame_;
    const auto joints = static_cast<std::size_t>(avatar_->skeleton().numJoints());
    Pose pose;
    for (std::size_t j = 0; j < joints; ++j) {
      const double w = number(words), x = number(words), y = number(words), z = number(words);
      pose.rotations.emplace_back(w, x, y, z);
    }
    for (std::size_t j = 0; j < joints; ++j) {
      const double x = number(words), y = number(words), z = number(words);
      pose.translations.emplace_back(x, y, z);
    }
    // As whoever is asked about a pose takes it.
    auto valid = validatedPose(avatar_->skeleton(), std::move(pose));
    if (!valid) throw std::runtime_error(describe(valid.error()));
    if (from_) {
      truth_ =
          std::make_unique<oracle::Motion>(plainJoints(avatar_->skeleton(), *from_, valid.value()));
    }
    from_ = std::move(valid).value();
  }

  void judge(std::istream& words) {
    LinkId link = 0;
    int verdict = 0;
    oracle::Answer answer;
    words >> link >> verdict;
    answer.verdict = verdictOf(verdict);
    answer.toi = number(words);
    answer.freeUntil = number(words);
    answer.separation = number(words);
    answer.penetration = number(words);
    words >> answer.capsule >> answer.triangle;
    answer.onScene = point(words);
    answer.onLink = point(words);
    answer.normal = point(words);
    if (!words || link < 0 || link >= avatar_->numLinks()) return;
    const auto capsules = plainCapsules(*avatar_, link);
    if (capsules.empty() && answer.verdict == oracle::Verdict::Clear) return;
    const oracle::Judgement judgement =
        oracle::Judge(*scene_, *truth_, link, capsules).judge(answer, kTolerance);
    ++verdicts_[answer.verdict];
    ++findings_[judgement.finding];
    if (judgement.finding == oracle::Finding::Ok || lines_.size() >= kMostLines) return;
    std::ostringstream line;
    line << "case " << at_ << ", step to frame " << frame_ << ", link " << link << ": "
         << toString(judgement.finding) << " at " << judgement.time << ", separation "
         << judgement.separation << " " << judgement.what;
    lines_.push_back(line.str());
  }

  static constexpr double kTolerance = 1e-3;  // of ft_query_options, by default
  static constexpr std::size_t kMostLines = 20;
  std::vector<CrossCase> cases_;
  std::size_t at_ = 0;
  std::unique_ptr<oracle::Scene> scene_;
  std::optional<Avatar> avatar_;
  std::optional<Pose> from_;
  std::unique_ptr<oracle::Motion> truth_;  ///< Of the step that ends in from_.
  std::string frame_;
  std::map<oracle::Verdict, std::uint64_t> verdicts_;
  std::map<oracle::Finding, std::uint64_t> findings_;
  std::vector<std::string> lines_;
};

}  // namespace
}  // namespace foretouch::test

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "judge_verdicts CASES ANSWERS\n");
    return 2;
  }
  try {
    foretouch::test::AnswersJudge judge(foretouch::test::readCases(arguments[1]));
    judge.read(arguments[2]);
    return judge.tell() ? 0 : 1;
  } catch (const std::exception& failed) {
    std::fprintf(stderr, "judge_verdicts: %s\n", failed.what());
    return 1;
  }
}
