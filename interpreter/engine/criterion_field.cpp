// SPDX-License-Identifier: MIT
#include "engine/criterion_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "compile/expression_search.h"
#include "engine/force_evaluate.h"
#include "engine/force_report.h"
#include "gmap/orbit_walk.h"

namespace gmsim::engine {

namespace {

using compile::ValueSource;
using compile::ValueSources;
using types::Expr;
using types::ExprKind;

ValueSource source_of(const DartExpression& expression) {
  const Expr& value = *expression.value;
  if (value.kind == ExprKind::Literal && !value.value.data.empty())
    return ValueSource::uniform(value.value.data);
  return ValueSource::expression(expression.value, ValueSource::Frame::ReadDart, expression.dart,
                                 expression.frame_size);
}

/// What the criterion can read besides the columns of the forces: its own parameters, as the scene
/// gives them or by default.
ValueSources sources_of(const ForceContext& context, const TearPairing& pairing) {
  ValueSources sources = context.sources;
  const compile::CriterionBody& body = context.state.program.criterion_bodies[pairing.criterion];
  for (const compile::BodyParameter& parameter : body.parameters) {
    if (parameter.embedding) continue;
    const auto given =
        std::find_if(pairing.parameters.begin(), pairing.parameters.end(),
                     [&](const SlotValue& value) { return value.slot == parameter.slot; });
    if (given != pairing.parameters.end()) {
      sources.parameters.emplace_back(parameter.slot, source_of(given->value));
    } else if (parameter.default_value) {
      sources.parameters.emplace_back(
          parameter.slot, ValueSource::expression(parameter.default_value, ValueSource::Frame::Item,
                                                  {}, 0));
    }
  }
  return sources;
}

/// Value, threshold, then the results.
compile::Wanted wanted(const compile::CriterionBody& body, types::Slot threshold) {
  compile::Wanted all = compile::wanted_values(body);
  auto local = std::make_shared<Expr>();
  local->kind = ExprKind::Local;
  local->slot = threshold;
  local->type = {types::ValueKind::Real};
  local->span = body.name_span;
  all.values.insert(all.values.begin() + 1, std::move(local));
  return all;
}

}  // namespace

ForceReads force_reads(const TearPairing& pairing, const compile::Program& program,
                       types::OrbitType vertex) {
  const compile::CriterionBody& body = program.criterion_bodies[pairing.criterion];
  const gmap::EmbeddingSchema& schema = program.schema;
  ForceReads reads;
  const auto collect = [&](const Expr& expr) {
    (void)compile::any_node(expr, schema, [&](const Expr& node) {
      const bool sum = node.kind == ExprKind::ForceOn;
      const bool of_all = sum && node.orbit == vertex && node.number != 1;
      reads.internal = reads.internal || of_all;
      reads.single = reads.single || (sum && !of_all) || node.kind == ExprKind::Forces;
      if (sum &&
          std::find(reads.orbits.begin(), reads.orbits.end(), node.orbit) == reads.orbits.end())
        reads.orbits.push_back(node.orbit);
      return false;  // look at all of them
    });
  };
  collect(*body.value);
  for (const compile::BodyStep& step : body.steps) collect(*step.value);
  for (const compile::BodyResult& result : body.results) collect(*result.value);
  for (const SlotValue& parameter : pairing.parameters) collect(*parameter.value.value);
  if (pairing.where)  // which is not computed by kernels
    reads.single = reads.single || compile::reads_forces(*pairing.where->value, schema);
  return reads;
}

namespace {

/// The value where the criterion's conditions do not hold: below everything.
constexpr double kNotJudged = std::numeric_limits<double>::lowest();

/// The threshold where it is the same for all matches of a shape.
std::optional<double> uniform_threshold(const compile::Shape& shape) {
  const compile::ir::Node& node = shape.graph[shape.values[1].front()];
  if (node.op != compile::ir::Op::Constant) return std::nullopt;
  return node.constant;
}

/// The value, and the threshold where it is not uniform.
ForceProgram judged_program(const compile::Shape& shape, const ShapeInputs& inputs) {
  namespace ir = compile::ir;
  ForceProgram program = values_program(shape, inputs, 0, uniform_threshold(shape) ? 1 : 2);
  if (shape.condition != ir::kNone)
    program.roots[0] = program.graph.make(ir::Op::Select, shape.condition,
                                          shape.values[0].front(),
                                          program.graph.constant(kNotJudged));
  return program;
}

double ratio(const NearestMatch& match) { return match.value / match.threshold; }

/// Nearer to its threshold; of two alike the one with the smaller dart.
void take_nearer(const NearestMatch& candidate, NearestMatch& nearest) {
  if (nearest.where == gmap::kNoDart || ratio(candidate) > ratio(nearest) ||
      (ratio(candidate) == ratio(nearest) && candidate.where < nearest.where))
    nearest = candidate;
}

}  // namespace

struct CriterionField::Part {
  Part(const compile::Shape& shape, const ShapeInputs& inputs, const MatchTable& of)
      : table(of),
        uniform(uniform_threshold(shape)),
        judged(judged_program(shape, inputs)),
        results(values_program(shape, inputs, 2, shape.values.size() - 2)),
        evaluator(results.graph) {}

  [[nodiscard]] double threshold(std::uint32_t row) const {
    return uniform ? *uniform : thresholds[row];
  }
  const std::vector<double>& compute_ratios() {
    ratios.resize(values.size());
    for (std::size_t row = 0; row < values.size(); ++row)
      ratios[row] = values[row] == kNotJudged ? kNotJudged : values[row] / thresholds[row];
    return ratios;
  }

  const MatchTable& table;
  const std::optional<double> uniform;  // threshold of all
  ForceKernel judged;                   // value, and threshold unless uniform
  ForceProgram results;
  IrEvaluator<double> evaluator;  // of results
  std::vector<InputBinding> bindings;  // of judged
  std::vector<double> values, thresholds, ratios;
};

CriterionField::CriterionField(const ForceContext& context, const compile::World& world,
                               const TearPairing& pairing, std::uint32_t number)
    : context_(context),
      pairing_(pairing),
      number_(number),
      body_(context.state.program.criterion_bodies[pairing.criterion]),
      sources_(sources_of(context, pairing)),
      matches_(context, context.state.program.criteria[pairing.criterion], world, body_,
               wanted(body_, pairing.threshold), sources_) {}
CriterionField::~CriterionField() = default;

CriterionField::Diagnostic CriterionField::rebuild() {
  Diagnostic error = matches_.rebuild();
  add_parts();
  return error;
}

void CriterionField::add_parts() {
  while (parts_.size() < matches_.shape_count()) {
    const auto number = static_cast<std::uint32_t>(parts_.size());
    parts_.push_back(std::make_unique<Part>(matches_.shape(number), matches_.inputs(number),
                                            matches_.table(number)));
  }
}

CriterionField::Diagnostic CriterionField::repair(std::span<const compile::Dependence> changed,
                                                  std::uint64_t& looked_at) {
  matches_.find_stale(changed, stale_);
  looked_at += stale_.matches.size();
  for (const StaleMatch& match : stale_.matches)
    if (Diagnostic error = repair(match)) return error;
  matches_.list_orbits(stale_);
  looked_at += stale_.hooks.size();
  std::vector<DartId> gone;
  for (const DartId smallest : stale_.hooks) {
    // A dart before the hook may have come to match.
    if (matches_.place(smallest).shape != MatchSet::kNowhere) matches_.remove(smallest, gone);
    std::optional<DartId> key;
    if (Diagnostic error = matches_.find_at(smallest, key)) return error;
  }
  add_parts();
  if (matches_.crowded()) matches_.pack();
  return std::nullopt;
}

CriterionField::Diagnostic CriterionField::repair(const StaleMatch& match) {
  const MatchSet::Place place = matches_.place(match.key);
  if (place.shape == MatchSet::kNowhere) {
    // There may be a match where a condition stood against it.
    stale_.hooks.push_back(match.key);
    return std::nullopt;
  }
  if (Diagnostic error = matches_.read_again(place, match.what, reading_)) return error;
  if (reading_.again)
    matches_.remove(match.key, stale_.hooks);
  else
    matches_.adopt(place, reading_);
  return std::nullopt;
}

void CriterionField::add_sums(ForceReadings& readings) const {
  const auto add_all = [&](const ForceProgram& program) {
    for (const ForceProgram::LiveInput& input : program.inputs) {
      const InputOrigin& origin = input.origin;
      if (origin.kind != InputOrigin::Kind::ForceOn) continue;
      if (!readings.has(origin.orbit, origin.offset))
        readings.sums.push_back(std::make_unique<OrbitForces>(origin.orbit, origin.offset));
    }
  };
  for (const auto& part : parts_) {
    add_all(part->judged.program());
    add_all(part->results);
  }
}

bool CriterionField::reads_forces_one_by_one() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) {
    return part->judged.program().reads(InputOrigin::Kind::AtomicForce) ||
           part->results.reads(InputOrigin::Kind::AtomicForce);
  });
}

std::string CriterionField::explain() const {
  std::string text = fmt::format("  {} on {}\n", body_.name, types::to_string(body_.orbit));
  for (const auto& part : parts_) {
    if (part->table.count() == 0) continue;
    const compile::Kernel& kernel = part->judged.kernel();
    text += fmt::format("    {} matches: {} operations and {} bytes a match, {} instructions\n",
                        part->table.count(), kernel.operations(), kernel.bytes(),
                        kernel.code.size());
  }
  return text;
}

CriterionField::Diagnostic CriterionField::judge(const ForceMoment& moment,
                                                 const std::function<bool(DartId)>& allowed,
                                                 std::vector<TearRequest>& requests) {
  ratios_.clear();
  NearestMatch nearest;
  for (std::uint32_t shape = 0; shape < parts_.size(); ++shape)
    if (Diagnostic error = judge_part(*parts_[shape], shape, moment, allowed, nearest, requests))
      return error;
  note_nearest(nearest, moment);
  return std::nullopt;
}

CriterionField::Diagnostic CriterionField::judge_part(Part& part, std::uint32_t shape,
                                                      const ForceMoment& moment,
                                                      const std::function<bool(DartId)>& allowed,
                                                      NearestMatch& nearest,
                                                      std::vector<TearRequest>& requests) {
  const std::uint32_t count = part.table.size();
  part.values.resize(count);
  if (!part.uniform) part.thresholds.resize(count);
  part.judged.bind(part.table, context_.state.store, moment, part.bindings);
  const OutputBinding outputs[] = {{part.values.data(), 1}, {part.thresholds.data(), 1}};
  if (const auto row = part.judged.run(part.table, part.bindings,
                                       std::span(outputs).first(part.uniform ? 1 : 2), 0, count,
                                       scratch_)) {
    const ForceMatch match = part.table.match(*row, shape);
    IrEvaluator<double> evaluator(part.judged.program().graph);
    evaluate_match(part.judged.program(), match, moment, context_.state.store, evaluator);
    return non_finite(body_, match, part.judged.program(), evaluator);
  }
  // Under one threshold the values have the order of the ratios.
  const std::vector<double>& measure = part.uniform ? part.values : part.compute_ratios();
  double best = kNotJudged;
  std::optional<std::uint32_t> best_row;
  for (std::uint32_t row = 0; row < count; ++row) {
    const bool fires = part.values[row] > part.threshold(row);
    if ((!(measure[row] >= best) && !fires) || measure[row] == kNotJudged || part.table.vacant(row))
      continue;
    if (!best_row || measure[row] > best ||
        (measure[row] == best && hook(part, row) < hook(part, *best_row))) {
      best = measure[row];
      best_row = row;
    }
    if (fires) fire(part, shape, row, moment, requests);
  }
  if (pairing_.where) {
    if (follow_nearest_ || keep_ratios_) survey_allowed(part, moment, allowed, nearest);
    return std::nullopt;
  }
  if (best_row)
    take_nearer({part.values[*best_row], part.threshold(*best_row), moment.time,
                 hook(part, *best_row), {}}, nearest);
  if (keep_ratios_) note_ratios(part);
  return std::nullopt;
}

void CriterionField::survey_allowed(const Part& part, const ForceMoment& moment,
                                    const std::function<bool(DartId)>& allowed,
                                    NearestMatch& nearest) {
  for (std::uint32_t row = 0; row < part.table.size(); ++row) {
    if (part.table.vacant(row) || part.values[row] == kNotJudged) continue;
    const NearestMatch here{part.values[row], part.threshold(row), moment.time, hook(part, row), {}};
    const auto is_farther = [&](const NearestMatch& other) {
      return other.where != gmap::kNoDart && ratio(here) < ratio(other);
    };
    if (!keep_ratios_ && (is_farther(nearest) || is_farther(nearest_))) continue;
    if (!allowed(here.where)) continue;
    if (keep_ratios_) ratios_.push_back(ratio(here));
    take_nearer(here, nearest);
  }
}

DartId CriterionField::hook(const Part& part, std::uint32_t row) const {
  return part.table.nodes(row)[body_.hook];
}

void CriterionField::note_ratios(const Part& part) {
  for (std::uint32_t row = 0; row < part.table.size(); ++row)
    if (!part.table.vacant(row) && part.values[row] != kNotJudged)
      ratios_.push_back(part.values[row] / part.threshold(row));
}

void CriterionField::note_nearest(const NearestMatch& candidate, const ForceMoment& moment) {
  if (candidate.where == gmap::kNoDart) return;
  if (nearest_.where != gmap::kNoDart && !(ratio(candidate) > ratio(nearest_))) return;
  nearest_ = candidate;
  const VertexRecord& at = moment.position[context_.vertices().row(candidate.where)];
  nearest_.position = {at.x, at.y, at.z};
}

void CriterionField::fire(Part& part, std::uint32_t shape, std::uint32_t row,
                          const ForceMoment& moment, std::vector<TearRequest>& requests) {
  TearRequest request{.pairing = number_, .hook = hook(part, row), .node = body_.hook,
                      .value = part.values[row], .threshold = part.threshold(row),
                      .results = {}, .orbit = {}};
  if (!part.results.roots.empty()) {
    const ForceMatch match = part.table.match(row, shape);
    evaluate_match(part.results, match, moment, context_.state.store, part.evaluator);
    for (const compile::ir::NodeId root : part.results.roots) {
      const auto& entries = part.evaluator[root];
      const std::uint32_t width = types::component_count({part.results.graph[root].type});
      request.results.insert(request.results.end(), entries.begin(), entries.begin() + width);
    }
  }
  gmap::for_each_dart(context_.state.map, body_.orbit, request.hook,
                      [&](DartId d) { request.orbit.push_back(d); });
  std::sort(request.orbit.begin(), request.orbit.end());
  requests.push_back(std::move(request));
}

}  // namespace gmsim::engine
