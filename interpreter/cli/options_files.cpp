// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include "cli/add_commands.h"
#include "cli/number_checks.h"

namespace gmsim::cli {
namespace {

constexpr const char* kInfoExamples = R"(Say what is in the file of a run.

Examples:
  gmsim info run.vtkhdf                               times, meshes, fields, energies
  gmsim info run.vtkhdf.part                          the same of a run that goes on or was cut short
  gmsim info run.vtkhdf --json | jq .frames           for programs
  gmsim info run.vtkhdf --scene > again.yaml          the scene that was run
  gmsim info run.vtkhdf --rules                       the rule files that were used
  gmsim info run.vtkhdf --events                      what tore, when, where and why
)";

constexpr const char* kExportExamples = R"(Write the frames of a run in another format.

Examples:
  gmsim export run.vtkhdf -o frames                   .pvd and .vtu, for ParaView of any age
  gmsim export run.vtkhdf -o frames --format obj      the surface of each frame
  gmsim export run.vtkhdf -o . --format usd           one .usda, for Blender
  gmsim export run.vtkhdf -o last --first -1          the last frame alone
  gmsim export run.vtkhdf -o few --every 10           every tenth frame
)";

constexpr const char* kRecoverExamples = R"(Get back the frames of a run that was cut short.

Examples:
  gmsim recover run.vtkhdf.part                       writes run.vtkhdf
  gmsim recover run.vtkhdf.part -o saved.vtkhdf
)";

constexpr const char* kSnapshotExamples = R"(Copy the finished frames of a run that goes on.

Examples:
  gmsim snapshot run.vtkhdf.part -o now.vtkhdf
)";

constexpr const char* kViewExamples = R"(Make a page that shows a run in a browser.

Examples:
  gmsim view run.vtkhdf                               writes run.html, one file to keep or to mail
  gmsim view run.vtkhdf -o swing.html --field velocity
  gmsim view run.vtkhdf --frames 500                  more frames, larger page
)";

void add_file(CLI::App& command, Options& options) {
  command.add_option("file", options.file.file, "a .vtkhdf or .vtkhdf.part that gmsim wrote")
      ->required()
      ->type_name("FILE");
}

void add_force(CLI::App& command, Options& options) {
  command.add_flag("--force", options.file.force, "write over a file that is there already");
}

}  // namespace

void add_info(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("info", kInfoExamples);
  add_file(*command, options);
  command->add_flag("--json", options.file.json, "as one JSON object");
  auto* scene = command->add_flag("--scene", options.file.show_scene, "print the scene and nothing else");
  auto* rules =
      command->add_flag("--rules", options.file.show_rules, "print the rule files and nothing else")
          ->excludes(scene);
  command->add_flag("--events", options.file.show_events, "print what tore and nothing else")
      ->excludes(scene)
      ->excludes(rules);
  command->callback([&options] { options.command = Options::Command::Info; });
}

void add_export(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("export", kExportExamples);
  add_file(*command, options);
  command->add_option("-o,--output", options.file.output, "folder for the files")
      ->required()
      ->type_name("DIR");
  command->add_option("--format", options.file.format, "pvd (the default), obj or usd")
      ->check(CLI::IsMember({"pvd", "obj", "usd"}))
      ->type_name("FORMAT");
  command->add_option("--first", options.file.first, "frame to begin with; -1 is the last");
  command->add_option("--last", options.file.last, "frame to end with");
  take_counts(command->add_option("--every", options.file.every, "only every so many frames"));
  command->callback([&options] { options.command = Options::Command::Export; });
}

void add_recover(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("recover", kRecoverExamples);
  add_file(*command, options);
  command->add_option("-o,--output", options.file.output, "the file to write; else NAME of NAME.part")
      ->type_name("FILE");
  add_force(*command, options);
  command->callback([&options] { options.command = Options::Command::Recover; });
}

void add_snapshot(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("snapshot", kSnapshotExamples);
  add_file(*command, options);
  command->add_option("-o,--output", options.file.output, "the file to write")
      ->required()
      ->type_name("FILE");
  add_force(*command, options);
  command->callback([&options] { options.command = Options::Command::Snapshot; });
}

void add_view(CLI::App& app, Options& options) {
  auto* command = app.add_subcommand("view", kViewExamples);
  add_file(*command, options);
  command->add_option("-o,--output", options.file.output, "the page; else NAME.html")
      ->type_name("FILE");
  command->add_option("--field", options.file.field, "colours the mesh when the page opens")
      ->type_name("NAME");
  take_counts(command->add_option("--frames", options.file.frames, "frames at most"));
  command->add_option("--title", options.file.title, "heading of the page")->type_name("TEXT");
  command->callback([&options] { options.command = Options::Command::View; });
}

}  // namespace gmsim::cli
