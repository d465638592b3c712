// SPDX-License-Identifier: MIT
#include "engine/force_merge.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "engine/force_linear.h"

namespace gmsim::engine {

namespace ir = compile::ir;
using Kind = InputOrigin::Kind;

namespace {

constexpr std::size_t kMostColumns = 8;  // sets of summed columns are tried one by one

bool moves(Kind kind) { return kind == Kind::Position || kind == Kind::Velocity; }

bool between(const ForceProgram& program, const std::array<std::uint32_t, 2>& ends) {
  return std::all_of(program.inputs.begin(), program.inputs.end(), [&](const auto& input) {
    return !moves(input.origin.kind) || input.origin.role == ends[0] || input.origin.role == ends[1];
  });
}

/// The inputs of a graph with the two ends exchanged.
std::vector<std::uint32_t> partners(const ForceProgram& program) {
  std::vector<std::uint32_t> partner(program.graph.inputs().size());
  for (std::uint32_t i = 0; i < partner.size(); ++i) partner[i] = i;
  for (const auto& a : program.inputs)
    for (const auto& b : program.inputs)
      if (moves(a.origin.kind) && a.origin.kind == b.origin.kind && a.origin.role != b.origin.role)
        partner[a.number] = b.number;
  for (const auto& input : program.inputs)  // a vertex of which only one end is read
    if (moves(input.origin.kind) && partner[input.number] == input.number)
      partner[input.number] = static_cast<std::uint32_t>(partner.size());
  return partner;
}

bool has_column(const InputOrigin& origin) {
  return origin.kind == Kind::Column || origin.kind == Kind::Own;
}

/// The largest set of number columns in which all forces are linear; by number of the input.
std::vector<bool> summed_inputs(const ForceProgram& program) {
  std::vector<std::uint32_t> columns;
  for (const auto& input : program.inputs)
    if (has_column(input.origin) && input.origin.width == 1) columns.push_back(input.number);
  std::vector<bool> best(program.graph.inputs().size(), false);
  if (columns.size() > kMostColumns) return best;
  int most = 0;
  for (std::uint32_t set = 1; set < (1u << columns.size()); ++set) {
    if (std::popcount(set) <= most) continue;
    std::vector<bool> summed(best.size(), false);
    for (std::size_t k = 0; k < columns.size(); ++k) summed[columns[k]] = (set >> k & 1u) != 0;
    if (!linear_in(program.graph, program.roots, summed)) continue;
    best = std::move(summed);
    most = std::popcount(set);
  }
  return best;
}

/// Multiplies the forces by the number of matches, an input of its own.
void count_matches(MergePlan& plan, std::uint32_t offset) {
  ir::Graph& graph = plan.program.graph;
  const ir::Input count{.source = ir::Input::Source::MatchValue, .role = 0xfffffffeu};
  const ir::NodeId factor = graph.input(count, types::ValueKind::Real);
  for (ir::NodeId& root : plan.program.roots) root = graph.make(ir::Op::Scale, factor, root);
  const auto number = static_cast<std::uint32_t>(graph.inputs().size()) - 1;
  plan.program.inputs.push_back({number, {.kind = Kind::Own, .offset = offset}});
}

}  // namespace

std::optional<MergePlan> plan_merge(const compile::Shape& shape, const ForceProgram& program) {
  if (shape.forces.size() != 2) return std::nullopt;
  MergePlan plan;
  plan.ends = {shape.forces[0].role, shape.forces[1].role};
  if (!between(program, plan.ends)) return std::nullopt;
  const std::vector<std::uint32_t> partner = partners(program);
  plan.symmetric =
      equal_when_exchanged(program.graph, program.roots[0], program.roots[1], partner) &&
      equal_when_exchanged(program.graph, program.roots[1], program.roots[0], partner);
  const std::vector<bool> summed = summed_inputs(program);
  plan.counted = std::find(summed.begin(), summed.end(), true) == summed.end();
  plan.program = program;
  std::uint32_t offset = 0;
  for (auto& [number, origin] : plan.program.inputs) {
    if (has_column(origin)) {
      plan.columns.push_back({origin, summed[number]});
      const std::uint32_t width = origin.width;
      origin = {.kind = Kind::Own, .offset = offset, .width = width};
      offset += width;
    } else if (moves(origin.kind)) {
      origin.role = origin.role == plan.ends[0] ? 0 : 1;
    }
  }
  if (plan.counted) count_matches(plan, offset);
  return plan;
}

// ---- the table ----------------------------------------------------------------------------------

namespace {

MatchTable::Widths widths_of(const MergePlan& plan) {
  MatchTable::Widths widths{.roles = 2, .nodes = 0, .targets = 0, .own = {}};
  for (const MergePlan::Column& column : plan.columns) widths.own.push_back(column.origin.width);
  if (plan.counted) widths.own.push_back(1);
  return widths;
}

}  // namespace

MergedTable::MergedTable(MergePlan plan)
    : plan_(std::move(plan)), table_(widths_of(plan_)), kernel_(plan_.program) {
  for (const MergePlan::Column& column : plan_.columns) value_count_ += column.origin.width;
}

const ForceKernel& MergedTable::product() {
  if (!product_) product_ = std::make_unique<ForceKernel>(product_program(plan_.program));
  return *product_;
}

void MergedTable::read_values(const MatchTable& atomic, const gmap::EmbeddingStore& store,
                              std::uint32_t row) {
  for (const auto& [origin, summed] : plan_.columns) {
    const double* begin = nullptr;
    if (origin.kind == Kind::Column) {
      begin = store.column(origin.embedding).get(atomic.rows(origin.role)[row]).data() + origin.offset;
    } else {
      const MatchTable::OwnColumn own = atomic.own(origin.offset);
      begin = own.begin + std::size_t{own.stride} * row;
    }
    values_.insert(values_.end(), begin, begin + origin.width);
  }
}

/// May two matches be in one group? Parameters that are not summed have to agree to the last bit.
bool MergedTable::together(const Candidate& a, const Candidate& b) const {
  const bool straight = a.ends == b.ends;
  const bool turned = a.ends[0] == b.ends[1] && a.ends[1] == b.ends[0];
  if (!straight && !(turned && plan_.symmetric)) return false;
  std::uint32_t k = 0;
  for (const auto& [origin, summed] : plan_.columns) {
    const std::size_t bytes = sizeof(double) * origin.width;
    if (!summed && std::memcmp(&values_[a.values + k], &values_[b.values + k], bytes) != 0) return false;
    k += origin.width;
  }
  return true;
}

/// By vertices, then by parameters that are not summed, then by key: groups stand together.
bool MergedTable::before(const Candidate& a, const Candidate& b) const {
  const auto pair = [&](const Candidate& c) {
    const bool turn = plan_.symmetric && c.ends[1] < c.ends[0];
    return turn ? std::array{c.ends[1], c.ends[0]} : c.ends;
  };
  if (pair(a) != pair(b)) return pair(a) < pair(b);
  std::uint32_t k = 0;
  for (const auto& [origin, summed] : plan_.columns) {
    const int order =
        summed ? 0
               : std::memcmp(&values_[a.values + k], &values_[b.values + k],
                             sizeof(double) * origin.width);
    if (order != 0) return order < 0;
    k += origin.width;
  }
  return a.key < b.key;
}

void MergedTable::add_group(std::span<const Candidate> group) {
  sums_.assign(values_.begin() + group.front().values,
               values_.begin() + group.front().values + value_count_);
  for (const Candidate& other : group.subspan(1)) {
    std::uint32_t k = 0;
    for (const auto& [origin, summed] : plan_.columns) {
      if (summed) sums_[k] += values_[other.values + k];
      k += origin.width;
    }
  }
  if (plan_.counted) sums_.push_back(static_cast<double>(group.size()));
  remember(group, table_.add(group.front().key, group.front().ends, sums_));
}

void MergedTable::rebuild(const MatchTable& atomic, const gmap::EmbeddingStore& store) {
  table_.clear();
  by_key_.clear();
  std::vector<std::uint32_t> rows;
  for (std::uint32_t row = 0; row < atomic.size(); ++row)
    if (!atomic.vacant(row)) rows.push_back(row);
  group(atomic, store, rows);
}

void MergedTable::group(const MatchTable& atomic, const gmap::EmbeddingStore& store,
                        std::span<const std::uint32_t> rows) {
  values_.clear();
  std::vector<Candidate> candidates;
  for (const std::uint32_t row : rows) {
    candidates.push_back({atomic.key(row),
                          {atomic.rows(plan_.ends[0])[row], atomic.rows(plan_.ends[1])[row]},
                          static_cast<std::uint32_t>(values_.size())});
    read_values(atomic, store, row);
  }
  std::sort(candidates.begin(), candidates.end(),
            [&](const Candidate& a, const Candidate& b) { return before(a, b); });
  std::vector<std::span<const Candidate>> groups;
  for (std::size_t first = 0, last = 0; first < candidates.size(); first = last) {
    while (last < candidates.size() && together(candidates[first], candidates[last])) ++last;
    groups.push_back(std::span(candidates).subspan(first, last - first));
  }
  // Rows in the order of keys, as in the table of the matches: neighbours in the mesh stay close.
  std::sort(groups.begin(), groups.end(),
            [](const auto& a, const auto& b) { return a.front().key < b.front().key; });
  for (const auto& members : groups) add_group(members);
}

// ---- who is in which group ----------------------------------------------------------------------

void MergedTable::remember(std::span<const Candidate> group, std::uint32_t row) {
  for (std::size_t k = 0; k < group.size(); ++k) {
    const std::size_t key = types::index(group[k].key);
    if (by_key_.size() <= key) by_key_.resize(key + key / 2 + 1);
    by_key_[key] = {group.front().key, k + 1 < group.size() ? group[k + 1].key : gmap::kNoDart, row};
  }
}

std::uint32_t MergedTable::group_of(DartId key) const {
  if (types::index(key) >= by_key_.size()) return gmap::kNoRow;
  const DartId head = by_key_[types::index(key)].head;
  return head == gmap::kNoDart ? gmap::kNoRow : by_key_[types::index(head)].row;
}

void MergedTable::members(std::uint32_t row, std::vector<DartId>& keys) const {
  for (DartId key = table_.key(row); key != gmap::kNoDart; key = by_key_[types::index(key)].next)
    keys.push_back(key);
}

MergedTable::Share MergedTable::share(std::uint32_t row, std::uint32_t force,
                                      const std::array<Row, 2>& ends) const {
  const MatchTable::OwnColumn count = table_.own(value_count_);
  const bool straight = ends[0] == table_.rows(0)[row];
  return {straight ? force : 1 - force, 1 / count.begin[std::size_t{count.stride} * row]};
}

void MergedTable::remove(std::uint32_t row) {
  for (DartId key = table_.key(row); key != gmap::kNoDart;)
    key = std::exchange(by_key_[types::index(key)], Member{}).next;
  table_.vacate(row);
}

}  // namespace gmsim::engine
