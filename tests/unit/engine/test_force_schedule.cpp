// SPDX-License-Identifier: MIT
// The schedule of forces: whatever the pieces, every vertex is summed once, after all of its forces
// were computed and before one of their slots is used again.
#include <doctest/doctest.h>

#include <random>
#include <set>

#include "engine/force_schedule.h"

using namespace gmsim;
using engine::ForcePiece;
using engine::RowRange;

namespace {

std::uint32_t below(std::mt19937& random, std::uint32_t end) {
  return static_cast<std::uint32_t>(random() % end);
}

/// Pieces that push vertices near a place that moves on, or anywhere when `scattered`.
std::vector<ForcePiece> random_pieces(std::mt19937& random, gmap::Row vertices, bool scattered) {
  std::vector<ForcePiece> pieces(below(random, 60));
  std::uint32_t k = 0;
  for (ForcePiece& piece : pieces) {
    const auto near = static_cast<gmap::Row>(std::uint64_t{vertices} * k++ / pieces.size());
    const gmap::Row begin = scattered ? below(random, vertices) : near;
    const gmap::Row end = std::min<gmap::Row>(vertices, begin + 1 + below(random, 200));
    piece = {.block = k, .begin = 0, .end = 1, .slots = 1 + below(random, 3) * 8,
             .pushed = {begin, end}, .first_slot = 0, .complete = {}};
  }
  return pieces;
}

/// Runs a schedule, a piece for a force: which pieces' forces each vertex gets.
class Rehearsal {
 public:
  Rehearsal(const engine::ForceSchedule& schedule, gmap::Row vertices)
      : owner_(schedule.slots, 0), sums_(vertices, 0) {
    for (const engine::ForceChunk& chunk : schedule.chunks)
      for (std::uint32_t p = chunk.begin; p < chunk.end; ++p) run(schedule, p);
    for (const RowRange rows : schedule.last) sum(schedule, rows);
  }
  [[nodiscard]] const std::vector<int>& sums() const { return sums_; }

 private:
  void run(const engine::ForceSchedule& schedule, std::uint32_t p) {
    const ForcePiece& piece = schedule.pieces[p];
    for (std::uint32_t s = 0; s < piece.slots; ++s) {
      REQUIRE(piece.first_slot + s < owner_.size());
      owner_[piece.first_slot + s] = piece.block;
    }
    sum(schedule, piece.complete);
  }
  void sum(const engine::ForceSchedule& schedule, RowRange rows) {
    for (gmap::Row v = rows.begin; v < rows.end; ++v) {
      ++sums_[v];
      for (const ForcePiece& piece : schedule.pieces) {
        if (v < piece.pushed.begin || v >= piece.pushed.end) continue;
        for (std::uint32_t s = 0; s < piece.slots; ++s)
          REQUIRE(owner_[piece.first_slot + s] == piece.block);
      }
    }
  }

  std::vector<std::uint32_t> owner_;  // by slot: whose force was written last
  std::vector<int> sums_;
};

}  // namespace

TEST_CASE("each vertex is summed once, with all its forces in their slots") {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const gmap::Row vertices = 1 + below(random, 1000);
    const bool keep = seed % 5 == 0;
    const auto schedule = engine::plan_schedule(random_pieces(random, vertices, seed % 3 == 0),
                                                vertices, 1 + below(random, 6), keep);
    const Rehearsal rehearsal(schedule, vertices);
    for (const int count : rehearsal.sums()) REQUIRE(count == 1);
    std::uint32_t needed = 0;
    for (const ForcePiece& piece : schedule.pieces) needed += piece.slots;
    if (keep) CHECK(schedule.slots == needed);
  }
}

TEST_CASE("chunks use slots of their own") {
  std::mt19937 random(7);
  const auto schedule = engine::plan_schedule(random_pieces(random, 1000, false), 1000, 4, false);
  std::vector<std::set<std::uint32_t>> used;
  for (const engine::ForceChunk& chunk : schedule.chunks) {
    used.emplace_back();
    for (std::uint32_t p = chunk.begin; p < chunk.end; ++p)
      for (std::uint32_t s = 0; s < schedule.pieces[p].slots; ++s)
        used.back().insert(schedule.pieces[p].first_slot + s);
  }
  for (std::size_t a = 0; a < used.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (const std::uint32_t slot : used[a]) REQUIRE_FALSE(used[b].contains(slot));
}

TEST_CASE("along a mesh slots are used again") {
  std::vector<ForcePiece> pieces(100);
  for (std::uint32_t k = 0; k < pieces.size(); ++k)
    pieces[k] = {.block = k, .begin = 0, .end = 1, .slots = 10,
                 .pushed = {100 * k, 100 * k + 150}, .first_slot = 0, .complete = {}};
  CHECK(engine::plan_schedule(pieces, 10050, 1, false).slots <= 40);
  CHECK(engine::plan_schedule(pieces, 10050, 1, true).slots == 1000);
}
