// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include "cli/add_commands.h"
#include "cli/number_checks.h"

namespace gmsim::cli {
namespace {

constexpr const char* kRunExamples = R"(Run a scene. The word `run` may be left out.

Examples:
  gmsim hanging.yaml                                  writes hanging.vtkhdf
  gmsim hanging.yaml -o other.vtkhdf --threads 4
  gmsim hanging.yaml --set integrator.dt=5e-4 --set bodies.cloth.mass=0.2
  gmsim hanging.yaml --max-wall 60 --json > log.jsonl
  gmsim hanging.yaml --no-output                      only the numbers on the screen
  gmsim hanging.yaml --explain-tear                   why nothing tore, or so little

Ctrl-C ends the run after the current step and closes the file (exit code 4).
)";

constexpr const char* kVerifyExamples = R"(Run a scene and compare what it expects with what comes out.

Examples:
  gmsim verify scenes/verification/pendulum.yaml      exit code 1 when an expectation is not met
  gmsim verify pendulum.yaml --set integrator.dt=1e-4 --json
)";

constexpr const char* kExplainExamples = R"(Show what a scene becomes: interactions, matches, and the plan of the forces.

Examples:
  gmsim explain hanging.yaml
  gmsim explain hanging.yaml --set integrator.method=velocity_verlet
)";

constexpr const char* kStudyExamples = R"(Compare integrators and step sizes on one scene: cost against error.

Examples:
  gmsim study swing.yaml --methods rk4,velocity_verlet --dt 4e-3,2e-3,1e-3 -o study
  gmsim study swing.yaml --methods rk4 --dt 1e-3 --reference-dt 1e-5 --repetitions 9 -o study

Prints a table and, with -o, writes study.csv and study.json. Errors are against a run of the
reference method at an eighth of the smallest step; a second one at twice that step gives the floor
below which errors mean nothing. Timed runs write nothing.
)";

void add_scene(CLI::App& command, Options& options) {
  command.add_option("scene", options.run.scene, "the scene, a YAML file")
      ->required()
      ->type_name("SCENE");
  command.add_option("--set", options.run.overrides, "another value for something in the scene")
      ->allow_extra_args(false)
      ->type_name("PATH=VALUE");
}

void add_engine(CLI::App& command, Options& options) {
  take_whole_numbers(command.add_option("--threads", options.run.threads,
                                        "threads; the result is the same bit by bit"),
                     1, 1024);
  command.add_option_function<std::string>(
      "--kernel",
      [&options](const std::string& name) { options.run.tree_kernel = name == "tree"; },
      "batched, or tree (slow, for comparison)")
      ->check(CLI::IsMember({"batched", "tree"}))
      ->type_name("KIND");
}

}  // namespace

void add_run(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("run", kRunExamples);
  add_scene(*command, options);
  auto* output = command->add_option("-o,--out", options.run.output, "the file to write")
                     ->type_name("FILE");
  command->add_flag("--no-output", options.run.no_output, "write no file")->excludes(output);
  command->add_flag("--force", options.run.force,
                    "write over what an earlier run left behind (NAME.part)");
  command->add_flag("--json", options.run.json, "log lines as JSON, one object a line");
  command->add_flag("--explain-tear", options.run.explain_tear,
                    "at the end, how near each criterion came to its threshold, where and when");
  take_numbers_from_zero(command
                             ->add_option("--max-wall", options.run.max_wall,
                                          "stop after so many seconds (exit code 4)")
                             ->type_name("SECONDS"));
  command->add_option("--trace", options.run.traces, "follow a phase, as in `step` or `match:RULE`")
      ->allow_extra_args(false)
      ->type_name("PHASE[:RULE]");
  add_engine(*command, options);
  add_stdlib(*command, options);
  command->callback([&options] { options.command = Options::Command::Run; });
}

void add_verify(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("verify", kVerifyExamples);
  add_scene(*command, options);
  command->add_flag("--json", options.run.json, "as one JSON object");
  add_engine(*command, options);
  add_stdlib(*command, options);
  command->callback([&options] { options.command = Options::Command::Verify; });
}

void add_explain(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("explain", kExplainExamples);
  add_scene(*command, options);
  add_engine(*command, options);
  add_stdlib(*command, options);
  command->callback([&options] { options.command = Options::Command::Explain; });
}

void add_study(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("study", kStudyExamples);
  add_scene(*command, options);
  command->add_option("--methods", options.study.methods, "integrators to compare")
      ->required()
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME,NAME");
  take_positive_numbers(command->add_option("--dt", options.study.steps, "steps to compare, s")
                            ->delimiter(',')
                            ->allow_extra_args(false)
                            ->type_name("DT,DT"));
  take_positive_numbers(
      command
          ->add_option("--rtol", options.study.tolerances,
                       "tolerances to compare, for methods that choose their steps")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->type_name("RTOL,RTOL"));
  take_positive_numbers(
      command
          ->add_option("--reference-dt", options.study.reference_step, "step of the reference, s")
          ->type_name("DT"));
  command->add_option("--reference-method", options.study.reference_method, "rk4 unless told otherwise")
      ->type_name("NAME");
  take_whole_numbers(
      command->add_option("--repetitions", options.study.repetitions, "timed runs of each point"),
      1, 1000);
  command->add_option("-o,--out", options.study.folder, "folder for the results")->type_name("DIR");
  add_engine(*command, options);
  add_stdlib(*command, options);
  command->callback([&options] { options.command = Options::Command::Study; });
}

}  // namespace gmsim::cli
