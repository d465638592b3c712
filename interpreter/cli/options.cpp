// SPDX-License-Identifier: MIT
#include "cli/options.h"

#include <CLI/CLI.hpp>
#include <ostream>

#include "cli/run_cli.h"
#include "cli/version.h"
#include "support/suggest.h"

namespace gmsim::cli {
namespace {

constexpr const char* kTopExamples = R"(gmsim: a rule language for deformable bodies that tear

Examples:
  gmsim check my.rule                                 all errors of a rule file
  gmsim list rules                                    what the library offers
  gmsim apply triangulate_face --mesh grid:quads:10x10 -o out.vtu
  gmsim apply remove_element --mesh liver.msh --where "position.z > 0.1" -o cut.vtu
  gmsim fuzz my_rule my.rule                          look for a map that the rule breaks
  gmsim --dump ast,checked,plan my.rule               one rule at every stage
)";

constexpr const char* kCheckExamples = R"(Report every error of rule files.

Examples:
  gmsim check my.rule
  gmsim check stdlib-rules/tear/*.rule --stdlib stdlib-rules
)";

constexpr const char* kListExamples = R"(Show what rule files can use.

Examples:
  gmsim list rules
  gmsim list interactions --dimension 3
  gmsim list embeddings my.rule
  gmsim list builtins --markdown
)";

constexpr const char* kApplyExamples = R"(Apply a rule or an operation to a mesh and write the result.

Examples:
  gmsim apply triangulate_face --mesh grid:quads:10x10 -o out.vtu
  gmsim apply remove_element --mesh organ.msh --where "centroid(a).z > 0.1" -o cut.vtu
  gmsim apply subdivide_quads --mesh cloth.obj --times 3 -o fine.vtu
  gmsim apply thicken my.rule --mesh box:hexes:4x4x1 --param height=0.2 -o out.vtu

Meshes: a file, grid:CELLS:NXxNY[:WIDTHxHEIGHT] with CELLS quads, triangles, tri4, mix2 or mix4,
        box:CELLS:NXxNYxNZ[:LXxLYxLZ] with CELLS hexes, tets6 or tets5, chain:N[:LENGTH]
)";

constexpr const char* kFuzzExamples = R"(Apply a rule to random valid maps, look for one that it breaks, and make it small.

Examples:
  gmsim fuzz separate_elements
  gmsim fuzz my_rule my.rule --trials 10000 --seed 7
)";

void add_common(CLI::App& app, Options& options) {
  app.add_option("--stdlib", options.stdlib_folder,
                 "read the standard library from this folder instead of the one built in")
      ->type_name("DIR");
}

CLI::Option* add_dimension(CLI::App& app, Options& options) {
  return app.add_option("--dimension", options.dimension, "dimension of the map")
      ->check(CLI::Range(1, 3));
}

void add_check(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("check", kCheckExamples);
  command->add_option("files", options.files, "rule files")->required();
  add_common(*command, options);
  command->callback([&options] { options.command = Options::Command::Check; });
}

void add_list(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("list", kListExamples);
  command
      ->add_option("what", options.what,
                   "rules, operations, interactions, families, criteria, embeddings, orbits, "
                   "functions, patterns, builtins, types, units or diagnostics")
      ->required();
  command->add_option("files", options.files, "rule files to list beside the library");
  add_dimension(*command, options);
  command->add_flag("--markdown", options.markdown, "as a page of the documentation");
  add_common(*command, options);
  command->callback([&options] { options.command = Options::Command::List; });
}

void add_rule_and_parameters(CLI::App& command, Options& options) {
  command.add_option("rule", options.rule, "the rule or operation")->required();
  command.add_option("files", options.files, "rule files that define it or what it needs");
  command.add_option("--param", options.parameters, "a parameter of the rule, NAME=VALUE")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
}

void add_apply(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("apply", kApplyExamples);
  add_rule_and_parameters(*command, options);
  command->add_option("--mesh", options.mesh, "a mesh file or a builder, see above")->required();
  command->add_option("--to", options.to, "try one candidate per orbit of this kind");
  command->add_option("--where", options.where, "only where this expression of `a` is true");
  command->add_option("--at", options.at, "only at these darts, one for each hook of the rule")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("DART,DART");
  command->add_option("--times", options.times, "repeat the whole application")
      ->check(CLI::Range(1u, 1000000u));
  command->add_option("--density", options.density, "mass per measure of an element, for corner_mass")
      ->check(CLI::NonNegativeNumber);
  command->add_option("-o,--output", options.output, "result, .vtu or .obj")->type_name("FILE");
  command->add_flag("--validate", options.validate, "check the map after every rewrite");
  command->add_flag("--profile", options.profile, "time, touched darts and rows");
  command->add_option_function<std::string>(
      "--matcher",
      [&options](const std::string& name) { options.naive_matcher = name == "naive"; },
      "planned, or naive (slow, for comparison)")
      ->check(CLI::IsMember({"planned", "naive"}));
  add_common(*command, options);
  command->callback([&options] { options.command = Options::Command::Apply; });
}

void add_fuzz(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("fuzz", kFuzzExamples);
  add_rule_and_parameters(*command, options);
  command->add_option("--trials", options.trials, "maps to try")->check(CLI::Range(1u, 100000000u));
  command->add_option_function<std::uint64_t>(
      "--seed",
      [&options](std::uint64_t seed) {
        options.seed = seed;
        options.has_seed = true;
      },
      "repeat a run that printed this seed");
  add_dimension(*command, options);
  add_common(*command, options);
  command->callback([&options] { options.command = Options::Command::Fuzz; });
}

void add_dump(CLI::App& app, Options& options) {
  app.add_option("--dump", options.dumps, "tokens, ast, source, checked, plan")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"tokens", "ast", "source", "checked", "plan"}));
  app.add_option("files", options.files, "rule files to dump");
}

/// The first word is no command, and scenes cannot be run yet.
void refuse_word(const Options& options, std::ostream& err) {
  const std::string word = options.files.empty() ? "" : options.files.front();
  if (word.ends_with(".yaml") || word.ends_with(".yml")) {
    err << "error: this version does not run scenes yet [usage]\n"
        << "help: it checks rule files and applies rules to meshes: `gmsim -h` shows how\n";
    return;
  }
  const std::string guess =
      support::did_you_mean(word, {"check", "list", "apply", "fuzz", "--dump"});
  err << "error: `" << word << "` is no command [usage]\n"
      << "help: " << (guess.empty() ? "commands are check, list, apply and fuzz" : guess) << '\n';
}

/// CLI11 throws for `-h` as well as for mistakes; tell them apart here.
std::optional<int> answer(const CLI::App& app, const CLI::ParseError& error, std::ostream& out,
                          std::ostream& err) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    app.exit(error, out, err);
    return kDone;
  }
  err << "error: " << error.what() << " [usage]\n"
      << "help: `gmsim -h` and `gmsim COMMAND -h` show examples\n";
  return kRejected;
}

}  // namespace

ParsedOptions parse_options(std::span<const std::string> arguments, std::ostream& out,
                            std::ostream& err) {
  ParsedOptions parsed;
  Options& options = parsed.options;
  CLI::App app{kTopExamples, "gmsim"};
  app.set_version_flag("--version", kVersionText);
  app.require_subcommand(0, 1);
  app.get_formatter()->column_width(30);
  add_dump(app, options);
  add_dimension(app, options);
  add_common(app, options);
  add_check(app, options);
  add_list(app, options);
  add_apply(app, options);
  add_fuzz(app, options);

  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
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
