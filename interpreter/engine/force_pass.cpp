// SPDX-License-Identifier: MIT
#include "engine/force_pass.h"

#include <algorithm>
#include <utility>

namespace gmsim::engine {

namespace {

constexpr Row kVerticesPerTask = 1024;
// So many changes, and a share of all rows, until everything is laid out anew.
constexpr std::uint32_t kFewChanges = 256;
constexpr std::uint32_t kShareOfChanges = 4;

std::uint32_t pieces_of(std::uint32_t rows, std::uint32_t size) { return (rows + size - 1) / size; }

}  // namespace

SignedSlot ForcePass::Block::slot(std::uint32_t force, std::uint32_t row) const {
  const auto [output, negative] = kernel->root(force);
  if (row < laid_out)
    return signed_slot(first_slots[row / kPiece] + output * kPiece + row % kPiece, negative);
  const std::uint32_t late = row - laid_out;
  return signed_slot(late_slots[late / kLatePiece] + output * kLatePiece + late % kLatePiece,
                     negative);
}

// ---- layout -------------------------------------------------------------------------------------

void ForcePass::lay_out(Row vertices, std::uint32_t chunks) {
  blocks_.clear();
  first_block_.clear();
  std::uint32_t rows = 0;
  for (const auto& of : tables_) {
    first_block_.push_back(blocks_.size());
    for (std::uint32_t shape = 0; shape < of->shape_count(); ++shape) add_block(*of, shape);
  }
  for (const Block& block : blocks_) rows += block.laid_out;
  schedule_ = plan_schedule(pieces(), vertices, chunks, kind_ == Forces::Kept);
  for (const ForcePiece& piece : schedule_.pieces)
    blocks_[piece.block].first_slots[piece.begin / kPiece] = piece.first_slot;
  forces_.resize(schedule_.slots);
  make_sums(vertices);
  last_.clear();
  plan_last_sums(schedule_.last);
  laid_out_ = vertices;
  leaders_.clear();
  followers_.clear();
  planned_ = 0;
  late_.clear();
  late_stale_ = crowded_ = followed_ = false;
  changes_ = 0;
  room_ = rows / kShareOfChanges + kFewChanges;
}

void ForcePass::add_block(InteractionTables& of, std::uint32_t shape) {
  const bool merged = merges(of, shape);
  const MatchTable& table = merged ? of.merged(shape)->table() : of.table(shape);
  Block block;
  block.of = &of;
  block.shape = shape;
  block.merged = merged;
  block.table = &table;
  block.kernel = merged ? &of.merged(shape)->kernel() : &of.kernels(shape).force();
  block.laid_out = table.size();
  for (std::uint32_t force = 0; force < of.shape(shape).forces.size(); ++force)
    block.roles.push_back(merged ? force : of.shape(shape).forces[force].role);
  block.outputs = static_cast<std::uint32_t>(block.kernel->kernel().outputs.size());
  block.first_slots.resize(pieces_of(table.size(), kPiece));
  blocks_.push_back(std::move(block));
}

std::vector<ForcePiece> ForcePass::pieces() const {
  std::vector<ForcePiece> result;
  for (std::uint32_t number = 0; number < blocks_.size(); ++number) {
    const Block& block = blocks_[number];
    for (std::uint32_t begin = 0; begin < block.laid_out; begin += kPiece) {
      ForcePiece piece{.block = number, .begin = begin,
                       .end = std::min(block.laid_out, begin + kPiece),
                       .slots = block.outputs * kPiece, .pushed = {}, .first_slot = 0,
                       .complete = {}};
      bool any = false;
      for (const std::uint32_t role : block.roles) {
        const Row* const rows = block.table->rows(role).data();
        const auto [low, high] = std::minmax_element(rows + piece.begin, rows + piece.end);
        piece.pushed = any ? RowRange{std::min(piece.pushed.begin, *low),
                                      std::max(piece.pushed.end, *high + 1)}
                           : RowRange{*low, *high + 1};
        any = true;
      }
      result.push_back(piece);
    }
  }
  return result;
}

/// Blocks of one interaction hold different keys; their matches are visited in one order.
template <typename Visit>
void ForcePass::each_term(const Visit& visit) const {
  struct Entry {
    DartId key;
    const Block* block;
    std::uint32_t row;
  };
  std::vector<Entry> entries;
  for (std::size_t first = 0, last = 0; first < blocks_.size(); first = last) {
    entries.clear();
    for (; last < blocks_.size() && blocks_[last].of == blocks_[first].of; ++last)
      for (std::uint32_t row = 0; row < blocks_[last].table->size(); ++row)
        if (!blocks_[last].table->vacant(row))
          entries.push_back({blocks_[last].table->key(row), &blocks_[last], row});
    const auto before = [](const Entry& a, const Entry& b) { return a.key < b.key; };
    if (!std::is_sorted(entries.begin(), entries.end(), before))
      std::sort(entries.begin(), entries.end(), before);
    for (const auto& [key, block, row] : entries)
      for (std::uint32_t force = 0; force < block->roles.size(); ++force)
        visit(ForceSums::Term{block->vertex(force, row), block->order(force, row),
                              block->slot(force, row)});
  }
}

void ForcePass::make_sums(Row vertices) {
  const auto load = std::find_if(tables_.begin(), tables_.end(),
                                 [](const auto& of) { return of->body().external; });
  sums_.loads_from(force_order(static_cast<std::uint32_t>(load - tables_.begin()), DartId{0}, 0));
  sums_.rebuild(vertices, [&](const auto& visit) { each_term(visit); });
}

void ForcePass::plan_last_sums(std::span<const RowRange> ranges) {
  for (const RowRange rows : ranges)
    for (Row begin = rows.begin; begin < rows.end; begin += kVerticesPerTask)
      last_.push_back({begin, std::min(rows.end, begin + kVerticesPerTask)});
}

// ---- vertices that came later -------------------------------------------------------------------

void ForcePass::grow(Row vertices) {
  if (vertices <= sums_.vertices()) return;
  sums_.grow(vertices);
  leaders_.resize(vertices - laid_out_, gmap::kNoRow);
}

bool ForcePass::summed_last(Row vertex) const {
  return std::any_of(schedule_.last.begin(), schedule_.last.end(), [&](const RowRange& rows) {
    return rows.begin <= vertex && vertex < rows.end;
  });
}

void ForcePass::plan_new_vertices() {
  const auto before = static_cast<std::ptrdiff_t>(followers_.size());
  std::vector<RowRange> last;
  for (; planned_ < leaders_.size(); ++planned_) {
    const Row vertex = laid_out_ + static_cast<Row>(planned_), leader = leaders_[planned_];
    if (leader != gmap::kNoRow && !summed_last(leader)) {
      followers_.push_back({leader, vertex});
    } else if (!last.empty() && last.back().end == vertex) {
      ++last.back().end;
    } else {
      last.push_back({vertex, vertex + 1});
    }
  }
  plan_last_sums(last);
  std::sort(followers_.begin() + before, followers_.end());
  std::inplace_merge(followers_.begin(), followers_.begin() + before, followers_.end());
}

void ForcePass::sum_followers(RowRange leaders, const ForceSums::Totals& out) const {
  auto next = std::lower_bound(followers_.begin(), followers_.end(), Follower{leaders.begin, 0});
  for (; next != followers_.end() && next->leader < leaders.end; ++next)
    sums_.sum(forces_.data(), next->vertex, next->vertex + 1, out);
}

// ---- single rows --------------------------------------------------------------------------------

void ForcePass::link(const InteractionTables& of, std::uint32_t shape, std::uint32_t row) {
  Block& block = blocks_[block_of(of, shape)];
  const std::uint32_t late = row - block.laid_out;
  while (late / kLatePiece >= block.late_slots.size()) {
    block.late_slots.push_back(static_cast<std::uint32_t>(forces_.size()));
    forces_.resize(forces_.size() + std::size_t{block.outputs} * kLatePiece);
  }
  for (std::uint32_t force = 0; force < block.roles.size(); ++force) {
    sums_.insert({block.vertex(force, row), block.order(force, row), block.slot(force, row)});
    relisted_.push_back(block.vertex(force, row));
  }
  linked_.push_back({static_cast<std::uint32_t>(block_of(of, shape)), row});
  late_stale_ = true;
  crowded_ = crowded_ || ++changes_ > room_;
}

void ForcePass::unlink(const InteractionTables& of, std::uint32_t shape, std::uint32_t row) {
  const Block& block = blocks_[block_of(of, shape)];
  for (std::uint32_t force = 0; force < block.roles.size(); ++force) {
    sums_.erase(block.vertex(force, row), block.order(force, row));
    relisted_.push_back(block.vertex(force, row));
  }
  crowded_ = crowded_ || ++changes_ > room_;
}

bool ForcePass::can_move(const InteractionTables& of, std::uint32_t shape, std::uint32_t row,
                         Row from, Row to) const {
  if (row >= blocks_[block_of(of, shape)].laid_out) return true;  // has a slot of its own
  if (to < laid_out_) return to == leader(from);
  const Row there = leader(to);
  return there == gmap::kNoRow ? to - laid_out_ >= planned_ : there == leader(from);
}

void ForcePass::move(const InteractionTables& of, std::uint32_t shape, std::uint32_t row,
                     std::uint32_t role, Row from, Row to) {
  const Block& block = blocks_[block_of(of, shape)];
  const auto force = std::find(block.roles.begin(), block.roles.end(), role);
  if (force == block.roles.end()) return;  // is only read
  if (row < block.laid_out && to >= laid_out_) leaders_[to - laid_out_] = leader(from);
  sums_.move(from, to,
             block.order(static_cast<std::uint32_t>(force - block.roles.begin()), row));
  relisted_.insert(relisted_.end(), {from, to});
  crowded_ = crowded_ || ++changes_ > room_;
}

void ForcePass::rerun(const InteractionTables& of, std::uint32_t shape, std::uint32_t row) {
  const auto number = static_cast<std::uint32_t>(block_of(of, shape));
  for (std::uint32_t force = 0; force < blocks_[number].roles.size(); ++force)
    relisted_.push_back(blocks_[number].vertex(force, row));
  linked_.push_back({number, row});
}

void ForcePass::make_late_pieces() {
  late_.clear();
  for (std::uint32_t number = 0; number < blocks_.size(); ++number) {
    const Block& block = blocks_[number];
    const std::uint32_t end = block.table->size();
    for (std::uint32_t begin = block.laid_out; begin < end; begin += kLatePiece)
      late_.push_back({.block = number, .begin = begin, .end = std::min(end, begin + kLatePiece),
                       .slots = 0, .pushed = {},
                       .first_slot = block.late_slots[(begin - block.laid_out) / kLatePiece],
                       .complete = {}});
  }
  late_stale_ = false;
}

// ---- running ------------------------------------------------------------------------------------

void ForcePass::bind(PassKernels kernels, const ForceMoment& moment,
                     const gmap::EmbeddingStore& store) {
  for (Block& block : blocks_) {
    const bool products = kernels == PassKernels::Products;
    if (products && block.product == nullptr)
      block.product = block.merged ? &block.of->merged(block.shape)->product()
                                   : &block.of->kernels(block.shape).product();
    const ForceKernel* const before = std::exchange(block.running, products ? block.product : block.kernel);
    if (before == block.running && !unbound_)
      block.running->bind_again(*block.table, store, moment, block.inputs);
    else
      block.running->bind(*block.table, store, moment, block.inputs);
  }
  unbound_ = false;
}

bool ForcePass::run_piece(const ForcePiece& piece, std::uint32_t number,
                          ForceWorkers::Space& space) {
  const Block& block = blocks_[piece.block];
  const std::uint32_t columns = piece.begin < block.laid_out ? kPiece : kLatePiece;
  space.outputs.clear();
  for (std::uint32_t output = 0; output < block.outputs; ++output) {
    // Outputs are addressed from match 0 on; only those of this piece are written.
    double* const first = &forces_[piece.first_slot + output * columns].x;
    space.outputs.push_back({first - std::ptrdiff_t{kRecord} * piece.begin, kRecord});
  }
  const auto row = block.running->run(*block.table, block.inputs, space.outputs, piece.begin,
                                      piece.end, space.scratch);
  if (row && number < space.failed.piece) space.failed = {number, piece.block, *row};
  return !row;
}

void ForcePass::run_chunk(const ForceChunk& chunk, ForceWorkers::Space& space,
                          const ForceSums::Totals& out) {
  const auto late = static_cast<std::uint32_t>(late_.size());
  for (std::uint32_t p = chunk.begin; p < chunk.end; ++p) {
    const ForcePiece& piece = schedule_.pieces[p];
    if (!run_piece(piece, late + p, space)) return;
    sums_.sum(forces_.data(), piece.complete.begin, piece.complete.end, out);
    if (!followers_.empty()) sum_followers(piece.complete, out);
  }
}

std::optional<ForcePass::Failure> ForcePass::run(PassKernels kernels, const ForceMoment& moment,
                                                 const gmap::EmbeddingStore& store,
                                                 ForceWorkers& workers, bool alone,
                                                 const ForceSums::Totals& out) {
  for (ForceWorkers::Space& space : workers.spaces) space.failed = {};
  if (late_stale_) make_late_pieces();
  if (planned_ < leaders_.size()) plan_new_vertices();
  followed_ = kernels == PassKernels::Forces;
  linked_.clear();
  relisted_.clear();
  bind(kernels, moment, store);
  const auto share = [&](std::size_t tasks, const auto& work) {
    workers.threads.run(static_cast<std::uint32_t>(tasks), alone, work);
  };
  share(late_.size(), [&](std::uint32_t p, unsigned worker) {
    run_piece(late_[p], p, workers.spaces[worker]);
  });
  share(schedule_.chunks.size(), [&](std::uint32_t c, unsigned worker) {
    run_chunk(schedule_.chunks[c], workers.spaces[worker], out);
  });
  share(last_.size(), [&](std::uint32_t k, unsigned) {
    sums_.sum(forces_.data(), last_[k].begin, last_[k].end, out);
  });
  return first_failure(workers);
}

std::optional<ForcePass::Failure> ForcePass::first_failure(const ForceWorkers& workers) const {
  FailedMatch first;
  for (const ForceWorkers::Space& space : workers.spaces)
    if (space.failed.piece < first.piece) first = space.failed;
  if (first.piece == FailedMatch{}.piece) return std::nullopt;
  const Block& block = blocks_[first.block];
  return Failure{block.of, block.shape, first.row, block.merged};
}

}  // namespace gmsim::engine
