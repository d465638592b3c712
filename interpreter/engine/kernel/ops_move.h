// SPDX-License-Identifier: MIT
// Operations that move data between registers and memory. Included inside the namespace of one
// instruction set.

/// Where the value of lane `lane` is; lanes past the last match repeat it.
GMSIM_INLINE const double* source(const InputBinding& in, const BlockFrame& f, std::size_t lane) {
  const std::size_t match = f.begin + (lane < f.count ? lane : f.count - 1);
  if (in.rows != nullptr) return in.base + std::size_t(in.stride) * in.rows[match];
  return in.per_match ? in.base + in.stride * match : in.base;
}
GMSIM_INLINE bool in_records(const double* base, std::size_t stride) {
  return stride == 4 && reinterpret_cast<std::uintptr_t>(base) % 32 == 0;
}

/// Asks for what the next block reads of a column: long tables come from main memory, a page of one
/// column after a page of another, which the processor does not foresee.
GMSIM_INLINE void fetch_ahead(const void* begin, std::size_t bytes) {
  const char* const next = static_cast<const char*>(begin) + bytes;
  for (std::size_t at = 0; at < bytes; at += 64) __builtin_prefetch(next + at);
}

/// Four records {x, y, z, w} as rows of x, y and z, and back.
#if GMSIM_VECTOR_BYTES >= 32
typedef double Record __attribute__((vector_size(32)));
typedef double StoredRecord __attribute__((vector_size(32), may_alias));
GMSIM_INLINE Record load_record(const double* p) {
  return *reinterpret_cast<const StoredRecord*>(p);
}
GMSIM_INLINE Record difference(Record a, Record b) {
  return a - b;
}
GMSIM_INLINE void store_columns(double* d, std::size_t row, Record a, Record b, Record c,
                                Record e) {
  const Record xz0 = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Record y0 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Record xz1 = __builtin_shufflevector(c, e, 0, 4, 2, 6);
  const Record y1 = __builtin_shufflevector(c, e, 1, 5, 3, 7);
  *reinterpret_cast<StoredRecord*>(d) = __builtin_shufflevector(xz0, xz1, 0, 1, 4, 5);
  *reinterpret_cast<StoredRecord*>(d + row) = __builtin_shufflevector(y0, y1, 0, 1, 4, 5);
  *reinterpret_cast<StoredRecord*>(d + 2 * row) = __builtin_shufflevector(xz0, xz1, 2, 3, 6, 7);
}
GMSIM_INLINE void store_records(const double* x, const double* y, const double* z, double* out[4]) {
  const Record a = load_record(x), b = load_record(y), c = load_record(z), zero = {};
  const Record xy0 = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Record xy1 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Record zw0 = __builtin_shufflevector(c, zero, 0, 4, 2, 6);
  const Record zw1 = __builtin_shufflevector(c, zero, 1, 5, 3, 7);
  *reinterpret_cast<StoredRecord*>(out[0]) = __builtin_shufflevector(xy0, zw0, 0, 1, 4, 5);
  *reinterpret_cast<StoredRecord*>(out[1]) = __builtin_shufflevector(xy1, zw1, 0, 1, 4, 5);
  *reinterpret_cast<StoredRecord*>(out[2]) = __builtin_shufflevector(xy0, zw0, 2, 3, 6, 7);
  *reinterpret_cast<StoredRecord*>(out[3]) = __builtin_shufflevector(xy1, zw1, 2, 3, 6, 7);
}
#else
struct Record {
  V xy, zw;
};
GMSIM_INLINE Record load_record(const double* p) {
  return {load(p), load(p + 2)};
}
GMSIM_INLINE Record difference(const Record& a, const Record& b) {
  return {a.xy - b.xy, a.zw - b.zw};
}
GMSIM_INLINE void store_columns(double* d, std::size_t row, const Record& a, const Record& b,
                                const Record& c, const Record& e) {
  store(d, __builtin_shufflevector(a.xy, b.xy, 0, 2));
  store(d + 2, __builtin_shufflevector(c.xy, e.xy, 0, 2));
  store(d + row, __builtin_shufflevector(a.xy, b.xy, 1, 3));
  store(d + row + 2, __builtin_shufflevector(c.xy, e.xy, 1, 3));
  store(d + 2 * row, __builtin_shufflevector(a.zw, b.zw, 0, 2));
  store(d + 2 * row + 2, __builtin_shufflevector(c.zw, e.zw, 0, 2));
}
GMSIM_INLINE void store_records(const double* x, const double* y, const double* z, double* out[4]) {
  for (int half = 0; half < 2; ++half) {
    const V a = load(x + 2 * half), b = load(y + 2 * half), c = load(z + 2 * half);
    store(out[2 * half], __builtin_shufflevector(a, b, 0, 2));
    store(out[2 * half] + 2, __builtin_shufflevector(c, V{}, 0, 2));
    store(out[2 * half + 1], __builtin_shufflevector(a, b, 1, 3));
    store(out[2 * half + 1] + 2, __builtin_shufflevector(c, V{}, 1, 3));
  }
}
#endif

/// Four lanes at a time, the last ones repeating the last match: fetch(lane) reads a record, and
/// fetch_inside(lane) does so for lanes of matches.
template <typename FetchInside, typename Fetch>
GMSIM_INLINE void gather_records(double* d, const BlockFrame& f, const FetchInside& fetch_inside,
                                 const Fetch& fetch) {
  std::size_t i = 0;
  for (; i + 4 <= f.count; i += 4)
    store_columns(d + i, f.row, fetch_inside(i), fetch_inside(i + 1), fetch_inside(i + 2),
                  fetch_inside(i + 3));
  for (; i < f.active; i += 4)
    store_columns(d + i, f.row, fetch(i), fetch(i + 1), fetch(i + 2), fetch(i + 3));
}

template <int N>
static void gather_any(const InputBinding& in, double* d, std::size_t row, const BlockFrame& f) {
  for (std::size_t i = 0; i < f.active; ++i) {
    const double* from = source(in, f, i);
    for (int k = 0; k < N; ++k) d[k * row + i] = from[k];
  }
}

template <int N>
static void gather(const Instruction& in, BlockFrame& f) {
  const InputBinding& binding = f.inputs[in.numbers[0]];
  const Writer to = writer(f, in.d);
  if (N == 3 && binding.rows != nullptr && in_records(binding.base, binding.stride)) {
    const double* base = binding.base;
    const std::uint32_t* rows = binding.rows + f.begin;
    fetch_ahead(rows, f.count * sizeof(*rows));
    return gather_records(
        to.first, f,
        [=](std::size_t lane) { return load_record(base + 4 * std::size_t(rows[lane])); },
        [&](std::size_t lane) { return load_record(source(binding, f, lane)); });
  }
  if (N == 1 && f.count == f.active) {
    if (binding.rows != nullptr) {
      const double* base = binding.base;
      const std::uint32_t* rows = binding.rows + f.begin;
      const std::size_t stride = binding.stride;
      for (std::size_t i = 0; i < f.count; ++i) to.first[i] = base[stride * rows[i]];
      return;
    }
    if (binding.per_match && binding.stride == 1) {
      __builtin_memcpy(to.first, binding.base + f.begin, f.count * sizeof(double));
      fetch_ahead(binding.base + f.begin, f.count * sizeof(double));
      return;
    }
  }
  gather_any<N>(binding, to.first, to.row, f);
}

static void gather_difference(const Instruction& in, BlockFrame& f) {
  const InputBinding &a = f.inputs[in.numbers[0]], &b = f.inputs[in.numbers[1]];
  const Writer to = writer(f, in.d);
  const auto by_records = [](const InputBinding& x) {
    return x.rows != nullptr && in_records(x.base, x.stride);
  };
  if (by_records(a) && by_records(b)) {
    const double *base_a = a.base, *base_b = b.base;
    const std::uint32_t *rows_a = a.rows + f.begin, *rows_b = b.rows + f.begin;
    fetch_ahead(rows_a, f.count * sizeof(*rows_a));
    fetch_ahead(rows_b, f.count * sizeof(*rows_b));
    return gather_records(
        to.first, f,
        [=](std::size_t lane) {
          return difference(load_record(base_a + 4 * std::size_t(rows_a[lane])),
                            load_record(base_b + 4 * std::size_t(rows_b[lane])));
        },
        [&](std::size_t lane) {
          return difference(load_record(source(a, f, lane)), load_record(source(b, f, lane)));
        });
  }
  for (std::size_t i = 0; i < f.active; ++i) {
    const double *from_a = source(a, f, i), *from_b = source(b, f, i);
    for (int k = 0; k < 3; ++k) to.first[k * to.row + i] = from_a[k] - from_b[k];
  }
}

/// x - x is 0, or not a number: so is the sum over all entries.
template <int N>
GMSIM_INLINE V finite_test(const Pack<N>& pack) {
  V sum = pack.c[0] - pack.c[0];
  for (int k = 1; k < N; ++k) sum += pack.c[k] - pack.c[k];
  return sum;
}

/// The first matches of a block in whole records; gives how many.
static std::uint32_t store_as_records(double* to, const Reader& from, std::uint32_t count) {
  std::uint32_t i = 0;
  for (; i + 4 <= count; i += 4) {
    const double* x = from.first + i;
    double* records[4] = {to + 4 * i, to + 4 * i + 4, to + 4 * i + 8, to + 4 * i + 12};
    store_records(x, x + from.row, x + 2 * from.row, records);
  }
  return i;
}
template <int N>
static void store_any(double* to, std::size_t stride, const Reader& from, std::uint32_t begin,
                      std::uint32_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const double* x = from.first + (i & from.moving);
    for (int k = 0; k < N; ++k) to[stride * i + k] = x[k * from.row];
    if (N == 3 && stride == 4) to[4 * i + 3] = 0.0;
  }
}
template <int N>
static void test_finite(const Reader& from, BlockFrame& f) {
  V test = {};
  each_vector(f.active, [&](std::size_t i) { test += finite_test(read<N>(from, i)); });
  if (any(test != test)) f.finite = false;
}

template <int N>
static void store(const Instruction& in, BlockFrame& f) {
  const OutputBinding& out = f.outputs[in.numbers[0]];
  const Reader from = reader(f, in.operands[0]);
  test_finite<N>(from, f);
  double* to = out.base + std::size_t(out.stride) * f.begin;
  const bool records = N == 3 && in_records(out.base, out.stride) && from.moving != 0;
  store_any<N>(to, out.stride, from, records ? store_as_records(to, from, f.count) : 0, f.count);
}
