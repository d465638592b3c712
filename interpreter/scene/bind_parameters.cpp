// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compile/expression_search.h"
#include "engine/enumerate.h"
#include "engine/new_interactions.h"
#include "scene/acting.h"
#include "scene/expression_facts.h"

namespace gmsim::scene {
namespace {

using engine::ParameterBinding;
using gmap::DartId;
using support::DiagnosticKind;

/// What one use of an interaction gives for a parameter; null: its default.
const SceneExpression* given(const Acting::Use& use, std::uint32_t parameter) {
  const auto found = std::ranges::find(use.member->given, parameter, &GivenParameter::parameter);
  return found == use.member->given.end() ? nullptr : &found->value;
}

class Binder {
 public:
  Binder(Building& building, engine::Matcher& matcher, std::uint32_t interaction,
         const Acting& acting)
      : building_(building),
        matcher_(matcher),
        acting_(acting),
        pattern_(building.scene.program.interactions[interaction]),
        body_(building.scene.program.interaction_bodies[interaction]),
        evaluator_(building),
        written_(embeddings_written(building.scene)) {
    active_.interaction = interaction;
    active_.span = acting.uses.front().use->span;
  }

  std::optional<engine::ActiveInteraction> bind() {
    for (std::uint32_t i = 0; i < body_.parameters.size(); ++i) {
      active_.parameters.push_back(binding(i));
      if (building_.diagnostics.has_errors()) return std::nullopt;
    }
    const bool stored =
        std::ranges::any_of(active_.parameters, [](const ParameterBinding& parameter) {
          return parameter.kind == ParameterBinding::Kind::Stored;
        });
    if (stored && !store_all()) return std::nullopt;
    for (const Acting::Use& use : acting_.uses) active_.sites.push_back(site_of(use));
    return std::move(active_);
  }

 private:
  // ---- how each parameter is kept ---------------------------------------------------------------

  ParameterBinding binding(std::uint32_t i) {
    ParameterBinding result{.embedding = body_.parameters[i].embedding.value(),
                            .kind = {},
                            .uniform = {},
                            .expression = {}};
    for (const Acting::Use& use : acting_.uses)
      if (const SceneExpression* expression = given(use, i); expression && !result.expression.value)
        result.expression = expression->code;
    if (reads_time(i)) {
      result.kind = ParameterBinding::Kind::OfTime;
      require_one_text(i);
    } else if (auto uniform = uniform_value(i); uniform && !needs_column(result.embedding)) {
      result.kind = ParameterBinding::Kind::Uniform;
      result.uniform = std::move(*uniform);
    } else {
      result.kind = ParameterBinding::Kind::Stored;
      building_.state().use(result.embedding);
    }
    return result;
  }

  [[nodiscard]] engine::InteractionSite site_of(const Acting::Use& use) const {
    engine::InteractionSite site;
    if (use.use->body && building_.plan.bodies.size() > 1) site.body = static_cast<std::uint32_t>(*use.use->body);
    if (use.use->where.good()) site.where = use.use->where.code;
    for (std::uint32_t i = 0; i < body_.parameters.size(); ++i) {
      const SceneExpression* expression = given(use, i);
      site.given.push_back(expression ? expression->code : engine::DartExpression{});
    }
    return site;
  }

  [[nodiscard]] bool reads_time(std::uint32_t i) const {
    const auto& initial = body_.parameters[i].default_value;
    return std::ranges::any_of(acting_.uses, [&](const Acting::Use& use) {
      const SceneExpression* expression = given(use, i);
      return expression ? expression->reads_clock
                        : initial && compile::reads_clock(*initial, building_.scene.program.schema);
    });
  }

  /// A parameter that changes in time is one expression for all of the scene.
  void require_one_text(std::uint32_t i) {
    const SceneExpression* first = given(acting_.uses.front(), i);
    for (const Acting::Use& use : acting_.uses) {
      const SceneExpression* expression = given(use, i);
      if (first && expression && expression->text == first->text) continue;
      building_.report(
          DiagnosticKind::NotAvailable, expression ? expression->span : use.use->span,
          fmt::format(
              "`{}` of `{}` reads the time, so it must be one expression for the whole scene",
              body_.parameters[i].name, pattern_.name),
          fmt::format("give the same text wherever `{}` acts; it may tell places apart with `if`",
                      pattern_.name));
      return;
    }
  }

  /// The value that all uses give, when each is a constant.
  std::optional<types::Value> uniform_value(std::uint32_t i) {
    std::optional<types::Value> common;
    for (const Acting::Use& use : acting_.uses) {
      const auto value = constant_value(given(use, i), i);
      if (!value || (common && common->data != value->data)) return std::nullopt;
      common = value;
    }
    return common;
  }

  std::optional<types::Value> constant_value(const SceneExpression* expression, std::uint32_t i) {
    const types::ExprPtr& value =
        expression ? expression->code.value : body_.parameters[i].default_value;
    if (!value || !is_constant(*value)) return std::nullopt;
    engine::Frame frame(expression ? expression->code.frame_size : body_.frame_size);
    types::Value result{.type = body_.parameters[i].type};
    result.data.resize(types::component_count(result.type));
    if (!number(*value, frame, result.data, i, gmap::kNoDart)) return std::nullopt;
    return result;
  }

  /// Something may write or read it as a value of its orbit, or divide it.
  [[nodiscard]] bool needs_column(types::EmbeddingId id) const {
    const bool changes = !building_.scene.model.tears.empty() || !building_.scene.model.rewrites.empty();
    const bool divided =
        changes && building_.scene.program.schema[id].kind == gmap::EmbeddingKind::Extensive;
    return divided || written_.contains(id) || building_.reads.contains(id);
  }

  // ---- values at matches ------------------------------------------------------------------------

  bool store_all() {
    const engine::Enumeration enumeration{.orbit = pattern_.orbit,
                                          .first = pattern_.first.get(),
                                          .first_dart = pattern_.first_dart,
                                          .presence = pattern_.presence};
    std::vector<std::pair<DartId, std::vector<std::vector<double>>>> all;
    const auto error = engine::for_each_match(
        matcher_, building_.state(), pattern_.match, pattern_.frame_size, {}, enumeration,
        [&](DartId dart, const engine::Match&, engine::Frame& frame) {
          if (!building_.diagnostics.has_errors()) all.emplace_back(dart, values_at(dart, frame));
        });
    if (error) building_.diagnostics.report(*error);
    if (building_.diagnostics.has_errors()) return false;
    for (std::size_t i = 0; i < active_.parameters.size(); ++i) {
      if (active_.parameters[i].kind != ParameterBinding::Kind::Stored) continue;
      for (const auto& [dart, values] : all)
        building_.state().store.set(active_.parameters[i].embedding, dart, values[i]);
    }
    return true;
  }

  [[nodiscard]] const Acting::Use& use_at(DartId dart) const {
    const gmap::OrbitIndex& rows = building_.state().store.index_of(*pattern_.presence);
    return acting_.uses[acting_.use_of_row[rows.row(dart)]];
  }

  /// All parameters at a match, in order: a default may read those above it.
  std::vector<std::vector<double>> values_at(DartId dart, engine::Frame& frame) {
    std::vector<std::vector<double>> values;
    const Acting::Use& use = use_at(dart);
    for (std::uint32_t i = 0; i < body_.parameters.size(); ++i) {
      const compile::BodyParameter& parameter = body_.parameters[i];
      std::vector<double> value(types::component_count(parameter.type));
      if (active_.parameters[i].kind == ParameterBinding::Kind::Uniform) {
        value = active_.parameters[i].uniform.data;
      } else if (const SceneExpression* expression = given(use, i)) {
        if (!evaluator_.evaluate(*expression, dart, value)) return {};
      } else if (!define_lets(*parameter.default_value, frame) ||
                 !number(*parameter.default_value, frame, value, i, dart)) {
        return {};
      }
      frame.set(parameter.slot, value);
      values.push_back(std::move(value));
    }
    return values;
  }

  bool define_lets(const types::Expr& expr, engine::Frame& frame) {
    if (engine::define_lets(body_, expr, matcher_.evaluator(), frame)) return true;
    building_.diagnostics.report(matcher_.evaluator().take_failure().diagnostic);
    return false;
  }

  bool number(const types::Expr& expr, engine::Frame& frame, std::vector<double>& out,
              std::uint32_t i, DartId dart) {
    support::Diagnostic problem{
        .kind = DiagnosticKind::NonFinite,
        .message = fmt::format("the parameter `{}` is not finite", body_.parameters[i].name),
        .place = expr.span};
    if (matcher_.evaluator().evaluate(expr, frame, out)) {
      if (std::ranges::all_of(out, [](double x) { return std::isfinite(x); })) return true;
    } else {
      problem = matcher_.evaluator().take_failure().diagnostic;
    }
    problem.notes.push_back(
        fmt::format("parameter `{}` of `{}`{}", body_.parameters[i].name, pattern_.name,
                    dart == gmap::kNoDart ? "" : " at " + dart_text(building_.state(), dart)));
    building_.diagnostics.report(std::move(problem));
    return false;
  }

  Building& building_;
  engine::Matcher& matcher_;
  const Acting& acting_;
  const compile::RootedPattern& pattern_;
  const compile::InteractionBody& body_;
  DartEvaluator evaluator_;
  std::set<types::EmbeddingId> written_;
  engine::ActiveInteraction active_;
};

}  // namespace

std::optional<engine::ActiveInteraction> bind_parameters(Building& building,
                                                         engine::Matcher& matcher,
                                                         std::uint32_t interaction,
                                                         const Acting& acting) {
  return Binder(building, matcher, interaction, acting).bind();
}

}  // namespace gmsim::scene
