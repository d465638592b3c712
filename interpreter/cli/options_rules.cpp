// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include "cli/add_commands.h"
#include "cli/number_checks.h"

namespace gmsim::cli {
namespace {

constexpr const char* kCheckExamples = R"(Report every error of scenes and rule files.

Examples:
  gmsim check hanging.yaml                            with line, column and a suggestion
  gmsim check my.rule
  gmsim check stdlib-rules/tear/*.rule --stdlib stdlib-rules
)";

constexpr const char* kListExamples = R"(Show what rule files can use.

Examples:
  gmsim list rules
  gmsim list interactions --dimension 3
  gmsim list embeddings my.rule
  gmsim list integrators
  gmsim list scene                                    the keys of scenes
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
  gmsim fuzz my_rule my.rule --force       what a rule breaks that the checker rejects
)";

void add_rule_and_parameters(CLI::App& command, Options& options) {
  command.add_option("rule", options.rule, "the rule or operation")->required();
  command.add_option("files", options.files, "rule files that define it or what it needs");
  command.add_option("--param", options.parameters, "a parameter of the rule, NAME=VALUE")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
}

}  // namespace

void add_check(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("check", kCheckExamples);
  command->add_option("files", options.files, "scenes (.yaml) and rule files")->required();
  add_stdlib(*command, options);
  command->callback([&options] { options.command = Options::Command::Check; });
}

void add_list(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("list", kListExamples);
  command
      ->add_option("what", options.what,
                   "rules, operations, interactions, families, criteria, embeddings, orbits, "
                   "functions, patterns, builtins, types, units, integrators, scene or diagnostics")
      ->required();
  command->add_option("files", options.files, "rule files to list beside the library");
  add_dimension(*command, options);
  command->add_flag("--markdown", options.markdown, "as a page of the documentation");
  add_stdlib(*command, options);
  command->callback([&options] { options.command = Options::Command::List; });
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
  take_whole_numbers(command->add_option("--times", options.times, "repeat the whole application"),
                     1, 1000000);
  take_numbers_from_zero(command->add_option("--density", options.density,
                                             "mass per measure of an element, for corner_mass"));
  command->add_option("-o,--output", options.output, "result, .vtu or .obj")->type_name("FILE");
  command->add_flag("--validate", options.validate, "check the map after every rewrite");
  command->add_flag("--profile", options.profile, "time, touched darts and rows");
  command->add_option_function<std::string>(
      "--matcher",
      [&options](const std::string& name) { options.naive_matcher = name == "naive"; },
      "planned, or naive (slow, for comparison)")
      ->check(CLI::IsMember({"planned", "naive"}));
  add_stdlib(*command, options);
  command->callback([&options] { options.command = Options::Command::Apply; });
}

void add_fuzz(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("fuzz", kFuzzExamples);
  add_rule_and_parameters(*command, options);
  take_whole_numbers(command->add_option("--trials", options.trials, "maps to try"), 1, 100000000);
  command->add_option_function<std::uint64_t>(
      "--seed",
      [&options](std::uint64_t seed) {
        options.seed = seed;
        options.has_seed = true;
      },
      "repeat a run that printed this seed");
  command->add_flag("--force", options.force,
                    "try a rule although the checker rejects it, to see what it breaks");
  add_dimension(*command, options);
  add_stdlib(*command, options);
  command->callback([&options] { options.command = Options::Command::Fuzz; });
}

}  // namespace gmsim::cli
