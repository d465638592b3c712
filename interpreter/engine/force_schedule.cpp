// SPDX-License-Identifier: MIT
#include "engine/force_schedule.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace gmsim::engine {

namespace {

using gmap::Row;

constexpr Row kLast = std::numeric_limits<Row>::max();
/// A sum of fewer vertices waits for the next piece.
constexpr Row kFewest = 64;

std::vector<ForceChunk> equal_chunks(const std::vector<ForcePiece>& pieces, std::uint32_t wanted) {
  const auto count = static_cast<std::uint32_t>(pieces.size());
  const std::uint32_t chunks = std::min(std::max(1u, wanted), count);
  std::vector<ForceChunk> result;
  for (std::uint32_t c = 0; c < chunks; ++c)
    result.push_back({static_cast<std::uint32_t>(std::uint64_t{count} * c / chunks),
                      static_cast<std::uint32_t>(std::uint64_t{count} * (c + 1) / chunks)});
  return result;
}

RowRange pushed_by(const std::vector<ForcePiece>& pieces, const ForceChunk& chunk) {
  RowRange all{kLast, 0};
  for (std::uint32_t p = chunk.begin; p < chunk.end; ++p) {
    all.begin = std::min(all.begin, pieces[p].pushed.begin);
    all.end = std::max(all.end, pieces[p].pushed.end);
  }
  return all;
}

/// For each chunk the vertices that no other one pushes; ascending and disjoint.
std::vector<RowRange> own_vertices(const ForceSchedule& schedule, Row vertices) {
  std::vector<RowRange> pushed, own(schedule.chunks.size(), RowRange{0, vertices});
  for (const ForceChunk& chunk : schedule.chunks)
    pushed.push_back(pushed_by(schedule.pieces, chunk));
  Row before = 0;  // pushed by earlier chunks
  for (std::size_t c = 0; c < own.size(); ++c) {
    own[c].begin = before;
    before = std::max(before, pushed[c].end);
  }
  Row after = vertices;
  for (std::size_t c = own.size(); c-- > 0;) {
    own[c].end = after;
    after = std::min(after, pushed[c].begin);
  }
  Row given = 0;  // vertices that nobody pushes are given once
  for (RowRange& range : own) {
    range.begin = std::max(range.begin, given);
    range.end = std::max(range.begin, range.end);
    if (range.begin < range.end) given = range.end;
  }
  return own;
}

/// Says after which pieces of a chunk its own vertices are complete.
void complete_vertices(ForceSchedule& schedule, const ForceChunk& chunk, RowRange own) {
  std::vector<Row> needed(chunk.end - chunk.begin + 1, kLast);  // by later pieces, from this row on
  for (std::uint32_t p = chunk.end; p-- > chunk.begin;)
    needed[p - chunk.begin] = std::min(needed[p - chunk.begin + 1], schedule.pieces[p].pushed.begin);
  Row done = own.begin;
  for (std::uint32_t p = chunk.begin; p < chunk.end; ++p) {
    const bool last = p + 1 == chunk.end;
    const Row ready = std::clamp(needed[p - chunk.begin + 1], done, own.end);
    if (ready - done < kFewest && !last) continue;
    schedule.pieces[p].complete = {done, ready};
    done = ready;
  }
}

/// Gives out slots; those of pieces whose vertices are all summed are used again.
void give_slots(ForceSchedule& schedule, const ForceChunk& chunk, RowRange own, bool keep) {
  std::multimap<std::uint32_t, std::uint32_t> free;   // first slot by size
  std::multimap<Row, const ForcePiece*> waiting;      // for the sum of the vertices before this one
  for (std::uint32_t p = chunk.begin; p < chunk.end; ++p) {
    ForcePiece& piece = schedule.pieces[p];
    if (const auto found = free.find(piece.slots); found != free.end()) {
      piece.first_slot = found->second;
      free.erase(found);
    } else {
      piece.first_slot = schedule.slots;
      schedule.slots += piece.slots;
    }
    if (!keep && piece.pushed.begin >= own.begin && piece.pushed.end <= own.end)
      waiting.emplace(piece.pushed.end, &piece);
    if (piece.complete.begin == piece.complete.end) continue;
    const auto end = waiting.upper_bound(piece.complete.end);
    for (auto done = waiting.begin(); done != end; ++done)
      free.emplace(done->second->slots, done->second->first_slot);
    waiting.erase(waiting.begin(), end);
  }
}

}  // namespace

ForceSchedule plan_schedule(std::vector<ForcePiece> pieces, Row vertices, std::uint32_t chunks,
                            bool keep) {
  ForceSchedule schedule{.pieces = std::move(pieces), .chunks = {}, .last = {}, .slots = 0};
  std::stable_sort(schedule.pieces.begin(), schedule.pieces.end(),
                   [](const ForcePiece& a, const ForcePiece& b) {
                     return a.pushed.begin < b.pushed.begin;
                   });
  schedule.chunks = equal_chunks(schedule.pieces, chunks);
  const std::vector<RowRange> own = own_vertices(schedule, vertices);
  Row done = 0;
  for (std::size_t c = 0; c < own.size(); ++c) {
    complete_vertices(schedule, schedule.chunks[c], own[c]);
    give_slots(schedule, schedule.chunks[c], own[c], keep);
    if (own[c].begin == own[c].end) continue;
    if (own[c].begin > done) schedule.last.push_back({done, own[c].begin});
    done = own[c].end;
  }
  if (done < vertices) schedule.last.push_back({done, vertices});
  return schedule;
}

}  // namespace gmsim::engine
