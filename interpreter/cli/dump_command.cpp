// SPDX-License-Identifier: MIT
#include <algorithm>
#include <ostream>
#include <string>

#include "cli/commands.h"
#include "cli/run_cli.h"
#include "compile/compile.h"
#include "syntax/parse.h"

namespace gmsim::cli {
namespace {

bool wants(const Session& session, const char* stage) {
  const auto& dumps = session.options.dumps;
  return std::find(dumps.begin(), dumps.end(), stage) != dumps.end();
}

/// The stages that need the text alone; returns false when a file cannot be read.
bool dump_texts(Session& session) {
  for (const std::string& path : session.options.files) {
    const auto file = session.read(path);
    if (!file) return false;
    if (wants(session, "tokens")) syntax::dump_tokens(session.sources, *file, session.out);
    if (!wants(session, "ast") && !wants(session, "source")) continue;
    const syntax::RuleFile tree =
        syntax::parse_rule_file(session.sources, *file, session.diagnostics);
    if (wants(session, "ast")) syntax::dump_ast(tree, session.out);
    if (wants(session, "source")) session.out << syntax::reprint(tree);
  }
  return true;
}

bool is_asked(const Session& session, support::FileId file) {
  const auto& files = session.options.files;
  return std::find(files.begin(), files.end(), session.sources.name(file)) != files.end();
}

void dump_dimension(Session& session, const check::CheckedRules& rules, int dimension) {
  const check::RuleLibrary& library = rules.in(dimension);
  for (const syntax::RuleFile& file : rules.files())
    if (is_asked(session, file.file) && wants(session, "checked"))
      check::dump_checked(library, file.file, session.out);
  if (!wants(session, "plan")) return;
  const compile::Program program = compile::compile_program(library);
  const auto print_own = [&](const compile::ItemHead& item) {
    if (is_asked(session, item.name_span.file))
      compile::print_program(program, session.out, item.name);
  };
  for (const auto& rule : program.rules) print_own(rule);
  for (const auto& operation : program.operations) print_own(operation);
  for (const auto& interaction : program.interactions) print_own(interaction);
  for (const auto& criterion : program.criteria) print_own(criterion);
}

}  // namespace

int run_dump(Session& session) {
  if (session.options.files.empty())
    session.diagnostics.report({.kind = support::DiagnosticKind::Usage,
                                .message = "`--dump` needs a rule file",
                                .help = "for example `gmsim --dump ast,checked,plan my.rule`"});
  if (session.diagnostics.has_errors() || !dump_texts(session)) return session.finish();
  if (!wants(session, "checked") && !wants(session, "plan")) return session.finish();
  const check::CheckedRules rules = session.check_rules();
  for (int dimension : {1, 2, 3})
    if (session.options.dimension == 0 || session.options.dimension == dimension)
      dump_dimension(session, rules, dimension);
  return session.finish();
}

}  // namespace gmsim::cli
