// SPDX-License-Identifier: MIT
#include "engine/criterion_field.h"

#include <algorithm>
#include <utility>

#include "compile/expression_search.h"
#include "engine/force_evaluate.h"
#include "engine/force_report.h"
#include "gmap/orbit_walk.h"
#include "support/sort_once.h"

namespace gmsim::engine {

namespace {

constexpr std::uint32_t kFewVacant = 256;

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

ForceReads force_reads(const compile::CriterionBody& body, const gmap::EmbeddingSchema& schema) {
  ForceReads reads;
  const auto collect = [&](const Expr& expr) {
    (void)compile::any_node(expr, schema, [&](const Expr& node) {
      reads.any = reads.any || node.kind == ExprKind::ForceOn || node.kind == ExprKind::Forces;
      if (node.kind == ExprKind::ForceOn &&
          std::find(reads.orbits.begin(), reads.orbits.end(), node.orbit) == reads.orbits.end())
        reads.orbits.push_back(node.orbit);
      return false;  // look at all of them
    });
  };
  collect(*body.value);
  for (const compile::BodyStep& step : body.steps) collect(*step.value);
  for (const compile::BodyResult& result : body.results) collect(*result.value);
  return reads;
}

struct CriterionField::Part {
  Part(const compile::Shape& shape, const ShapeInputs& inputs, MatchTable::Widths widths)
      : table(std::move(widths)),
        judged(values_program(shape, inputs, 0, 2)),
        results(values_program(shape, inputs, 2, shape.values.size() - 2)),
        evaluator(results.graph) {}

  MatchTable table;
  ForceKernel judged;      // value and threshold
  ForceProgram results;
  IrEvaluator<double> evaluator;  // of results
  std::vector<double> values, thresholds;
};

CriterionField::CriterionField(const ForceContext& context, const compile::World& world,
                               const TearPairing& pairing, std::uint32_t number)
    : context_(context),
      pairing_(pairing),
      number_(number),
      body_(context.state.program.criterion_bodies[pairing.criterion]),
      sources_(sources_of(context, pairing)),
      finder_(context, context.state.program.criteria[pairing.criterion], world, body_,
              wanted(body_, pairing.threshold), sources_),
      watch_(context, context.state.program.criteria[pairing.criterion], body_) {
  finder_.on_excluded([this](const ForceMatch& match) { watch_.add(match); });
}
CriterionField::~CriterionField() = default;

CriterionField::Diagnostic CriterionField::rebuild() {
  for (const auto& part : parts_) part->table.clear();
  watch_.clear();
  places_.assign(context_.state.map.dart_end(), {});
  if (Diagnostic error = finder_.find_all([&](const ForceMatch& match) { add(match); }))
    return error;
  watch_.pack();
  return std::nullopt;
}

void CriterionField::add(const ForceMatch& match) {
  while (parts_.size() < finder_.shapes().size()) add_part(match);
  if (places_.size() <= types::index(match.key)) places_.resize(context_.state.map.dart_end());
  places_[types::index(match.key)] = {match.shape, parts_[match.shape]->table.add(match)};
  watch_.add(match);
}

void CriterionField::add_part(const ForceMatch& match) {
  const auto number = static_cast<std::uint32_t>(parts_.size());
  const compile::Shape& shape = finder_.shapes()[number];
  const ShapeInputs& inputs = finder_.inputs(number);
  const std::size_t rows = shape.roles.size() + match.roles.atomic.size();
  parts_.push_back(std::make_unique<Part>(
      shape, inputs,
      MatchTable::Widths{.roles = static_cast<std::uint32_t>(rows),
                         .nodes = static_cast<std::uint32_t>(body_.nodes.size()),
                         .targets = 0,
                         .own = inputs.own_widths()}));
  own_stay_ = own_stay_ && inputs.own_stay_in_orbits();
}

void CriterionField::remove(DartId key) {
  const Place gone = std::exchange(places_[types::index(key)], Place{});
  parts_[gone.shape]->table.vacate(gone.row);
}

/// Takes vacant rows out of a table when they are many.
void CriterionField::pack(Part& part) {
  MatchTable& table = part.table;
  if (table.size() <= table.count() + table.count() / 4 + kFewVacant) return;
  std::vector<std::uint32_t> rows;
  for (std::uint32_t row = 0; row < table.size(); ++row) {
    if (table.vacant(row)) continue;
    places_[types::index(table.key(row))].row = static_cast<std::uint32_t>(rows.size());
    rows.push_back(row);
  }
  table.pack(rows);
}

CriterionField::Diagnostic CriterionField::repair(std::span<const DartId> changed,
                                                  std::uint64_t& looked_at) {
  const gmap::GMap& map = context_.state.map;
  std::vector<DartId> keys, hooks;
  watch_.find_stale(changed, keys, hooks);
  for (const DartId key : keys) {
    hooks.push_back(key);
    const Place there = place(key);
    if (there.shape == kNowhere) continue;
    hooks.push_back(parts_[there.shape]->table.nodes(there.row)[body_.hook]);
    remove(key);
  }
  for (DartId& hook : hooks)
    hook = map.alive(hook) ? gmap::smallest_dart(map, body_.orbit, hook) : gmap::kNoDart;
  support::sort_once(hooks);
  if (!hooks.empty() && hooks.back() == gmap::kNoDart) hooks.pop_back();
  looked_at += hooks.size();
  for (const DartId key : hooks) {
    if (place(key).shape != kNowhere) remove(key);
    if (Diagnostic error = finder_.find_at(key, [&](const ForceMatch& match) { add(match); }))
      return error;
  }
  for (const auto& part : parts_) pack(*part);
  return std::nullopt;
}

void CriterionField::add_sums(ForceReadings& readings) const {
  const auto add_all = [&](const ForceProgram& program) {
    for (const ForceProgram::LiveInput& input : program.inputs) {
      const InputOrigin& origin = input.origin;
      if (origin.kind != InputOrigin::Kind::ForceOn) continue;
      if (readings.find(origin.orbit, origin.offset) == nullptr)
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

CriterionField::Diagnostic CriterionField::judge(const ForceMoment& moment,
                                                 std::vector<TearRequest>& requests) {
  ratios_.clear();
  NearestMatch nearest;
  for (std::uint32_t shape = 0; shape < parts_.size(); ++shape)
    if (Diagnostic error = judge_part(*parts_[shape], shape, moment, nearest, requests))
      return error;
  note_nearest(nearest, moment);
  return std::nullopt;
}

CriterionField::Diagnostic CriterionField::judge_part(Part& part, std::uint32_t shape,
                                                      const ForceMoment& moment,
                                                      NearestMatch& nearest,
                                                      std::vector<TearRequest>& requests) {
  const std::uint32_t count = part.table.size();
  part.values.resize(count);
  part.thresholds.resize(count);
  std::vector<InputBinding> inputs;
  part.judged.bind(part.table, context_.state.store, moment, inputs);
  const OutputBinding outputs[] = {{part.values.data(), 1}, {part.thresholds.data(), 1}};
  if (const auto row = part.judged.run(part.table, inputs, outputs, 0, count, scratch_)) {
    const ForceMatch match = part.table.match(*row, shape);
    IrEvaluator<double> evaluator(part.judged.program().graph);
    evaluate_match(part.judged.program(), match, moment, context_.state.store, evaluator);
    return non_finite(body_, match, part.judged.program(), evaluator);
  }
  for (std::uint32_t row = 0; row < count; ++row) {
    if (part.table.vacant(row)) continue;
    const double value = part.values[row], threshold = part.thresholds[row];
    if (value == 0 && threshold == 0) continue;  // the criterion's conditions do not hold there
    if (keep_ratios_) ratios_.push_back(value / threshold);
    const DartId hook = part.table.nodes(row)[body_.hook];
    const double ratio = value / threshold, best = nearest.value / nearest.threshold;
    if (nearest.where == gmap::kNoDart || ratio > best || (ratio == best && hook < nearest.where))
      nearest = {value, threshold, moment.time, hook, {}};
    if (value > threshold) fire(part, shape, row, moment, value, threshold, requests);
  }
  return std::nullopt;
}

void CriterionField::note_nearest(const NearestMatch& candidate, const ForceMoment& moment) {
  const bool nearer = nearest_.where == gmap::kNoDart || candidate.value / candidate.threshold >
                                                             nearest_.value / nearest_.threshold;
  if (candidate.where == gmap::kNoDart || !nearer) return;
  nearest_ = candidate;
  const VertexRecord& at = moment.position[context_.vertices().row(candidate.where)];
  nearest_.position = {at.x, at.y, at.z};
}

void CriterionField::fire(Part& part, std::uint32_t shape, std::uint32_t row,
                          const ForceMoment& moment, double value, double threshold,
                          std::vector<TearRequest>& requests) {
  TearRequest request{.pairing = number_, .hook = part.table.nodes(row)[body_.hook],
                      .node = body_.hook, .value = value, .threshold = threshold,
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
