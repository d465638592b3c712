// SPDX-License-Identifier: MIT
#include "compile/value_parts.h"

#include <algorithm>

#include "support/check.h"

namespace gmsim::compile {

using ir::NodeId;
using ir::Op;
using types::ValueKind;

ValueParts value_parts(const types::ValueType& type) {
  ValueParts parts;
  for (const std::uint32_t extent : type.extents) parts.count *= extent;
  switch (type.kind) {
    case ValueKind::Vec2:
      parts.count *= 2;
      break;
    case ValueKind::Mat2:
      parts.count *= 4;
      break;
    case ValueKind::Vec3:
    case ValueKind::Mat3:
    case ValueKind::Sym3:
      parts.kind = type.kind;
      parts.stride = types::component_count({type.kind});
      break;
    default:
      break;
  }
  return parts;
}

namespace {

NodeId vector(ir::Graph& graph, double x, double y, double z) {
  return graph.make(Op::Vector, graph.constant(x), graph.constant(y), graph.constant(z));
}

NodeId columns(ir::Graph& graph, std::span<const double> m) {
  return graph.make(Op::Columns, vector(graph, m[0], m[3], m[6]), vector(graph, m[1], m[4], m[7]),
                    vector(graph, m[2], m[5], m[8]));
}

}  // namespace

NodeId constant_part(ir::Graph& graph, ir::ValueKind kind, std::span<const double> n) {
  if (kind == ValueKind::Real) return graph.constant(n[0]);
  if (std::all_of(n.begin(), n.end(), [](double x) { return x == 0.0; })) return graph.zero(kind);
  switch (kind) {
    case ValueKind::Vec3:
      return vector(graph, n[0], n[1], n[2]);
    case ValueKind::Mat3:
      return columns(graph, n);
    case ValueKind::Sym3: {
      if (n[3] == 0.0 && n[4] == 0.0 && n[5] == 0.0)
        return graph.make(Op::Diagonal, vector(graph, n[0], n[1], n[2]));
      const double full[9] = {n[0], n[5], n[4], n[5], n[1], n[3], n[4], n[3], n[2]};
      return graph.make(Op::Sym, columns(graph, full));
    }
    default:
      support::internal_error(__FILE__, __LINE__, "no constants of this kind");
  }
}

}  // namespace gmsim::compile
