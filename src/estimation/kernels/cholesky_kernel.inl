// Block Cholesky factorisation (right-looking, by panels of columns) and solution. Included by the kernel
// sources only, inside of their namespace.

/// Replaces the lower triangle of a 6x6 block by the inverse of its Cholesky factor, with zeros above.
STDC_INLINE bool invert_factor(double* block) {
  double l[6][6], inverse[6][6] = {};
  for (int j = 0; j < 6; ++j) {
    double pivot = block[8 * j + j];
    const double whole = pivot;
    for (int k = 0; k < j; ++k) pivot -= l[j][k] * l[j][k];
    if (!(pivot > 1e-14 * whole)) return false;
    inverse[j][j] = 1.0 / __builtin_sqrt(pivot);
    for (int i = j + 1; i < 6; ++i) {
      double value = block[8 * j + i];
      for (int k = 0; k < j; ++k) value -= l[i][k] * l[j][k];
      l[i][j] = value * inverse[j][j];
    }
  }
  for (int j = 0; j < 6; ++j) {
    for (int i = j + 1; i < 6; ++i) {
      double value = 0;
      for (int k = j; k < i; ++k) value -= l[i][k] * inverse[k][j];
      inverse[i][j] = value * inverse[i][i];
    }
  }
  for (int c = 0; c < 6; ++c) {
    for (int r = 0; r < 6; ++r) block[8 * c + r] = inverse[r][c];
  }
  return true;
}

/// block = block * inverse^T.
STDC_INLINE void multiply_transposed(double* block, const double* inverse) {
  Lanes low[6], high[6];
  for (int k = 0; k < 6; ++k) low[k] = load(block + 8 * k), high[k] = load(block + 8 * k + 4);
  for (int c = 0; c < 6; ++c) {
    Lanes top = all(0.0), bottom = all(0.0);
    for (int k = 0; k <= c; ++k) {
      top += low[k] * inverse[8 * k + c];
      bottom += high[k] * inverse[8 * k + c];
    }
    store(block + 8 * c, top);
    store(block + 8 * c + 4, bottom);
  }
}

/// Columns with the same rows below them, which are treated as one; at most this many.
constexpr std::size_t kWidestPanel = 8;

/// How many columns from `first` on have, each without its diagonal, the rows of the next one.
STDC_INLINE std::size_t panel_width(const BlockColumns& columns, std::size_t first) {
  const auto count = [&](std::size_t c) { return columns.start[c + 1] - columns.start[c]; };
  std::size_t width = 1;
  while (width < kWidestPanel && first + width < columns.size) {
    const std::size_t last = first + width - 1;
    // The rows of a column are among those of its first one below the diagonal: equal if as many.
    const bool is_next =
        count(last) > 1 && columns.row[columns.start[last] + 1] == static_cast<int>(last + 1);
    if (!is_next || count(last) != count(last + 1) + 1) break;
    ++width;
  }
  return width;
}

/// target -= sum over the first `width` columns m of a panel of L(row, m) L(column, m)^T; `start`: of the
/// panel's columns; rows are counted from the first column's diagonal.
STDC_INLINE void subtract_panel(double* target, const double* blocks, const std::uint32_t* start,
                                std::size_t width, std::size_t row, std::size_t column) {
  Lanes top[6], bottom[6];
  for (int c = 0; c < 6; ++c) top[c] = load(target + 8 * c), bottom[c] = load(target + 8 * c + 4);
  for (std::size_t m = 0; m < width; ++m) {
    const double* a = blocks + kBlock * (start[m] + row - m);
    const double* b = blocks + kBlock * (start[m] + column - m);
#pragma GCC unroll 1
    for (int k = 0; k < 6; ++k) {
      const Lanes low = load(a + 8 * k), high = load(a + 8 * k + 4);
      for (int c = 0; c < 6; ++c) {
        top[c] -= low * b[8 * k + c];
        bottom[c] -= high * b[8 * k + c];
      }
    }
  }
  for (int c = 0; c < 6; ++c) store(target + 8 * c, top[c]), store(target + 8 * c + 4, bottom[c]);
}

bool factorise(const BlockColumns& columns, double* blocks) {
  for (std::size_t first = 0; first < columns.size;) {
    const std::size_t width = panel_width(columns, first);
    const std::uint32_t* start = columns.start + first;
    const std::size_t rows = start[1] - start[0];
    for (std::size_t m = 0; m < width; ++m) {
      for (std::size_t r = m; r < rows && m > 0; ++r) {
        subtract_panel(blocks + kBlock * (start[m] + r - m), blocks, start, m, r, m);
      }
      double* diagonal = blocks + kBlock * start[m];
      if (!invert_factor(diagonal)) return false;
      for (std::size_t r = m + 1; r < rows; ++r) multiply_transposed(diagonal + kBlock * (r - m), diagonal);
    }
    const std::int32_t* row = columns.row + start[0];
    for (std::size_t c = width; c < rows; ++c) {
      // The column that row c stands for holds, by the fill, every row from there on.
      std::size_t target = columns.start[row[c]];
      for (std::size_t r = c; r < rows; ++r) {
        while (columns.row[target] != row[r]) ++target;
        subtract_panel(blocks + kBlock * target, blocks, start, width, r, c);
      }
    }
    first += width;
  }
  return true;
}

void solve(const BlockColumns& columns, const double* blocks, double* x) {
  for (std::size_t j = 0; j < columns.size; ++j) {
    const double* inverse = blocks + kBlock * columns.start[j];
    Lanes low = all(0.0), high = all(0.0);
    double* xj = x + kSegment * j;
    for (int k = 0; k < 6; ++k)
      low += load(inverse + 8 * k) * xj[k], high += load(inverse + 8 * k + 4) * xj[k];
    store(xj, low);
    store(xj + 4, high);
    for (std::size_t b = columns.start[j] + 1; b < columns.start[j + 1]; ++b) {
      double* xi = x + kSegment * static_cast<std::size_t>(columns.row[b]);
      low = load(xi), high = load(xi + 4);
      for (int k = 0; k < 6; ++k) {
        low -= load(blocks + kBlock * b + 8 * k) * xj[k];
        high -= load(blocks + kBlock * b + 8 * k + 4) * xj[k];
      }
      store(xi, low);
      store(xi + 4, high);
    }
  }
  for (std::size_t j = columns.size; j-- > 0;) {
    double* xj = x + kSegment * j;
    for (std::size_t b = columns.start[j] + 1; b < columns.start[j + 1]; ++b) {
      const double* xi = x + kSegment * static_cast<std::size_t>(columns.row[b]);
      for (int c = 0; c < 6; ++c) {
        for (int r = 0; r < 6; ++r) xj[c] -= blocks[kBlock * b + 8 * c + r] * xi[r];
      }
    }
    const double* inverse = blocks + kBlock * columns.start[j];
    double result[6];
    for (int c = 0; c < 6; ++c) {
      result[c] = 0;
      for (int r = c; r < 6; ++r) result[c] += inverse[8 * c + r] * xj[r];
    }
    for (int c = 0; c < 6; ++c) xj[c] = result[c];
  }
}
