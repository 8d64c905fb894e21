// Elimination of the points of a bundle adjustment. Included by the kernel sources only, inside of their
// namespace. Notation: V the 3x3 Hessian of a point, damped, V = L L^T; V_i and g_i the shares of observation
// i; d_i = point - centre of its camera, G_i = [I; [d_i]_x]. Eliminating the point leaves to the cameras
//   block (i, j): [i = j] G_i V_i G_i^T - Q_i Q_j^T,  gradient: G_i g_i - Q_i L^-1 g,  Q_i = G_i V_i L^-T.

/// out = a x b.
STDC_INLINE void cross(const Lanes* a, const Lanes* b, Lanes* out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/// Twelve numbers of each of four records (three vectors) become twelve lanes.
STDC_INLINE void gather12(const double* a, const double* b, const double* c, const double* d, Lanes* out) {
  for (int k = 0; k < 12; k += 4) transpose(load(a + k), load(b + k), load(c + k), load(d + k), out + k);
}

/// Upper triangle of a symmetric 3x3 matrix row by row as a full one.
STDC_INLINE void expand_symmetric(const double (*packed)[kLanes], Lanes (*full)[3]) {
  full[0][0] = load(packed[0]);
  full[0][1] = full[1][0] = load(packed[1]);
  full[0][2] = full[2][0] = load(packed[2]);
  full[1][1] = load(packed[3]);
  full[1][2] = full[2][1] = load(packed[4]);
  full[2][2] = load(packed[5]);
}

/// Adds the Hessians and gradients of the observations begin..end.
STDC_INLINE void add_terms(const BundleTerm* terms, std::size_t begin, std::size_t end, double* total) {
  for (std::size_t o = begin; o < end; ++o) {
    const double* first = &terms[o / kLanes].hessian[0][o % kLanes];
    for (int k = 0; k < 9; ++k) total[k] += first[k * kLanes];
  }
}

/// Damps and factorises four points. Points that nothing in use sees get zeros.
STDC_INLINE void factor_four(const double (*sums)[kLanes], double damping, PointFactor* factors) {
  Lanes v[6], out[12];
  for (int k = 0; k < 6; ++k) v[k] = load(sums[k]);
  const Lanes trace = v[0] + v[3] + v[5];
  const Lanes seen = trace > 0.0 ? all(1.0) : all(0.0);
  // A share of the trace keeps the matrix definite where a point is seen along one ray only.
  out[9] = damping * (v[0] + 1e-3 * trace);
  out[10] = damping * (v[3] + 1e-3 * trace);
  out[11] = damping * (v[5] + 1e-3 * trace);
  for (int k = 0; k < 3; ++k) out[6 + k] = load(sums[6 + k]);
  Lanes* l = out;
  const Lanes unseen = 1.0 - seen;
  l[0] = seen / square_root(v[0] + out[9] + unseen);
  const Lanes l10 = v[1] * l[0], l20 = v[2] * l[0];
  l[2] = seen / square_root(v[3] + out[10] - l10 * l10 + unseen);
  const Lanes l21 = (v[4] - l20 * l10) * l[2];
  l[5] = seen / square_root(v[5] + out[11] - l20 * l20 - l21 * l21 + unseen);
  l[1] = -l10 * l[0] * l[2];
  l[4] = -l21 * l[2] * l[5];
  l[3] = -(l20 * l[0] + l21 * l[1]) * l[5];
  for (int k = 0; k < 12; k += 4) {
    Lanes rows[4];
    transpose(out[k], out[k + 1], out[k + 2], out[k + 3], rows);
    for (int p = 0; p < kLanes; ++p) store(factors[p].inverse + k, rows[p]);
  }
}

void factor_points(const SchurInput& in, PointFactor* factors) {
  for (std::size_t p = 0; p < in.point_count; p += kLanes) {
    alignas(32) double sums[9][kLanes] = {};
    for (std::size_t lane = 0; lane < kLanes && p + lane < in.point_count; ++lane) {
      double total[9] = {};
      add_terms(in.terms, in.moving_start[p + lane], in.moving_start[p + lane + 1], total);
      add_terms(in.terms, in.fixed_start[p + lane], in.fixed_start[p + lane + 1], total);
      for (int k = 0; k < 9; ++k) sums[k][lane] = total[k];
    }
    factor_four(sums, in.damping, factors + p);
  }
}

/// What four observations leave to their cameras, in the order of CameraSum, and Q_i column by column.
STDC_INLINE void reduce_four(const BundleTerm& term, const Lanes* factor, Lanes* sums, Lanes* q) {
  const Lanes* l = factor;
  const Lanes* g = factor + 6;
  const Lanes y[3] = {l[0] * g[0], l[1] * g[0] + l[2] * g[1], l[3] * g[0] + l[4] * g[1] + l[5] * g[2]};
  const Lanes d[3] = {load(term.offset[0]), load(term.offset[1]), load(term.offset[2])};
  Lanes v[3][3];
  expand_symmetric(term.hessian, v);
  for (int r = 0; r < 3; ++r) {
    q[r] = v[r][0] * l[0];
    q[8 + r] = v[r][0] * l[1] + v[r][1] * l[2];
    q[16 + r] = v[r][0] * l[3] + v[r][1] * l[4] + v[r][2] * l[5];
  }
  for (int k = 0; k < 3; ++k) cross(d, q + 8 * k, q + 8 * k + 3);
  Lanes n[3][3], m[3][3];  // V_i - P P^T by columns (P: top of Q), and [d]_x times it
  for (int c = 0; c < 3; ++c) {
    for (int r = c; r < 3; ++r) {
      n[c][r] = n[r][c] = v[r][c] - (q[r] * q[c] + q[8 + r] * q[8 + c] + q[16 + r] * q[16 + c]);
      sums[r * (r + 1) / 2 + c] = n[c][r];
    }
  }
  for (int c = 0; c < 3; ++c) cross(d, n[c], m[c]);
  for (int r = 0; r < 3; ++r) {
    Lanes* row = sums + (3 + r) * (4 + r) / 2;
    for (int c = 0; c < 3; ++c) row[c] = m[c][r];
    cross(d, row, row + 3);  // of [d]_x n [d]_x^T; what is right of the diagonal the next row overwrites
  }
  const Lanes gradient[3] = {load(term.gradient[0]), load(term.gradient[1]), load(term.gradient[2])};
  for (int r = 0; r < 3; ++r) sums[21 + r] = gradient[r];
  cross(d, gradient, sums + 24);
  for (int r = 0; r < 6; ++r) {
    sums[27 + r] = -(q[r] * y[0] + q[8 + r] * y[1] + q[16 + r] * y[2]);
    sums[33 + r] = q[r] * q[r] + q[8 + r] * q[8 + r] + q[16 + r] * q[16 + r];
  }
  sums[39] = all(0.0);
  for (int c = 0; c < 24; c += 8) q[c + 6] = q[c + 7] = all(0.0);
}

/// Adds the moving observations begin..end to their cameras; their Q go to `scratch`.
STDC_INLINE void reduce_range(const SchurInput& in, const SchurOutput& out, std::size_t begin,
                              std::size_t end) {
  alignas(32) double nowhere[40];  // takes what lanes outside of the range give
  for (std::size_t first = begin / kLanes * kLanes; first < end; first += kLanes) {
    const std::int32_t* point = in.packets[first / kLanes].point;
    Lanes factor[12], sums[40], q[24], rows[4];
    gather12(out.factors[point[0]].inverse, out.factors[point[1]].inverse, out.factors[point[2]].inverse,
             out.factors[point[3]].inverse, factor);
    reduce_four(in.terms[first / kLanes], factor, sums, q);
    double *camera[kLanes], *column[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t o = first + lane;
      const bool inside = o >= begin && o < end;
      camera[lane] = inside ? out.cameras[in.slot[o]].block : nowhere;
      column[lane] = inside ? out.scratch + kScratch * (o - begin) : nowhere;
    }
    for (int k = 0; k < 40; k += 4) {
      transpose(sums[k], sums[k + 1], sums[k + 2], sums[k + 3], rows);
      for (int l = 0; l < kLanes; ++l) store(camera[l] + k, load(camera[l] + k) + rows[l]);
    }
    for (int k = 0; k < 24; k += 4) {
      transpose(q[k], q[k + 1], q[k + 2], q[k + 3], rows);
      for (int l = 0; l < kLanes; ++l) store(column[l] + k, rows[l]);
    }
  }
}

/// block -= rows * columns^T, both with three columns of eight.
STDC_INLINE void subtract_outer(double* block, const double* rows, const double* columns) {
  const Lanes low[3] = {load(rows), load(rows + 8), load(rows + 16)};
  const Lanes high[3] = {load(rows + 4), load(rows + 12), load(rows + 20)};
  for (int c = 0; c < 6; ++c) {
    Lanes top = load(block + 8 * c), bottom = load(block + 8 * c + 4);
    for (int k = 0; k < 3; ++k) {
      top -= low[k] * columns[8 * k + c];
      bottom -= high[k] * columns[8 * k + c];
    }
    store(block + 8 * c, top);
    store(block + 8 * c + 4, bottom);
  }
}

void eliminate_points(const SchurInput& in, const SchurOutput& out) {
  factor_points(in, out.factors);
  const std::uint32_t* pair = in.pair_block;
  for (std::size_t p = 0; p < in.point_count;) {
    // As many points as leave their Q in the first cache.
    const std::size_t begin = in.moving_start[p];
    std::size_t last = p + 1;
    while (last < in.point_count && in.moving_start[last + 1] - begin <= kChunk) ++last;
    reduce_range(in, out, begin, in.moving_start[last]);
    for (; p < last; ++p) {
      const double* q = out.scratch + kScratch * (in.moving_start[p] - begin);
      const std::size_t moving = in.moving_start[p + 1] - in.moving_start[p];
      for (std::size_t i = 1; i < moving; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          subtract_outer(out.blocks + kBlock * *pair++, q + kScratch * i, q + kScratch * j);
        }
      }
    }
  }
}

double substitute_points(const SchurInput& in, const PointFactor* factors, const double* steps,
                         BundlePoint* moved) {
  // First the right-hand sides, g + sum V_i G_i^T step, are gathered in `moved`.
  for (std::size_t p = 0; p < in.point_count; ++p) {
    for (int k = 0; k < 3; ++k) moved[p].position[k] = factors[p].gradient[k];
  }
  const std::size_t moving = in.moving_start[in.point_count];
  for (std::size_t first = 0; first < moving; first += kLanes) {
    const BundleTerm& term = in.terms[first / kLanes];
    const double* s[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      s[lane] = steps + kSegment * static_cast<std::size_t>(in.slot[first + lane]);
    }
    Lanes step[8], v[3][3], motion[3];
    transpose(load(s[0]), load(s[1]), load(s[2]), load(s[3]), step);
    transpose(load(s[0] + 4), load(s[1] + 4), load(s[2] + 4), load(s[3] + 4), step + 4);
    const Lanes d[3] = {load(term.offset[0]), load(term.offset[1]), load(term.offset[2])};
    cross(step + 3, d, motion);
    for (int k = 0; k < 3; ++k) motion[k] += step[k];
    expand_symmetric(term.hessian, v);
    Lanes push[3];
    for (int k = 0; k < 3; ++k) push[k] = v[k][0] * motion[0] + v[k][1] * motion[1] + v[k][2] * motion[2];
    const std::size_t lanes = moving - first < kLanes ? moving - first : kLanes;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      double* sum = moved[in.packets[first / kLanes].point[lane]].position;
      for (int k = 0; k < 3; ++k) sum[k] += push[k][lane];
    }
  }
  double expected = 0;
  for (std::size_t p = 0; p < in.point_count; ++p) {
    const double *l = factors[p].inverse, *s = moved[p].position;
    const double y[3] = {l[0] * s[0], l[1] * s[0] + l[2] * s[1], l[3] * s[0] + l[4] * s[1] + l[5] * s[2]};
    const double change[3] = {-(l[0] * y[0] + l[1] * y[1] + l[3] * y[2]), -(l[2] * y[1] + l[4] * y[2]),
                              -l[5] * y[2]};
    for (int k = 0; k < 3; ++k) {
      moved[p].position[k] = in.points[p].position[k] + change[k];
      expected += change[k] * (factors[p].damping[k] * change[k] - factors[p].gradient[k]);
    }
    moved[p].position[3] = 0;
  }
  return expected;
}
