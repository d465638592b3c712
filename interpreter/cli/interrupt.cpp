// SPDX-License-Identifier: MIT
#include "cli/interrupt.h"

namespace gmsim::cli {
namespace {

// A signal handler can reach nothing else.
volatile std::sig_atomic_t noted = 0;

extern "C" void note_signal(int) {
  noted = 1;
}

}  // namespace

InterruptWatch::InterruptWatch() {
  noted = 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &old_int_);
  sigaction(SIGTERM, &action, &old_term_);
}

InterruptWatch::~InterruptWatch() {
  sigaction(SIGINT, &old_int_, nullptr);
  sigaction(SIGTERM, &old_term_, nullptr);
}

bool InterruptWatch::interrupted() const {
  return noted != 0;
}

}  // namespace gmsim::cli
