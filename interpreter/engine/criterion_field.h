// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/force_kernel.h"
#include "engine/force_readings.h"
#include "engine/match_set.h"
#include "engine/tear_requests.h"

namespace gmsim::engine {

/// One line of `tear:` as it stands in a simulation: the matches of its criterion, and the kernels that
/// compute value and threshold of all of them.
class CriterionField {
 public:
  using Diagnostic = std::optional<support::Diagnostic>;

  /// `world` lists atomic forces. Everything given must outlive it.
  CriterionField(const ForceContext& context, const compile::World& world,
                 const TearPairing& pairing, std::uint32_t number);
  ~CriterionField();

  /// Finds all matches anew.
  Diagnostic rebuild();
  /// Looks again at the matches that rest on what has changed, and counts them.
  Diagnostic repair(std::span<const compile::Dependence> changed, std::uint64_t& looked_at);
  /// False: only rebuild() is safe.
  [[nodiscard]] bool repairable() const { return matches_.repairable(); }
  /// Shapes that its matches have had.
  [[nodiscard]] std::size_t shape_count() const { return parts_.size(); }
  /// Makes the sums of forces that the criterion reads, where they are not there yet.
  void add_sums(ForceReadings& readings) const;
  [[nodiscard]] bool reads_forces_one_by_one() const;

  /// Adds a request for each match whose value is above its threshold; `node` is the hook. Where and
  /// how many of them count is the caller's. `allowed` says of a hook whether the scene lets it tear
  /// there; only such matches come near to tearing.
  Diagnostic judge(const ForceMoment& moment, const std::function<bool(DartId)>& allowed,
                   std::vector<TearRequest>& requests);
  [[nodiscard]] const NearestMatch& nearest() const { return nearest_; }
  /// Value over threshold of all matches in the last judgement, if they are kept.
  [[nodiscard]] const std::vector<double>& ratios() const { return ratios_; }
  void keep_ratios(bool keep) { keep_ratios_ = keep; }
  /// Look for the nearest match in every judgement, also where that takes asking `allowed`.
  void follow_nearest(bool follow) { follow_nearest_ = follow; }
  /// Its tables as text (`gmsim explain`).
  [[nodiscard]] std::string explain() const;
  [[nodiscard]] const TearPairing& pairing() const { return pairing_; }
  [[nodiscard]] const compile::CriterionBody& body() const { return body_; }

 private:
  /// The kernels of one shape.
  struct Part;

  void add_parts();
  /// Looks at one match that is there.
  Diagnostic repair(const StaleMatch& match);
  Diagnostic judge_part(Part& part, std::uint32_t shape, const ForceMoment& moment,
                        const std::function<bool(DartId)>& allowed, NearestMatch& nearest,
                        std::vector<TearRequest>& requests);
  void note_ratios(const Part& part);
  /// The nearest match, and the ratios if they are kept, of those that are allowed.
  void survey_allowed(const Part& part, const ForceMoment& moment,
                      const std::function<bool(DartId)>& allowed, NearestMatch& nearest);
  [[nodiscard]] DartId hook(const Part& part, std::uint32_t row) const;
  /// Takes over the nearest match of a judgement if none before was nearer.
  void note_nearest(const NearestMatch& candidate, const ForceMoment& moment);
  void fire(Part& part, std::uint32_t shape, std::uint32_t row, const ForceMoment& moment,
            std::vector<TearRequest>& requests);

  const ForceContext& context_;
  const TearPairing& pairing_;
  const std::uint32_t number_;
  const compile::CriterionBody& body_;
  const compile::ValueSources sources_;
  MatchSet matches_;
  std::vector<std::unique_ptr<Part>> parts_;  // by shape
  KernelScratch scratch_;
  NearestMatch nearest_;
  std::vector<double> ratios_;
  bool keep_ratios_ = false;
  bool follow_nearest_ = false;
  // Work space of repairs.
  MatchSet::Stale stale_;
  MatchSet::Reading reading_;
};

/// What a line of `tear:` reads of forces.
struct ForceReads {
  std::vector<types::OrbitType> orbits;  ///< on which it reads sums: they need an index
  bool internal = false;  ///< the sum of all internal forces on a vertex
  bool single = false;    ///< other sums, or forces one by one
};
[[nodiscard]] ForceReads force_reads(const TearPairing& pairing, const compile::Program& program,
                                     types::OrbitType vertex);

}  // namespace gmsim::engine
