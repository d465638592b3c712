// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

#include "cli/options.h"

/// Internal: each function describes commands to the parser of the command line.
namespace gmsim::cli {

void add_check(CLI::App& app, Options& options);
void add_list(CLI::App& app, Options& options);
void add_apply(CLI::App& app, Options& options);
void add_fuzz(CLI::App& app, Options& options);

void add_run(CLI::App& app, Options& options);
void add_verify(CLI::App& app, Options& options);
void add_explain(CLI::App& app, Options& options);
void add_study(CLI::App& app, Options& options);

void add_info(CLI::App& app, Options& options);
void add_export(CLI::App& app, Options& options);
void add_recover(CLI::App& app, Options& options);
void add_snapshot(CLI::App& app, Options& options);
void add_view(CLI::App& app, Options& options);

/// Options of several commands.
void add_stdlib(CLI::App& app, Options& options);
void add_dimension(CLI::App& app, Options& options);

}  // namespace gmsim::cli
