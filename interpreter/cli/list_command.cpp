// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/run_cli.h"
#include "engine/integrators.h"
#include "scene/scene.h"
#include "scene/schema.h"
#include "support/suggest.h"
#include "types/builtin.h"
#include "types/unit.h"

namespace gmsim::cli {
namespace {

using check::RuleLibrary;

/// One line of a list: what it is called, what it looks like, and what it is for.
struct Entry {
  std::string name;
  std::string signature;
  std::string doc;
};
using Entries = std::vector<Entry>;

std::string unit_text(const types::MaybeUnit& unit) {
  return unit ? fmt::format(" [{}]", types::to_string(*unit)) : std::string{};
}

std::string parameter_text(const std::vector<check::Parameter>& parameters) {
  std::vector<std::string> texts;
  for (const check::Parameter& parameter : parameters)
    texts.push_back(fmt::format("{} : {}{}{}", parameter.name, types::to_string(parameter.type),
                                unit_text(parameter.unit),
                                parameter.default_value ? " = …" : ""));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string orbit_text(const RuleLibrary& library, types::OrbitType orbit) {
  for (const check::OrbitName& name : library.orbits)
    if (name.orbit == orbit) return fmt::format("{} {}", name.name, types::to_string(orbit));
  return types::to_string(orbit);
}

std::string with_parameters(std::string text, const std::vector<check::Parameter>& parameters) {
  return parameters.empty() ? text : fmt::format("{}; {}", text, parameter_text(parameters));
}

Entries list_rules(const RuleLibrary& library) {
  Entries entries;
  for (const check::Rule& rule : library.rules) {
    std::vector<std::string> hooks;
    for (const check::NodeIndex hook : rule.hooks) hooks.push_back(rule.left.nodes[hook].name);
    entries.push_back({rule.name,
                       with_parameters(fmt::format("({})", fmt::join(hooks, ", ")), rule.parameters),
                       rule.doc});
  }
  return entries;
}

template <class Item>
Entries list_on_orbit(const RuleLibrary& library, const std::vector<Item>& items) {
  Entries entries;
  for (const Item& item : items)
    entries.push_back(
        {item.name,
         with_parameters("on " + orbit_text(library, item.orbit), item.parameters), item.doc});
  return entries;
}

/// As `list_on_orbit`, with what is done where they fire.
Entries list_criteria(const RuleLibrary& library) {
  Entries entries = list_on_orbit(library, library.criteria);
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (const auto& change = library.criteria[i].change)
      entries[i].signature += fmt::format("; apply {}",
                                          change->operation ? library.operations[change->target].name
                                                            : library.rules[change->target].name);
  return entries;
}

Entries list_families(const RuleLibrary& library) {
  Entries entries;
  for (const check::Family& family : library.families) {
    std::vector<std::string> members;
    for (const types::InteractionId id : family.members)
      members.push_back(library.interactions[types::index(id)].name);
    entries.push_back({family.name, fmt::format("= {}", fmt::join(members, ", ")), family.doc});
  }
  return entries;
}

std::string kind_text(const gmap::EmbeddingDecl& embedding) {
  switch (embedding.kind) {
    case gmap::EmbeddingKind::Intensive: return "";
    case gmap::EmbeddingKind::Extensive: return ", extensive";
    case gmap::EmbeddingKind::Derived: return ", derived";
  }
  return "";
}

Entries list_embeddings(const RuleLibrary& library) {
  Entries entries;
  for (const gmap::EmbeddingDecl& embedding : library.schema) {
    if (embedding.role != gmap::EmbeddingRole::Data) continue;
    entries.push_back({embedding.name,
                       fmt::format("{}{} on {}{}{}{}", types::to_string(embedding.type),
                                   unit_text(embedding.unit),
                                   orbit_text(library, embedding.orbit), kind_text(embedding),
                                   embedding.optional ? ", optional" : "",
                                   embedding.default_value
                                       ? ", default " + types::to_string(*embedding.default_value)
                                       : ""),
                       embedding.doc});
  }
  return entries;
}

Entries list_orbits(const RuleLibrary& library) {
  Entries entries;
  for (const check::OrbitName& orbit : library.orbits)
    entries.push_back({orbit.name, types::to_string(orbit.orbit), orbit.doc});
  return entries;
}

Entries list_named(const std::vector<check::NamedDoc>& items) {
  Entries entries;
  for (const check::NamedDoc& item : items) entries.push_back({item.name, item.signature, item.doc});
  return entries;
}

std::string signature_text(const types::Signature& signature) {
  std::vector<std::string> parameters;
  for (const types::ValueType& type : signature.parameters)
    parameters.push_back(types::to_string(type));
  return fmt::format("({}) -> {}", fmt::join(parameters, ", "), types::to_string(signature.result));
}

Entries list_builtins() {
  Entries entries;
  for (const types::BuiltinInfo& builtin : types::builtins()) {
    std::vector<std::string> signatures;
    for (const types::Signature& signature : builtin.signatures)
      signatures.push_back(signature_text(signature));
    entries.push_back({std::string(builtin.name), fmt::format("{}", fmt::join(signatures, "; ")),
                       std::string(builtin.doc)});
  }
  return entries;
}

Entries list_diagnostics() {
  Entries entries;
  for (const support::DiagnosticKindInfo& kind : support::diagnostic_kinds())
    entries.push_back({std::string(kind.name), "", std::string(kind.doc)});
  return entries;
}

Entries list_names(const std::vector<std::string>& names) {
  Entries entries;
  for (const std::string& name : names) entries.push_back({name, "", ""});
  return entries;
}

Entries list_units() {
  Entries entries;
  for (const std::string& name : types::unit_names()) {
    const auto unit = types::named_unit(name);
    entries.push_back({name,
                       unit->scale == 1.0
                           ? types::to_string(unit->unit)
                           : fmt::format("{} {}", unit->scale, types::to_string(unit->unit)),
                       ""});
  }
  return entries;
}

Entries list_integrators() {
  Entries entries;
  for (const engine::IntegratorInfo& method : engine::integrators())
    entries.push_back({std::string(method.name),
                       fmt::format("order {}, {} evaluation{} a step{}", method.order,
                                   method.stages, method.stages == 1 ? "" : "s",
                                   method.adaptive ? ", chooses its steps" : ""),
                       std::string(method.doc)});
  return entries;
}

Entries list_scene_keys() {
  Entries entries;
  for (const scene::SchemaRow& row : scene::schema_rows())
    entries.push_back({std::string(row.path),
                       row.fallback.empty() ? "" : fmt::format("({})", row.fallback),
                       std::string(row.doc)});
  return entries;
}

/// A list of items that depends on the dimension of the map, or of things that do not.
struct Listing {
  const char* name;
  std::function<Entries(const RuleLibrary&)> per_dimension;
  std::function<Entries()> once;
};

const std::vector<Listing>& listings() {
  static const std::vector<Listing> all = {
      {"rules", list_rules, {}},
      {"operations",
       [](const RuleLibrary& library) { return list_on_orbit(library, library.operations); },
       {}},
      {"interactions",
       [](const RuleLibrary& library) { return list_on_orbit(library, library.interactions); },
       {}},
      {"families", list_families, {}},
      {"criteria", list_criteria, {}},
      {"embeddings", list_embeddings, {}},
      {"orbits", list_orbits, {}},
      {"functions", [](const RuleLibrary& library) { return list_named(library.functions); }, {}},
      {"patterns", [](const RuleLibrary& library) { return list_named(library.patterns); }, {}},
      {"builtins", {}, list_builtins},
      {"types", {}, [] { return list_names(types::value_type_names()); }},
      {"units", {}, list_units},
      {"integrators", {}, list_integrators},
      {"scene", {}, list_scene_keys},
      {"diagnostics", {}, list_diagnostics}};
  return all;
}

std::string first_line(const std::string& doc) { return doc.substr(0, doc.find('\n')); }

void print_plain(const Entries& entries, std::ostream& out) {
  std::size_t name_width = 0;
  for (const Entry& entry : entries) name_width = std::max(name_width, entry.name.size());
  for (const Entry& entry : entries) {
    out << fmt::format("{:<{}}", entry.name, name_width + 2);
    if (!entry.signature.empty()) out << entry.signature;
    if (!entry.signature.empty() && !entry.doc.empty())
      out << fmt::format("\n{:<{}}", "", name_width + 2);
    out << first_line(entry.doc) << '\n';
  }
}

/// A documentation block as a page shows it: what stands under `Usage:` as code, and without the
/// tests under `Test:`.
std::string page_text(const std::string& doc) {
  enum class Part { Text, Usage, Test } part = Part::Text;
  std::string text;
  std::istringstream lines(doc);
  for (std::string line; std::getline(lines, line);) {
    const bool indented = line.empty() || line.starts_with("  ");
    if (part == Part::Usage && !indented) text += "```\n";
    if (!indented) part = Part::Text;
    if (line.starts_with("Test:")) part = Part::Test;
    if (part == Part::Test) continue;
    if (line.starts_with("Usage:")) {
      part = Part::Usage;
      const std::string rest = line.size() > 8 ? line.substr(8) + '\n' : "";
      text += "Usage:\n\n```\n" + rest;
      continue;
    }
    if (part == Part::Usage && line.empty()) {
      text += "```\n";
      part = Part::Text;
    }
    text += line + '\n';
  }
  if (part == Part::Usage) text += "```\n";
  return text;
}

void print_markdown(const Entries& entries, const std::string& title, std::ostream& out) {
  out << "# " << title << "\n";
  for (const Entry& entry : entries) {
    out << "\n## `" << entry.name << "`\n\n";
    if (!entry.signature.empty()) out << "`" << entry.name << ' ' << entry.signature << "`\n\n";
    if (!entry.doc.empty()) out << page_text(entry.doc);
  }
}

/// Items of all dimensions together, each said once; those that not every dimension has, or that
/// differ from one to the other, say where they are.
Entries merge_dimensions(const check::CheckedRules& rules, const Listing& listing) {
  Entries merged;
  for (int dimension : {2, 3, 1}) {
    for (Entry& entry : listing.per_dimension(rules.in(dimension))) {
      const auto known = std::find_if(merged.begin(), merged.end(), [&](const Entry& other) {
        return other.name == entry.name;
      });
      if (known == merged.end()) {
        if (dimension != 2) entry.signature += fmt::format("  ({}D)", dimension);
        merged.push_back(std::move(entry));
      }
    }
  }
  return merged;
}

}  // namespace

int run_list(Session& session) {
  const auto& all = listings();
  const auto listing = std::find_if(all.begin(), all.end(), [&](const Listing& candidate) {
    return candidate.name == session.options.what;
  });
  if (listing == all.end()) {
    std::vector<std::string> names;
    for (const Listing& candidate : all) names.emplace_back(candidate.name);
    session.diagnostics.report(
        {.kind = support::DiagnosticKind::Usage,
         .message = fmt::format("there is no list of `{}`", session.options.what),
         .notes = {fmt::format("lists are {}", fmt::join(names, ", "))},
         .help = support::did_you_mean(session.options.what, names)});
    return session.finish();
  }

  Entries entries;
  if (listing->once) {
    entries = listing->once();
  } else {
    const check::CheckedRules rules = session.check_rules();
    const int dimension = session.options.dimension;
    entries = dimension == 0 ? merge_dimensions(rules, *listing)
                             : listing->per_dimension(rules.in(dimension));
  }
  if (session.options.markdown && session.options.what == "scene") {
    session.out << scene::schema_documentation();
  } else if (session.options.markdown) {
    std::string title = listing->name;
    title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
    print_markdown(entries, title, session.out);
  } else {
    print_plain(entries, session.out);
  }
  return session.finish();
}

}  // namespace gmsim::cli
