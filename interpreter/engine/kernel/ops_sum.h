// SPDX-License-Identifier: MIT
// Sums of records by lists of slots. Included inside the namespace of one instruction set, after
// ops_move.h.

#if GMSIM_VECTOR_BYTES >= 32
alignas(32) static const double kSigns[2][4] = {{0.0, 0.0, 0.0, 0.0}, {-0.0, -0.0, -0.0, -0.0}};

GMSIM_INLINE void add_to(Record& sum, const double* records, SignedSlot slot) {
  typedef long long RecordBits __attribute__((vector_size(32)));
  const auto number = static_cast<std::uint32_t>(slot);
  const Record x = load_record(records + 2 * std::size_t(number & ~1u));
  sum += Record(RecordBits(x) ^ RecordBits(load_record(kSigns[number & 1])));
}
GMSIM_INLINE void add_share(Record& sum, const double* records, const SlotShare& of) {
  const Record share = {of.share, of.share, of.share, of.share};
  sum += share * load_record(records + 4 * std::size_t(of.slot));
}
GMSIM_INLINE void store_record(double* to, const Record& x) {
  *reinterpret_cast<StoredRecord*>(to) = x;
}
#else
alignas(16) static const double kSigns[2][2] = {{0.0, 0.0}, {-0.0, -0.0}};

GMSIM_INLINE void add_to(Record& sum, const double* records, SignedSlot slot) {
  const auto number = static_cast<std::uint32_t>(slot);
  const double* x = records + 2 * std::size_t(number & ~1u);
  const Bits sign = Bits(load(kSigns[number & 1]));
  sum.xy += V(Bits(load(x)) ^ sign);
  sum.zw += V(Bits(load(x + 2)) ^ sign);
}
GMSIM_INLINE void add_share(Record& sum, const double* records, const SlotShare& of) {
  const double* x = records + 4 * std::size_t(of.slot);
  const V share = {of.share, of.share};
  sum.xy += share * load(x);
  sum.zw += share * load(x + 2);
}
GMSIM_INLINE void store_record(double* to, const Record& x) {
  store(to, x.xy);
  store(to + 2, x.zw);
}
#endif

static void sum_list(const double* records, const SlotList& list, const SignedSlot* slots,
                     std::uint32_t first, Record sum, double* out, double* inner) {
  if (inner != nullptr) {
    for (; first < list.inner; ++first) add_to(sum, records, slots[list.begin + first]);
    store_record(inner, sum);
  }
  for (std::uint32_t k = first; k < list.count; ++k) add_to(sum, records, slots[list.begin + k]);
  store_record(out, sum);
}

/// Four rows abreast: the additions of one wait for each other, those of four do not.
static void sum_slots(const double* records, const SlotList* lists, const SignedSlot* slots,
                      std::uint32_t rows, double* out, double* inner) {
  const auto inner_of = [=](std::uint32_t of) {
    return inner == nullptr ? nullptr : inner + 4 * std::size_t(of);
  };
  const auto shared = [=](const SlotList& list) { return inner == nullptr ? list.count : list.inner; };
  std::uint32_t row = 0;
  for (; row + 4 <= rows; row += 4) {
    const SlotList* list = lists + row;
    const SignedSlot *s0 = slots + list[0].begin, *s1 = slots + list[1].begin,
                     *s2 = slots + list[2].begin, *s3 = slots + list[3].begin;
    std::uint32_t common = shared(list[0]);
    for (int i = 1; i < 4; ++i) common = shared(list[i]) < common ? shared(list[i]) : common;
    Record sum0 = {}, sum1 = {}, sum2 = {}, sum3 = {};
    for (std::uint32_t k = 0; k < common; ++k) {
      add_to(sum0, records, s0[k]);
      add_to(sum1, records, s1[k]);
      add_to(sum2, records, s2[k]);
      add_to(sum3, records, s3[k]);
    }
    double* to = out + 4 * std::size_t(row);
    sum_list(records, list[0], slots, common, sum0, to, inner_of(row));
    sum_list(records, list[1], slots, common, sum1, to + 4, inner_of(row + 1));
    sum_list(records, list[2], slots, common, sum2, to + 8, inner_of(row + 2));
    sum_list(records, list[3], slots, common, sum3, to + 12, inner_of(row + 3));
  }
  for (; row < rows; ++row)
    sum_list(records, lists[row], slots, 0, Record{}, out + 4 * std::size_t(row), inner_of(row));
}

static void sum_shares(const double* records, const SlotList* lists, const SlotShare* shares,
                       std::uint32_t rows, double* out) {
  for (std::uint32_t row = 0; row < rows; ++row) {
    const SlotShare* of = shares + lists[row].begin;
    Record sum = {};
    for (std::uint32_t k = 0; k < lists[row].count; ++k) add_share(sum, records, of[k]);
    store_record(out + 4 * std::size_t(row), sum);
  }
}
