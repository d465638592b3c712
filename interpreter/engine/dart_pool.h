// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "types/orbit_type.h"

namespace gmsim::engine {

/// Vectors of darts that keep their memory between uses; the last one taken is the first given back.
class DartPool {
 public:
  /// An empty vector for as long as it is needed.
  class Lease {
   public:
    explicit Lease(DartPool& pool) : pool_(pool) {
      if (pool.used_ == pool.vectors_.size()) pool.vectors_.emplace_back();
      darts_ = &pool.vectors_[pool.used_++];
      darts_->clear();
    }
    ~Lease() { --pool_.used_; }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    [[nodiscard]] std::vector<types::DartId>& operator*() const { return *darts_; }
    [[nodiscard]] std::vector<types::DartId>* operator->() const { return darts_; }

   private:
    DartPool& pool_;
    std::vector<types::DartId>* darts_;
  };

 private:
  std::deque<std::vector<types::DartId>> vectors_;
  std::size_t used_ = 0;
};

}  // namespace gmsim::engine
