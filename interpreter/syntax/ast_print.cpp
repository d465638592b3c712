// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <ostream>
#include <sstream>

#include "syntax/ast_text.h"
#include "syntax/parse.h"

namespace gmsim::syntax {
namespace {

/// Prints every node on a line of its own, its parts below it. Everything but places is shown, so
/// that two trees are equal exactly when they print alike.
class TreePrinter {
 public:
  explicit TreePrinter(std::ostream& out) : out_(out) {}

  void print(const Item& item) {
    std::visit([&](const auto& node) { print_item(node, item.doc); }, item.node);
  }

  void print(const Expr& expr) {
    const char* brackets = expr.parenthesised ? " ()" : "";
    std::visit([&](const auto& node) { print_expr(node, brackets); }, expr.node);
  }

 private:
  template <class... Parts>
  void line(fmt::format_string<Parts...> format, Parts&&... parts) {
    out_ << std::string(2 * depth_, ' ') << fmt::format(format, std::forward<Parts>(parts)...)
         << '\n';
  }
  template <class Print>
  void below(Print print_parts) {
    ++depth_;
    print_parts();
    --depth_;
  }

  void part(const ExprPtr& expr) {
    below([&] { expr ? print(*expr) : line("nothing"); });
  }
  void part(std::string_view role, const ExprPtr& expr) {
    if (!expr) return;
    below([&] {
      line("{}", role);
      part(expr);
    });
  }
  void parts(const std::vector<ExprPtr>& list) {
    for (const ExprPtr& expr : list) part(expr);
  }
  void parts(const std::vector<Statement>& body) {
    below([&] {
      for (const Statement& statement : body) print(statement);
    });
  }
  void parts(const PatternBlock& block) {
    below([&] {
      for (const PatternStatement& statement : block.statements) line("{}", to_text(statement));
    });
  }
  void clauses(const KindClause& kind, const std::optional<MergeClause>& merge) {
    below([&] {
      if (kind.kind == KindClause::Kind::Intensive) line("intensive");
      if (kind.kind == KindClause::Kind::Extensive) line("extensive");
      part("split", kind.split);
      if (merge) line("merge {}", merge->policy.text);
    });
  }
  void doc(const std::string& text) {
    std::istringstream lines(text);
    for (std::string one; std::getline(lines, one);) below([&] { line("doc {}", quoted(one)); });
  }

  // ---- items ----

  void print_item(const ImportItem& item, const std::string& text) {
    line("import {}", quoted(item.path));
    doc(text);
  }
  void print_item(const DimensionStatement& item, const std::string& text) {
    line("dimension {}", item.dimension);
    doc(text);
  }
  void print_item(const OrbitItem& item, const std::string& text) {
    line("orbit {} = {}", item.name.text, to_text(item.orbit));
    doc(text);
  }
  void print_item(const EmbeddingItem& item, const std::string& text) {
    line("embedding {} : {} on {}{}", item.name.text, to_text(item.type), to_text(item.orbit),
         item.optional ? " optional" : "");
    doc(text);
    clauses(item.kind, item.merge);
    part("default", item.default_value);
  }
  void print_item(const DerivedItem& item, const std::string& text) {
    line("derived {} : {} on {}({})", item.name.text, to_text(item.type), to_text(item.orbit),
         item.dart.text);
    doc(text);
    part(item.value);
  }
  void print_item(const FunctionItem& item, const std::string& text) {
    line("function {}({})", item.name.text, to_text(item.parameters));
    doc(text);
    part(item.value);
  }
  void print_item(const PatternItem& item, const std::string& text) {
    line("pattern {}({})", item.name.text, to_text(item.parameters));
    doc(text);
    parts(item.block);
  }
  void print_item(const RuleItem& item, const std::string& text) {
    line("rule {}({})", item.name.text, to_text(item.hooks));
    doc(text);
    parts(item.body);
  }
  void print_item(const InteractionItem& item, const std::string& text) {
    line("{}interaction {} on {}({})", item.external ? "external " : "", item.name.text,
         to_text(item.orbit), item.dart.text);
    doc(text);
    parts(item.body);
  }
  void print_item(const FamilyItem& item, const std::string& text) {
    line("family {} = {}", item.name.text, to_text(item.members));
    doc(text);
  }
  void print_item(const CriterionItem& item, const std::string& text) {
    if (item.interaction)
      line("criterion {} of {}", item.name.text, item.interaction->text);
    else
      line("criterion {} on {}({})", item.name.text, to_text(item.orbit), item.dart.text);
    doc(text);
    parts(item.body);
  }
  void print_item(const OperationItem& item, const std::string& text) {
    line("operation {} on {}({})", item.name.text, to_text(item.orbit), item.dart.text);
    doc(text);
    parts(item.body);
  }

  // ---- statements ----

  void print(const Statement& statement) {
    std::visit([&](const auto& node) { print_statement(node); }, statement.node);
  }
  void print_statement(const DimensionStatement& statement) {
    line("dimension {}", statement.dimension);
  }
  void print_statement(const SideStatement& statement) {
    line("{}", to_text(statement.side));
    parts(statement.block);
  }
  void print_statement(const WhereStatement& statement) {
    line("where");
    part(statement.condition);
  }
  void print_statement(const ParamStatement& statement) {
    line("param {} : {}", statement.name.text, to_text(statement.type));
    clauses(statement.kind, statement.merge);
    part("default", statement.default_value);
  }
  void print_statement(const LetStatement& statement) {
    if (statement.parameters)
      line("let {}({})", statement.name.text, to_text(*statement.parameters));
    else
      line("let {}", statement.name.text);
    part(statement.value);
  }
  void print_statement(const AssignStatement& statement) {
    line("assign");
    part(statement.target);
    part(statement.value);
  }
  void print_statement(const EnergyStatement& statement) {
    line("energy");
    part(statement.value);
  }
  void print_statement(const ForceStatement& statement) {
    line("force {} on {}", to_text(statement.targets), to_text(statement.orbit));
    part("in", statement.collection);
    part("value", statement.value);
  }
  void print_statement(const FirstStatement& statement) {
    line("first {}", statement.name.text);
    part(statement.condition);
  }
  void print_statement(const ResultStatement& statement) {
    if (statement.type)
      line("result {} : {}", statement.name.text, to_text(*statement.type));
    else
      line("result {}", statement.name.text);
    part(statement.value);
  }
  void print_statement(const ValueStatement& statement) {
    line("value");
    part(statement.value);
  }
  void print_statement(const ForStatement& statement) {
    line("for {}", statement.variable.text);
    part("in", statement.collection);
    part("where", statement.condition);
    parts(statement.body);
  }
  void print_statement(const IfStatement& statement) {
    line("if");
    part(statement.condition);
    parts(statement.then_body);
    if (statement.else_body.empty()) return;
    line("else");
    parts(statement.else_body);
  }
  void print_statement(const ApplyStatement& statement) {
    line("apply {}", statement.rule.text);
    parts(statement.arguments);
    for (const NamedArgument& argument : statement.parameters)
      part(fmt::format("parameter {}", argument.name.text), argument.value);
  }

  // ---- expressions ----

  void print_expr(const NumberExpr& node, const char* brackets) {
    line("number {}{}{}", node.text, with_blank(node.unit), brackets);
  }
  void print_expr(const BoolExpr& node, const char* brackets) {
    line("{}{}", node.value, brackets);
  }
  void print_expr(const DimensionExpr&, const char* brackets) { line("n{}", brackets); }
  void print_expr(const NameExpr& node, const char* brackets) {
    line("name {}{}", node.name.text, brackets);
  }
  void print_expr(const MemberExpr& node, const char* brackets) {
    line("member {}{}", node.member.text, brackets);
    part(node.object);
  }
  void print_expr(const WalkExpr& node, const char* brackets) {
    line("walk {}{}", to_text(node.dimension), brackets);
    part(node.object);
  }
  void print_expr(const IndexExpr& node, const char* brackets) {
    line("index{}", brackets);
    part(node.object);
    part(node.index);
  }
  void print_expr(const CallExpr& node, const char* brackets) {
    line("call {}{}", node.callee.text, brackets);
    parts(node.arguments);
  }
  void print_expr(const OrbitLiteralExpr& node, const char* brackets) {
    line("orbit {}{}", to_text(node.orbit), brackets);
    if (node.argument) part(node.argument);
  }
  void print_expr(const AllExpr& node, const char* brackets) {
    line("all {}{}", to_text(node.orbit), brackets);
  }
  void print_expr(const RangeExpr& node, const char* brackets) {
    line("range{}", brackets);
    part(node.lo);
    part(node.hi);
  }
  void print_expr(const FoldExpr& node, const char* brackets) {
    line("fold {} {}{}", node.fold.text, node.variable.text, brackets);
    part(node.collection);
    if (node.body) part(node.body);
    if (node.result) part(node.result);
  }
  void print_expr(const UnaryExpr& node, const char* brackets) {
    line("{}{}", node.op == UnaryOp::Minus ? "minus" : "not", brackets);
    part(node.operand);
  }
  void print_expr(const BinaryExpr& node, const char* brackets) {
    line("{}{}", to_text(node.op), brackets);
    part(node.left);
    part(node.right);
  }
  void print_expr(const IfExpr& node, const char* brackets) {
    line("if{}", brackets);
    part(node.condition);
    part(node.then_value);
    part(node.else_value);
  }
  void print_expr(const TupleExpr& node, const char* brackets) {
    line("tuple{}{}", with_blank(node.unit), brackets);
    parts(node.elements);
  }

  std::ostream& out_;
  std::size_t depth_ = 0;
};

std::string dumped(const RuleFile& file) {
  std::ostringstream out;
  dump_ast(file, out);
  return std::move(out).str();
}

}  // namespace

void dump_ast(const RuleFile& file, std::ostream& out) {
  TreePrinter printer(out);
  for (const Item& item : file.items) printer.print(item);
}

void dump_ast(const Expr& expr, std::ostream& out) {
  TreePrinter(out).print(expr);
}

bool same_tree(const RuleFile& a, const RuleFile& b) {
  return dumped(a) == dumped(b);
}

}  // namespace gmsim::syntax
