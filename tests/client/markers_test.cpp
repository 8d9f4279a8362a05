#include <gmock/gmock.h>

#include <fstream>

#include "tests/client/run_choreo.h"
#include "tests/support/temporary_folder.h"

/// `choreo edit` on a project.
namespace choreo::markers_test {

using nlohmann::json;
using testing::HasSubstr;

class MarkersTest : public testing::Test {
 protected:
  MarkersTest() { std::ofstream(folder_ / "p.json") << project_.dump(); }
  std::string At(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
  Outcome Edit(const std::string& options, const std::string& from = "p.json") const {
    return Choreo("edit " + At(from) + " -o " + At("q.json") + " " + options);
  }
  void ExpectRefused(const Outcome& outcome, const std::string& message) const {
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.said, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "q.json"));
  }

  TemporaryFolder folder_;
  const json key_ = {{"id", "k"}, {"time", 2}, {"pose", "kick"}};
  const json project_ = {
      {"studio", 1},
      {"seconds", 10},
      {"markers",
       {{{"time", 1}, {"name", "verse"}},
        {{"time", 4}, {"name", "drop"}},
        {{"time", 8}, {"name", "drop"}}}},
      {"path",
       {{"points", {{{"time", 0}, {"x", 0}, {"z", 0}}, {{"time", 9}, {"x", 1.5}, {"z", 0}}}}}},
      {"keyframes", json::array({key_})}};
};

TEST_F(MarkersTest, AreSetMovedAndRemoved) {
  const Outcome outcome =
      Edit("--mark 'the \"end\"' 9.5 --mark verse 5 --unmark drop@8 --mark first 0");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  json expected = project_;
  expected["markers"] = {{{"time", 0}, {"name", "first"}},
                         {{"time", 4}, {"name", "drop"}},
                         {{"time", 5}, {"name", "verse"}},
                         {{"time", 9.5}, {"name", "the \"end\""}}};
  EXPECT_EQ(ReadJson(folder_ / "q.json"), expected) << "all else stays";
  std::ifstream file(folder_ / "q.json");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(text, HasSubstr("\n  {\"time\": 5.0, \"name\": \"verse\"},\n"));
  // Without markers a project has no list of them.
  std::filesystem::rename(folder_ / "q.json", folder_ / "r.json");
  ASSERT_EQ(
      Edit("--unmark first --unmark drop --unmark verse --unmark 'the \"end\"'", "r.json").code, 0);
  EXPECT_FALSE(ReadJson(folder_ / "q.json").contains("markers"));
}

TEST_F(MarkersTest, StandOnTheProjectsCounts) {
  json counted = project_;
  counted["beats"] = {{0.5, 4}, {1, 5}, {1.5, 6}, {2, 7}, {2.5, 8}, {3, 1}, {3.5, 2}};
  std::ofstream(folder_ / "c.json") << counted.dump();
  const Outcome outcome = Edit("--mark last 3.5c --mark pickup 0.5c", "c.json");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const json markers = ReadJson(folder_ / "q.json")["markers"];
  EXPECT_EQ(markers[1], json({{"time", 2.75}, {"name", "pickup"}}));
  EXPECT_EQ(markers[3], json({{"time", 4.25}, {"name", "last"}}));
}

TEST_F(MarkersTest, RefusalsSayWhatIsThere) {
  ExpectRefused(Edit("--unmark chorus"),
                "--unmark: the project has no marker \"chorus\"; it has verse@1, drop@4, drop@8");
  ExpectRefused(Edit("--unmark vers"), "no marker \"vers\"; did you mean verse@1?");
  ExpectRefused(Edit("--unmark drop"),
                "several markers are called \"drop\"; say which, as in drop@4");
  ExpectRefused(Edit("--mark verse 4.01"), "--mark: 4.01 s is where drop@4 stands");
  ExpectRefused(Edit("--mark x 4000"), "--mark");
  ExpectRefused(Edit("--mark x 3c"), "--mark: 3c: counts need music that has beats");
  ExpectRefused(Edit(""), "nothing to change");
  ExpectRefused(Edit("--mark x 3 --mirror"), "p.json is a project");
  std::ofstream(folder_ / "d.npz") << "no dance";
  ExpectRefused(Choreo("edit " + At("d.npz") + " --mark x 3 -o " + At("q.json")),
                "--mark: goes with a project");
}

}  // namespace choreo::markers_test
