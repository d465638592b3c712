// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace gmsim::engine {

/// Stack of numbers whose blocks never move while they are in use.
template <typename T>
class StackMemory {
 public:
  struct Mark {
    std::size_t chunk = 0;
    std::size_t used = 0;
  };
  [[nodiscard]] T* allocate(std::size_t count) {
    if (used_ + count > size_) next_chunk(count);
    T* block = begin_ + used_;
    used_ += count;
    return block;
  }
  [[nodiscard]] Mark mark() const { return {chunk_, used_}; }
  void release(Mark mark) {
    chunk_ = mark.chunk;
    used_ = mark.used;
    enter();
  }

 private:
  struct Chunk {
    std::unique_ptr<T[]> data;
    std::size_t size = 0;
  };
  [[gnu::noinline]] void next_chunk(std::size_t count) {
    constexpr std::size_t kChunk = 1024;
    while (chunk_ < chunks_.size() && used_ + count > chunks_[chunk_].size) {
      ++chunk_;
      used_ = 0;
    }
    if (chunk_ == chunks_.size()) {
      const std::size_t size = std::max(kChunk, count);
      chunks_.push_back({std::make_unique<T[]>(size), size});
    }
    enter();
  }
  void enter() {
    if (chunks_.empty()) return;
    begin_ = chunks_[chunk_].data.get();
    size_ = chunks_[chunk_].size;
  }

  std::vector<Chunk> chunks_;
  std::size_t chunk_ = 0;
  std::size_t used_ = 0;
  T* begin_ = nullptr;  // of the chunk at hand
  std::size_t size_ = 0;
};

}  // namespace gmsim::engine
