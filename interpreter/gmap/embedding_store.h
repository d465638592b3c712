// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gmap/embedding_schema.h"
#include "gmap/gmap.h"
#include "gmap/orbit_index.h"

namespace gmsim::gmap {

/// The values of one embedding, `stride` doubles a row (component_count of its type), rows as in
/// the OrbitIndex of its orbit type. A row without a value (an optional embedding, or a dead orbit)
/// holds zeros.
class EmbeddingColumn {
 public:
  EmbeddingColumn(std::uint32_t stride, bool optional) : stride_(stride), optional_(optional) {}

  [[nodiscard]] std::uint32_t stride() const { return stride_; }
  [[nodiscard]] bool optional() const { return optional_; }
  /// One past the last row there is room for.
  [[nodiscard]] Row row_end() const { return static_cast<Row>(present_.size()); }
  [[nodiscard]] std::span<const double> get(Row row) const {
    if (source_ != nullptr) fetch(row);
    return {data_.data() + std::size_t{row} * stride_, stride_};
  }
  [[nodiscard]] bool has(Row row) const { return row < present_.size() && present_[row] != 0; }
  void set(Row row, std::span<const double> value, Journal* journal = nullptr);
  void clear(Row row, Journal* journal = nullptr);
  /// Gives `to` what `from` has, be it no value: how a part of a split orbit inherits.
  void copy(Row from, Row to, Journal* journal = nullptr);
  /// New rows have no value.
  void resize(Row row_end, Journal* journal = nullptr);
  [[nodiscard]] std::span<const double> data() const;
  [[nodiscard]] std::span<double> data();

  // Somebody else may hold the values for a while, in records of `pitch` doubles that begin with them.
  /// From now on a row below `rows` has the value that is in its record, until it is set. Only rows
  /// that are asked for are copied. Not for several threads at once.
  void read_from(const double* records, std::uint32_t pitch, Row rows);
  /// Rows that were not asked for keep the value that they had before.
  void stop_reading() { source_ = nullptr; }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  friend class Journal;
  void before_change(Row row, Journal* journal);
  void fetch(Row row) const;

  std::uint32_t stride_;
  bool optional_;
  mutable std::vector<double> data_;  // a copy of what is read from elsewhere is made when asked for
  std::vector<std::uint8_t> present_;
  const double* source_ = nullptr;
  std::uint32_t pitch_ = 0;
  Row source_rows_ = 0;
  mutable std::vector<std::uint32_t> fetched_;  // by row of the source: the epoch of its copy
  std::uint32_t epoch_ = 0;
};

/// The embeddings of one map: a column for each stored embedding that is in use and an orbit index
/// for each orbit type that is in use. Derived embeddings have no column; readers evaluate them.
/// Schema and map are borrowed and stay where they are.
class EmbeddingStore {
 public:
  EmbeddingStore(const EmbeddingSchema& schema, const GMap& map);

  [[nodiscard]] const EmbeddingSchema& schema() const { return *schema_; }
  /// Makes the column (filled with the default where there is one) and its orbit index.
  EmbeddingColumn& use(types::EmbeddingId id);
  [[nodiscard]] bool in_use(types::EmbeddingId id) const;
  [[nodiscard]] EmbeddingColumn& column(types::EmbeddingId id);
  [[nodiscard]] const EmbeddingColumn& column(types::EmbeddingId id) const;
  /// The index of an orbit type, made on first use.
  OrbitIndex& use_index(OrbitType type);
  /// The index whose rows a column in use has.
  [[nodiscard]] const OrbitIndex& index_of(types::EmbeddingId id) const;
  /// Null when the type is not indexed.
  [[nodiscard]] const OrbitIndex* find_index(OrbitType type) const;
  [[nodiscard]] std::span<const std::unique_ptr<OrbitIndex>> indices() const { return indices_; }

  /// Value at the orbit of a dart; empty when it has none.
  [[nodiscard]] std::span<const double> get(types::EmbeddingId id, DartId d) const;
  void set(types::EmbeddingId id, DartId d, std::span<const double> value,
           Journal* journal = nullptr);
  /// Gives every column a row for each row of its index, after repairs.
  void grow_columns(Journal* journal = nullptr);
  /// Cuts every column down to the rows of its index, after a roll-back.
  void trim_columns();
  /// Columns there are; they are never taken away, so an equal count means the same columns.
  [[nodiscard]] std::size_t column_count() const { return column_count_; }
  /// The embeddings in use.
  [[nodiscard]] std::vector<types::EmbeddingId> embeddings() const;
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Slot {
    std::unique_ptr<EmbeddingColumn> column;  // null: not in use
    const OrbitIndex* index = nullptr;
  };
  [[nodiscard]] const Slot& slot(types::EmbeddingId id) const;

  const EmbeddingSchema* schema_;
  const GMap* map_;
  std::vector<std::unique_ptr<OrbitIndex>> indices_;
  std::vector<Slot> slots_;  // by EmbeddingId
  std::size_t column_count_ = 0;
};

}  // namespace gmsim::gmap
