// Elimination of the points of a bundle adjustment. Included by the kernel sources only, inside of their
// namespace. Notation: V the 3x3 Hessian of a point, V_i the share of observation i, d_i = point - centre of
// its camera, G_i = [I; [d_i]_x], so that the camera's Hessian is G_i V_i G_i^T and the mixed one G_i V_i.

/// out = a x b.
STDC_INLINE void cross(const double* a, const double* b, double* out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

STDC_INLINE double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// One observation out of its group of four: V_i as a full matrix, and its gradient.
struct Term {
  double v[3][3], g[3];
};

STDC_INLINE void read_term(const BundleTerm* terms, std::size_t observation, Term* out) {
  const BundleTerm& four = terms[observation / kLanes];
  const std::size_t lane = observation % kLanes;
  out->v[0][0] = four.hessian[0][lane];
  out->v[0][1] = out->v[1][0] = four.hessian[1][lane];
  out->v[0][2] = out->v[2][0] = four.hessian[2][lane];
  out->v[1][1] = four.hessian[3][lane];
  out->v[1][2] = out->v[2][1] = four.hessian[4][lane];
  out->v[2][2] = four.hessian[5][lane];
  for (int k = 0; k < 3; ++k) out->g[k] = four.gradient[k][lane];
}

/// Inverse of the Cholesky factor of a damped point Hessian: lower triangle row by row.
struct PointFactor {
  double l[6];   ///< L^-1 = [l0; l1 l2; l3 l4 l5]
  double y[3];   ///< L^-1 g
  bool is_seen;  ///< false: nothing that takes part sees the point
};

STDC_INLINE void factor_point(const BundleTerm* terms, std::size_t begin, std::size_t end, double damping,
                              PointFactor* factor, PointSystem* system) {
  double v[6] = {}, g[3] = {};
  for (std::size_t o = begin; o < end; ++o) {
    const BundleTerm& four = terms[o / kLanes];
    const std::size_t lane = o % kLanes;
    for (int k = 0; k < 6; ++k) v[k] += four.hessian[k][lane];
    for (int k = 0; k < 3; ++k) g[k] += four.gradient[k][lane];
  }
  const double trace = v[0] + v[3] + v[5];
  factor->is_seen = trace > 0;
  *system = {};
  if (!factor->is_seen) return;
  // A share of the trace keeps the matrix definite where a point is seen along one ray only.
  const double diagonal[3] = {v[0], v[3], v[5]};
  for (int k = 0; k < 3; ++k) {
    system->damping[k] = damping * (diagonal[k] + 1e-3 * trace);
    system->gradient[k] = g[k];
  }
  double* l = factor->l;
  l[0] = 1.0 / __builtin_sqrt(v[0] + system->damping[0]);
  const double l10 = v[1] * l[0], l20 = v[2] * l[0];
  l[2] = 1.0 / __builtin_sqrt(v[3] + system->damping[1] - l10 * l10);
  const double l21 = (v[4] - l20 * l10) * l[2];
  l[5] = 1.0 / __builtin_sqrt(v[5] + system->damping[2] - l20 * l20 - l21 * l21);
  l[1] = -l10 * l[0] * l[2];
  l[4] = -l21 * l[2] * l[5];
  l[3] = -(l20 * l[0] + l21 * l[1]) * l[5];
  factor->y[0] = l[0] * g[0];
  factor->y[1] = l[1] * g[0] + l[2] * g[1];
  factor->y[2] = l[3] * g[0] + l[4] * g[1] + l[5] * g[2];
  double* inverse = system->inverse;  // L^-T L^-1
  inverse[0] = l[0] * l[0] + l[1] * l[1] + l[3] * l[3];
  inverse[1] = l[1] * l[2] + l[3] * l[4];
  inverse[2] = l[3] * l[5];
  inverse[3] = l[2] * l[2] + l[4] * l[4];
  inverse[4] = l[4] * l[5];
  inverse[5] = l[5] * l[5];
}

/// Adds an observation to the diagonal block of its camera and to the camera's gradients, and writes
/// Q_i = G_i V_i L^-T, three columns of eight.
STDC_INLINE void add_moving(const Term& term, const double* d, const PointFactor& factor, double* block,
                            double* gradient, double* reduced, double* diagonal, double* q) {
  const double* l = factor.l;
  double n[3][3], m[3][3];  // V_i - P P^T and [d]_x (V_i - P P^T) by columns
  for (int r = 0; r < 3; ++r) {
    q[r] = term.v[r][0] * l[0];
    q[8 + r] = term.v[r][0] * l[1] + term.v[r][1] * l[2];
    q[16 + r] = term.v[r][0] * l[3] + term.v[r][1] * l[4] + term.v[r][2] * l[5];
  }
  for (int k = 0; k < 3; ++k) {
    cross(d, q + 8 * k, q + 8 * k + 3);
    q[8 * k + 6] = q[8 * k + 7] = 0;
  }
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      n[c][r] = term.v[r][c] - (q[r] * q[c] + q[8 + r] * q[8 + c] + q[16 + r] * q[16 + c]);
    }
    cross(d, n[c], m[c]);
    for (int r = 0; r < 3; ++r) {
      block[8 * c + r] += n[c][r];
      block[8 * c + 3 + r] += m[c][r];
    }
  }
  for (int r = 0; r < 3; ++r) {  // the lower right part is symmetric, so its rows serve as its columns
    const double row[3] = {m[0][r], m[1][r], m[2][r]};
    double corner[3];
    cross(d, row, corner);
    for (int c = 0; c < 3; ++c) block[8 * (3 + r) + 3 + c] += corner[c];
  }
  double turn[3];
  cross(d, term.g, turn);
  for (int k = 0; k < 3; ++k) {
    gradient[k] += term.g[k];
    gradient[3 + k] += turn[k];
    diagonal[k] += term.v[k][k];
  }
  const auto& v = term.v;
  diagonal[3] += d[1] * d[1] * v[2][2] - 2 * d[1] * d[2] * v[1][2] + d[2] * d[2] * v[1][1];
  diagonal[4] += d[2] * d[2] * v[0][0] - 2 * d[0] * d[2] * v[0][2] + d[0] * d[0] * v[2][2];
  diagonal[5] += d[0] * d[0] * v[1][1] - 2 * d[0] * d[1] * v[0][1] + d[1] * d[1] * v[0][0];
  for (int k = 0; k < 6; ++k) {
    reduced[k] -= q[k] * factor.y[0] + q[8 + k] * factor.y[1] + q[16 + k] * factor.y[2];
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

/// d = point - centre of the camera of an observation.
STDC_INLINE void offset(const SchurInput& in, std::size_t observation, const double* position, double* d) {
  const BundleView& view = in.views[in.fours[observation / kLanes].pose[observation % kLanes]];
  for (int k = 0; k < 3; ++k) d[k] = position[k] - view.rows[k][3];
}

void eliminate_points(const SchurInput& in, const SchurOutput& out) {
  const std::uint32_t* pair = in.pair_block;
  for (std::size_t p = 0; p < in.point_count; ++p) {
    const std::size_t begin = in.point_start[p], end = in.point_start[p + 1];
    PointFactor factor;
    factor_point(in.terms, begin, end, in.damping, &factor, &out.points[p]);
    std::size_t first = begin;
    while (first < end && in.slot[first] < 0) ++first;
    const std::size_t moving = end - first;
    if (!factor.is_seen) {
      pair += moving * (moving - (moving > 0 ? 1 : 0)) / 2;
      continue;
    }
    for (std::size_t i = 0; i < moving; ++i) {
      const std::size_t o = first + i;
      const std::size_t slot = static_cast<std::size_t>(in.slot[o]);
      Term term;
      double d[3];
      read_term(in.terms, o, &term);
      offset(in, o, in.points[p].position, d);
      double* q = out.scratch + 24 * i;
      add_moving(term, d, factor, out.blocks + kBlock * in.diagonal_block[slot],
                 out.gradient + kSegment * slot, out.reduced_gradient + kSegment * slot,
                 out.diagonal + kSegment * slot, q);
      for (std::size_t j = 0; j < i; ++j) {
        double* block = out.blocks + kBlock * *pair++;
        subtract_outer(block, q, out.scratch + 24 * j);
        // The same camera twice: the lower triangle needs both halves of the product.
        if (in.slot[first + j] == in.slot[o]) subtract_outer(block, out.scratch + 24 * j, q);
      }
    }
  }
}

double substitute_points(const SchurInput& in, const PointSystem* systems, const double* steps,
                         BundlePoint* moved) {
  double expected = 0;
  for (std::size_t p = 0; p < in.point_count; ++p) {
    const double* position = in.points[p].position;
    const PointSystem& system = systems[p];
    double s[3] = {system.gradient[0], system.gradient[1], system.gradient[2]};
    for (std::size_t o = in.point_start[p]; o < in.point_start[p + 1]; ++o) {
      if (in.slot[o] < 0) continue;
      const double* step = steps + kSegment * static_cast<std::size_t>(in.slot[o]);
      Term term;
      double d[3], motion[3];
      read_term(in.terms, o, &term);
      offset(in, o, position, d);
      cross(step + 3, d, motion);
      for (int k = 0; k < 3; ++k) motion[k] += step[k];
      for (int k = 0; k < 3; ++k) s[k] += dot(term.v[k], motion);
    }
    const double* v = system.inverse;
    const double change[3] = {-(v[0] * s[0] + v[1] * s[1] + v[2] * s[2]),
                              -(v[1] * s[0] + v[3] * s[1] + v[4] * s[2]),
                              -(v[2] * s[0] + v[4] * s[1] + v[5] * s[2])};
    for (int k = 0; k < 3; ++k) {
      moved[p].position[k] = position[k] + change[k];
      expected += change[k] * (system.damping[k] * change[k] - system.gradient[k]);
    }
    moved[p].position[3] = 0;
  }
  return expected;
}
