// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "check/symbolic_dart.h"
#include "gmap/embedding_schema.h"

namespace gmsim::check {

/// A sum of products of atoms, in an order of its own: equal for expressions that the laws below
/// make equal. Scalar factors commute, the others keep their order (matrix times vector).
struct Product {
  std::vector<int> scalars;
  std::vector<int> others;
  auto operator<=>(const Product&) const = default;
};
using Sum = std::map<Product, double>;

/// a + factor b.
[[nodiscard]] Sum plus(Sum a, const Sum& b, double factor);

/// Brings the expressions of a rule into a normal form: equal forms are equal values in exact
/// arithmetic, at every match. (The converse does not hold: this proves, it does not decide.)
///
/// The laws: those of DartAlgebra for darts; a value read at a dart is the same at all darts of
/// its orbit; + and * commute, associate and distribute; dot, cross, outer and contract are
/// bilinear, dot and contract symmetric, cross antisymmetric; norm and abs are even, normalize and
/// the like odd; min, max, and, or, == are symmetric; sums and means are linear; a fold does not
/// depend on which dart of an orbit names its collection, nor on the direction around a face.
class NormalForms {
 public:
  /// `steps` are the rule's `let`s.
  NormalForms(const Pattern& left, const KnownLinks& links, const gmap::EmbeddingSchema& schema,
              const std::vector<Step>& steps);

  /// The form of an expression as seen from the match's own row or, with a position, from the row
  /// that this label position leads to. Only forms of one NormalForms compare.
  /// An enormous expression has a form of its own at every call.
  [[nodiscard]] int of(const types::Expr& expr, std::optional<std::uint8_t> position = {});

 private:
  struct Collection {
    std::string key;
    bool around_face = false;
    bool reversed = false;  ///< go over x@0 for every x of the collection that `key` names
  };
  /// What an expression or a local stands for: exactly one of the three.
  struct Form {
    enum class Kind { Number, Dart, Collection } kind = Kind::Number;
    Sum sum;
    SymbolicDart dart;
    Collection collection;
  };
  using Expr = types::Expr;

  Form evaluate(const Expr& expr);
  Form compute(const Expr& expr);
  Form local(const Expr& expr);
  Form fold(const Expr& expr);
  Form choice(const Expr& expr);
  Sum call(const Expr& expr);
  Sum power(const Expr& expr);
  Sum quotient(const Sum& a, const Sum& b);
  Sum component(const Expr& expr);
  Sum comparison(const Expr& expr);
  Collection collection(const Expr& expr);
  /// Variables are numbered by how many folds stand around, not by their names.
  Form variable(types::ValueKind collection, const Word& walk) const;
  Sum fold_body(const Expr& expr, const Collection& over);
  void bind(types::Slot slot, Form form);

  Sum number(const Expr& expr) { return evaluate(expr).sum; }
  SymbolicDart dart(const Expr& expr) { return evaluate(expr).dart; }
  Sum multiply(const Sum& a, const Sum& b);
  /// A bilinear function of vectors or matrices; `flip` is the sign under exchange, 0 without law.
  Sum bilinear(const std::string& name, int flip, bool scalar, const Sum& a, const Sum& b);
  Sum symmetric(const std::string& name, const std::vector<const Expr*>& operands, bool scalar);
  /// f(sum) where f(-x) = sign f(x).
  Sum with_parity(const std::string& name, int sign, bool scalar, const Sum& argument);

  int intern(const std::string& text);
  int id(const Sum& sum);
  int id(const SymbolicDart& dart);
  int id(const Form& form);
  Sum atom(const std::string& text, bool scalar);
  Sum atom(const std::string& text, const Expr& expr);

  const KnownLinks& links_;
  const gmap::EmbeddingSchema& schema_;
  const std::vector<Step>& steps_;
  DartAlgebra darts_;
  std::unordered_map<std::uint32_t, NodeIndex> node_of_slot_;
  std::unordered_map<std::string, int> atoms_;
  std::unordered_map<int, std::vector<int>> operands_;  ///< of a symmetric atom, to flatten it

  // Of the evaluation at hand.
  std::optional<std::uint8_t> position_;
  std::unordered_map<std::uint32_t, Form> locals_;
  std::unordered_map<const Expr*, Form> done_;
  int work_ = 0;
  std::uint32_t open_folds_ = 0;
  std::size_t walked_ = 0;  ///< links between variables and the darts named from them
};

}  // namespace gmsim::check
