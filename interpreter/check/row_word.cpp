// SPDX-License-Identifier: MIT

namespace gmsim::check {}  // namespace gmsim::check
