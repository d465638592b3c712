// SPDX-License-Identifier: MIT
#include "cli/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ostream>

#include "cli/add_commands.h"
#include "cli/number_checks.h"
#include "cli/run_cli.h"
#include "cli/version.h"
#include "support/suggest.h"

namespace gmsim::cli {
namespace {

constexpr const char* kTopExamples = R"(gmsim: a rule language for deformable bodies that tear

Examples:
  gmsim hanging.yaml                                  run a scene; writes hanging.vtkhdf
  gmsim check hanging.yaml my.rule                    all errors of scenes and rule files
  gmsim info hanging.vtkhdf                           what a run left
  gmsim view hanging.vtkhdf                           a page for the browser
  gmsim export hanging.vtkhdf -o frames               for ParaView of any age
  gmsim list rules                                    what the library offers
  gmsim apply triangulate_face --mesh grid:quads:10x10 -o out.vtu
  gmsim fuzz my_rule my.rule                          look for a map that the rule breaks
  gmsim --dump ast,checked,plan my.rule               one rule at every stage

Exit codes: 0 done, 1 stopped (unstable, diverged, an expectation not met), 2 input rejected,
            3 reading or writing failed, 4 interrupted with everything written
)";

constexpr std::array kCommands = {"run",  "check",  "verify", "explain", "study", "info", "export",
                                  "recover", "snapshot", "view", "list", "apply", "fuzz"};

/// Shows commands by the first line of what they do; `gmsim COMMAND -h` has the rest.
class Formatter : public CLI::Formatter {
 public:
  Formatter() { column_width(30); }
  std::string make_subcommand(const CLI::App* command) const override {
    const std::string text = command->get_description();
    std::ostringstream line;
    CLI::detail::format_help(line, command->get_name(), text.substr(0, text.find('\n')),
                             get_column_width());
    return line.str();
  }
};

void add_dump(CLI::App& app, Options& options) {
  app.add_option("--dump", options.dumps, "tokens, ast, source, checked, plan")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"tokens", "ast", "source", "checked", "plan"}));
  app.add_option("files", options.files, "a scene to run, or rule files to dump");
}

bool is_scene(const std::string& word) {
  return word.ends_with(".yaml") || word.ends_with(".yml");
}

bool is_command(const std::string& word) {
  return std::find(kCommands.begin(), kCommands.end(), word) != kCommands.end();
}

/// `gmsim scene.yaml` and `gmsim --threads 2 scene.yaml` mean `gmsim run …`.
bool means_run(std::span<const std::string> words) {
  if (words.empty() || is_command(words.front())) return false;
  if (is_scene(words.front())) return true;
  return words.front().starts_with("-") && std::any_of(words.begin(), words.end(), is_scene) &&
         std::none_of(words.begin(), words.end(), is_command) &&
         std::none_of(words.begin(), words.end(),
                      [](const std::string& word) { return word.starts_with("--dump"); });
}

void refuse_word(const Options& options, std::ostream& err) {
  const std::string word = options.files.empty() ? "" : options.files.front();
  std::vector<std::string> known(kCommands.begin(), kCommands.end());
  std::string guess = support::did_you_mean(word, known);
  if (word.ends_with(".rule")) guess = "write `gmsim check " + word + "`";
  if (word.ends_with(".vtkhdf")) guess = "write `gmsim info " + word + "`";
  err << "error: `" << word << "` is no command and no scene [usage]\n"
      << "help: " << (guess.empty() ? "`gmsim -h` lists the commands; scenes end in .yaml" : guess)
      << '\n';
}

/// CLI11 throws for `-h` as well as for mistakes; tell them apart here.
std::optional<int> answer(const CLI::App& app, const CLI::ParseError& error, std::ostream& out,
                          std::ostream& err) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    app.exit(error, out, err);
    return kDone;
  }
  const auto commands = app.get_subcommands();
  err << "error: " << error.what() << " [usage]\n"
      << "help: `gmsim " << (commands.empty() ? "" : commands.front()->get_name() + " ")
      << "-h` shows examples\n";
  return kRejected;
}

/// A word as a shell would take it.
std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) || std::string_view("-_./=,:+@%").find(static_cast<char>(c)) !=
                                  std::string_view::npos;
  });
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string command_line(std::span<const std::string> arguments) {
  std::string text = "gmsim";
  for (const std::string& word : arguments) text += ' ' + quoted(word);
  return text;
}

}  // namespace

void add_stdlib(CLI::App& app, Options& options) {
  app.add_option("--stdlib", options.stdlib_folder,
                 "read the standard library from this folder instead of the one built in")
      ->type_name("DIR");
}

void add_dimension(CLI::App& app, Options& options) {
  take_whole_numbers(app.add_option("--dimension", options.dimension, "dimension of the map"), 1,
                     3);
}

ParsedOptions parse_options(std::span<const std::string> arguments, std::ostream& out,
                            std::ostream& err) {
  ParsedOptions parsed;
  Options& options = parsed.options;
  options.command_line = command_line(arguments);
  CLI::App app{kTopExamples, "gmsim"};
  app.formatter(std::make_shared<Formatter>());
  app.set_version_flag("--version", version_text());
  app.require_subcommand(0, 1);
  add_dump(app, options);
  add_dimension(app, options);
  add_stdlib(app, options);
  for (const auto add : {add_run, add_check, add_verify, add_explain, add_study, add_info,
                         add_export, add_recover, add_snapshot, add_view, add_list, add_apply, add_fuzz})
    add(app, options);

  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  if (means_run(arguments)) reversed.emplace_back("run");
  try {
    app.parse(std::move(reversed));
  } catch (const CLI::ParseError& error) {
    parsed.exit_code = answer(app, error, out, err);
    return parsed;
  }
  if (options.command != Options::Command::None) return parsed;
  if (!options.dumps.empty()) {
    options.command = Options::Command::Dump;
  } else if (arguments.empty()) {
    out << app.help();
    parsed.exit_code = kDone;
  } else {
    refuse_word(options, err);
    parsed.exit_code = kRejected;
  }
  return parsed;
}

}  // namespace gmsim::cli
