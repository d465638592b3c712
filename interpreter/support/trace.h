// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace gmsim::support {

/// What can be traced with `--trace PHASE[:RULE]`; each line of a trace starts with its phase.
enum class TracePhase { Parse, Check, Compile, Match, Kernel, Rewrite, Step };
[[nodiscard]] std::string_view name_of(TracePhase phase);

/// Switched-off by default; asking for a line costs one test then.
class Trace {
 public:
  Trace() = default;
  explicit Trace(std::ostream& out) : out_(&out) {}

  /// Adds a filter "rewrite" or "rewrite:separate_elements"; false when the phase is unknown.
  bool enable(std::string_view filter);
  [[nodiscard]] bool wants(TracePhase phase, std::string_view subject) const;
  void line(TracePhase phase, std::string_view subject, std::string_view text) const;

 private:
  struct Filter {
    TracePhase phase;
    std::string subject;
  };
  std::ostream* out_ = nullptr;
  std::vector<Filter> filters_;
};

}  // namespace gmsim::support
