// SPDX-License-Identifier: MIT
#include "cli/frame_column.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>

#include "support/check.h"

namespace gmsim::cli {
namespace {

using engine::DartId;
using io::NumberType;
using types::OrbitType;

NumberType number_type(const types::ValueType& type) {
  const bool whole = type.kind == types::ValueKind::Bool || type.kind == types::ValueKind::Int;
  return whole ? NumberType::Int32 : NumberType::Float32;
}

io::FieldPlace place_of(OrbitType orbit, int dimension) {
  if (orbit == OrbitType::cell(0, dimension)) return io::FieldPlace::Point;
  if (orbit == OrbitType::cell(dimension, dimension)) return io::FieldPlace::Cell;
  return io::FieldPlace::Orbit;
}

io::FieldDescription describe(const scene::OutputField& field, int dimension) {
  io::FieldDescription description;
  description.name = field.name;
  description.components = types::component_count(field.type);
  description.place = place_of(field.orbit, dimension);
  description.type = number_type(field.type);
  description.expression = field.text;
  if (field.unit) description.unit = types::to_string(*field.unit);
  return description;
}

FrameColumn::Read reader_of(const scene::OutputField& field) {
  const auto frame = std::make_shared<engine::Frame>(field.value.frame_size);
  return [value = field.value, frame](engine::TreeEvaluator& evaluator, DartId dart,
                                      std::span<double> out) {
    frame->set(value.dart, dart);
    return evaluator.evaluate(*value.value, *frame, out);
  };
}

}  // namespace

FrameColumn::FrameColumn(io::FieldDescription description, OrbitType orbit, Read read)
    : description_(std::move(description)), orbit_(orbit), read_(std::move(read)) {
  description_.orbit = types::to_string(orbit);
}

FrameColumn::FrameColumn(const scene::OutputField& field, int dimension)
    : FrameColumn(describe(field, dimension), field.orbit, reader_of(field)) {}

bool FrameColumn::evaluate(engine::TreeEvaluator& evaluator, std::span<const DartId> darts,
                           support::Diagnostics& diagnostics) {
  const std::size_t components = description_.components;
  std::vector<double> values(darts.size() * components);
  for (std::size_t row = 0; row < darts.size(); ++row)
    if (!read_row(evaluator, darts[row], {values.data() + row * components, components},
                  diagnostics))
      return false;
  std::vector<std::int32_t> numbers;
  if (description_.place == io::FieldPlace::Orbit)
    for (const DartId dart : darts)
      numbers.push_back(static_cast<std::int32_t>(types::index(dart)));
  // Bit by bit, for values that are not numbers.
  unchanged_ = values.size() == values_.size() && numbers == darts_ &&
               std::memcmp(values.data(), values_.data(), values.size() * sizeof(double)) == 0;
  if (unchanged_ && !values.empty()) return true;
  unchanged_ = false;
  values_ = std::move(values);
  darts_ = std::move(numbers);
  store(values_);
  return true;
}

bool FrameColumn::read_row(engine::TreeEvaluator& evaluator, DartId dart, std::span<double> out,
                           support::Diagnostics& diagnostics) {
  if (read_(evaluator, dart, out)) return true;
  engine::EvalFailure failure = evaluator.take_failure();
  if (failure.missing_optional) {
    std::fill(out.begin(), out.end(), std::numeric_limits<double>::quiet_NaN());
    return true;
  }
  failure.diagnostic.notes.push_back("in the output field `" + description_.name + "`");
  diagnostics.report(std::move(failure.diagnostic));
  return false;
}

void FrameColumn::store(std::span<const double> values) {
  switch (description_.type) {
    case NumberType::Float64: doubles_.assign(values.begin(), values.end()); break;
    case NumberType::Float32: floats_.assign(values.begin(), values.end()); break;
    case NumberType::Int32:
      integers_.clear();
      for (const double value : values)
        integers_.push_back(value == value ? static_cast<std::int32_t>(value)
                                           : std::numeric_limits<std::int32_t>::min());
      break;
    case NumberType::Int64: GMSIM_CHECK(false, "no field of a scene has 64-bit numbers");
  }
}

io::FrameField FrameColumn::frame_field() const {
  if (unchanged_) return {io::Unchanged{}, {}};
  switch (description_.type) {
    case NumberType::Float64: return {std::span(doubles_), darts_};
    case NumberType::Float32: return {std::span(floats_), darts_};
    case NumberType::Int32:
    case NumberType::Int64: return {std::span(integers_), darts_};
  }
  return {};
}

}  // namespace gmsim::cli
