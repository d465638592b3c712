// SPDX-License-Identifier: MIT
#include "gmap/embedding_schema.h"

namespace gmsim::gmap {

types::EmbeddingId EmbeddingSchema::add(EmbeddingDecl declaration) {
  declarations_.push_back(std::move(declaration));
  return static_cast<types::EmbeddingId>(declarations_.size() - 1);
}

std::optional<types::EmbeddingId> EmbeddingSchema::find(std::string_view name) const {
  for (std::size_t i = declarations_.size(); i-- > 0;) {
    if (declarations_[i].name == name) return static_cast<types::EmbeddingId>(i);
  }
  return std::nullopt;
}

}  // namespace gmsim::gmap
