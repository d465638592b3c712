// SPDX-License-Identifier: MIT
#include "check/merge_reports.h"

#include <algorithm>
#include <set>

namespace gmsim::check {
using support::Diagnostic;
using support::DiagnosticKind;
namespace {

using States = std::array<const ItemState*, 3>;

bool same_message(const Diagnostic& a, const Diagnostic& b) {
  return a.kind == b.kind && a.place == b.place && a.message == b.message;
}

/// Another wording for the same place is the same mistake seen in another dimension.
bool same_mistake(const Diagnostic& a, const Diagnostic& b) {
  return a.kind == b.kind && a.place == b.place;
}

void report(const States& states, const std::vector<int>& dimensions,
            support::Diagnostics& diagnostics) {
  std::vector<Diagnostic> reported;
  for (const int d : dimensions)
    for (const Diagnostic& found : states[static_cast<std::size_t>(d - 1)]->diagnostics.all()) {
      if (std::ranges::any_of(reported,
                              [&](const Diagnostic& other) { return same_mistake(found, other); }))
        continue;
      const bool everywhere = std::ranges::all_of(dimensions, [&](int other) {
        const auto& all = states[static_cast<std::size_t>(other - 1)]->diagnostics.all();
        return std::ranges::any_of(
            all, [&](const Diagnostic& same) { return same_message(found, same); });
      });
      Diagnostic diagnostic = found;
      if (!everywhere) diagnostic.notes.push_back("in dimension " + std::to_string(d));
      reported.push_back(found);
      diagnostics.report(std::move(diagnostic));
    }
}

bool is_absent(const ItemState& state) { return state.status == ItemStatus::Absent; }

/// The dimensions whose problems are reported.
std::vector<int> decisive(const ItemEntry& entry, const States& states) {
  std::vector<int> dimensions;
  for (const int d : {2, 3})
    if (!is_absent(*states[static_cast<std::size_t>(d - 1)])) dimensions.push_back(d);
  const bool one = entry.dimension == 1 || dimensions.empty();
  if (one && !is_absent(*states[0])) dimensions = {1};
  return dimensions;
}

/// In the dimension that the item asks for, else in the highest.
const Diagnostic& best_absence(const ItemEntry& entry, const States& states) {
  const int d = entry.dimension.value_or(3);
  return *states[static_cast<std::size_t>(d - 1)]->absence;
}

std::string reason(const ItemState& state) {
  if (state.absence) return state.absence->message;
  if (!state.diagnostics.all().empty()) return state.diagnostics.all().front().message;
  return state.status == ItemStatus::Failed ? "something that it needs has an error" : "";
}

/// A name is absent from a dimension only if no item of that name is there.
void forget_present(const ItemTable& items, const std::array<Environment, 3>& environments,
                    Absences& absences) {
  for (std::size_t d = 0; d < 3; ++d) {
    std::set<std::string> present;
    for (ItemIndex i = 0; i < items.entries().size(); ++i)
      if (environments[d].states[i].status == ItemStatus::Present)
        present.insert(items[i].name->text);
    for (auto& [name, reasons] : absences)
      if (present.contains(name)) reasons[d].clear();
  }
}

}  // namespace

Absences merge_reports(const ItemTable& items, const std::array<Environment, 3>& environments,
                       support::Diagnostics& diagnostics) {
  Absences absences;
  for (ItemIndex i = 0; i < items.entries().size(); ++i) {
    const ItemEntry& entry = items[i];
    const States states = {&environments[0].states[i], &environments[1].states[i],
                           &environments[2].states[i]};
    const std::vector<int> dimensions = decisive(entry, states);
    if (!dimensions.empty())
      report(states, dimensions, diagnostics);
    else if (best_absence(entry, states).kind != DiagnosticKind::Shadowing)
      diagnostics.report(best_absence(entry, states));
    std::array<std::string, 3> reasons;
    bool any = false;
    for (std::size_t d = 0; d < 3; ++d) {
      const ItemStatus status = states[d]->status;
      if (status != ItemStatus::Absent && status != ItemStatus::Failed) continue;
      reasons[d] = reason(*states[d]);
      any = true;
    }
    if (any) absences.emplace_back(entry.name->text, std::move(reasons));
  }
  forget_present(items, environments, absences);
  return absences;
}

}  // namespace gmsim::check
