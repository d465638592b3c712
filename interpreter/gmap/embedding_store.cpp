// SPDX-License-Identifier: MIT
#include "gmap/embedding_store.h"

#include <algorithm>

#include "gmap/journal.h"

namespace gmsim::gmap {

void EmbeddingColumn::before_change(Row row, Journal* journal) {
  GMSIM_CHECK(row < row_end(), "row outside the column");
  if (source_ != nullptr) fetch(row);
  if (journal != nullptr) journal->record(*this, row);
}

void EmbeddingColumn::set(Row row, std::span<const double> value, Journal* journal) {
  GMSIM_CHECK(value.size() == stride_, "value and column differ in size");
  before_change(row, journal);
  std::copy_n(value.begin(), stride_, data_.begin() + std::ptrdiff_t{row} * stride_);
  present_[row] = 1;
}

void EmbeddingColumn::clear(Row row, Journal* journal) {
  before_change(row, journal);
  std::fill_n(data_.begin() + std::ptrdiff_t{row} * stride_, stride_, 0.0);
  present_[row] = 0;
}

void EmbeddingColumn::copy(Row from, Row to, Journal* journal) {
  GMSIM_CHECK(from < row_end(), "row outside the column");
  if (source_ != nullptr) fetch(from);
  before_change(to, journal);
  std::copy_n(data_.begin() + std::ptrdiff_t{from} * stride_, stride_,
              data_.begin() + std::ptrdiff_t{to} * stride_);
  present_[to] = present_[from];
}

void EmbeddingColumn::resize(Row row_end, Journal* journal) {
  if (journal != nullptr) journal->begin(*this);
  data_.resize(std::size_t{row_end} * stride_);
  present_.resize(row_end);
}

std::span<const double> EmbeddingColumn::data() const {
  GMSIM_CHECK(source_ == nullptr, "the values are elsewhere");
  return data_;
}

std::span<double> EmbeddingColumn::data() {
  GMSIM_CHECK(source_ == nullptr, "the values are elsewhere");
  return data_;
}

void EmbeddingColumn::read_from(const double* records, std::uint32_t pitch, Row rows) {
  GMSIM_CHECK(pitch >= stride_ && rows <= row_end(), "records and column differ");
  source_ = records;
  pitch_ = pitch;
  source_rows_ = rows;
  if (++epoch_ == 0) {
    fetched_.clear();
    epoch_ = 1;
  }
  if (fetched_.size() < rows) fetched_.resize(rows);
}

void EmbeddingColumn::fetch(Row row) const {
  if (row >= source_rows_ || fetched_[row] == epoch_) return;
  fetched_[row] = epoch_;
  std::copy_n(source_ + std::size_t{row} * pitch_, stride_,
              data_.begin() + std::ptrdiff_t{row} * stride_);
}

std::size_t EmbeddingColumn::memory_bytes() const {
  return sizeof(*this) + data_.capacity() * sizeof(double) + present_.capacity() +
         fetched_.capacity() * sizeof(std::uint32_t);
}

EmbeddingStore::EmbeddingStore(const EmbeddingSchema& schema, const GMap& map)
    : schema_(&schema), map_(&map) {}

EmbeddingColumn& EmbeddingStore::use(types::EmbeddingId id) {
  if (in_use(id)) return column(id);
  const EmbeddingDecl& decl = (*schema_)[id];
  GMSIM_CHECK(decl.kind != EmbeddingKind::Derived, "a derived embedding has no column");
  const OrbitIndex& orbits = use_index(decl.orbit);
  if (slots_.size() <= types::index(id)) slots_.resize(types::index(id) + 1);
  auto column = std::make_unique<EmbeddingColumn>(types::component_count(decl.type), decl.optional);
  column->resize(orbits.row_end());
  if (decl.default_value) {
    for (Row row = 0; row < orbits.row_end(); ++row) {
      if (orbits.alive(row)) column->set(row, decl.default_value->data);
    }
  }
  slots_[types::index(id)] = {std::move(column), &orbits};
  ++column_count_;
  return *slots_[types::index(id)].column;
}

bool EmbeddingStore::in_use(types::EmbeddingId id) const {
  return types::index(id) < slots_.size() && slots_[types::index(id)].column != nullptr;
}

const EmbeddingStore::Slot& EmbeddingStore::slot(types::EmbeddingId id) const {
  GMSIM_CHECK(in_use(id), "embedding is not in use");
  return slots_[types::index(id)];
}

EmbeddingColumn& EmbeddingStore::column(types::EmbeddingId id) {
  return *slot(id).column;
}

const EmbeddingColumn& EmbeddingStore::column(types::EmbeddingId id) const {
  return *slot(id).column;
}

const OrbitIndex& EmbeddingStore::index_of(types::EmbeddingId id) const {
  return *slot(id).index;
}

OrbitIndex& EmbeddingStore::use_index(OrbitType type) {
  for (const auto& index : indices_) {
    if (index->type() == type) return *index;
  }
  return *indices_.emplace_back(std::make_unique<OrbitIndex>(*map_, type));
}

const OrbitIndex* EmbeddingStore::find_index(OrbitType type) const {
  for (const auto& index : indices_) {
    if (index->type() == type) return index.get();
  }
  return nullptr;
}

std::span<const double> EmbeddingStore::get(types::EmbeddingId id, DartId d) const {
  const Slot& values = slot(id);
  const Row row = values.index->row(d);
  return values.column->has(row) ? values.column->get(row) : std::span<const double>{};
}

void EmbeddingStore::set(types::EmbeddingId id, DartId d, std::span<const double> value,
                         Journal* journal) {
  const Slot& values = slot(id);
  values.column->set(values.index->row(d), value, journal);
}

void EmbeddingStore::grow_columns(Journal* journal) {
  for (Slot& values : slots_) {
    if (values.column == nullptr || values.column->row_end() >= values.index->row_end()) continue;
    values.column->resize(values.index->row_end(), journal);
  }
}

void EmbeddingStore::trim_columns() {
  for (Slot& values : slots_) {
    if (values.column == nullptr || values.column->row_end() <= values.index->row_end()) continue;
    values.column->resize(values.index->row_end());
  }
}

std::vector<types::EmbeddingId> EmbeddingStore::embeddings() const {
  std::vector<types::EmbeddingId> ids;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (slots_[i].column != nullptr) ids.push_back(static_cast<types::EmbeddingId>(i));
  }
  return ids;
}

std::size_t EmbeddingStore::memory_bytes() const {
  std::size_t bytes = sizeof(*this);
  for (const auto& index : indices_) bytes += index->memory_bytes();
  for (const Slot& values : slots_) {
    if (values.column != nullptr) bytes += values.column->memory_bytes();
  }
  return bytes;
}

}  // namespace gmsim::gmap
