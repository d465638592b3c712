// SPDX-License-Identifier: MIT
#include "support/trace.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <ostream>

namespace gmsim::support {
namespace {

/// In the order of TracePhase.
constexpr std::array<std::string_view, 7> kPhaseNames = {"parse",  "check",   "compile", "match",
                                                         "kernel", "rewrite", "step"};

}  // namespace

std::string_view name_of(TracePhase phase) {
  return kPhaseNames.at(static_cast<std::size_t>(phase));
}

bool Trace::enable(std::string_view filter) {
  const std::size_t colon = filter.find(':');
  const auto found = std::find(kPhaseNames.begin(), kPhaseNames.end(), filter.substr(0, colon));
  if (found == kPhaseNames.end()) return false;
  const auto phase = static_cast<TracePhase>(found - kPhaseNames.begin());
  const bool all = colon == std::string_view::npos;
  filters_.push_back({phase, all ? std::string{} : std::string(filter.substr(colon + 1))});
  return true;
}

bool Trace::wants(TracePhase phase, std::string_view subject) const {
  if (out_ == nullptr) return false;
  return std::any_of(filters_.begin(), filters_.end(), [&](const Filter& filter) {
    return filter.phase == phase && (filter.subject.empty() || filter.subject == subject);
  });
}

void Trace::line(TracePhase phase, std::string_view subject, std::string_view text) const {
  if (!wants(phase, subject)) return;
  *out_ << std::left << std::setw(8) << name_of(phase);
  if (!subject.empty()) *out_ << ' ' << subject;
  *out_ << ' ' << text << '\n';
}

}  // namespace gmsim::support
