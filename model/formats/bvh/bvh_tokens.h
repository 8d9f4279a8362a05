#pragma once

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>

#include "model/core/error.h"
#include "model/core/text/printable.h"

namespace choreo {

/// Splits the text of a BVH file at white space. Lines matter only in messages. # and // begin
/// comments up to the end of the line. Not thread-safe. Private to this folder.
class BvhTokens {
 public:
  BvhTokens(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  bool AtEnd() {
    SkipSpace();
    return at_ == text_.size();
  }

  std::string_view Next(const char* expected) {
    SkipSpace();
    if (at_ == text_.size()) Fail(expected, "the end of the file");
    const size_t begin = at_;
    while (at_ < text_.size() && !IsSpace(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  // Skips a label: "Frames:", "Frames :" or "Frames". The next token may follow directly.
  void Label(std::string_view word) {
    SkipSpace();
    if (!SameWord(text_.substr(at_, word.size()), word)) {
      const std::string expected = "'" + std::string(word) + ":'";
      Fail(expected, Next(expected.c_str()));
    }
    at_ += word.size();
    size_t colon = at_;
    while (colon < text_.size() && (text_[colon] == ' ' || text_[colon] == '\t')) ++colon;
    if (colon < text_.size() && text_[colon] == ':') at_ = colon + 1;
  }

  bool NextIs(std::string_view word) {
    SkipSpace();
    const size_t end = at_ + word.size();
    return SameWord(text_.substr(at_, word.size()), word) &&
           (end == text_.size() || IsSpace(text_[end]));
  }

  bool NextIs(char letter) {
    SkipSpace();
    return at_ < text_.size() && text_[at_] == letter;
  }

  // The rest of the line, for joint names with spaces.
  std::string_view RestOfLine(const char* expected) {
    while (at_ < text_.size() && IsSpace(text_[at_]) && text_[at_] != '\n') ++at_;
    const size_t begin = at_;
    // "ROOT Hips {" puts the brace on the same line.
    at_ = std::min(text_.find_first_of("\n{", begin), text_.size());
    size_t end = at_;
    while (end > begin && IsSpace(text_[end - 1])) --end;
    if (end == begin) Fail(expected, "nothing");
    return text_.substr(begin, end - begin);
  }

  void Expect(const char* word) {
    const std::string_view token = Next(word);
    if (!SameWord(token, word)) Fail("'" + std::string(word) + "'", token);
  }

  double Number(const char* expected, double limit = std::numeric_limits<double>::infinity()) {
    std::string_view token = Next(expected);
    std::string digits(token.starts_with('+') ? token.substr(1) : token);
    // Accepts a decimal comma.
    if (std::ranges::count(digits, ',') == 1 && digits.find('.') == std::string::npos)
      std::ranges::replace(digits, ',', '.');
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end != digits.data() + digits.size()) Fail(expected, token);
    if (error == std::errc::result_out_of_range) {
      if (digits.find("e-") == std::string::npos && digits.find("E-") == std::string::npos)
        Fail(expected, token);
      value = 0;  // below the smallest double
    } else if (error != std::errc() || !std::isfinite(value)) {
      Fail(std::string(expected) + " that is finite", token);
    }
    if (std::abs(value) > limit) {
      std::ostringstream within;
      within << expected << " from " << -limit << " to " << limit;
      Fail(within.str(), token);
    }
    return value;
  }

  int64_t line() const { return line_; }

  int64_t Count(const char* expected, int64_t limit) {
    const std::string_view token = Next(expected);
    int64_t value = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error != std::errc() || end != token.data() + token.size() || value < 0 || value > limit) {
      Fail(std::string(expected) + " of 0 to " + std::to_string(limit), token);
    }
    return value;
  }

  [[noreturn]] void Fail(const std::string& expected, std::string_view found) const {
    throw InvalidArgument(
        name_ + ":" + std::to_string(line_),
        "found '" + Printable(std::string(found.substr(0, 40))) + "', expected " + expected);
  }

  static bool SameWord(std::string_view a, std::string_view b) {
    return boost::algorithm::iequals(a, b, std::locale::classic());
  }

 private:
  // DOS's end-of-file character, and zeros that fill the last block, count as spaces.
  static bool IsSpace(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r') || c == '\x1a' || c == '\0';
  }
  void SkipSpace() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#' || text_.substr(at_, 2) == "//") {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (IsSpace(text_[at_])) {
        line_ += text_[at_++] == '\n';
      } else {
        return;
      }
    }
  }

  std::string_view text_;
  std::string name_;
  size_t at_ = 0;
  int64_t line_ = 1;
};

}  // namespace choreo
