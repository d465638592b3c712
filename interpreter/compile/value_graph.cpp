// SPDX-License-Identifier: MIT
#include "compile/value_graph.h"

#include <algorithm>
#include <bit>

namespace gmsim::compile {

bool makes_dart(ValueOp op) {
  return op < ValueOp::Range || op == ValueOp::PickDart;
}

// ---- domains ------------------------------------------------------------------------------------

DomainId ValueGraph::rows(std::uint8_t joined) {
  // Where larger groups are joined, every one of them has a chosen row.
  const bool all = (chosen_ & ~joined) == 0;
  const std::uint8_t chosen = all ? std::uint8_t{0} : chosen_;
  for (DomainId id = 0; id < domains_.size(); ++id) {
    const LaneDomain& domain = domains_[id];
    if (domain.above != LaneDomain::kNone) continue;
    if (domain.joined == joined && domain.chosen == chosen) return id;
  }
  domains_.push_back({.chosen = chosen, .joined = joined});
  return static_cast<DomainId>(domains_.size() - 1);
}

bool ValueGraph::is_above(DomainId above, DomainId below) const {
  while (below != above && domains_[below].above != LaneDomain::kNone)
    below = domains_[below].above;
  const LaneDomain &a = domains_[above], &b = domains_[below];
  if (above == below) return true;
  if (a.above != LaneDomain::kNone) return false;
  return (a.chosen == 0 || a.chosen == b.chosen) && (b.joined & ~a.joined) == 0;
}

DomainId ValueGraph::join(DomainId a, DomainId b) {
  if (is_above(a, b)) return b;
  if (is_above(b, a)) return a;
  if (domains_[a].above != LaneDomain::kNone || domains_[b].above != LaneDomain::kNone) {
    throw LanesDiffer{};
  }
  return rows(domains_[a].joined & domains_[b].joined);
}

// ---- instructions -------------------------------------------------------------------------------

ValueId ValueGraph::intern(const ValueInstruction& key, DomainId domain) {
  const auto [entry, added] = known_.emplace(key, static_cast<ValueId>(code_.size()));
  if (added) {
    code_.push_back(key);
    code_.back().domain = domain;
  }
  return entry->second;
}

ValueId ValueGraph::add(ValueInstruction instruction) {
  DomainId joint = whole();
  for (const ValueId arg : instruction.args) {
    if (arg != LaneDomain::kNone) joint = join(joint, domain(arg));
  }
  for (ValueId& arg : instruction.args) {
    if (arg != LaneDomain::kNone) arg = spread(arg, joint);
  }
  if (instruction.op == ValueOp::Node) joint = instruction.domain;
  instruction.domain = joint;
  return intern(instruction, joint);
}

ValueId ValueGraph::open(ValueInstruction instruction, DomainId above) {
  for (ValueId& arg : instruction.args) {
    if (arg != LaneDomain::kNone && instruction.op != ValueOp::Quotient) arg = spread(arg, above);
  }
  instruction.domain = above;
  const auto members = static_cast<DomainId>(domains_.size());
  const ValueId id = intern(instruction, members);
  if (domain(id) == members) domains_.push_back({.above = above, .opened_by = id});
  return id;
}

ValueId ValueGraph::fold(ValueInstruction instruction, DomainId members) {
  instruction.number = static_cast<std::int32_t>(members);
  for (ValueId& arg : instruction.args) {
    const bool choice = (instruction.op == ValueOp::Pick || instruction.op == ValueOp::PickDart) &&
                        &arg == instruction.args.data();
    if (arg != LaneDomain::kNone && !choice) arg = spread(arg, members);
  }
  instruction.domain = above(members);
  return intern(instruction, instruction.domain);
}

ValueId ValueGraph::constant(std::span<const double> components) {
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  auto at =
      std::search(constants_.begin(), constants_.end(), components.begin(), components.end(), same);
  const auto begin = static_cast<std::int32_t>(at - constants_.begin());
  if (at == constants_.end()) {
    constants_.insert(constants_.end(), components.begin(), components.end());
  }
  ValueInstruction load{.op = ValueOp::Constant};
  load.count = static_cast<std::uint32_t>(components.size());
  load.number = begin;
  return add(load);
}

std::optional<double> ValueGraph::known_number(ValueId value) const {
  const ValueInstruction& by = code_[value];
  if (by.op != ValueOp::Constant || by.count != 1) return std::nullopt;
  return constants_[static_cast<std::size_t>(by.number)];
}

ValueId ValueGraph::spread(ValueId value, DomainId to) {
  const DomainId from = domain(value);
  if (from == to) return value;
  if (!is_above(from, to)) throw LanesDiffer{};
  const DomainId next = domains_[to].above;
  if (next != LaneDomain::kNone) value = spread(value, next);
  const bool dart = makes_dart(code_[value].op);
  ValueInstruction instruction{.op = dart ? ValueOp::SpreadDart : ValueOp::Spread};
  instruction.count = code_[value].count;
  instruction.args[0] = value;
  instruction.domain = to;
  return intern(instruction, to);
}

ValueId ValueGraph::any_dart_of(OrbitType orbit, ValueId dart) {
  while (true) {
    const ValueInstruction& by = code_[dart];
    switch (by.op) {
      case ValueOp::Alpha:
        if (!orbit.contains(by.number)) return dart;
        dart = by.args[0];
        break;
      case ValueOp::Smallest:
      case ValueOp::Members:
        if (!orbit.contains(by.orbit)) return dart;
        dart = by.args[0];
        break;
      case ValueOp::Quotient:  // of members
        if (!orbit.contains(by.orbit)) return dart;
        dart = code_[by.args[0]].args[0];
        break;
      case ValueOp::Polygon:
        if (!orbit.contains(OrbitType{0, 1})) return dart;
        dart = by.args[0];
        break;
      case ValueOp::SpreadDart:
        dart = by.args[0];
        break;
      case ValueOp::Node: {
        ValueInstruction node = by;
        std::uint8_t joined = domains_[node.domain].joined;
        const auto& label = match_.nodes[static_cast<std::size_t>(node.number)].label;
        for (std::size_t p = 0; p < label.size(); ++p) {
          const bool inside = label[p] != kNoEntry && orbit.contains(label[p]);
          joined = static_cast<std::uint8_t>(joined | (inside ? 1u << p : 0u));
        }
        node.domain = rows(joined);
        return intern(node, node.domain);
      }
      default:
        return dart;
    }
  }
}

// ---- the program --------------------------------------------------------------------------------

ValueProgram ValueGraph::finish(std::vector<ValueProgram::Output> outputs) {
  std::vector<bool> needed(code_.size(), false);
  const auto need_domain = [&](DomainId id) {
    for (; domains_[id].above != LaneDomain::kNone; id = domains_[id].above) {
      needed[domains_[id].opened_by] = true;
    }
  };
  for (const ValueProgram::Output& output : outputs) needed[output.value] = true;
  for (ValueId id = static_cast<ValueId>(code_.size()); id-- > 0;) {
    if (!needed[id]) continue;
    need_domain(code_[id].domain);
    for (const ValueId arg : code_[id].args) {
      if (arg == LaneDomain::kNone) continue;
      needed[arg] = true;
      need_domain(code_[arg].domain);
    }
    if (code_[id].op == ValueOp::Count) {
      need_domain(static_cast<DomainId>(code_[id].number));
    }
  }
  ValueProgram program;
  std::vector<ValueId> place(code_.size(), LaneDomain::kNone);
  for (ValueId id = 0; id < code_.size(); ++id) {
    if (!needed[id]) continue;
    place[id] = static_cast<ValueId>(program.code.size());
    ValueInstruction& instruction = program.code.emplace_back(code_[id]);
    for (ValueId& arg : instruction.args) {
      if (arg != LaneDomain::kNone) arg = place[arg];
    }
  }
  for (ValueProgram::Output& output : outputs) output.value = place[output.value];
  program.outputs = std::move(outputs);
  program.domains = domains_;
  for (LaneDomain& domain : program.domains) {
    if (domain.opened_by != LaneDomain::kNone) domain.opened_by = place[domain.opened_by];
  }
  program.constants = std::move(constants_);
  return program;
}

}  // namespace gmsim::compile
