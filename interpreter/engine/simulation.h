// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/force_field.h"
#include "engine/model.h"
#include "engine/stability_limit.h"
#include "engine/state.h"
#include "engine/tear_requests.h"
#include "support/diagnostic.h"
#include "support/trace.h"

namespace gmsim::engine {

/// Sums over the whole state; SI.
struct Totals {
  double kinetic = 0;            ///< J
  double potential = 0;          ///< J, of all energies, external ones included
  double mass = 0;               ///< kg
  std::array<double, 3> momentum{};          ///< kg m/s
  std::array<double, 3> angular_momentum{};  ///< kg m^2/s, about the origin
};

/// What it took to change the map at the end of a step. Judging the criteria, which happens whether or
/// not something tears, is left out.
struct ChangeCost {
  double rewrite = 0;   ///< s: rules applied, orbits and values repaired
  double tables = 0;    ///< s: matches of interactions, their groups and lists of forces
  double vertices = 0;  ///< s: masses, holds, positions and velocities of changed vertices
  double forces = 0;    ///< s: forces on the new map
  double criteria = 0;  ///< s: matches of criteria, lists and sums of forces that they read
  std::uint64_t touched_darts = 0;
  std::uint64_t matches = 0;            ///< of interactions that were found again
  std::uint64_t criterion_matches = 0;  ///< the same of criteria

  [[nodiscard]] double total() const { return rewrite + tables + vertices + forces + criteria; }
};

/// What one step did.
struct StepReport {
  double time = 0;                 ///< s, at the end of the step
  double dt = 0;                   ///< s, of this step
  std::uint32_t evaluations = 0;   ///< of all forces
  std::uint32_t rejected = 0;      ///< adaptive: steps tried and thrown away
  bool at_stability_limit = false; ///< adaptive: the limit, not the error, set the length
  std::vector<TearEvent> events;   ///< what tore at its end
  std::uint64_t dropped = 0;       ///< changes that criteria asked for and that did not fit any more
  bool map_changed = false;
  ChangeCost cost;
};

struct SimulationOptions {
  unsigned threads = 1;
  bool tree_kernel = false;  ///< evaluate forces by the tree oracle: slow, for comparison
  bool follow_nearest = false;  ///< survey() is to know how near criteria have come since the start
  support::Trace* trace = nullptr;
};

/// Advances a state in time. Values of `position` and `velocity` live in the engine's own arrays
/// between steps; sync() puts them into the store.
class Simulation {
 public:
  /// Prepares everything; reports what is wrong (a free particle without mass, a step above the
  /// limit, a pattern that holds nowhere …) and returns null after an error.
  static std::unique_ptr<Simulation> create(State& state, Model model, IntegratorSettings settings,
                                            SimulationOptions options,
                                            support::Diagnostics& diagnostics);
  /// The same with forces of the caller's.
  static std::unique_ptr<Simulation> create(State& state, Model model, IntegratorSettings settings,
                                            std::unique_ptr<ForceField> forces,
                                            SimulationOptions options,
                                            support::Diagnostics& diagnostics);
  ~Simulation();

  /// One step, which ends at `until` (s, after time()) at the latest: methods with a fixed step
  /// shorten the one that would pass it and go on in full steps from there; adaptive methods fit
  /// their steps. Who wants unshortened fixed steps gives a later `until`. Empty after an error,
  /// which is then in `diagnostics`; the state is the last good one.
  std::optional<StepReport> step(double until, support::Diagnostics& diagnostics);

  [[nodiscard]] double time() const;
  [[nodiscard]] std::uint64_t steps() const;
  [[nodiscard]] std::uint64_t evaluations() const;
  /// s: the fixed step (chosen from the limit when the settings leave it open), or the longest step
  /// that an adaptive method will try next.
  [[nodiscard]] double dt() const;
  /// Positions of all vertices at `time` within the last step (vertex rows, 3 numbers each), by
  /// quintic Hermite interpolation of positions, velocities and accelerations; adaptive methods
  /// only, others answer at the end of the step.
  void dense_positions(double time, std::vector<double>& out) const;
  [[nodiscard]] Totals totals();
  [[nodiscard]] const StabilityLimit& limit() const;
  /// Largest length of any edge over its length when the simulation was made, for the progress line.
  [[nodiscard]] double max_elongation() const;
  /// Puts positions, velocities and the clock into the state's store.
  void sync();
  /// Takes over a state whose map or values were rewritten after sync(). False after an error.
  bool refresh(support::Diagnostics& diagnostics);
  /// What a line of `tear:` has seen.
  struct CriterionReport {
    NearestMatch nearest;              ///< since the start, with SimulationOptions::follow_nearest
    std::vector<double> ratios;        ///< value over threshold of all matches, now
  };
  /// Judges all criteria on the state as it is, and changes nothing; by line of `tear:`.
  std::optional<std::vector<CriterionReport>> survey(support::Diagnostics& diagnostics);
  /// A hash of positions, velocities and the clock, bit by bit.
  [[nodiscard]] std::uint64_t state_hash() const;
  /// The plan as text: `gmsim explain`.
  [[nodiscard]] std::string explain() const;

 private:
  class Implementation;
  explicit Simulation(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gmsim::engine
