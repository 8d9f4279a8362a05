#include "model/training/style.h"

#include <cctype>
#include <map>

namespace choreo {
namespace {

const std::map<std::string, std::string>& StyleOfWord() {
  static const std::map<std::string, std::string> styles = {
      {"afraid", "afraid"},       {"angry", "angry"},     {"annoyed", "annoyed"},
      {"bored", "bored"},         {"excited", "excited"}, {"happy", "happy"},
      {"miserable", "miserable"}, {"active", "active"},   {"neutral", "neutral"},
      {"pleased", "pleased"},     {"relaxed", "relaxed"}, {"sad", "sad"},
      {"satisfied", "satisfied"}, {"tired", "tired"},     {"salsa", "salsa"},
      {"indian", "indian"},       {"martial", "martial"}, {"w", "waltz"},
      {"c", "cha-cha"},           {"r", "rumba"},         {"t", "tango"},
      {"nervous", "nervous"},     {"scary", "scary"},     {"005", "modern"},
      {"aachan", "pop"},          {"kashiyuka", "pop"},   {"nocchi", "pop"}};
  return styles;
}

}  // namespace

std::string StyleOf(const std::string& clip_name) {
  std::string word;
  for (const char c : clip_name + "_") {
    if (c != '_') {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      continue;
    }
    const auto found = StyleOfWord().find(word);
    if (found != StyleOfWord().end()) return found->second;
    word.clear();
  }
  return "";
}

}  // namespace choreo
