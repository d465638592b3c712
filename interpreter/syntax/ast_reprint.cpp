// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <sstream>

#include "syntax/ast_text.h"
#include "syntax/parse.h"

namespace gmsim::syntax {
namespace {

/// Writes a tree as a rule file. Brackets are those of the source, so only trees that were parsed
/// come out right.
class SourcePrinter {
 public:
  [[nodiscard]] std::string take() { return std::move(text_); }

  void print(const Item& item) {
    std::istringstream lines(item.doc);
    for (std::string line; std::getline(lines, line);)
      add("///{}{}\n", line.empty() ? "" : " ", line);
    std::visit([&](const auto& node) { print_item(node); }, item.node);
  }

  void print(const Expr& expr) {
    if (expr.parenthesised) text_ += '(';
    std::visit([&](const auto& node) { print_expr(node); }, expr.node);
    if (expr.parenthesised) text_ += ')';
  }

 private:
  template <class... Parts>
  void add(fmt::format_string<Parts...> format, Parts&&... parts) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Parts>(parts)...);
  }
  void add(const ExprPtr& expr) { print(*expr); }
  /// ` = EXPR` if there is one.
  void add_value(const ExprPtr& expr) {
    if (!expr) return;
    text_ += " = ";
    print(*expr);
  }
  void add_list(const std::vector<ExprPtr>& list) {
    for (const ExprPtr& expr : list) {
      if (&expr != &list.front()) text_ += ", ";
      print(*expr);
    }
  }
  void new_line() {
    text_ += '\n';
    text_.append(4 * depth_, ' ');
  }
  template <class List, class Print>
  void add_block(const List& list, Print print_one) {
    text_ += " {";
    ++depth_;
    for (const auto& element : list) {
      new_line();
      print_one(element);
    }
    --depth_;
    new_line();
    text_ += '}';
  }
  void add_body(const std::vector<Statement>& body) {
    add_block(body, [&](const Statement& statement) { print(statement); });
  }
  void add_block(const PatternBlock& block) {
    add_block(block.statements,
              [&](const PatternStatement& statement) { text_ += to_text(statement); });
  }
  void add_clauses(const KindClause& kind, const std::optional<MergeClause>& merge) {
    if (kind.kind == KindClause::Kind::Intensive) text_ += " intensive";
    if (kind.kind == KindClause::Kind::Extensive) text_ += " extensive";
    if (kind.split) {
      text_ += " split ";
      print(*kind.split);
    }
    if (merge) add(" merge {}", merge->policy.text);
  }

  // ---- items ----

  void print_item(const ImportItem& item) { add("import {};\n", quoted(item.path)); }
  void print_item(const DimensionStatement& item) { add("dimension {};\n", item.dimension); }
  void print_item(const OrbitItem& item) {
    add("orbit {} = {};\n", item.name.text, to_text(item.orbit));
  }
  void print_item(const EmbeddingItem& item) {
    add("embedding {} : {} on {}", item.name.text, to_text(item.type), to_text(item.orbit));
    if (item.optional) text_ += " optional";
    add_clauses(item.kind, item.merge);
    add_value(item.default_value);
    text_ += ";\n";
  }
  void print_item(const DerivedItem& item) {
    add("derived {} : {} on {}({})", item.name.text, to_text(item.type), to_text(item.orbit),
        item.dart.text);
    add_value(item.value);
    text_ += ";\n";
  }
  void print_item(const FunctionItem& item) {
    add("function {}({})", item.name.text, to_text(item.parameters));
    add_value(item.value);
    text_ += ";\n";
  }
  void print_item(const PatternItem& item) {
    add("pattern {}({})", item.name.text, to_text(item.parameters));
    add_block(item.block);
    text_ += '\n';
  }
  void print_item(const RuleItem& item) {
    add("rule {}({})", item.name.text, to_text(item.hooks));
    add_body(item.body);
    text_ += '\n';
  }
  void print_item(const InteractionItem& item) {
    add("{}interaction {} on {}({})", item.external ? "external " : "", item.name.text,
        to_text(item.orbit), item.dart.text);
    add_body(item.body);
    text_ += '\n';
  }
  void print_item(const FamilyItem& item) {
    add("family {} = {};\n", item.name.text, to_text(item.members));
  }
  void print_item(const CriterionItem& item) {
    if (item.interaction)
      add("criterion {} of {}", item.name.text, item.interaction->text);
    else
      add("criterion {} on {}({})", item.name.text, to_text(item.orbit), item.dart.text);
    add_body(item.body);
    text_ += '\n';
  }
  void print_item(const OperationItem& item) {
    add("operation {} on {}({})", item.name.text, to_text(item.orbit), item.dart.text);
    add_body(item.body);
    text_ += '\n';
  }

  // ---- statements ----

  void print(const Statement& statement) {
    std::visit([&](const auto& node) { print_statement(node); }, statement.node);
  }
  void print_statement(const DimensionStatement& statement) {
    add("dimension {};", statement.dimension);
  }
  void print_statement(const SideStatement& statement) {
    text_ += to_text(statement.side);
    const auto& inside = statement.block.statements;
    const bool one_pattern = statement.side == SideKind::Match && inside.size() == 1 &&
                             !std::holds_alternative<DimensionStatement>(inside.front().node);
    if (one_pattern)
      add(" {}", to_text(inside.front()));
    else
      add_block(statement.block);
  }
  void print_statement(const WhereStatement& statement) {
    text_ += "where ";
    add(statement.condition);
    text_ += ';';
  }
  void print_statement(const ParamStatement& statement) {
    add("param {} : {}", statement.name.text, to_text(statement.type));
    add_clauses(statement.kind, statement.merge);
    add_value(statement.default_value);
    text_ += ';';
  }
  void print_statement(const LetStatement& statement) {
    add("let {}", statement.name.text);
    if (statement.parameters) add("({})", to_text(*statement.parameters));
    add_value(statement.value);
    text_ += ';';
  }
  void print_statement(const AssignStatement& statement) {
    add(statement.target);
    add_value(statement.value);
    text_ += ';';
  }
  void print_statement(const EnergyStatement& statement) {
    text_ += "energy ";
    add(statement.value);
    text_ += ';';
  }
  void print_statement(const ForceStatement& statement) {
    add("force {}", to_text(statement.targets));
    if (statement.collection) {
      text_ += " in ";
      add(statement.collection);
    }
    add(" on {}", to_text(statement.orbit));
    add_value(statement.value);
    text_ += ';';
  }
  void print_statement(const FirstStatement& statement) {
    add("first {} where ", statement.name.text);
    add(statement.condition);
    text_ += ';';
  }
  void print_statement(const ResultStatement& statement) {
    add("result {}", statement.name.text);
    if (statement.type) add(" : {}", to_text(*statement.type));
    add_value(statement.value);
    text_ += ';';
  }
  void print_statement(const ValueStatement& statement) {
    text_ += "value ";
    add(statement.value);
    text_ += ';';
  }
  void print_statement(const ForStatement& statement) {
    add("for {} in ", statement.variable.text);
    add(statement.collection);
    if (statement.condition) {
      text_ += " where ";
      add(statement.condition);
    }
    add_body(statement.body);
  }
  void print_statement(const IfStatement& statement) {
    text_ += "if ";
    add(statement.condition);
    add_body(statement.then_body);
    if (statement.else_body.empty()) return;
    text_ += " else";
    const Statement& first = statement.else_body.front();
    if (statement.else_body.size() == 1 && std::holds_alternative<IfStatement>(first.node)) {
      text_ += ' ';
      print(first);
    } else {
      add_body(statement.else_body);
    }
  }
  void print_statement(const ApplyStatement& statement) {
    add("apply {}(", statement.rule.text);
    add_list(statement.arguments);
    for (const NamedArgument& argument : statement.parameters) {
      add("{} {}", &argument == &statement.parameters.front() ? ";" : ",", argument.name.text);
      add_value(argument.value);
    }
    text_ += ");";
  }

  // ---- expressions ----

  void print_expr(const NumberExpr& node) {
    text_ += node.text;
    text_ += with_blank(node.unit);
  }
  void print_expr(const BoolExpr& node) { text_ += node.value ? "true" : "false"; }
  void print_expr(const DimensionExpr&) { text_ += 'n'; }
  void print_expr(const NameExpr& node) { text_ += node.name.text; }
  void print_expr(const MemberExpr& node) {
    add(node.object);
    add(".{}", node.member.text);
  }
  void print_expr(const WalkExpr& node) {
    add(node.object);
    const bool is_difference = node.dimension.from_top && node.dimension.value != 0;
    add(fmt::runtime(is_difference ? "@({})" : "@{}"), to_text(node.dimension));
  }
  void print_expr(const IndexExpr& node) {
    add(node.object);
    text_ += '[';
    add(node.index);
    text_ += ']';
  }
  void print_expr(const CallExpr& node) {
    add("{}(", node.callee.text);
    add_list(node.arguments);
    text_ += ')';
  }
  void print_expr(const OrbitLiteralExpr& node) {
    text_ += to_text(node.orbit);
    if (!node.argument) return;
    text_ += '(';
    add(node.argument);
    text_ += ')';
  }
  void print_expr(const AllExpr& node) { add("all {}", to_text(node.orbit)); }
  void print_expr(const RangeExpr& node) {
    add(node.lo);
    text_ += "..";
    add(node.hi);
  }
  void print_expr(const FoldExpr& node) {
    add("{}({} in ", node.fold.text, node.variable.text);
    add(node.collection);
    for (const ExprPtr* part : {&node.body, &node.result}) {
      if (!*part) continue;
      text_ += " : ";
      add(*part);
    }
    text_ += ')';
  }
  void print_expr(const UnaryExpr& node) {
    text_ += node.op == UnaryOp::Minus ? "-" : "not ";
    add(node.operand);
  }
  void print_expr(const BinaryExpr& node) {
    add(node.left);
    if (node.op == BinaryOp::Pow)
      text_ += '^';
    else
      add(" {} ", to_text(node.op));
    add(node.right);
  }
  void print_expr(const IfExpr& node) {
    text_ += "if ";
    add(node.condition);
    text_ += " then ";
    add(node.then_value);
    text_ += " else ";
    add(node.else_value);
  }
  void print_expr(const TupleExpr& node) {
    text_ += '(';
    add_list(node.elements);
    text_ += ')';
    text_ += with_blank(node.unit);
  }

  std::string text_;
  std::size_t depth_ = 0;
};

}  // namespace

std::string reprint(const RuleFile& file) {
  SourcePrinter printer;
  for (const Item& item : file.items) printer.print(item);
  return printer.take();
}

std::string reprint(const Expr& expr) {
  SourcePrinter printer;
  printer.print(expr);
  return printer.take();
}

}  // namespace gmsim::syntax
