// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/force_schedule.h"
#include "engine/force_sums.h"
#include "engine/force_tables.h"
#include "engine/force_threads.h"

namespace gmsim::engine {

/// A match whose result is not finite.
struct FailedMatch {
  std::uint32_t piece = 0xffffffffu;  ///< in the order of the pieces
  std::uint32_t block = 0, row = 0;
};

/// Threads, each with work space of its own.
struct ForceWorkers {
  struct alignas(64) Space {
    KernelScratch scratch;
    std::vector<OutputBinding> outputs;
    FailedMatch failed;  ///< the first one that this worker met
  };
  explicit ForceWorkers(unsigned count) : threads(count), spaces(threads.count()) {}
  ForceThreads threads;
  std::vector<Space> spaces;
};

/// What a pass computes of its matches.
enum class PassKernels : std::uint8_t { Forces, Products };

/// One way to compute the sums of all forces: the forces of all matches, kernel by kernel, then their
/// sums vertex by vertex, as the schedule interleaves them. Changes of single matches are followed
/// without looking at the others, until so much has changed that it is better laid out anew.
class ForcePass {
 public:
  enum class Forces : std::uint8_t {
    Summed,  ///< only their sums count; where matches merge, they are added up first
    Kept     ///< stay to be read; matches merge only where that of each can be told
  };
  using Tables = std::vector<std::unique_ptr<InteractionTables>>;

  ForcePass(const Tables& tables, Forces forces) : tables_(tables), kind_(forces) {}

  void lay_out(Row vertices, std::uint32_t chunks);
  /// Tables or columns may be elsewhere from now on.
  void unbind() { unbound_ = true; }
  [[nodiscard]] bool merges(const InteractionTables& of, std::uint32_t shape) const {
    const MergedTable* merged = of.merged(shape);
    return merged != nullptr && (kind_ == Forces::Summed || merged->plan().counted);
  }

  // Single rows: of the merged table where the pass merges, else of the table of matches.
  void grow(Row vertices);
  /// A row that was added at the end of its table.
  void link(const InteractionTables& of, std::uint32_t shape, std::uint32_t row);
  /// A row that is going to be vacated.
  void unlink(const InteractionTables& of, std::uint32_t shape, std::uint32_t row);
  // A force whose match stays, but pushes another vertex than before.
  /// Will its slot still hold it when that vertex is summed? If not, the row has to be taken out.
  [[nodiscard]] bool can_move(const InteractionTables& of, std::uint32_t shape, std::uint32_t row,
                              Row from, Row to) const;
  /// `role`: as in the table.
  void move(const InteractionTables& of, std::uint32_t shape, std::uint32_t row,
            std::uint32_t role, Row from, Row to);
  /// A row that reads something else than before.
  void rerun(const InteractionTables& of, std::uint32_t shape, std::uint32_t row);
  /// True when it should be laid out anew.
  [[nodiscard]] bool crowded() const { return crowded_; }

  struct Failure {
    InteractionTables* of = nullptr;
    std::uint32_t shape = 0, row = 0;
    bool merged = false;
  };
  /// Sums into `out`. After a result that is not finite: where, the same on any number of threads.
  std::optional<Failure> run(PassKernels kernels, const ForceMoment& moment,
                             const gmap::EmbeddingStore& store, ForceWorkers& workers, bool alone,
                             const ForceSums::Totals& out);
  /// The same at the motion of the last run, whose sums are in `out`: only vertices with other
  /// matches than then are summed again, unless everything was laid out anew since.
  std::optional<Failure> run_changes(const ForceMoment& moment, const gmap::EmbeddingStore& store,
                                     ForceWorkers& workers, const ForceSums::Totals& out);

  [[nodiscard]] const ForceSums& sums() const { return sums_; }
  /// Kept forces.
  [[nodiscard]] std::span<const VertexRecord> slots() const { return forces_; }
  /// That of force number `force` of a row: of the merged table where the pass merges.
  [[nodiscard]] SignedSlot slot(const InteractionTables& of, std::uint32_t shape,
                                std::uint32_t force, std::uint32_t row) const {
    return blocks_[block_of(of, shape)].slot(force, row);
  }

  /// What runs over a table.
  struct KernelAtWork {
    InteractionTables* of = nullptr;
    std::uint32_t shape = 0;
    bool merged = false;
    const MatchTable* table = nullptr;
    const ForceKernel* kernel = nullptr;
  };
  template <typename Visit>
  void each_kernel(const Visit& visit) const {
    for (const Block& block : blocks_)
      if (block.table->count() > 0) visit(static_cast<const KernelAtWork&>(block));
  }

 private:
  static constexpr std::uint32_t kPiece = 1024;  // matches
  static constexpr std::uint32_t kLatePiece = 64;
  static constexpr std::uint32_t kRecord = sizeof(VertexRecord) / sizeof(double);

  /// One table and the kernel that runs over it. Rows from `laid_out` on came later: their slots are
  /// given when they come, for small pieces at a time.
  struct Block : KernelAtWork {
    const ForceKernel* product = nullptr;     ///< when it was asked for
    const ForceKernel* running = nullptr;     ///< one of them
    std::vector<std::uint32_t> roles;         ///< vertex of each force
    std::uint32_t outputs = 0;
    std::uint32_t laid_out = 0;               ///< rows
    std::vector<std::uint32_t> first_slots;   ///< of the pieces
    std::vector<std::uint32_t> late_slots;
    std::vector<InputBinding> inputs;

    [[nodiscard]] SignedSlot slot(std::uint32_t force, std::uint32_t row) const;
    [[nodiscard]] ForceOrder order(std::uint32_t force, std::uint32_t row) const {
      return force_order(of->number(), table->key(row), force);
    }
    [[nodiscard]] Row vertex(std::uint32_t force, std::uint32_t row) const {
      return table->rows(roles[force])[row];
    }
  };
  [[nodiscard]] std::size_t block_of(const InteractionTables& of, std::uint32_t shape) const {
    return first_block_[of.number()] + shape;
  }
  void add_block(InteractionTables& of, std::uint32_t shape);
  [[nodiscard]] std::vector<ForcePiece> pieces() const;
  void make_sums(Row vertices);
  template <typename Visit>
  void each_term(const Visit& visit) const;
  void make_late_pieces();
  void plan_last_sums(std::span<const RowRange> ranges);
  /// Says when the vertices that came after the layout are summed.
  void plan_new_vertices();
  [[nodiscard]] Row leader(Row vertex) const {
    return vertex < laid_out_ ? vertex : leaders_[vertex - laid_out_];
  }
  [[nodiscard]] bool summed_last(Row vertex) const;
  void sum_followers(RowRange leaders, const ForceSums::Totals& out) const;
  void bind(PassKernels kernels, const ForceMoment& moment, const gmap::EmbeddingStore& store);
  /// `number`: in the order of all pieces, late ones first.
  bool run_piece(const ForcePiece& piece, std::uint32_t number, ForceWorkers::Space& space);
  void run_chunk(const ForceChunk& chunk, ForceWorkers::Space& space,
                 const ForceSums::Totals& out);
  [[nodiscard]] std::optional<Failure> first_failure(const ForceWorkers& workers) const;

  // Changes (force_pass_changes.cpp).
  /// A row of one block.
  struct RowAt {
    std::uint32_t block = 0, row = 0;
    auto operator<=>(const RowAt&) const = default;
  };
  [[nodiscard]] std::uint32_t first_slot(const RowAt& at) const;
  bool run_linked(ForceWorkers::Space& space);
  void sum_from_scratch(ForceWorkers::Space& space, const ForceSums::Totals& out);
  [[nodiscard]] RowAt row_of(ForceOrder order) const;

  const Tables& tables_;
  const Forces kind_;
  std::vector<Block> blocks_;              // by interaction, by shape
  std::vector<std::size_t> first_block_;   // by interaction
  std::vector<VertexRecord> forces_;       // by slot
  ForceSchedule schedule_;
  std::vector<RowRange> last_;             // schedule_.last and later vertices, in parts to share
  // A vertex that split off from another gets forces from slots that are used again once that one, its
  // leader, is summed: it is summed with it.
  struct Follower {
    Row leader = 0, vertex = 0;
    auto operator<=>(const Follower&) const = default;
  };
  Row laid_out_ = 0;                       // vertices
  std::vector<Row> leaders_;               // of vertices that came later; kNoRow: none
  std::size_t planned_ = 0;                // of these
  std::vector<Follower> followers_;        // planned ones that are not summed last, ascending
  std::vector<ForcePiece> late_;           // rows that came after the layout
  bool late_stale_ = false;
  std::uint32_t changes_ = 0, room_ = 0;   // rows that came or went, and how many may
  bool crowded_ = false;
  bool unbound_ = true;                    // inputs of the blocks
  ForceSums sums_;
  bool followed_ = false;                  // there was a run since the layout
  std::vector<RowAt> linked_;              // since the last run
  std::vector<Row> relisted_;              // vertices with other matches than at the last run
};

}  // namespace gmsim::engine
