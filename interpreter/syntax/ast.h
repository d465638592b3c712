// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "support/span.h"

/// The tree of a rule file exactly as written: nothing is resolved, every part knows its place.
namespace gmsim::syntax {

using support::Span;

struct Name {
  std::string text;
  Span span;
};

/// A link dimension: a number, or `n` minus a number (`n`, `n-1`).
struct LinkDimension {
  bool from_top = false;
  int value = 0;  ///< the number itself, or what is subtracted from n
  Span span;
  [[nodiscard]] int in(int n) const { return from_top ? n - value : value; }
};

/// One entry of `<0..n-2, _, n>`: a blank, a dimension (first only), or an inclusive range.
struct OrbitEntry {
  enum class Kind { Blank, Single, Range } kind = Kind::Single;
  LinkDimension first;
  LinkDimension last;
  Span span;
};

/// A named orbit (`vertex`) or a literal one (`<1,2>`, `<>`).
struct OrbitExpr {
  std::optional<Name> name;
  std::vector<OrbitEntry> entries;
  Span span;
};

/// `[N s/m]` as factors with exponents numerator/denominator; `[1]` has no factors.
struct UnitFactor {
  Name name;
  int numerator = 1;
  int denominator = 1;
};
struct UnitExpr {
  std::vector<UnitFactor> factors;
  Span span;
};

/// `vec3[4][8] [m]`.
struct TypeExpr {
  Name name;
  std::vector<std::uint32_t> extents;
  std::optional<UnitExpr> unit;
  Span span;
};

// ---- expressions --------------------------------------------------------------------------------

struct Expr;
using ExprPtr = std::unique_ptr<Expr>;

struct NumberExpr {
  std::string text;
  double value = 0;
  bool is_integer = false;  ///< written without `.` and exponent
  std::optional<UnitExpr> unit;
};
struct BoolExpr {
  bool value = false;
};
/// The constant `n`, dimension of the map.
struct DimensionExpr {};
struct NameExpr {
  Name name;
};
/// `object.member`: an embedding, a vector component, an interaction, a field of a result.
struct MemberExpr {
  ExprPtr object;
  Name member;
};
/// `object@1`.
struct WalkExpr {
  ExprPtr object;
  LinkDimension dimension;
};
struct IndexExpr {
  ExprPtr object;
  ExprPtr index;
};
struct CallExpr {
  Name callee;
  std::vector<ExprPtr> arguments;
};
/// `<2>(a)`, or `<2>` alone as the right side of a quotient (argument null).
struct OrbitLiteralExpr {
  OrbitExpr orbit;
  ExprPtr argument;
};
/// `all vertex`.
struct AllExpr {
  OrbitExpr orbit;
};
/// `lo..hi`, only as the collection of a fold or a `for`.
struct RangeExpr {
  ExprPtr lo;
  ExprPtr hi;
};
/// `sum(x in collection : body)`; `count(x in A)` has no body; `argmax(x in A : key : result)`.
struct FoldExpr {
  Name fold;
  Name variable;
  ExprPtr collection;
  ExprPtr body;
  ExprPtr result;
};
enum class UnaryOp { Minus, Not };
struct UnaryExpr {
  UnaryOp op;
  ExprPtr operand;
};
enum class BinaryOp {
  Add,
  Sub,
  Mul,
  Div,
  Pow,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Equal,
  NotEqual,
  And,
  Or
};
struct BinaryExpr {
  BinaryOp op;
  Span op_span;
  ExprPtr left;
  ExprPtr right;
};
struct IfExpr {
  ExprPtr condition;
  ExprPtr then_value;
  ExprPtr else_value;
};
struct TupleExpr {
  std::vector<ExprPtr> elements;
  std::optional<UnitExpr> unit;
};

struct Expr {
  Span span;
  bool parenthesised = false;  ///< written in parentheses of its own, kept for reprinting
  std::variant<NumberExpr, BoolExpr, DimensionExpr, NameExpr, MemberExpr, WalkExpr, IndexExpr,
               CallExpr, OrbitLiteralExpr, AllExpr, RangeExpr, FoldExpr, UnaryExpr, BinaryExpr,
               IfExpr, TupleExpr>
      node;
  /// Levels of the tree from here down. The parser bounds it, so that walking a tree may recurse.
  std::uint16_t height = 1;
};

// ---- patterns -----------------------------------------------------------------------------------

/// A node in a chain: `a` or `a<0>`.
struct NodeMention {
  Name name;
  std::optional<OrbitExpr> label;  ///< never a named orbit
};
/// `-2-` or `-0.1-`: one link or a path through unnamed darts.
struct Link {
  std::vector<LinkDimension> path;
  Span span;
};
/// `a<0> -2- b<0>`: nodes.size() == links.size() + 1.
struct Chain {
  std::vector<NodeMention> nodes;
  std::vector<Link> links;
};
/// `quad(a, b, c, d)`.
struct PatternUse {
  Name pattern;
  std::vector<Name> arguments;
};
struct DimensionStatement {
  int dimension = 0;
  Span span;
};
struct PatternStatement {
  Span span;
  std::variant<Chain, PatternUse, DimensionStatement> node;
};
/// The inside of `left { … }`, `right { … }`, `match { … }`, `match …;` or a pattern.
struct PatternBlock {
  std::vector<PatternStatement> statements;
  Span span;
};

// ---- statements of item bodies ------------------------------------------------------------------

struct Statement;

enum class SideKind { Left, Right, Match };
struct SideStatement {
  SideKind side;
  PatternBlock block;
};
struct WhereStatement {
  ExprPtr condition;
};
/// How a value behaves when its orbit splits, as written.
struct KindClause {
  enum class Kind { None, Intensive, Extensive } kind = Kind::None;
  ExprPtr split;  ///< weight of `split EXPR`
  Span span;
};
/// `merge mean`.
struct MergeClause {
  Name policy;
};
struct ParamStatement {
  Name name;
  TypeExpr type;
  KindClause kind;
  std::optional<MergeClause> merge;
  ExprPtr default_value;
};
/// `let d = …;` or the macro `let side(x) = …;`.
struct LetStatement {
  Name name;
  std::optional<std::vector<Name>> parameters;
  ExprPtr value;
};
/// `a.position = …;`, `a.stretch_spring.rest = …;` (target is a MemberExpr).
struct AssignStatement {
  ExprPtr target;
  ExprPtr value;
};
struct EnergyStatement {
  ExprPtr value;
};
/// `force a, b on dart = …;` or `force x in polygon(a) on dart;` (then one target and a
/// collection).
struct ForceStatement {
  std::vector<Name> targets;
  ExprPtr collection;
  OrbitExpr orbit;
  ExprPtr value;
};
/// `first d where EXPR;`.
struct FirstStatement {
  Name name;
  ExprPtr condition;
};
/// `result stress : sym3 [Pa] = EXPR;` or, in a criterion, `result normal = EXPR;`.
struct ResultStatement {
  Name name;
  std::optional<TypeExpr> type;
  ExprPtr value;
};
/// `value EXPR;` of a criterion.
struct ValueStatement {
  ExprPtr value;
};
struct ForStatement {
  Name variable;
  ExprPtr collection;
  ExprPtr condition;  ///< null without `where`
  std::vector<Statement> body;
};
struct IfStatement {
  ExprPtr condition;
  std::vector<Statement> then_body;
  std::vector<Statement> else_body;
};
struct NamedArgument {
  Name name;
  ExprPtr value;
};
/// `apply rule(a, b; limit = 3);`.
struct ApplyStatement {
  Name rule;
  std::vector<ExprPtr> arguments;
  std::vector<NamedArgument> parameters;
};

struct Statement {
  Span span;
  std::variant<DimensionStatement, SideStatement, WhereStatement, ParamStatement, LetStatement,
               AssignStatement, EnergyStatement, ForceStatement, FirstStatement, ResultStatement,
               ValueStatement, ForStatement, IfStatement, ApplyStatement>
      node;
};

// ---- items --------------------------------------------------------------------------------------

struct ImportItem {
  std::string path;
  Span path_span;
};
struct OrbitItem {
  Name name;
  OrbitExpr orbit;
};
struct EmbeddingItem {
  Name name;
  TypeExpr type;
  OrbitExpr orbit;
  bool optional = false;
  KindClause kind;
  std::optional<MergeClause> merge;
  ExprPtr default_value;
};
/// `derived mass : real [kg] on vertex(v) = …;`.
struct DerivedItem {
  Name name;
  TypeExpr type;
  OrbitExpr orbit;
  Name dart;
  ExprPtr value;
};
struct FunctionItem {
  Name name;
  std::vector<Name> parameters;
  ExprPtr value;
};
struct PatternItem {
  Name name;
  std::vector<Name> parameters;
  PatternBlock block;
};
struct RuleItem {
  Name name;
  std::vector<Name> hooks;
  std::vector<Statement> body;
};
struct InteractionItem {
  bool external = false;
  Name name;
  OrbitExpr orbit;
  Name dart;
  std::vector<Statement> body;
};
struct FamilyItem {
  Name name;
  std::vector<Name> members;
};
/// `criterion c on facet(a) { … }`, or `criterion c of interaction { … }` (then no orbit, no dart).
struct CriterionItem {
  Name name;
  std::optional<Name> interaction;
  OrbitExpr orbit;
  Name dart;
  std::vector<Statement> body;
};
struct OperationItem {
  Name name;
  OrbitExpr orbit;
  Name dart;
  std::vector<Statement> body;
};

struct Item {
  Span span;
  std::string doc;  ///< the `///` lines above, without the slashes
  std::variant<ImportItem, DimensionStatement, OrbitItem, EmbeddingItem, DerivedItem, FunctionItem,
               PatternItem, RuleItem, InteractionItem, FamilyItem, CriterionItem, OperationItem>
      node;
};

struct RuleFile {
  support::FileId file{};
  std::vector<Item> items;
};

}  // namespace gmsim::syntax
