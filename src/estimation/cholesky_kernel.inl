// Block Cholesky factorisation (right-looking, by columns) and solution. Included by the kernel sources only,
// inside of their namespace.

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

/// block -= rows * columns^T.
STDC_INLINE void subtract_product(double* block, const double* rows, const double* columns) {
  for (int c = 0; c < 6; ++c) {
    Lanes top = load(block + 8 * c), bottom = load(block + 8 * c + 4);
    for (int k = 0; k < 6; ++k) {
      top -= load(rows + 8 * k) * columns[8 * k + c];
      bottom -= load(rows + 8 * k + 4) * columns[8 * k + c];
    }
    store(block + 8 * c, top);
    store(block + 8 * c + 4, bottom);
  }
}

bool factorise(const BlockColumns& columns, double* blocks) {
  for (std::size_t j = 0; j < columns.size; ++j) {
    const std::size_t begin = columns.start[j], end = columns.start[j + 1];
    double* diagonal = blocks + kBlock * begin;
    if (!invert_factor(diagonal)) return false;
    for (std::size_t b = begin + 1; b < end; ++b) multiply_transposed(blocks + kBlock * b, diagonal);
    for (std::size_t c = begin + 1; c < end; ++c) {
      // The column that row c stands for holds, by the fill, every row from there on.
      std::size_t target = columns.start[columns.row[c]];
      for (std::size_t r = c; r < end; ++r) {
        while (columns.row[target] != columns.row[r]) ++target;
        subtract_product(blocks + kBlock * target, blocks + kBlock * r, blocks + kBlock * c);
      }
    }
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
