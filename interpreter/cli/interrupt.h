// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>

namespace gmsim::cli {

/// While one lives, the first Ctrl-C (SIGINT) or SIGTERM is only noted; a second one ends the
/// process as always. One at a time.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  [[nodiscard]] bool interrupted() const;

 private:
  struct sigaction old_int_ {}, old_term_ {};
};

}  // namespace gmsim::cli
