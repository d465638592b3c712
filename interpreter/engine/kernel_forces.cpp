// SPDX-License-Identifier: MIT
#include "engine/kernel_forces.h"

#include <algorithm>
#include <chrono>

#include "engine/force_evaluate.h"
#include "engine/force_report.h"

namespace gmsim::engine {

namespace {

constexpr std::uint32_t kMatchesPerTask = 512;
constexpr Row kVerticesPerTask = 1024;
// Room for matches to come, so that a repair seldom has to lay everything out again.
constexpr std::uint32_t kSpareShare = 8;
constexpr std::uint32_t kSpare = 16;

}  // namespace

void ThreadProbe::note(double seconds) {
  double& fastest = fastest_[runs_ % 2];
  fastest = std::min(fastest, seconds);
  ++runs_;
}

KernelForces::KernelForces(const State& state, const Model& model, unsigned threads,
                           ForceOptions options)
    : context_(state, model.interactions),
      threads_(std::max(1u, threads)),
      scratch_(threads_.count()),
      failures_(threads_.count()) {
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

void KernelForces::refresh(std::span<const DartId> touched) {
  if (touched.empty() || error_ || !repair(touched)) rebuild();
}

void KernelForces::lay_out() {
  blocks_.clear();
  jobs_.clear();
  product_jobs_.clear();
  first_block_.clear();
  for (const auto& of : interactions_) {
    first_block_.push_back(blocks_.size());
    for (std::uint32_t shape = 0; shape < of->shape_count(); ++shape) add_block(*of, shape);
  }
  forces_.resize(blocks_.empty() ? 0 : blocks_.back().end());
  for (Job& job : jobs_) bind_outputs(job);
  sums_.rebuild(blocks_, context_.vertices().row_end());
  add_tasks();
  const std::span<const Row> rows = context_.vertices().rows();
  vertex_of_.assign(rows.begin(), rows.end());
  stale_ = false;
}

void KernelForces::add_block(InteractionTables& of, std::uint32_t shape) {
  const MergedTable* merged = of.merged(shape);
  const MatchTable& table = merged != nullptr ? merged->table() : of.table(shape);
  ForceBlock block{.table = &table, .roles = {}, .interaction = of.number(),
                   .first = blocks_.empty() ? 0 : blocks_.back().end(),
                   .capacity = table.size() + table.size() / kSpareShare + kSpare};
  for (std::uint32_t root = 0; root < of.shape(shape).forces.size(); ++root)
    block.roles.push_back(merged != nullptr ? root : of.shape(shape).forces[root].role);
  jobs_.push_back({.of = &of, .shape = shape, .table = &table,
                   .kernel = merged != nullptr ? &merged->kernel() : &of.kernels(shape).force(),
                   .merged = merged != nullptr, .block = blocks_.size(), .inputs = {},
                   .outputs = {}});
  blocks_.push_back(std::move(block));
}

void KernelForces::add_tasks() {
  tasks_.clear();
  for (std::uint32_t job = 0; job < jobs_.size(); ++job) {
    const std::uint32_t count = jobs_[job].table->size();
    for (std::uint32_t begin = 0; begin < count; begin += kMatchesPerTask)
      tasks_.push_back({job, begin, std::min(count, begin + kMatchesPerTask)});
  }
}

void KernelForces::bind_outputs(Job& job) {
  constexpr std::uint32_t kRecord = sizeof(VertexRecord) / sizeof(double);
  const ForceBlock& block = blocks_[job.block];
  for (std::uint32_t root = 0; root < block.roles.size(); ++root) {
    VertexRecord* first = forces_.data() + block.slot(root, 0);
    job.outputs.push_back({&first->x, kRecord});
  }
}

ForceMoment KernelForces::moment(const Motion& motion, double time, double dt) const {
  return {.position = motion.position, .velocity = motion.velocity, .time = time, .dt = dt,
          .step = step()};
}

bool KernelForces::evaluate(const Motion& motion, double time, double dt,
                            std::span<VertexRecord> force) {
  return run(jobs_, moment(motion, time, dt), force);
}

bool KernelForces::product(const Motion& motion, double time, std::span<const VertexRecord> dx,
                           std::span<const VertexRecord> dv, std::span<VertexRecord> out) {
  if (product_jobs_.size() != jobs_.size()) {
    product_jobs_ = jobs_;
    for (Job& job : product_jobs_)
      job.kernel = job.merged ? &job.of->merged(job.shape)->product()
                              : &job.of->kernels(job.shape).product();
  }
  ForceMoment now = moment(motion, time, context_.state.dt);
  now.position_change = dx;
  now.velocity_change = dv;
  return run(product_jobs_, now, out);
}

bool KernelForces::run(std::vector<Job>& jobs, const ForceMoment& moment,
                       std::span<VertexRecord> out) {
  if (error_) return false;
  if (threads_.count() == 1) return run_stages(jobs, moment, out, true);
  if (probe_.decided()) return run_stages(jobs, moment, out, probe_.alone());
  const auto start = std::chrono::steady_clock::now();
  if (!run_stages(jobs, moment, out, probe_.alone())) return false;
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  probe_.note(passed.count());
  return true;
}

bool KernelForces::run_stages(std::vector<Job>& jobs, const ForceMoment& moment,
                              std::span<VertexRecord> out, bool alone) {
  if (!run_tables(jobs, moment, alone)) return false;
  sum(out, alone);
  return true;
}

bool KernelForces::run_tables(std::vector<Job>& jobs, const ForceMoment& moment, bool alone) {
  for (Job& job : jobs) job.kernel->bind(*job.table, context_.state.store, moment, job.inputs);
  std::fill(failures_.begin(), failures_.end(), Failure{});
  threads_.run(static_cast<std::uint32_t>(tasks_.size()), alone,
               [&](std::uint32_t number, unsigned worker) {
                 const Task& task = tasks_[number];
                 const Job& job = jobs[task.job];
                 const auto match = run_kernel(job.kernel->kernel(), job.inputs, job.outputs,
                                               task.begin, task.end, scratch_[worker]);
                 if (match && number < failures_[worker].task)
                   failures_[worker] = {number, *match};
               });
  // The first failed task, whoever ran it, so that the message does not depend on threads.
  const Failure& first = *std::min_element(
      failures_.begin(), failures_.end(),
      [](const Failure& a, const Failure& b) { return a.task < b.task; });
  if (first.task == Failure{}.task) return true;
  return fail(jobs[tasks_[first.task].job], first.match, moment);
}

bool KernelForces::fail(const Job& job, std::uint32_t row, const ForceMoment& moment) {
  if (!job.merged) return fail(*job.of, job.shape, row, job.kernel->program(), moment);
  // Said of the first of the merged matches, with the program for single ones.
  const InteractionTables::Place place = job.of->place(job.table->key(row));
  const bool forces = moment.position_change.empty();
  ShapeKernels& kernels = job.of->kernels(job.shape);
  return fail(*job.of, job.shape, place.row,
              forces ? kernels.force().program() : kernels.product().program(), moment);
}

void KernelForces::sum(std::span<VertexRecord> out, bool alone) {
  const Row vertices = sums_.vertices();
  const std::uint32_t tasks = (vertices + kVerticesPerTask - 1) / kVerticesPerTask;
  threads_.run(tasks, alone, [&](std::uint32_t task, unsigned) {
    const Row begin = task * kVerticesPerTask;
    sums_.sum(forces_.data(), begin, std::min(vertices, begin + kVerticesPerTask), out.data());
  });
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
  const auto match = run_kernel(kernel.kernel(), inputs, {&output, 1}, 0, table.size(), scratch_[0]);
  return !match || fail(of, static_cast<std::uint32_t>(shape), *match, kernel.program(), moment);
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
  return std::any_of(jobs_.begin(), jobs_.end(),
                     [&](const Job& job) { return job.kernel->program().reads(kind); });
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
