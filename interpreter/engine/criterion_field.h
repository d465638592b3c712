// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "engine/force_kernel.h"
#include "engine/force_matches.h"
#include "engine/force_readings.h"
#include "engine/match_table.h"
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
  /// Makes the sums of forces that the criterion reads, where they are not there yet.
  void add_sums(ForceReadings& readings) const;
  [[nodiscard]] bool reads_forces_one_by_one() const;

  /// What the last judgement saw.
  struct Survey {
    std::uint32_t matches = 0;
    std::uint32_t fired = 0;
    double value = 0, threshold = 0;     ///< of the match with the largest ratio
    DartId where = gmap::kNoDart;        ///< its hook
    std::vector<double> ratios;          ///< of all matches when asked for
  };
  /// Adds a request for each match whose value is above its threshold; `node` is the hook. Where and
  /// how many of them count is the caller's.
  Diagnostic judge(const ForceMoment& moment, std::vector<TearRequest>& requests);
  [[nodiscard]] const Survey& survey() const { return survey_; }
  /// The match that was nearest to tearing in all judgements so far, and when (s).
  struct Nearest {
    double value = 0, threshold = 0, time = 0;
    DartId where = gmap::kNoDart;
    std::array<double, 3> position{};  ///< of that dart's vertex, m
  };
  [[nodiscard]] const Nearest& nearest() const { return nearest_; }
  void keep_ratios(bool keep) { keep_ratios_ = keep; }
  [[nodiscard]] const TearPairing& pairing() const { return pairing_; }
  [[nodiscard]] const compile::CriterionBody& body() const { return body_; }
  [[nodiscard]] std::size_t match_count() const;

 private:
  /// The table of one shape and its kernels.
  struct Part;
  void add(const ForceMatch& match);
  Diagnostic judge_part(Part& part, std::uint32_t shape, const ForceMoment& moment,
                        std::vector<TearRequest>& requests);
  void fire(Part& part, std::uint32_t shape, std::uint32_t row, const ForceMoment& moment,
            double value, double threshold, std::vector<TearRequest>& requests);

  const ForceContext& context_;
  const TearPairing& pairing_;
  const std::uint32_t number_;
  const compile::CriterionBody& body_;
  const compile::ValueSources sources_;
  ForceMatches finder_;
  std::vector<std::unique_ptr<Part>> parts_;  // by shape
  KernelScratch scratch_;
  Survey survey_;
  Nearest nearest_;
  bool keep_ratios_ = false;
};

/// What a criterion reads of forces.
struct ForceReads {
  std::vector<types::OrbitType> orbits;  ///< on which it reads sums: they need an index
  bool any = false;
};
[[nodiscard]] ForceReads force_reads(const compile::CriterionBody& body,
                                     const gmap::EmbeddingSchema& schema);

}  // namespace gmsim::engine
