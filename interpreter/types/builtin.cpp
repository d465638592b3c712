// SPDX-License-Identifier: MIT
#include "types/builtin.h"

#include "support/check.h"

namespace gmsim::types {
namespace {

constexpr std::string_view kBlanks = " ";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// The parts of `text` between separators, trimmed; no parts when it is blank.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  if (trimmed(text).empty()) return parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

ValueType parse_type(std::string_view name) {
  if (name == "eigenpair") return {ValueKind::EigenPair};
  const std::optional<ValueKind> kind = value_kind(name);
  GMSIM_CHECK(kind.has_value(), "builtins.def: no type called " + std::string(name));
  return {*kind};
}

/// "(vec3, vec3) -> real"
Signature parse_signature(std::string_view text) {
  const std::size_t close = text.find(')');
  const std::size_t arrow = text.find("->");
  GMSIM_CHECK(text.starts_with('(') && close < arrow && arrow != std::string_view::npos,
              "builtins.def: no signature: " + std::string(text));
  Signature signature;
  for (std::string_view parameter : split(text.substr(1, close - 1), ','))
    signature.parameters.push_back(parse_type(parameter));
  signature.result = parse_type(trimmed(text.substr(arrow + 2)));
  return signature;
}

std::vector<Signature> parse_signatures(std::string_view text) {
  std::vector<Signature> signatures;
  for (std::string_view overload : split(text, ';'))
    signatures.push_back(parse_signature(overload));
  return signatures;
}

}  // namespace

const std::vector<BuiltinInfo>& builtins() {
  static const std::vector<BuiltinInfo> rows = {
#define BUILTIN(id, name, signatures, units, doc) \
  {Builtin::id, name, parse_signatures(signatures), UnitRule::units, doc},
#include "types/builtins.def"
#undef BUILTIN
  };
  return rows;
}

const BuiltinInfo& info(Builtin id) {
  return builtins().at(static_cast<std::size_t>(id));
}

std::optional<Builtin> builtin(std::string_view name) {
  for (const BuiltinInfo& row : builtins())
    if (row.name == name) return row.id;
  return std::nullopt;
}

}  // namespace gmsim::types
