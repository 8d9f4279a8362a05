#include "model/papers/tables/study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "model/core/files/atomic_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::study_test {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// Two methods with films of the clips "one" and "two"; one has another clip, too.
class Study : public testing::Test {
 protected:
  Study() {
    for (const std::string method : {"ours", "theirs"}) {
      std::filesystem::create_directories(folder_ / method);
      for (const std::string clip : {"one", "two"})
        WriteFile(folder_ / method / (clip + ".webm"), method + " " + clip);
    }
    WriteFile(folder_ / "ours" / "alone.webm", "x");
  }
  void Make(uint64_t seed = 0) {
    WriteStudy(methods_, "Which </script>?", seed, folder_ / "study");
  }
  json Key() const { return json::parse(ReadFile(folder_ / "study.key.json")); }
  /// The answers of a participant who always ranks `best` first.
  std::filesystem::path Answer(const std::string& name, const std::string& best) {
    json answers = json::array();
    int number = 0;
    const json key = Key();
    for (const json& clip : key["clips"]) {
      std::vector<std::string> ranking;
      for (const auto& [letter, method] : clip["films"].items())
        ranking.insert(method == best ? ranking.begin() : ranking.end(), letter);
      answers.push_back({{"clip", ++number}, {"ranking", ranking}});
    }
    WriteFile(folder_ / name, json{{"study", key["study"]}, {"answers", answers}}.dump());
    return folder_ / name;
  }

  TemporaryFolder folder_;
  std::vector<StudyMethod> methods_ = {{"ours", folder_ / "ours"}, {"theirs", folder_ / "theirs"}};
};

TEST_F(Study, ParticipantsSeeNoMethodNames) {
  Make();
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "study"))
    files.insert(entry.path().filename());
  EXPECT_THAT(files, ElementsAre("1A.webm", "1B.webm", "2A.webm", "2B.webm", "index.html"));
  const std::string page = ReadFile(folder_ / "study/index.html");
  EXPECT_THAT(page, Not(HasSubstr("theirs")));
  EXPECT_THAT(page, HasSubstr("Which \\u003c/script>?"));
  // The key does.
  int number = 0;
  const json key = Key();
  for (const json& clip : key["clips"]) {
    ++number;
    for (const auto& [letter, method] : clip["films"].items()) {
      EXPECT_EQ(ReadFile(folder_ / "study" / (std::to_string(number) + letter + ".webm")),
                method.get<std::string>() + " " + clip["clip"].get<std::string>());
    }
  }
}

TEST_F(Study, TheSeedDrawsTheOrder) {
  std::set<std::string> orders;
  for (const uint64_t seed : {0, 1, 2, 3, 4, 5, 6, 7}) {
    Make(seed);
    orders.insert(Key()["clips"].dump());
    std::filesystem::remove_all(folder_ / "study");
  }
  EXPECT_GE(orders.size(), 4U);  // of eight
}

// One seed, which need not be changed, gives many studies.
TEST_F(Study, SeparatesAnswersToOtherFilms) {
  Make();
  const std::filesystem::path answer = Answer("a", "ours");
  std::filesystem::remove_all(folder_ / "study");
  WriteFile(folder_ / "ours" / "one.webm", "ours one, danced anew");
  Make();
  ExpectError(ErrorCode::kInvalidArgument, "answers another study",
              [&] { ScoreStudy(folder_ / "study.key.json", std::vector{answer}); });
}

TEST_F(Study, RanksAreMeanOverPeople) {
  Make();
  const Table table =
      ScoreStudy(folder_ / "study.key.json",
                 std::vector{Answer("a", "theirs"), Answer("b", "theirs"), Answer("c", "ours")});
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_THAT(table.rows[0].labels, ElementsAre("theirs"));
  EXPECT_NEAR(table.rows[0].cells[0].value, 4.0 / 3, 1e-9);
  EXPECT_NEAR(table.rows[0].cells[1].value, 200.0 / 3, 1e-9);
  EXPECT_NEAR(table.rows[1].cells[0].value, 5.0 / 3, 1e-9);
  ASSERT_TRUE(table.rows[0].cells[0].interval);
  EXPECT_LT(table.rows[0].cells[0].interval->low, table.rows[0].cells[0].interval->high);
}

TEST_F(Study, BadInputIsRefusedByName) {
  const auto make = [&](const std::vector<StudyMethod>& methods) {
    return [this, methods] { WriteStudy(methods, "?", 0, folder_ / "other"); };
  };
  ExpectError(ErrorCode::kInvalidArgument, "2 to 8", make({methods_[0]}));
  ExpectError(ErrorCode::kInvalidArgument, "two are called", make({methods_[0], methods_[0]}));
  ExpectError(ErrorCode::kInvalidArgument, "is not a folder",
              make({methods_[0], {"none", folder_ / "none"}}));
  std::filesystem::create_directories(folder_ / "empty");
  ExpectError(ErrorCode::kInvalidArgument, "no clip",
              make({methods_[0], {"empty", folder_ / "empty"}}));
  Make();
  ExpectError(ErrorCode::kFailedPrecondition, "is there already", [&] { Make(); });
  const auto score = [&](const json& answer) {
    return [this, answer] {
      WriteFile(folder_ / "bad", answer.dump());
      ScoreStudy(folder_ / "study.key.json", std::vector{folder_ / "bad"});
    };
  };
  ExpectError(ErrorCode::kInvalidArgument, "another study", score({{"study", 9}, {"answers", {}}}));
  const std::filesystem::path once = Answer("once", "ours");
  ExpectError(ErrorCode::kInvalidArgument, "is given twice", [&] {
    ScoreStudy(folder_ / "study.key.json", std::vector{once, once});
  });
  ExpectError(ErrorCode::kInvalidArgument, "is not a file of a study", score({{"answers", {}}}));
  const auto ranks = [study = Key()["study"]](int clip, const std::vector<std::string>& ranking) {
    return json{{"study", study},
                {"answers", json::array({{{"clip", clip}, {"ranking", ranking}}})}};
  };
  ExpectError(ErrorCode::kInvalidArgument, "twice", score(ranks(1, {"A", "A"})));
  ExpectError(ErrorCode::kInvalidArgument, "ranks 1 of 2", score(ranks(1, {"A"})));
  ExpectError(ErrorCode::kInvalidArgument, "is not an answer", score(ranks(1, {"A", "C"})));
  ExpectError(ErrorCode::kInvalidArgument, "is not an answer", score(ranks(3, {"A", "B"})));
}

}  // namespace choreo::study_test
