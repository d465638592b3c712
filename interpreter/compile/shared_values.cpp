// SPDX-License-Identifier: MIT
#include "compile/shared_values.h"

#include <algorithm>
#include <bit>
#include <string>
#include <unordered_map>
#include <vector>

#include "types/value_type.h"

namespace gmsim::compile {

using types::Expr;
using types::ExprKind;
using types::ValueKind;

namespace {

/// Local names of a text in the order in which they are bound.
using Names = std::vector<Slot>;

// What a word of a text stands for, in its highest byte: a text is read in one way only.
constexpr std::uint64_t kHead = 1ull << 56, kLocal = 2ull << 56, kFunction = 3ull << 56;

void append(std::string& text, std::uint64_t word) {
  text.append(reinterpret_cast<const char*>(&word), sizeof word);
}

/// Everything of a node but its locals and arguments.
void append_head(std::string& text, const Expr& expr) {
  append(text, kHead | static_cast<std::uint64_t>(expr.kind) |
                   static_cast<std::uint64_t>(expr.fold) << 8 |
                   static_cast<std::uint64_t>(expr.builtin) << 16 |
                   static_cast<std::uint64_t>(expr.type.kind) << 32 |
                   static_cast<std::uint64_t>(expr.orbit.bits()) << 40 |
                   static_cast<std::uint64_t>(expr.orbit2.bits()) << 48);
  append(text, static_cast<std::uint32_t>(expr.number) |
                   static_cast<std::uint64_t>(types::index(expr.embedding)) << 32);
  append(text, types::index(expr.interaction) |
                   static_cast<std::uint64_t>(expr.args.size()) << 32 |
                   static_cast<std::uint64_t>(expr.type.extents.size()) << 56);
  for (const std::uint32_t extent : expr.type.extents) append(text, extent);
  if (expr.kind != ExprKind::Literal) return;
  append(text, types::index(expr.value.dart) |
                   static_cast<std::uint64_t>(expr.value.data.size()) << 32);
  for (const double x : expr.value.data) append(text, std::bit_cast<std::uint64_t>(x));
}

class Sharer {
 public:
  Sharer(std::span<Assignment> assignments, std::uint32_t positions)
      : assignments_(assignments), positions_(positions) {}

  void run() {
    for (const Assignment& assignment : assignments_) {
      const bool many_rows = assignment.joined.size() != positions_;
      count(*assignment.value, many_rows);
    }
    for (Assignment& assignment : assignments_) assignment.value = marked(assignment.value, 0);
  }

 private:
  /// What an expression depends on.
  struct Facts {
    std::vector<Slot> free;     // locals that are bound outside of it, ascending
    bool folds = false;         // somewhere in it
    bool orbit_fold = false;    // it is one whose value belongs to the orbit
    std::uint32_t number = 0;   // of the function that it is; 0: none
  };

  const Facts& facts(const Expr& expr) {
    if (const auto known = facts_.find(&expr); known != facts_.end()) return known->second;
    Facts own;
    own.folds = expr.kind == ExprKind::Fold;
    if (expr.kind == ExprKind::Local) own.free.push_back(expr.slot);
    if (expr.kind == ExprKind::Local && expr.type.kind == ValueKind::Dart) darts_.push_back(expr.slot);
    for (std::size_t k = 0; k < expr.args.size(); ++k) {
      const Facts& part = facts(*expr.args[k]);
      own.folds = own.folds || part.folds;
      for (const Slot slot : part.free) {
        if (!binds(expr, k) || slot != expr.slot) own.free.push_back(slot);
      }
    }
    std::sort(own.free.begin(), own.free.end());
    own.free.erase(std::unique(own.free.begin(), own.free.end()), own.free.end());
    own.orbit_fold = is_orbit_fold(expr);
    if (own.orbit_fold) {
      own.number = number_of_fold(expr);
    } else if (is_function(expr, own)) {
      own.number = number_of_function(expr, own.free.front());
    }
    return facts_.emplace(&expr, std::move(own)).first->second;
  }

  /// Is the expression's slot bound in its k-th argument?
  static bool binds(const Expr& expr, std::size_t k) {
    return k > 0 && (expr.kind == ExprKind::Let || expr.kind == ExprKind::Fold);
  }

  bool is_orbit_fold(const Expr& expr) {
    if (expr.kind != ExprKind::Fold || !types::is_storable(expr.type)) return false;
    const ExprKind collection = expr.args[0]->kind;
    if (collection != ExprKind::OrbitDarts && collection != ExprKind::Quotient) return false;
    return std::all_of(expr.args.begin() + 1, expr.args.end(), [&](const ExprPtr& term) {
      const std::vector<Slot>& free = facts(*term).free;
      return free.empty() || (free.size() == 1 && free.front() == expr.slot);
    });
  }

  [[nodiscard]] bool is_function(const Expr& expr, const Facts& own) const {
    return own.folds && own.free.size() == 1 && types::is_storable(expr.type) &&
           std::find(darts_.begin(), darts_.end(), own.free.front()) != darts_.end();
  }

  std::uint32_t number_of_fold(const Expr& fold) {
    std::string text;
    append_head(text, fold);
    append_head(text, *fold.args[0]);
    Names names{fold.slot};
    for (std::size_t k = 1; k < fold.args.size(); ++k) write(*fold.args[k], names, text);
    return intern(std::move(text));
  }

  std::uint32_t number_of_function(const Expr& expr, Slot dart) {
    std::string text;
    Names names{dart};
    write(expr, names, text, /*whole=*/true);
    return intern(std::move(text));
  }

  std::uint32_t intern(std::string text) {
    const auto next = static_cast<std::uint32_t>(numbers_.size()) + 1;
    const auto [entry, added] = numbers_.emplace(std::move(text), next);
    if (added) counts_.push_back(0);
    return entry->second;
  }

  /// Writes an expression with its locals numbered; what has a number of its own is written as that.
  void write(const Expr& expr, Names& names, std::string& text, bool whole = false) {
    if (expr.kind == ExprKind::Local) return write_local(expr.slot, names, text);
    const Facts* const own = whole ? nullptr : &facts(expr);
    if (own != nullptr && own->number != 0) {
      append(text, kFunction | own->number);
      if (own->orbit_fold) return write(*expr.args[0]->args[0], names, text);
      return write_local(own->free.front(), names, text);
    }
    append_head(text, expr);
    for (std::size_t k = 0; k < expr.args.size(); ++k) {
      if (binds(expr, k)) names.push_back(expr.slot);
      write(*expr.args[k], names, text);
      if (binds(expr, k)) names.pop_back();
    }
  }

  /// Locals are numbered in the order in which they are bound, from 1; 0 is not bound.
  static void write_local(Slot slot, const Names& names, std::string& text) {
    const auto name = std::find(names.rbegin(), names.rend(), slot);
    append(text, kLocal | static_cast<std::uint64_t>(names.rend() - name));
  }

  /// How often each function is asked for: a place that is visited for several darts counts twice
  /// for the folds, which these darts may share.
  void count(const Expr& expr, bool many_darts) {
    const Facts& own = facts(expr);
    if (own.number != 0) {
      counts_[own.number - 1] += own.orbit_fold && many_darts ? 2 : 1;
    }
    if (!counted_.emplace(&expr, true).second) return;
    for (std::size_t k = 0; k < expr.args.size(); ++k) {
      count(*expr.args[k], many_darts || (expr.kind == ExprKind::Fold && k > 0));
    }
  }

  /// The expression with numbers on what is asked for more than once. `outer` is how often the
  /// function around it is asked for, if that is kept.
  ExprPtr marked(const ExprPtr& expr, std::uint32_t outer) {
    const Facts& own = facts(*expr);
    if (!own.folds) return expr;
    const std::uint32_t times = own.number == 0 ? 0 : counts_[own.number - 1];
    const bool keep = times > 1 && (own.orbit_fold || times > outer);
    Expr copy = *expr;
    for (std::size_t k = 0; k < copy.args.size(); ++k) {
      copy.args[k] = marked(copy.args[k], binds(*expr, k) ? 0 : std::max(outer, keep ? times : 0u));
    }
    if (keep && own.orbit_fold) copy.number = static_cast<std::int32_t>(own.number);
    ExprPtr value = std::make_shared<const Expr>(std::move(copy));
    return keep && !own.orbit_fold ? kept(value, own) : value;
  }

  /// Let(dart = dart, value), with the number.
  static ExprPtr kept(const ExprPtr& value, const Facts& own) {
    Expr dart{.kind = ExprKind::Local, .type = {ValueKind::Dart}, .unit = {}, .span = value->span};
    dart.slot = own.free.front();
    Expr let{.kind = ExprKind::Let, .type = value->type, .unit = value->unit, .span = value->span};
    let.args = {std::make_shared<const Expr>(std::move(dart)), value};
    let.slot = own.free.front();
    let.number = static_cast<std::int32_t>(own.number);
    return std::make_shared<const Expr>(std::move(let));
  }

  std::span<Assignment> assignments_;
  std::uint32_t positions_;
  std::unordered_map<const Expr*, Facts> facts_;
  std::unordered_map<const Expr*, bool> counted_;
  std::vector<Slot> darts_;  // locals that are darts
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::vector<std::uint32_t> counts_;
};

}  // namespace

void share_values(std::span<Assignment> assignments, std::uint32_t positions) {
  Sharer(assignments, positions).run();
}

}  // namespace gmsim::compile
