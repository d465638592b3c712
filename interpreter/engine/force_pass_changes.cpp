// SPDX-License-Identifier: MIT
// ForcePass: the forces where matches came and went since the last run.
#include <algorithm>
#include <utility>

#include "engine/force_pass.h"
#include "support/sort_once.h"

namespace gmsim::engine {

namespace {

/// visit(first, count) of each run of rows that follow each other in one block and, as `piece` tells
/// them apart, in one piece.
template <typename RowAt, typename Piece, typename Visit>
void each_run(const std::vector<RowAt>& rows, const Piece& piece, const Visit& visit) {
  for (std::size_t i = 0, j = 0; i < rows.size(); i = j) {
    for (j = i + 1; j < rows.size() && rows[j].block == rows[i].block &&
                    rows[j].row == rows[j - 1].row + 1 && piece(rows[j]) == piece(rows[i]);)
      ++j;
    visit(rows[i], static_cast<std::uint32_t>(j - i));
  }
}

}  // namespace

std::optional<ForcePass::Failure> ForcePass::run_changes(const ForceMoment& moment,
                                                         const gmap::EmbeddingStore& store,
                                                         ForceWorkers& workers,
                                                         const ForceSums::Totals& out) {
  if (!followed_) return run(PassKernels::Forces, moment, store, workers, true, out);
  for (ForceWorkers::Space& space : workers.spaces) space.failed = {};
  bind(PassKernels::Forces, moment, store);
  std::erase_if(linked_, [&](const RowAt& at) { return blocks_[at.block].table->vacant(at.row); });
  support::sort_once(linked_);
  support::sort_once(relisted_);
  ForceWorkers::Space& space = workers.spaces[0];
  if (kind_ == Forces::Summed) {
    sum_from_scratch(space, out);
  } else if (run_linked(space)) {
    for (const Row vertex : relisted_) sums_.sum(forces_.data(), vertex, vertex + 1, out);
  }
  linked_.clear();
  relisted_.clear();
  return first_failure(workers);
}

/// Of the row's first output.
std::uint32_t ForcePass::first_slot(const RowAt& at) const {
  const Block& block = blocks_[at.block];
  if (at.row < block.laid_out) return block.first_slots[at.row / kPiece] + at.row % kPiece;
  const std::uint32_t late = at.row - block.laid_out;
  return block.late_slots[late / kLatePiece] + late % kLatePiece;
}

/// All forces stay in their slots, so only those of new matches and of such that read something else
/// are missing.
bool ForcePass::run_linked(ForceWorkers::Space& space) {
  bool good = true;
  std::uint32_t number = 0;
  const auto piece_of = [&](const RowAt& at) {
    const std::uint32_t laid_out = blocks_[at.block].laid_out;
    return at.row < laid_out ? std::pair(false, at.row / kPiece)
                             : std::pair(true, (at.row - laid_out) / kLatePiece);
  };
  each_run(linked_, piece_of, [&](const RowAt& at, std::uint32_t count) {
    const ForcePiece piece{.block = at.block, .begin = at.row, .end = at.row + count, .slots = 0,
                           .pushed = {}, .first_slot = first_slot(at), .complete = {}};
    good = run_piece(piece, number++, space) && good;
  });
  return good;
}

ForcePass::RowAt ForcePass::row_of(ForceOrder order) const {
  const InteractionTables& of = *tables_[interaction_of(order)];
  const InteractionTables::Place place = of.place(key_of(order));
  const auto block = static_cast<std::uint32_t>(block_of(of, place.shape));
  if (!merges(of, place.shape)) return {block, place.row};
  return {block, of.merged(place.shape)->group_of(key_of(order))};
}

/// Slots are used several times within a run, so every force on the vertices is computed again.
void ForcePass::sum_from_scratch(ForceWorkers::Space& space, const ForceSums::Totals& out) {
  std::vector<RowAt> rows;
  for (const Row vertex : relisted_)
    for (const ForceOrder order : sums_.orders(vertex)) rows.push_back(row_of(order));
  support::sort_once(rows);
  std::vector<std::uint32_t> first_slots;  // parallel to rows
  std::vector<std::uint32_t> strides;      // between the outputs of a row
  std::vector<VertexRecord> forces;
  std::uint32_t number = 0;
  const auto run = [&](const RowAt& at, std::uint32_t count) {
    const Block& block = blocks_[at.block];
    const auto begin = static_cast<std::uint32_t>(forces.size());
    forces.resize(forces.size() + std::size_t{block.outputs} * count);
    space.outputs.clear();
    for (std::uint32_t output = 0; output < block.outputs; ++output)
      space.outputs.push_back({&forces[begin + output * count].x - std::ptrdiff_t{kRecord} * at.row,
                               kRecord});
    const auto failed = block.running->run(*block.table, block.inputs, space.outputs, at.row,
                                           at.row + count, space.scratch);
    if (failed && number < space.failed.piece) space.failed = {number, at.block, *failed};
    ++number;
    for (std::uint32_t k = 0; k < count; ++k) {
      first_slots.push_back(begin + k);
      strides.push_back(count);
    }
  };
  each_run(rows, [](const RowAt& at) { return at.row / kPiece; }, run);
  if (space.failed.piece != FailedMatch{}.piece) return;
  std::vector<SignedSlot> slots;
  for (const Row vertex : relisted_) {
    slots.clear();
    for (const ForceOrder order : sums_.orders(vertex)) {
      const RowAt at = row_of(order);
      const auto k = static_cast<std::size_t>(std::lower_bound(rows.begin(), rows.end(), at) -
                                              rows.begin());
      const auto [output, negative] = blocks_[at.block].kernel->root(force_of(order));
      slots.push_back(signed_slot(first_slots[k] + output * strides[k], negative));
    }
    sums_.sum(forces.data(), vertex, slots, out);
  }
}

}  // namespace gmsim::engine
