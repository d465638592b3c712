// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "syntax/ast.h"
#include "types/expr.h"

namespace gmsim::check {

/// A local name and what it stands for.
struct Binding {
  enum class Kind {
    Node,          ///< of `left`, `match`, or the dart an item is on
    NewNode,       ///< made by the rule: cannot be read
    Parameter,
    Let,
    FoldVariable,
    Argument,      ///< parameter of a function being expanded
    Macro          ///< `let f(x) = …`
  };
  std::string name;
  Kind kind = Kind::Let;
  types::ExprPtr value;  ///< null for NewNode and Macro
  syntax::Span span;
  const syntax::LetStatement* macro = nullptr;
  std::size_t visible = 0;  ///< of a macro: how many bindings its body sees
  /// Of a variable over a range with constant bounds.
  std::optional<std::pair<std::int64_t, std::int64_t>> range = std::nullopt;
  /// Of a parameter of a function that is checked by itself: which one.
  std::optional<std::size_t> unknown_argument = std::nullopt;
};
/// "a node", "a parameter", …
[[nodiscard]] std::string_view describe(Binding::Kind kind);

/// The names in force, innermost last. Names are never shadowed.
class Scope {
 public:
  [[nodiscard]] const Binding* find(std::string_view name) const {
    for (auto at = bindings_.rbegin(); at != bindings_.rend(); ++at)
      if (at->name == name) return &*at;
    return nullptr;
  }
  void add(Binding binding) { bindings_.push_back(std::move(binding)); }
  [[nodiscard]] std::size_t size() const { return bindings_.size(); }
  void shrink(std::size_t size) { bindings_.resize(size); }
  [[nodiscard]] Scope first(std::size_t count) const {
    Scope scope;
    scope.bindings_.assign(bindings_.begin(),
                           bindings_.begin() + static_cast<std::ptrdiff_t>(count));
    return scope;
  }
  [[nodiscard]] const std::vector<Binding>& bindings() const { return bindings_; }

 private:
  std::vector<Binding> bindings_;
};

}  // namespace gmsim::check
