// SPDX-License-Identifier: MIT
// Random columns for the inputs of a kernel, and its results beside those of the tree evaluator.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "engine/ir_evaluate.h"
#include "engine/kernel/run_kernel.h"

namespace gmsim::tests {

namespace ir = compile::ir;

inline std::uint32_t entry_count(ir::ValueKind kind) {
  return kind == ir::ValueKind::Bool ? 1 : types::component_count({kind, {}});
}

/// A column of values, with the layouts that a state can have: dense, in records of four, one value
/// for each match, or one for all.
struct Column {
  struct alignas(32) Line {
    double d[4] = {};
  };
  std::vector<Line> memory;
  std::vector<std::uint32_t> rows;
  engine::InputBinding binding;

  [[nodiscard]] const double* value(std::uint32_t match) const {
    if (binding.rows != nullptr) return binding.base + binding.stride * binding.rows[match];
    return binding.per_match ? binding.base + binding.stride * match : binding.base;
  }
};

template <typename Random>
Column random_column(ir::ValueKind kind, bool uniform, std::uint32_t matches, Random& random) {
  Column column;
  const std::uint32_t entries = entry_count(kind), count = 2 * matches;
  const auto layout = uniform ? 0u : random() % 5;
  const std::uint32_t stride =
      kind == ir::ValueKind::Vec3 && layout >= 2 ? 4 : entries + random() % 2;
  column.memory.resize((count * stride + entries) / 4 + 1);
  double* base = column.memory.front().d;
  std::uniform_real_distribution<double> uniform_real(-1.5, 1.5);
  for (std::uint32_t i = 0; i < 4 * column.memory.size(); ++i) base[i] = uniform_real(random);
  column.binding = {base, stride, nullptr, layout == 1};
  if (layout >= 2) {
    for (std::uint32_t m = 0; m < matches; ++m)
      column.rows.push_back(static_cast<std::uint32_t>(random() % count));
    column.binding.rows = column.rows.data();
  }
  return column;
}

inline bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0;
}

/// Results of one match after the other by the evaluator.
inline std::vector<std::vector<double>> evaluate_each(
    const ir::Graph& graph, const std::vector<ir::NodeId>& roots,
    const std::vector<compile::KernelInput>& inputs, const std::vector<Column>& columns,
    std::uint32_t matches) {
  engine::IrEvaluator<double> evaluator(graph);
  std::vector<std::vector<double>> results(roots.size());
  for (std::uint32_t m = 0; m < matches; ++m) {
    for (std::size_t k = 0; k < inputs.size(); ++k)
      evaluator.set_input(inputs[k].input, {columns[k].value(m), entry_count(inputs[k].type)});
    evaluator.run();
    for (std::size_t k = 0; k < roots.size(); ++k)
      for (std::uint32_t i = 0; i < entry_count(graph[roots[k]].type); ++i)
        results[k].push_back(evaluator[roots[k]][i]);
  }
  return results;
}

/// Bits that a kernel must not write to.
inline constexpr double kUntouched = 12345.678;

inline void compare_kernel(const ir::Graph& graph, const std::vector<ir::NodeId>& roots,
                           std::uint32_t block, engine::Isa isa, const std::vector<Column>& columns,
                           const std::vector<std::vector<double>>& expected,
                           std::uint32_t matches) {
  const compile::Kernel kernel = compile::compile_kernel(graph, roots, {.block = block});
  CAPTURE(block);
  CAPTURE(engine::name_of(isa));
  std::vector<engine::InputBinding> in;
  for (const Column& column : columns) in.push_back(column.binding);
  std::vector<Column> out(roots.size());
  std::vector<engine::OutputBinding> bindings;
  for (std::size_t k = 0; k < roots.size(); ++k) {
    const std::uint32_t stride = entry_count(graph[roots[k]].type) + (k / 2 + matches) % 2;
    out[k].memory.resize(matches * stride / 4 + 1);
    for (auto& line : out[k].memory) std::fill_n(line.d, 4, kUntouched);
    out[k].binding = {out[k].memory.front().d, stride, nullptr, true};
    bindings.push_back({out[k].memory.front().d, stride});
  }
  engine::KernelScratch scratch;
  const std::uint32_t begin = matches / 3;  // two calls, as two threads would make them
  auto bad = engine::run_kernel(kernel, in, bindings, 0, begin, scratch, isa);
  if (!bad) bad = engine::run_kernel(kernel, in, bindings, begin, matches, scratch, isa);
  std::optional<std::uint32_t> expected_bad;
  for (std::uint32_t m = 0; m < matches && !expected_bad; ++m)
    for (std::size_t k = 0; k < roots.size(); ++k)
      for (std::uint32_t i = 0; i < entry_count(graph[roots[k]].type); ++i)
        if (!std::isfinite(expected[k][m * entry_count(graph[roots[k]].type) + i]))
          expected_bad = m;
  REQUIRE(bad == expected_bad);
  if (bad) {
    const auto origin = engine::locate_non_finite(kernel, in, *bad, scratch);
    REQUIRE(origin);
    CHECK_FALSE(origin->input);
    return;
  }
  for (std::size_t k = 0; k < roots.size(); ++k) {
    const std::uint32_t entries = entry_count(graph[roots[k]].type);
    for (std::uint32_t m = 0; m < matches; ++m) {
      for (std::uint32_t i = 0; i < entries; ++i) {
        const double got = out[k].value(m)[i], want = expected[k][m * entries + i];
        if (same_bits(got, want)) continue;
        FAIL("output ", k, " of match ", m, " entry ", i, ": ", got, " instead of ", want, "\n",
             to_string(graph, std::span(&roots[k], 1)), to_string(kernel));
      }
    }
  }
}

/// One graph at all block sizes and on all instruction sets of the machine.
inline void compare_everywhere(const ir::Graph& graph, const std::vector<ir::NodeId>& roots,
                               const std::vector<Column>& columns, std::uint32_t matches) {
  const compile::Kernel kernel = compile::compile_kernel(graph, roots);
  const auto expected = evaluate_each(graph, roots, kernel.inputs, columns, matches);
  for (const std::uint32_t block : {0u, 1u, 2u, 8u, 64u, 256u})
    for (const engine::Isa isa : engine::available_isas())
      compare_kernel(graph, roots, block, isa, columns, expected, matches);
}

template <typename Random>
std::vector<Column> random_columns(const std::vector<compile::KernelInput>& inputs,
                                   std::uint32_t matches, Random& random) {
  std::vector<Column> columns;
  for (const compile::KernelInput& input : inputs)
    columns.push_back(random_column(input.type, input.uniform, matches, random));
  return columns;
}

}  // namespace gmsim::tests
