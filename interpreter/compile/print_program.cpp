// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <ostream>

#include "compile/compile.h"

namespace gmsim::compile {

namespace {

std::string label_text(const std::vector<std::int8_t>& label) {
  std::string text = "<";
  for (std::size_t p = 0; p < label.size(); ++p) {
    if (p > 0) text += ',';
    text += label[p] == kNoEntry ? std::string("_") : std::to_string(label[p]);
  }
  return text + ">";
}

std::string walk_text(const std::vector<std::int8_t>& path) {
  std::string text;
  for (std::int8_t dimension : path) text += fmt::format("@{}", static_cast<int>(dimension));
  return text;
}

/// Prints items of one program, names resolved.
class Printer {
 public:
  Printer(const Program& program, std::ostream& out) : program_(program), out_(out) {
    for (const gmap::EmbeddingDecl& decl : program.schema) names_.embeddings.push_back(decl.name);
    for (const RootedPattern& item : program.interactions) names_.interactions.push_back(item.name);
  }

  void print(const Rule& rule) {
    head("rule", rule);
    print_match(rule.match);
    print_rewrite(rule);
  }
  void print(const RootedPattern& item, std::string_view kind) {
    head(kind, item);
    line(1, fmt::format("one per {}{}", to_string(item.orbit),
                        item.presence ? " that carries it" : ""));
    if (item.first) {
      line(1, fmt::format("first {} where {}", names_.slots.at(types::index(item.first_dart)),
                          expression(item.first)));
    }
    print_match(item.match);
  }
  void print(const Operation& operation) {
    head("operation", operation);
    line(1, fmt::format("on {}({})", to_string(operation.orbit), slot(operation.dart)));
    print_body(operation.body, 1);
  }

 private:
  void line(int depth, std::string_view text) {
    out_ << fmt::format("{:{}}{}\n", "", 2 * depth, text);
  }
  [[nodiscard]] std::string slot(Slot s) const { return names_.slots.at(types::index(s)); }
  [[nodiscard]] std::string expression(const ExprPtr& expr) const {
    return types::to_string(*expr, names_);
  }

  void head(std::string_view kind, const ItemHead& item) {
    names_.slots = item.slot_names;
    out_ << fmt::format("{} {}  dimension {}, {} slots\n", kind, item.name, program_.dimension,
                        item.frame_size);
    for (const Parameter& parameter : item.parameters) {
      line(1, fmt::format("param {} : {}{}", parameter.name, types::to_string(parameter.type),
                          parameter.default_value
                              ? fmt::format(" = {}", expression(parameter.default_value))
                              : std::string()));
    }
  }

  void print_match(const MatchPlan& plan) {
    std::string nodes, hooks;
    for (const PlanNode& node : plan.nodes) {
      nodes += fmt::format(" {}{}", node.name, label_text(node.label));
    }
    for (Column hook : plan.hooks) hooks += " " + plan.nodes[hook].name;
    line(1, fmt::format("match{}", nodes));
    line(2, fmt::format("start{}", hooks));
    std::size_t next = 0;
    const auto predicates_before = [&](std::uint32_t step) {
      for (; next < plan.predicates.size() && plan.predicates[next].after <= step; ++next) {
        print_predicate(plan.predicates[next]);
      }
    };
    for (std::uint32_t i = 0; i < plan.links.size(); ++i) {
      predicates_before(i);
      print_link(plan, plan.links[i]);
    }
    predicates_before(static_cast<std::uint32_t>(plan.links.size()));
    if (plan.positions > 0) line(2, fmt::format("rows along {} positions", plan.positions));
    for (const LabelStep& step : plan.labels) {
      line(2, fmt::format("label {} position {} is {}", plan.nodes[step.column].name, step.position,
                          static_cast<int>(step.dimension)));
    }
    if (plan.nodes.size() > 1) line(2, "all darts distinct");
    predicates_before(Predicate::kWholeMatch);
  }

  void print_link(const MatchPlan& plan, const LinkStep& step) {
    const std::string& from = plan.nodes[step.from].name;
    const std::string& to = plan.nodes[step.to].name;
    switch (step.kind) {
      case LinkStep::Kind::Follow:
        return line(2, fmt::format("follow {} := {}@{}", to, from, int{step.dimension}));
      case LinkStep::Kind::RequireLink:
        return line(2, fmt::format("require {}@{} is {}", from, int{step.dimension}, to));
      case LinkStep::Kind::RequireFree:
        return line(2, fmt::format("require {} is {}-free", from, int{step.dimension}));
      case LinkStep::Kind::FollowPath:
        return line(2, fmt::format("follow {} := {}{}", to, from, walk_text(step.path)));
      case LinkStep::Kind::RequirePath:
        return line(2, fmt::format("require {}{} is {}", from, walk_text(step.path), to));
    }
  }

  void print_predicate(const Predicate& predicate) {
    const std::string value = expression(predicate.value);
    switch (predicate.kind) {
      case Predicate::Kind::Parameter:
        return line(2, fmt::format("default {} := {}", slot(predicate.slot), value));
      case Predicate::Kind::Let:
        return line(2, fmt::format("let {} := {}", slot(predicate.slot), value));
      case Predicate::Kind::Where:
        return line(2, fmt::format("where {}", value));
    }
  }

  [[nodiscard]] static std::string column_name(const Rule& rule, Column column) {
    const std::uint32_t kept = rule.rewrite.kept_columns;
    return column < kept ? rule.match.nodes[column].name
                         : rule.rewrite.created_names[column - kept];
  }

  void print_rewrite(const Rule& rule) {
    const RewritePlan& plan = rule.rewrite;
    line(1, "rewrite");
    for (const ColumnChange& change : plan.changes) {
      const std::string name = column_name(rule, change.column);
      switch (change.fate) {
        case NodeFate::Preserved:
          line(2, fmt::format("touch {} in {}", name, to_string(change.links)));
          break;
        case NodeFate::Created:
          line(2, fmt::format("create {}", name));
          break;
        case NodeFate::Removed:
          line(2, fmt::format("remove {}", name));
          break;
      }
    }
    for (const LinkWrite& write : plan.writes) {
      const std::string from = column_name(rule, write.from);
      line(2, write.position == LinkWrite::kExplicit
                  ? fmt::format("link {} -{}- {}", from, int{write.dimension},
                                column_name(rule, write.to))
                  : fmt::format("link {} -{}- its row at position {}", from, int{write.dimension},
                                write.position));
    }
    for (const Assignment& assignment : plan.assignments) print_assignment(rule, assignment);
    print_affected(plan);
  }

  void print_assignment(const Rule& rule, const Assignment& assignment) {
    std::string joined;
    for (std::uint32_t p : assignment.joined) joined += fmt::format(" {}", p);
    line(2, fmt::format("value {}.{} := {}{}", column_name(rule, assignment.column),
                        names_.embeddings.at(types::index(assignment.embedding)),
                        expression(assignment.value),
                        joined.empty() ? "" : fmt::format("  (once for rows joined at{})", joined)));
  }

  void print_affected(const RewritePlan& plan) {
    std::string affected;
    for (std::size_t i = 0; i < program_.schema.size(); ++i) {
      const gmap::EmbeddingDecl& decl = program_.schema[static_cast<EmbeddingId>(i)];
      if (decl.kind == gmap::EmbeddingKind::Derived || !plan.affects(decl.orbit)) continue;
      affected += " " + decl.name;
    }
    if (!affected.empty()) line(2, "spread" + affected);
    std::string defaults;
    for (const EmbeddingId id : plan.unassigned) {
      if (program_.schema[id].default_value) defaults += " " + program_.schema[id].name;
    }
    if (!defaults.empty()) line(2, "default" + defaults);
  }

  void print_body(const std::vector<Statement>& body, int depth) {
    for (const Statement& statement : body) {
      std::visit([&](const auto& node) { print_statement(node, depth + 1); }, statement.node);
    }
  }
  void print_statement(const LetStatement& let, int depth) {
    line(depth, fmt::format("let {} := {}", slot(let.slot), expression(let.value)));
  }
  void print_statement(const AssignStatement& assign, int depth) {
    line(depth, fmt::format("value {}.{} := {}", expression(assign.dart),
                            names_.embeddings.at(types::index(assign.embedding)),
                            expression(assign.value)));
  }
  void print_statement(const ForStatement& loop, int depth) {
    line(depth, fmt::format("for {} in {}{}", slot(loop.variable), expression(loop.collection),
                            loop.condition ? " where " + expression(loop.condition) : ""));
    print_body(loop.body, depth);
  }
  void print_statement(const IfStatement& branch, int depth) {
    line(depth, fmt::format("if {}", expression(branch.condition)));
    print_body(branch.then_body, depth);
    if (branch.else_body.empty()) return;
    line(depth, "else");
    print_body(branch.else_body, depth);
  }
  void print_statement(const ApplyStatement& apply, int depth) {
    std::string darts;
    for (const ExprPtr& dart : apply.darts) darts += (darts.empty() ? "" : ", ") + expression(dart);
    const ItemHead& target = apply.operation
                                 ? static_cast<const ItemHead&>(program_.operations[apply.target])
                                 : program_.rules[apply.target];
    std::string parameters;
    for (const auto& [parameter, value] : apply.parameters) {
      parameters += fmt::format("{} {} = {}", parameters.empty() ? ";" : ",",
                                target.slot_names.at(types::index(parameter)), expression(value));
    }
    line(depth, fmt::format("apply {}({}{})", target.name, darts, parameters));
  }

  const Program& program_;
  std::ostream& out_;
  types::ExprNames names_;
};

}  // namespace

void print_program(const Program& program, std::ostream& out, std::string_view only) {
  Printer printer(program, out);
  const auto wanted = [&](const ItemHead& item) { return only.empty() || item.name == only; };
  for (const Rule& rule : program.rules) {
    if (wanted(rule)) printer.print(rule);
  }
  for (const RootedPattern& item : program.interactions) {
    if (wanted(item)) printer.print(item, "interaction");
  }
  for (const RootedPattern& item : program.criteria) {
    if (wanted(item)) printer.print(item, "criterion");
  }
  for (const Operation& operation : program.operations) {
    if (wanted(operation)) printer.print(operation);
  }
}

}  // namespace gmsim::compile
