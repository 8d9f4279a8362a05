#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>

// Figures that fall short are to be learnt, not corrected by constants.
namespace choreo::constants_test {

namespace fs = std::filesystem;

// Numbers in `source` that somebody chose: constants of any scope and, in a header, members of
// structs, that are doubles or floats with a numeral in their value. Neither integers, such as a
// solver's iterations, nor a private member_, nor what begins at zero.
int ChosenNumbers(const std::string& source, bool header) {
  static const std::regex comment(R"(//[^\n]*)"), braces(R"((\w)\{([^;{}]*)\})"), end("[;{}]"),
      declaration(R"(^\s*(?:(?:public|private|protected):\s*)?((?:inline |static )*)"
                  R"((?:(?:constexpr|const) )+)?(?:static )?(?:double|float)\s([^(]*[=<][^]*)$)"),
      chosen(R"(\b(\w*[A-Za-z0-9])(?:\[\w*\])?\s*[=<]\s*(?!\s*0\s*(?:,|$))[^,]*\b[0-9])");
  const std::string code =
      std::regex_replace(std::regex_replace(source, comment, ""), braces, "$1<$2>");
  int count = 0;
  for (std::sregex_token_iterator at(code.begin(), code.end(), end, -1), last; at != last; ++at) {
    const std::string statement = *at;
    std::smatch match;
    if (statement.size() > 1000 || !std::regex_search(statement, match, declaration)) continue;
    const bool constant = match[1].matched;
    if (!constant && !header) continue;
    const std::string declared = match[2];
    for (std::sregex_iterator name(declared.begin(), declared.end(), chosen), none; name != none;
         ++name) {
      // A constant's name begins with a k; other consts are local variables.
      const char first = (*name)[1].str()[0];
      if (constant == (first == 'k')) ++count;
    }
  }
  return count;
}

TEST(Architecture, ChosenNumbersAreFoundInEveryScope) {
  const auto count = [](const std::string& source) { return ChosenNumbers(source, true); };
  EXPECT_EQ(count("constexpr double kA = 0.5;"), 1);
  EXPECT_EQ(count("inline constexpr float kA = 1, kB = -2;  ///< kC = 3"), 2);
  EXPECT_EQ(count("void F() {\n  constexpr double kA{1.0 / 3};\n}"), 1);
  EXPECT_EQ(count("class C {\n public:\n  static constexpr double kA = 3;\n};"), 1);
  EXPECT_EQ(count("static const float kA = 60 * double{kB};"), 1);
  EXPECT_EQ(count("constexpr static double kA =\n    2;"), 1);
  EXPECT_EQ(count("struct Options {\n  double reach = 0.01, start = 0, offset = 2;\n};"), 2);
  EXPECT_EQ(count("constexpr int kA = 3; constexpr double kB = kA; double sum_ = 1;"), 0);
  EXPECT_EQ(count("const double left = 1 - passed;  // constexpr double kA = 1;"), 0);
  EXPECT_EQ(ChosenNumbers("double sum = 1;", /*header=*/false), 0);
}

// Whoever adds one takes another away, or says in a decision why there must be more.
TEST(Architecture, NumbersThatShapeADanceAreChosenNoMore) {
  const std::map<std::string, int> most = {
      {"plan", 36}, {"dance", 20}, {"flow", 34}, {"audio", 98}, {"motion", 51}};
  // What is asked of a transition, and a song that is made for tests.
  const std::set<std::string> others = {"transition_spec.h", "transition_noise.h", "made_song.h",
                                        "made_song.cpp"};
  int total = 0;
  for (const auto& [folder, count] : most) {
    int found = 0;
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(CHOREO_SOURCE_DIR) / "model" / folder)) {
      const fs::path& file = entry.path();
      if (!entry.is_regular_file() || others.contains(file.filename())) continue;
      std::ifstream in(file);
      found += ChosenNumbers({std::istreambuf_iterator<char>(in), {}}, file.extension() == ".h");
    }
    EXPECT_LE(found, count) << "in model/" << folder;
    total += found;
  }
  EXPECT_GT(total, 100) << "none were found";
}

}  // namespace choreo::constants_test
