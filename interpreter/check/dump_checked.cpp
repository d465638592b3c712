// SPDX-License-Identifier: MIT
// `--dump checked`: the items of one file as they are after checking.
#include <map>
#include <ostream>
#include <utility>

#include "check/check.h"
#include "check/make_expr.h"
#include "check/resolve.h"
#include "check/unit_rules.h"

namespace gmsim::check {
namespace {

std::string_view text_of(gmap::MergePolicy policy) {
  switch (policy) {
    case gmap::MergePolicy::None: return "";
    case gmap::MergePolicy::Equal: return "equal";
    case gmap::MergePolicy::First: return "first";
    case gmap::MergePolicy::Mean: return "mean";
    case gmap::MergePolicy::Min: return "min";
    case gmap::MergePolicy::Max: return "max";
  }
  return "";
}

/// Names of locals told apart: scopes that do not meet may share a name.
std::vector<std::string> distinct(std::vector<std::string> names) {
  std::map<std::string, int> uses;
  for (std::string& name : names)
    if (const int count = uses[name]++; count > 0) name += "#" + std::to_string(count + 1);
  return names;
}

class Dump {
 public:
  Dump(const RuleLibrary& library, std::ostream& out) : library_(library), out_(out) {
    for (const gmap::EmbeddingDecl& value : library.schema)
      names_.embeddings.push_back(value.name);
    for (const Interaction& law : library.interactions) names_.interactions.push_back(law.name);
  }

  void value(const gmap::EmbeddingDecl& v) {
    if (v.role != gmap::EmbeddingRole::Data) return;  // shown with their interaction
    names_.slots.clear();
    for (std::uint32_t i = 0; i < v.frame_size; ++i)
      names_.slots.push_back(std::string(1, static_cast<char>('a' + i % 26)) +
                             (i < 26 ? "" : std::to_string(i / 26)));
    out_ << (v.kind == gmap::EmbeddingKind::Derived ? "derived " : "embedding ") << v.name << " : "
         << type_text(v.type, v.unit) << " on " << to_string(v.orbit);
    behaviour(v);
    if (v.default_value) out_ << " = " << to_string(*v.default_value);
    if (v.derivation) out_ << "(" << slot(v.dart_slot) << ") = " << text(v.derivation);
    out_ << "\n";
  }

  void rule(const Rule& r) {
    head("rule", r);
    out_ << "(";
    for (std::size_t i = 0; i < r.hooks.size(); ++i)
      out_ << (i > 0 ? ", " : "") << r.left.nodes[r.hooks[i]].name;
    out_ << ")\n";
    pattern("left", r.left);
    if (r.has_right) pattern("right", r.right);
    parameters(r.parameters);
    steps(r.steps);
    for (const Assignment& a : r.assignments)
      out_ << "  " << r.right.nodes[a.node].name << "."
           << library_.schema[a.embedding].name << " = " << typed(a.value) << "\n";
    footprint(r.footprint);
  }

  void interaction(const Interaction& law) {
    head(law.external ? "external interaction" : "interaction", law);
    out_ << " on " << to_string(law.orbit) << "(" << slot(law.dart) << ")\n";
    pattern("match", law.match);
    if (law.first) out_ << "  first " << slot(law.first_dart) << " where " << text(law.first) << "\n";
    parameters(law.parameters);
    steps(law.steps);
    if (law.energy) out_ << "  energy " << typed(law.energy) << "\n";
    for (const ForceLine& line : law.forces) force(line);
    results(law.results);
    footprint(law.footprint);
  }

  void criterion(const Criterion& c) {
    head("criterion", c);
    if (c.interaction) out_ << " of " << names_.interactions[types::index(*c.interaction)];
    out_ << " on " << to_string(c.orbit) << "(" << slot(c.dart) << ")\n";
    pattern("match", c.match);
    parameters(c.parameters);
    steps(c.steps);
    out_ << "  value " << typed(c.value) << "\n";
    results(c.results);
    if (c.change)
      out_ << "  apply "
           << (c.change->operation ? library_.operations[c.change->target].name
                                   : library_.rules[c.change->target].name)
           << "(" << c.match.nodes[c.change->node].name << ")\n";
    footprint(c.footprint);
  }

  void operation(const Operation& o) {
    head("operation", o);
    out_ << " on " << to_string(o.orbit) << "(" << slot(o.dart) << ")\n";
    parameters(o.parameters);
    body(o.body, 2);
    footprint(o.footprint);
  }

  void family(const Family& f) {
    out_ << "family " << f.name << " =";
    for (std::size_t i = 0; i < f.members.size(); ++i)
      out_ << (i > 0 ? ", " : " ") << names_.interactions[types::index(f.members[i])];
    out_ << "\n";
  }

 private:
  void head(std::string_view kind, const ItemHead& item) {
    names_.slots = distinct(item.slot_names);
    out_ << kind << " " << item.name;
  }

  std::string slot(Slot s) const {
    const std::uint32_t i = types::index(s);
    return i < names_.slots.size() ? names_.slots[i] : "#" + std::to_string(i);
  }
  std::string text(const ExprPtr& expr) const { return to_string(*expr, names_); }
  std::string typed(const ExprPtr& expr) const {
    return text(expr) + "  : " + type_text(expr->type, expr->unit);
  }

  void behaviour(const gmap::EmbeddingDecl& v) {
    if (v.optional && v.role == gmap::EmbeddingRole::Data) out_ << " optional";
    if (v.kind == gmap::EmbeddingKind::Extensive) out_ << " extensive";
    if (v.weight) out_ << " split " << text(v.weight);
    if (v.merge != gmap::MergePolicy::None) out_ << " merge " << text_of(v.merge);
  }

  void pattern(std::string_view side, const Pattern& p) {
    out_ << "  " << side << " {";
    for (const PatternNode& node : p.nodes) {
      out_ << " " << node.name << "<";
      for (std::size_t i = 0; i < node.label.size(); ++i) {
        if (i > 0) out_ << ",";
        if (node.label[i] == kBlank)
          out_ << "_";
        else
          out_ << static_cast<int>(node.label[i]);
      }
      out_ << ">;";
    }
    for (const PatternArc& arc : p.arcs)
      out_ << " " << p.nodes[arc.a].name << " -" << arc.dimension << "- " << p.nodes[arc.b].name
           << ";";
    for (const PatternPath& path : p.paths) {
      out_ << " " << p.nodes[path.from].name << " -";
      for (std::size_t i = 0; i < path.dimensions.size(); ++i)
        out_ << (i > 0 ? "." : "") << path.dimensions[i];
      out_ << "- " << p.nodes[path.to].name << ";";
    }
    out_ << " }\n";
  }

  void parameters(const std::vector<Parameter>& all) {
    for (const Parameter& p : all) {
      out_ << "  param " << p.name << " : " << type_text(p.type, p.unit);
      if (p.embedding) behaviour(library_.schema[*p.embedding]);
      if (p.default_value) out_ << " = " << text(p.default_value);
      out_ << "\n";
    }
  }

  void steps(const std::vector<Step>& all) {
    for (const Step& step : all)
      if (step.kind == Step::Kind::Let)
        out_ << "  let " << slot(step.slot) << " = " << typed(step.value) << "\n";
      else
        out_ << "  where " << text(step.value) << "\n";
  }

  void results(const std::vector<Result>& all) {
    for (const Result& r : all)
      out_ << "  result " << r.name << " = " << typed(r.value) << "\n";
  }

  void force(const ForceLine& line) {
    out_ << "  force ";
    for (std::size_t i = 0; i < line.targets.size(); ++i)
      out_ << (i > 0 ? ", " : "") << text(line.targets[i]);
    if (line.collection) out_ << " in " << text(line.collection);
    out_ << " on " << to_string(line.orbit);
    if (line.value) out_ << " = " << typed(line.value);
    out_ << "\n";
  }

  void body(const std::vector<OperationStatement>& statements, std::size_t indent) {
    for (const OperationStatement& statement : statements) {
      const std::string space(indent, ' ');
      if (const auto* let = std::get_if<OpLet>(&statement.node))
        out_ << space << "let " << slot(let->slot) << " = " << typed(let->value) << "\n";
      if (const auto* assign = std::get_if<OpAssign>(&statement.node))
        out_ << space << text(assign->dart) << "." << library_.schema[assign->embedding].name
             << " = " << typed(assign->value) << "\n";
      if (const auto* loop = std::get_if<OpFor>(&statement.node)) {
        out_ << space << "for " << slot(loop->variable) << " in " << text(loop->collection);
        if (loop->condition) out_ << " where " << text(loop->condition);
        out_ << "\n";
        body(loop->body, indent + 2);
      }
      if (const auto* choice = std::get_if<OpIf>(&statement.node)) {
        out_ << space << "if " << text(choice->condition) << "\n";
        body(choice->then_body, indent + 2);
        if (!choice->else_body.empty()) out_ << space << "else\n";
        body(choice->else_body, indent + 2);
      }
      if (const auto* apply = std::get_if<OpApply>(&statement.node)) apply_line(*apply, space);
    }
  }

  void apply_line(const OpApply& apply, const std::string& space) {
    const ItemHead& target = apply.operation
                                 ? static_cast<const ItemHead&>(library_.operations[apply.target])
                                 : library_.rules[apply.target];
    out_ << space << "apply " << target.name << "(";
    for (std::size_t i = 0; i < apply.darts.size(); ++i)
      out_ << (i > 0 ? ", " : "") << text(apply.darts[i]);
    for (std::size_t i = 0; i < apply.parameters.size(); ++i)
      out_ << (i > 0 ? ", " : "; ")
           << target.slot_names[types::index(apply.parameters[i].first)] << " = "
           << text(apply.parameters[i].second);
    out_ << ")\n";
  }

  void footprint(const Footprint& f) {
    const auto list = [&](std::string_view word, const std::vector<EmbeddingId>& ids) {
      if (ids.empty()) return;
      out_ << "  " << word;
      for (std::size_t i = 0; i < ids.size(); ++i)
        out_ << (i > 0 ? ", " : " ") << library_.schema[ids[i]].name;
      out_ << "\n";
    };
    list("reads", f.reads);
    list("writes", f.writes);
    out_ << "  reads links " << to_string(f.reads_links);
    if (!f.writes_links.empty()) out_ << ", writes links " << to_string(f.writes_links);
    if (f.creates_darts) out_ << ", creates darts";
    if (f.removes_darts) out_ << ", removes darts";
    if (f.reads_forces) out_ << ", reads forces";
    if (f.reads_time) out_ << ", reads time";
    out_ << "\n";
  }

  const RuleLibrary& library_;
  std::ostream& out_;
  types::ExprNames names_;
};

}  // namespace

void dump_checked(const RuleLibrary& library, support::FileId file, std::ostream& out) {
  Dump dump(library, out);
  for (const gmap::EmbeddingDecl& value : library.schema)
    if (value.span.file == file) dump.value(value);
  for (const Rule& rule : library.rules)
    if (rule.span.file == file) dump.rule(rule);
  for (const Interaction& law : library.interactions)
    if (law.span.file == file) dump.interaction(law);
  for (const Family& family : library.families)
    if (family.name_span.file == file) dump.family(family);
  for (const Criterion& criterion : library.criteria)
    if (criterion.span.file == file) dump.criterion(criterion);
  for (const Operation& operation : library.operations)
    if (operation.span.file == file) dump.operation(operation);
}

}  // namespace gmsim::check
