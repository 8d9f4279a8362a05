#include "client/cli/options/misspelling.h"

#include "model/core/joined.h"
#include "model/core/text/nearest.h"

namespace choreo::cli {
namespace {

std::string DescribeCommand(const CLI::App& program, const std::string& word) {
  Nearest command(word);
  const auto known = program.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* one : known) command.Offer(one->get_name());
  const auto name = [](const CLI::App* one) { return one->get_name(); };
  return word + " is not a command; " +
         (command.nearest().empty() ? "there are " + Joined(known, name)
                                    : "did you mean " + command.nearest() + "?");
}

}  // namespace

std::string DescribeMisspelling(const CLI::App& program) {
  if (program.get_subcommands().empty()) {
    for (const std::string& word : program.remaining())
      if (!word.starts_with("-")) return DescribeCommand(program, word);
  }
  for (const CLI::App* command : program.get_subcommands()) {
    for (const std::string& word : command->remaining()) {
      if (!word.starts_with("--")) continue;
      const std::string name = word.substr(0, word.find('='));
      Nearest option(name.substr(2));
      for (const CLI::Option* known : command->get_options()) {
        if (known->get_group().empty()) continue;  // hidden
        for (const std::string& long_name : known->get_lnames()) option.Offer(long_name);
      }
      if (option.nearest().empty()) continue;
      return name + " is not an option of " + command->get_name() + "; did you mean --" +
             option.nearest() + "?";
    }
  }
  return "";
}

}  // namespace choreo::cli
