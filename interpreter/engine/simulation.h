// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/model.h"
#include "engine/state.h"
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

/// The largest step that is stable here and now, and where it comes from (numerics, 4).
struct StabilityLimit {
  double dt = 0;              ///< s, of the integrator in use, from the element-wise bound
  double dt_global = 0;       ///< s, from the global estimate (power iteration), >= dt
  double omega_bound = 0;     ///< rad/s
  double omega_global = 0;    ///< rad/s
  double damping_ratio = 0;   ///< of the top mode
  DartId where = gmap::kNoDart;   ///< a dart of the match that rules the bound
  std::string interaction;        ///< and its interaction
};

/// What one step did.
struct StepReport {
  double time = 0;                 ///< s, at the end of the step
  double dt = 0;                   ///< s, of this step
  std::uint32_t evaluations = 0;   ///< of all forces
  std::uint32_t rejected = 0;      ///< adaptive: steps tried and thrown away
};

struct SimulationOptions {
  unsigned threads = 1;
  bool tree_kernel = false;  ///< evaluate forces by the tree oracle: slow, for comparison
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
  ~Simulation();

  /// One step, not beyond `until` (s): the last step before it is shortened only for adaptive
  /// methods and for stop times. Empty after an error, which is then in `diagnostics`; the state is
  /// the last good one.
  std::optional<StepReport> step(double until, support::Diagnostics& diagnostics);

  [[nodiscard]] double time() const;
  [[nodiscard]] std::uint64_t steps() const;
  [[nodiscard]] std::uint64_t evaluations() const;
  /// Positions of all vertices at `time` within the last step, by the method's dense output (vertex
  /// rows, 3 numbers each); adaptive methods only, others answer at the end of the step.
  void dense_positions(double time, std::vector<double>& out) const;
  [[nodiscard]] Totals totals();
  [[nodiscard]] const StabilityLimit& limit() const;
  /// Largest length over rest length of any edge, for the progress line.
  [[nodiscard]] double max_elongation() const;
  /// Puts positions, velocities and the clock into the state's store.
  void sync();
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
