// SPDX-License-Identifier: MIT
#include "scene/build_scene.h"
#include "scene/expression_facts.h"

namespace gmsim::scene {
namespace {

using Ids = std::set<types::EmbeddingId>;

/// Collects what is read; every embedding once, with what it is computed from.
class Reads {
 public:
  Reads(const Scene& scene, const ScenePlan& plan)
      : schema_(scene.program.schema), library_(scene.rules.in(scene.program.dimension)) {
    for (const char* name : {"position", "velocity", "corner_mass"})
      if (const auto id = schema_.find(name)) add_read(*id, schema_, ids_);
    if (const auto id = schema_.find("fixed"); id && !plan.fixes.empty()) ids_.insert(*id);
    for (const BodyPlan& body : plan.bodies) add(body);
    for (const InteractionUse& use : plan.interactions) add(use);
    for (const FixPlan& fix : plan.fixes) add(fix.vertices.where.code);
    for (const MovePlan& move : plan.moves) {
      add(move.vertices.where.code);
      add(move.value.code);
    }
    for (const OutputField& field : scene.output.fields) add(field.value);
    for (const Expectation& expectation : scene.expectations) add(expectation.value);
    for (const engine::TearPairing& tear : scene.model.tears) add(tear);
    for (const engine::StandingRewrite& rewrite : scene.model.rewrites) {
      add(rewrite.change);
      if (rewrite.where) add(*rewrite.where);
      for (const engine::SlotValue& parameter : rewrite.parameters) add(parameter.value);
    }
  }

  [[nodiscard]] Ids take() { return std::move(ids_); }

 private:
  void add(const engine::DartExpression& expression) {
    if (expression.value) add_reads(*expression.value, schema_, ids_);
  }
  void add(const check::Footprint& footprint) {
    for (const types::EmbeddingId id : footprint.reads) add_read(id, schema_, ids_);
  }
  void add(const engine::NamedChange& change) {
    add(change.operation ? library_.operations[change.target].footprint
                         : library_.rules[change.target].footprint);
  }
  void add(const BodyPlan& body) {
    add(body.mass_of_vertex.code);
    for (const MeshData& data : body.data) add_read(data.embedding, schema_, ids_);
    for (const Preparation& preparation : body.prepare) {
      add(preparation.change);
      add(preparation.where.code);
    }
    for (const InitialValues& initial : body.initial) {
      add(initial.where.code);
      for (const auto& [id, value] : initial.values) {
        add_read(id, schema_, ids_);
        add(value.code);
      }
    }
  }
  void add(const InteractionUse& use) {
    add(use.where.code);
    for (const InteractionUse::Member& member : use.members) {
      add(library_.interactions[member.interaction].footprint);
      for (const GivenParameter& given : member.given) add(given.value.code);
    }
  }
  void add(const engine::TearPairing& tear) {
    add(library_.criteria[tear.criterion].footprint);
    add(tear.change);
    if (tear.where) add(*tear.where);
    for (const engine::SlotValue& parameter : tear.parameters) add(parameter.value);
    for (const engine::TearPairing::Argument& argument : tear.arguments) add(argument.value);
  }

  const gmap::EmbeddingSchema& schema_;
  const check::RuleLibrary& library_;
  Ids ids_;
};

}  // namespace

Ids embeddings_read(const Scene& scene, const ScenePlan& plan) {
  return Reads(scene, plan).take();
}

Ids embeddings_written(const Scene& scene) {
  const check::RuleLibrary& library = scene.rules.in(scene.program.dimension);
  Ids ids;
  const auto add = [&](const engine::NamedChange& change) {
    const auto& writes = change.operation ? library.operations[change.target].footprint.writes
                                          : library.rules[change.target].footprint.writes;
    ids.insert(writes.begin(), writes.end());
  };
  for (const engine::TearPairing& tear : scene.model.tears) add(tear.change);
  for (const engine::StandingRewrite& rewrite : scene.model.rewrites) add(rewrite.change);
  return ids;
}

}  // namespace gmsim::scene
