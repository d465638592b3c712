// SPDX-License-Identifier: MIT
#include "check/item_context.h"

#include <filesystem>
#include <utility>

#include "check/make_expr.h"

namespace gmsim::check {
using support::Diagnostic;
using support::DiagnosticKind;

std::string_view describe(Binding::Kind kind) {
  switch (kind) {
    case Binding::Kind::Node: return "a node";
    case Binding::Kind::NewNode: return "a node";
    case Binding::Kind::Parameter: return "a parameter";
    case Binding::Kind::Let: return "a `let`";
    case Binding::Kind::FoldVariable: return "a variable";
    case Binding::Kind::Argument: return "a parameter";
    case Binding::Kind::Macro: return "a `let`";
  }
  return {};
}

Slot ItemContext::new_slot(const std::string& name, double scale) {
  slot_names.push_back(name);
  slot_scales.push_back(scale);
  return Slot{static_cast<std::uint32_t>(slot_names.size() - 1)};
}

bool ItemContext::declare(Binding binding) {
  if (binding.name == "time" || binding.name == "step" || binding.name == "dt") {
    report({.kind = DiagnosticKind::DuplicateName,
            .message = "`" + binding.name + "` is predeclared",
            .place = binding.span,
            .help = "choose another name"});
    return false;
  }
  if (const Binding* other = scope.find(binding.name)) {
    report({.kind = DiagnosticKind::DuplicateName,
            .message = "`" + binding.name + "` is already " + std::string(describe(other->kind)) +
                       " here",
            .place = binding.span,
            .related = {{other->span, "declared here"}}});
    return false;
  }
  scope.add(std::move(binding));
  return true;
}

ExprPtr ItemContext::declare_slot(const syntax::Name& name, Binding::Kind kind,
                                  const types::ValueType& type, const types::MaybeUnit& unit,
                                  double scale) {
  ExprPtr local = make_local(new_slot(name.text, scale), type, unit, name.span);
  declare({.name = name.text, .kind = kind, .value = local, .span = name.span});
  return local;
}

namespace {

/// A wrong name is wrong wherever its function is called from.
bool is_about_a_name(DiagnosticKind kind) {
  return kind == DiagnosticKind::UnknownName || kind == DiagnosticKind::UnknownEmbedding ||
         kind == DiagnosticKind::UnknownOrbit || kind == DiagnosticKind::UnknownFunction ||
         kind == DiagnosticKind::UnknownUnit;
}

}  // namespace

void ItemContext::report(Diagnostic diagnostic) {
  if (absence) return;
  if (!expansions.empty() && diagnostic.place && !is_about_a_name(diagnostic.kind)) {
    const Expansion& outer = expansions.front();
    diagnostic.related.insert(diagnostic.related.begin(),
                              {*diagnostic.place, "in `" + expansions.back().name + "`"});
    diagnostic.place = outer.call;
  }
  diagnostics.report(std::move(diagnostic));
}

void ItemContext::report_unknown(Diagnostic diagnostic) {
  if (env.names_missing) return poison();
  report(std::move(diagnostic));
}

void ItemContext::absent(DiagnosticKind kind, Span place, std::string message) {
  if (absence) return;
  Diagnostic diagnostic{.kind = kind, .message = std::move(message), .place = place};
  if (!expansions.empty()) {
    diagnostic.related.push_back({place, "in `" + expansions.back().name + "`"});
    diagnostic.place = expansions.front().call;
  }
  absence = std::move(diagnostic);
}

bool ItemContext::require(ItemIndex item, Span place) {
  const ItemState& state = env.states[item];
  if (state.status == ItemStatus::Failed) {
    poison();
    return false;
  }
  if (state.status != ItemStatus::Absent) return true;
  const ItemEntry& entry = (*env.items)[item];
  absent(DiagnosticKind::Dimension, place,
         std::string(noun(entry.kind)) + " `" + entry.name->text +
             "` does not exist in dimension " + std::to_string(n()) + ": " +
             state.absence->message);
  return false;
}

std::string ItemContext::place_text(Span span) const {
  const std::string file = std::filesystem::path(sources.name(span.file)).filename().string();
  return file + ":" + std::to_string(sources.locate(span.file, span.begin).line);
}

}  // namespace gmsim::check
