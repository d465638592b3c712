// SPDX-License-Identifier: MIT
#include "engine/kernel_forces.h"

#include <algorithm>
#include <chrono>

#include "engine/force_evaluate.h"
#include "engine/force_report.h"

namespace gmsim::engine {

namespace {

// Chunks of the schedule for each thread: more share the load better, fewer use slots more often.
constexpr std::uint32_t kChunksPerThread = 4;
constexpr Row kRowsPerTask = 4096;
// Threads that wait for each other suffer from other programs: they have to be faster by this much.
constexpr double kClearGain = 1.1;

}  // namespace

void ThreadProbe::note(double seconds) {
  seconds_[runs_ % 2][runs_ / 2] = seconds;
  ++runs_;
  if (!decided()) return;
  const auto median = [](std::array<double, kRuns> times) {
    std::nth_element(times.begin(), times.begin() + kRuns / 2, times.end());
    return times[kRuns / 2];
  };
  alone_is_faster_ = median(seconds_[0]) <= kClearGain * median(seconds_[1]);
}

KernelForces::KernelForces(const State& state, const Model& model, unsigned threads,
                           ForceOptions options)
    : context_(state, model.interactions),
      main_(interactions_, ForcePass::Forces::Summed),
      keep_internal_(options.internal),
      workers_(std::max(1u, threads)) {
  if (options.atomic)
    atomic_ = std::make_unique<ForcePass>(interactions_, ForcePass::Forces::Kept);
  for (std::uint32_t i = 0; i < context_.active.size(); ++i)
    interactions_.push_back(std::make_unique<InteractionTables>(context_, i, options.merge));
}

bool KernelForces::rebuild() {
  error_.reset();
  for (const auto& of : interactions_)
    if ((error_ = of->rebuild())) return false;
  lay_out();
  return true;
}

void KernelForces::refresh(std::span<const compile::Dependence> changed) {
  listed_anew_ = false;
  if (changed.empty() || error_ || !repair(changed)) rebuild();
  each_pass([](ForcePass& pass) { pass.unbind(); });
}

void KernelForces::lay_out() {
  const unsigned threads = workers_.threads.count();
  each_pass([&](ForcePass& pass) {
    pass.lay_out(context_.vertices().row_end(), threads == 1 ? 1 : kChunksPerThread * threads);
  });
  stale_ = false;
  listed_anew_ = true;
}

ForceMoment KernelForces::moment(const Motion& motion, double time, double dt) const {
  return {.position = motion.position, .velocity = motion.velocity, .time = time, .dt = dt,
          .step = step()};
}

bool KernelForces::evaluate(const Motion& motion, double time, double dt,
                            std::span<VertexRecord> force) {
  return run(main_, PassKernels::Forces, moment(motion, time, dt), {force.data()});
}

ForceSums::Totals KernelForces::end_totals(std::span<VertexRecord> force) {
  if (!keep_internal_) return {force.data()};
  internal_.resize(force.size());
  return {force.data(), internal_.data()};
}

bool KernelForces::evaluate_end(const Motion& motion, double time, double dt,
                                std::span<VertexRecord> force) {
  return run(atomic_ ? *atomic_ : main_, PassKernels::Forces, moment(motion, time, dt),
             end_totals(force));
}

bool KernelForces::evaluate_changes(const Motion& motion, double time, double dt,
                                    std::span<VertexRecord> force) {
  // The clock is not that of the last evaluation.
  if (reads_time()) return evaluate_end(motion, time, dt, force);
  if (error_) return false;
  ForcePass& pass = atomic_ ? *atomic_ : main_;
  const ForceMoment now = moment(motion, time, dt);
  const auto failure =
      pass.run_changes(now, context_.state.store, workers_, end_totals(force));
  return !failure || fail(*failure, PassKernels::Forces, now);
}

bool KernelForces::product(const Motion& motion, double time, std::span<const VertexRecord> dx,
                           std::span<const VertexRecord> dv, std::span<VertexRecord> out) {
  ForceMoment now = moment(motion, time, context_.state.dt);
  now.position_change = dx;
  now.velocity_change = dv;
  return run(main_, PassKernels::Products, now, {out.data()});
}

bool KernelForces::run(ForcePass& pass, PassKernels kernels, const ForceMoment& moment,
                       const ForceSums::Totals& out) {
  if (error_) return false;
  const gmap::EmbeddingStore& store = context_.state.store;
  const bool probing = workers_.threads.count() > 1 && !probe_.decided() && &pass == &main_;
  const auto start = std::chrono::steady_clock::now();
  if (const auto failure = pass.run(kernels, moment, store, workers_, alone(), out))
    return fail(*failure, kernels, moment);
  if (!probing) return true;
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  probe_.note(passed.count());
  return true;
}

void KernelForces::share_rows(Row rows, RowWork work, const void* context) {
  const std::uint32_t tasks = (rows + kRowsPerTask - 1) / kRowsPerTask;
  workers_.threads.run(tasks, alone(), [&](std::uint32_t task, unsigned) {
    work(context, task * kRowsPerTask, std::min(rows, (task + 1) * kRowsPerTask));
  });
}

bool KernelForces::fail(const ForcePass::Failure& failure, PassKernels kernels,
                        const ForceMoment& moment) {
  // Of merged matches it is said of the first.
  const std::uint32_t row =
      failure.merged
          ? failure.of->place(failure.of->merged(failure.shape)->table().key(failure.row)).row
          : failure.row;
  ShapeKernels& programs = failure.of->kernels(failure.shape);
  return fail(*failure.of, failure.shape, row,
              kernels == PassKernels::Forces ? programs.program() : programs.product().program(),
              moment);
}

bool KernelForces::fail(InteractionTables& of, std::uint32_t shape, std::uint32_t row,
                        const ForceProgram& program, const ForceMoment& moment) {
  const ForceMatch match = of.table(shape).match(row, shape);
  IrEvaluator<double> evaluator(program.graph);
  evaluate_match(program, match, moment, context_.state.store, evaluator);
  error_ = non_finite(of.body(), match, program, evaluator);
  return false;
}

bool KernelForces::run_numbers(InteractionTables& of, std::size_t shape, const ForceKernel& kernel,
                               const ForceMoment& moment, std::vector<double>& values) {
  const MatchTable& table = of.table(shape);
  values.resize(table.size());
  std::vector<InputBinding> inputs;
  kernel.bind(table, context_.state.store, moment, inputs);
  const OutputBinding output{values.data(), 1};
  const auto row = kernel.run(table, inputs, {&output, 1}, 0, table.size(),
                              workers_.spaces[0].scratch);
  return !row || fail(of, static_cast<std::uint32_t>(shape), *row, kernel.program(), moment);
}

bool KernelForces::potential_energy(const Motion& motion, double time, double& energy) {
  energy = 0;
  if (error_) return false;
  const ForceMoment now = moment(motion, time, context_.state.dt);
  std::vector<std::vector<double>> values;
  for (const auto& of : interactions_) {
    values.assign(of->shape_count(), {});
    for (std::size_t shape = 0; shape < of->shape_count(); ++shape) {
      const ForceKernel* kernel = of->kernels(shape).energy();
      if (kernel != nullptr && !run_numbers(*of, shape, *kernel, now, values[shape])) return false;
    }
    of->in_order([&](std::uint32_t shape, std::uint32_t row) {
      if (!values[shape].empty()) energy += values[shape][row];
    });
  }
  return true;
}

std::vector<support::Diagnostic> KernelForces::notices(const Motion& motion, double time) {
  const ForceMoment now = moment(motion, time, context_.state.dt);
  std::vector<support::Diagnostic> result;
  std::vector<std::vector<double>> found;
  for (const auto& of : interactions_) {
    found.assign(of->shape_count(), {});
    for (std::size_t shape = 0; shape < of->shape_count(); ++shape)
      if (const ForceKernel* kernel = of->kernels(shape).direction())
        run_numbers(*of, shape, *kernel, now, found[shape]);
    of->in_order([&](std::uint32_t shape, std::uint32_t row) {
      if (found[shape].empty() || found[shape][row] == 0) return;
      const ForceMatch match = of->table(shape).match(row, shape);
      if (!warned_.emplace(of->number(), match.key).second) return;
      const ForceProgram& program = of->kernels(shape).direction()->program();
      IrEvaluator<double> evaluator(program.graph);
      evaluate_match(program, match, now, context_.state.store, evaluator);
      result.push_back(no_direction(of->body(), match, program, evaluator));
    });
  }
  return result;
}

bool KernelForces::reads(InputOrigin::Kind kind) const {
  bool result = false;
  main_.each_kernel([&](const ForcePass::KernelAtWork& work) {
    result = result || work.kernel->program().reads(kind);
  });
  return result;
}

bool KernelForces::reads_time() const {
  using Kind = InputOrigin::Kind;
  return reads(Kind::Time) || reads(Kind::Dt) || reads(Kind::Step);
}

std::unique_ptr<ForceField> make_kernel_forces(const State& state, const Model& model,
                                               unsigned threads,
                                               support::Diagnostics& diagnostics,
                                               ForceOptions options) {
  auto forces = std::make_unique<KernelForces>(state, model, threads, options);
  forces->refresh({});
  if (!forces->error()) return forces;
  diagnostics.report(*forces->error());
  return nullptr;
}

}  // namespace gmsim::engine
